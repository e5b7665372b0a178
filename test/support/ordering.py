# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
In which order tests run: as a table of times says, longest files first, or at random by a seed.

The table keeps itself. Every run of whole files writes how long each took to
``build/tests/durations.json``; what is not in there is looked up in ``test/durations.json``, which
a fresh clone has. It is about time only: a wrong line makes a run longer, never another.
"""

from collections import Counter
from collections.abc import Iterable, Mapping, Sequence
import contextlib
import hashlib
import itertools
import json
import math
import os
from pathlib import Path
import tempfile
from typing import Protocol

from support.paths import ROOT, TESTS

SEED_TABLE = TESTS / 'durations.json'
OWN_TABLE = ROOT / 'build' / 'tests' / 'durations.json'


SHARED_FIXTURES = ('browser',)
"""Those of a session that cost more than most tests: files that use one run in few workers."""
MOST_SHARED = 60.0
"""s of a worker, of files that share such a fixture; a run would wait for what takes longer."""


class Item(Protocol):
    """What is used here of a ``pytest.Item``."""

    path: Path
    nodeid: str
    fixturenames: Sequence[str]

    def get_closest_marker(self, name: str) -> object | None:
        """Return the nearest mark of that name."""


def random_place(item: Item, seed: str) -> tuple[bytes, bytes]:
    """
    Return what to sort a test by: files at random, and the tests within a file.

    It depends on the seed and the test's own name alone, so that fewer files, or a file alone, run
    in the same order again. A file marked ``in_order`` stays as it is written.
    """

    def chance(name: str) -> bytes:
        return hashlib.blake2b(f'{seed} {name}'.encode()).digest()

    within = b'' if item.get_closest_marker('in_order') else chance(item.nodeid)
    return chance(item.path.name), within


def groups(items: Iterable[Item], durations: Mapping[str, float]) -> list[Path | str]:
    """
    Return for each test which ones run in the same process: its file, or what files share.

    Files that share a fixture are as many groups as MOST_SHARED asks for, by how long they take.
    """
    items = [*items]
    sharing = {
        item.path: fixture
        for item in items
        for fixture in SHARED_FIXTURES
        if fixture in item.fixturenames
    }
    taken: Counter[str] = Counter()
    names: dict[Path, str] = {}
    for path, fixture in sharing.items():
        duration = duration_of(path, durations)
        for number in itertools.count(1):
            name = f'{fixture} {number}'
            if not taken[name] or taken[name] + duration <= MOST_SHARED:
                break
        names[path] = name
        taken[name] += duration
    return [names.get(item.path, item.path) for item in items]


def read_durations(*tables: Path) -> dict[str, float]:
    """
    Return file below ``test/`` → s of a worker, by the first table that has it.

    A table that is not there, is torn or was written by hand counts for what is sound in it.
    """
    durations: dict[str, float] = {}
    for table in reversed(tables):
        try:
            content = json.loads(table.read_text(encoding='utf-8'))
        except (OSError, ValueError, RecursionError):
            continue
        if isinstance(content, dict):
            durations |= {name: s for name, s in content.items() if _is_duration(s)}
    return durations


def _is_duration(value: object) -> bool:
    return isinstance(value, int | float) and math.isfinite(value) and value >= 0.0


def duration_of(path: Path, durations: Mapping[str, float]) -> float:
    """Return how long a file takes, s; one that has moved is known by its name, a new one is 0."""
    if (name := path_in_tests(path)) in durations:
        return durations[name]
    return max((s for known, s in durations.items() if Path(known).name == path.name), default=0.0)


def path_in_tests(path: Path) -> str:
    """Return how the tables call a file."""
    return path.relative_to(TESTS).as_posix() if path.is_relative_to(TESTS) else path.name


class DurationRecorder:
    """Adds up what the tests of each file take, in the process that hears of all of them."""

    def __init__(self, root: Path) -> None:
        """``root``: what the names of tests are relative to."""
        self._root = root
        self._seconds: Counter[str] = Counter()

    def add(self, nodeid: str, seconds: float) -> None:
        """Add a set-up, a test or a tear-down."""
        self._seconds[nodeid.partition('::')[0]] += seconds

    def write(self, table: Path, files: Iterable[str]) -> None:
        """
        Write the table anew, with what it knew of other files, as long as they are there.

        In one step: a run that is killed, or another one of this checkout, leaves no half of it.

        :param files: All test files, as the tables call them.
        """
        measured = {
            path_in_tests(self._root / file): round(s, 2) for file, s in self._seconds.items()
        }
        durations = read_durations(table) | measured
        known = {name: durations[name] for name in sorted(durations.keys() & set(files))}
        with contextlib.suppress(OSError):  # a full or read-only disk is no test's fault
            table.parent.mkdir(parents=True, exist_ok=True)
            with tempfile.NamedTemporaryFile(
                'w', encoding='utf-8', dir=table.parent, prefix=table.stem, delete=False
            ) as file:
                json.dump(known, file, indent=0)
                file.write('\n')
            os.replace(file.name, table)


def test_files() -> set[str]:
    """All test files, as the tables call them."""
    return {path_in_tests(path) for path in TESTS.rglob('test_*.py')}
