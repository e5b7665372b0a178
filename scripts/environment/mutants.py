# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
``mutants.py [FOLDER ...] [--sample N] [--seed S]``: whether a test would notice a fault.

A mutant is the package with one place of its code changed, as a slip of a hand would: a sign, a
comparison, a number, a condition. The tests of its folder in ``test/unit`` are to fail with it;
for what stands in a folder ``ros``, those in ``test/ros``.
Places are drawn at random, of each folder as many, and at each place one of the changes that
cosmic-ray knows. Nothing is written: a mutant is a process that imports the changed text.
"""

from __future__ import annotations

import argparse
import ast
from collections import Counter
from collections.abc import Iterator, Sequence
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass
import importlib.abc
import importlib.machinery
import importlib.util
import os
from pathlib import Path
import random
import subprocess
import sys
from types import CodeType, ModuleType

import cosmic_ray.ast
from cosmic_ray.operators.operator import Operator
from cosmic_ray.operators.provider import OperatorProvider
from parso.tree import NodeOrLeaf

ROOT = Path(__file__).resolve().parents[2]
PACKAGE = 'amr_description'
FOLDERS = ('control', 'controllers', 'model', 'simulation')
JUDGED = ROOT / 'test/judged_mutants.txt'
"""Mutants that no test can tell apart: what they change makes no difference that counts."""
_NOT_ASKED = {'VariableReplacer', 'VariableInserter', 'RemoveDecorator'}
_GUARDS = {'frozen', 'slots', 'strict'}
"""Arguments that guard against faults of later changes: without them all is as before."""
_MORE_TESTS = {'controllers': ['test/unit/base/test_parameters.py']}
"""Where tests of a folder stand elsewhere, too."""
_TIMEOUT = 200.0  # s
Place = tuple[int, int]


@dataclass(frozen=True)
class Mutant:
    """One change at one place."""

    file: str
    operator: str
    occurrence: int
    line: int

    def text(self) -> str:
        """Return the changed text of the module."""
        visitor = _Changing(OperatorProvider()[self.operator](), self.occurrence)
        return str(visitor.walk(_parsed(ROOT / self.file)).get_code())

    def change(self) -> str:
        """Return the changed line, as it was and as it is."""
        before, after = (ROOT / self.file).read_text().splitlines(), self.text().splitlines()
        pairs = zip(before, [*after, *[''] * len(before)], strict=False)
        old, new = next((pair for pair in pairs if pair[0] != pair[1]), ('', ''))
        return f'{self.file}: {" ".join(old.split())} -> {" ".join(new.split())}'


class _Changing(cosmic_ray.ast.Visitor):
    def __init__(self, operator: Operator, occurrence: int) -> None:
        self._operator = operator
        self._left = occurrence

    def visit(self, node: NodeOrLeaf) -> NodeOrLeaf | None:
        for index, _ in enumerate(self._operator.mutation_positions(node)):
            if self._left == 0:
                self._left = -1
                return self._operator.mutate(node, index)
            self._left -= 1
        return node


def _parsed(path: Path) -> NodeOrLeaf:
    return cosmic_ray.ast.get_ast(path.read_text())


def mutants_by_place(path: Path) -> dict[Place, list[Mutant]]:
    """Return all mutants of a module by line and column, without those of hints and guards."""
    nodes = list(cosmic_ray.ast.ast_nodes(_parsed(path)))
    left_out = _left_out(path.read_text())
    found: dict[Place, list[Mutant]] = {}
    provider = OperatorProvider()
    for name in sorted(set(provider) - _NOT_ASKED):
        operator = provider[name]()
        places = (place for node in nodes for place, _ in operator.mutation_positions(node))
        for occurrence, place in enumerate(places):
            if not any(begin <= place < end for begin, end in left_out):
                mutant = Mutant(str(path.relative_to(ROOT)), name, occurrence, place[0])
                found.setdefault(place, []).append(mutant)
    return found


def _left_out(text: str) -> list[tuple[Place, Place]]:
    """Return from where to where type hints and guards stand."""
    found: list[ast.AST | None] = []
    for node in ast.walk(ast.parse(text)):
        if isinstance(node, ast.arg | ast.AnnAssign):
            found.append(node.annotation)
        elif isinstance(node, ast.FunctionDef | ast.AsyncFunctionDef):
            found.append(node.returns)
        elif isinstance(node, ast.keyword) and node.arg in _GUARDS:
            found.append(node.value)
    spans = [each for each in found if isinstance(each, ast.expr)]
    return [
        ((each.lineno, each.col_offset), (each.end_lineno or 0, each.end_col_offset or 0))
        for each in spans
    ]


def drawn(folder: str, sample: int, seed: int) -> list[Mutant]:
    """Return so many mutants of a folder of the package, of different places."""
    places = []
    for path in sorted((ROOT / PACKAGE / folder).rglob('*.py')):
        places += sorted(mutants_by_place(path).items())
    dice = random.Random(f'{folder} {seed}')
    return [dice.choice(each) for _, each in dice.sample(places, min(sample, len(places)))]


def is_noticed(mutant: Mutant) -> bool:
    """Return whether a test fails; one that never ends has noticed it too."""
    _, folder, *inner = Path(mutant.file).parts
    tests = [f'test/{"ros" if "ros" in inner else "unit"}/{folder}', *_MORE_TESTS.get(folder, ())]
    here = [sys.executable, __file__, '--run', mutant.file, mutant.operator]
    command = [*here, str(mutant.occurrence), '-x', '-q', '-p', 'no:cacheprovider', *tests]
    with subprocess.Popen(
        command, cwd=ROOT, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL, process_group=0
    ) as process:
        try:
            return process.wait(_TIMEOUT) != 0
        except subprocess.TimeoutExpired:
            os.killpg(process.pid, 9)
            return True


class _Changed(importlib.machinery.SourceFileLoader):
    """Loads a module from the text of a mutant."""

    mutant: Mutant

    def get_code(self, fullname: str) -> CodeType:
        return compile(self.mutant.text(), self.path, 'exec', dont_inherit=True)


class _Finder(importlib.abc.MetaPathFinder):
    def __init__(self, mutant: Mutant) -> None:
        self._path = ROOT / mutant.file
        parts = list(Path(mutant.file).with_suffix('').parts)
        self._name = '.'.join(parts[:-1] if parts[-1] == '__init__' else parts)
        _Changed.mutant = mutant

    def find_spec(
        self, fullname: str, path: object, target: ModuleType | None = None
    ) -> importlib.machinery.ModuleSpec | None:
        if fullname != self._name:
            return None
        return importlib.util.spec_from_file_location(
            fullname, self._path, loader=_Changed(fullname, str(self._path))
        )


def _run(file: str, operator: str, occurrence: str, *arguments: str) -> int:
    """Run pytest with a mutant."""
    import pytest

    sys.path.insert(0, str(ROOT))
    sys.meta_path.insert(0, _Finder(Mutant(file, operator, int(occurrence), 0)))
    return int(pytest.main([*arguments]))


def judged() -> Iterator[str]:
    """Yield the mutants that were judged, one a line; what follows ``#`` says why."""
    for line in JUDGED.read_text().splitlines():
        if text := line.split('  # ')[0].strip():
            yield text


def main(arguments: Sequence[str]) -> int:
    """Print who was not noticed, and a table; return 0 if that is nobody."""
    if arguments[:1] == ['--run']:
        return _run(*arguments[1:])
    parser = argparse.ArgumentParser()
    parser.add_argument('folders', nargs='*', default=FOLDERS, metavar='FOLDER')
    parser.add_argument('--sample', type=int, default=40, metavar='N')
    parser.add_argument('--seed', type=int, default=1, metavar='S')
    args = parser.parse_args(arguments)
    known, rows, survivors = set(judged()), ['| folder | mutants | equal | noticed |'], 0
    rows.append('| --- | --: | --: | --: |')
    for folder in args.folders:
        mutants = drawn(folder, args.sample, args.seed)
        counts: Counter[str] = Counter()
        with ThreadPoolExecutor(len(os.sched_getaffinity(0))) as pool:
            results = pool.map(is_noticed, mutants)
            for mutant, noticed in zip(mutants, results, strict=True):
                equal = not noticed and mutant.change() in known
                counts['noticed' if noticed else 'equal' if equal else 'survived'] += 1
                if not noticed and not equal:
                    print(f'not noticed: {mutant.change()}  # line {mutant.line}', flush=True)
        asked = len(mutants) - counts['equal']
        share = 100 * counts['noticed'] / asked if asked else 100.0
        rows.append(f'| {folder} | {len(mutants)} | {counts["equal"]} | {share:.0f} % |')
        survivors += counts['survived']
    print('\n'.join(rows))
    return int(survivors > 0)


if __name__ == '__main__':
    sys.exit(main(sys.argv[1:]))
