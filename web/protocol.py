#!/usr/bin/env python3
# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
Write ``web/src/protocol.ts``, the page's side of the protocol, from the node's.

Run it after every change of one of :data:`MESSAGES` or :data:`BINARY`, in a shell with
``scripts/activate``::

    python web/protocol.py            # writes it
    python web/protocol.py --check    # says whether it is up to date; exit code 1: it is not

The rules:

- a dataclass of :data:`MESSAGES` becomes an interface. Its ``type`` is the message's, or one of
  ``types``; a field of a message from pages that has a default may be left out, those of the node
  are always there;
- ``X: TypeAlias = …`` becomes an exported type, and those of other modules that are used, such as
  ``Vector``, too; one that stands for a plain type, such as a float, is replaced by it;
- a public constant in capitals, a number or a string, becomes an exported constant;
- docstrings, and comments that begin with ``#:``, become the documentation.
"""

import argparse
import ast
from collections.abc import Iterator
from dataclasses import fields, is_dataclass, MISSING
from importlib import import_module
import inspect
import io
import json
from pathlib import Path
import sys
import tokenize
import types
from typing import Any

from amr_description.viewer import (
    bags,
    forms,
    introspection,
    marks,
    navigation,
    protocol,
    requests,
    samples,
    states,
)

MESSAGES = (protocol, introspection, forms, marks, navigation, bags, requests)
"""Modules whose dataclasses and types are in text frames, or in the heads of binary ones."""
BINARY = (states, samples)
"""Modules of binary frames: their constants alone are for the page."""
TARGET = Path(__file__).with_name('src') / 'protocol.ts'
WIDTH = 100
_PLAIN = {
    'str': 'string',
    'float': 'number',
    'int': 'number',
    'bool': 'boolean',
    'object': 'unknown',
    'Any': 'unknown',
}


def main() -> int:
    """Write the file, or check it; return the exit code."""
    parser = argparse.ArgumentParser(description=__doc__.strip().splitlines()[0])
    parser.add_argument('--check', action='store_true', help='write nothing, say what would be')
    text = generate()
    if not parser.parse_args().check:
        TARGET.write_text(text, encoding='utf-8')
    elif TARGET.read_text(encoding='utf-8') != text:
        print(f'{TARGET} is not up to date: run python web/protocol.py', file=sys.stderr)
        return 1
    return 0


def generate() -> str:
    """Return the text of protocol.ts."""
    names = ', '.join(Path(inspect.getfile(module)).name for module in (*MESSAGES, *BINARY))
    parts = [
        '// Copyright 2026 The amr_description authors\n// SPDX-License-Identifier: Apache-2.0\n'
        f'// Written by web/protocol.py from {names} in\n'
        '// amr_description/viewer/; change those and run it: python web/protocol.py\n'
    ]
    foreign: dict[str, str] = {}
    for module in (*MESSAGES, *BINARY):
        section = _Module(module)
        parts += section.declarations()
        foreign |= section.foreign
    parts[2:2] = [text for _, text in sorted(foreign.items())]
    return '\n'.join(parts)


class _Module:
    """One of the sources: what it declares, in its order, and how that is documented."""

    def __init__(self, module: types.ModuleType) -> None:
        text = inspect.getsource(module)
        self._module = module
        self._tree = ast.parse(text)
        self._remarks = dict(_remarks(text))
        self._aliases = {
            node.target.id: _unannotated(node.value)
            for node in self._tree.body
            if isinstance(node, ast.AnnAssign) and isinstance(node.target, ast.Name)
            if node.value and ast.unparse(node.annotation) == 'TypeAlias'
        }
        self._imported = {
            alias.name: node.module
            for node in self._tree.body
            if isinstance(node, ast.ImportFrom) and node.module
            for alias in node.names
        }
        self.foreign: dict[str, str] = {}
        """Declarations of types of other modules, by name."""

    def declarations(self) -> Iterator[str]:
        yield _documentation(ast.get_docstring(self._tree) or '')
        body = self._tree.body
        for node, after in zip(body, [*body[1:], None], strict=True):
            name = _name_of(node)
            value: Any = getattr(self._module, name, None)
            if name.startswith('_'):
                continue
            if isinstance(value, str | int | float) and name.isupper():
                yield _documentation(_docstring(after)) + _constant(name, value)
            elif self._module in BINARY:
                continue
            elif isinstance(node, ast.ClassDef) and is_dataclass(value):
                yield _documentation(ast.get_docstring(node) or '') + self._interface(node, value)
            elif name in self._aliases and not _is_plain(self._aliases[name]):
                yield _documentation(_docstring(after)) + self._alias(name)

    def _interface(self, node: ast.ClassDef, message: Any) -> str:
        lines = [f'export interface {node.name} {{']
        names = (message.type,) if isinstance(getattr(message, 'type', None), str) else ()
        if names := getattr(message, 'types', names):
            lines.append('  type: ' + ' | '.join(f"'{name}'" for name in names) + ';')
        places = {_name_of(each): each for each in node.body if isinstance(each, ast.AnnAssign)}
        for field in fields(message):
            if field.name == 'type':  # of a class with several `types`
                continue
            lines += _documentation(self._remark(places[field.name]), '  ').splitlines()
            may_lack = field.default is not MISSING or field.default_factory is not MISSING
            mark = '?' if may_lack and self._module is requests else ''
            lines.append(f'  {field.name}{mark}: {self._type(places[field.name].annotation)};')
        return '\n'.join([*lines, '}\n'])

    def _alias(self, name: str) -> str:
        parts = list(map(self._type, _members(self._aliases[name])))
        line = f'export type {name} = {" | ".join(parts)};'
        if len(line) <= WIDTH:
            return line + '\n'
        return '\n  | '.join([f'export type {name} =', *parts]) + ';\n'

    def _type(self, kind: ast.expr) -> str:
        """Return an annotation as TypeScript writes it. Raises TypeError."""
        match kind:
            case ast.Constant(value=None):
                return 'null'
            case ast.Constant(value=str(text)):  # of a class that comes later
                return self._type(ast.parse(text, mode='eval').body)
            case ast.Name(id=name):
                return self._named(name)
            case ast.BinOp():
                return ' | '.join(map(self._type, _members(kind)))
            case ast.Subscript(value=ast.Name(id='Literal'), slice=values):
                words = ast.literal_eval(ast.Tuple(_elements(values)))
                return ' | '.join(json.dumps(each).replace('"', "'") for each in words)
            case ast.Subscript(
                value=ast.Name(id='tuple'),
                slice=ast.Tuple(elts=[each, ast.Constant(value=types.EllipsisType())]),
            ):
                inner = self._type(each)
                return f'({inner})[]' if ' | ' in inner else f'{inner}[]'
            case ast.Subscript(value=ast.Name(id='tuple'), slice=values):
                return f'[{", ".join(map(self._type, _elements(values)))}]'
            case ast.Subscript(
                value=ast.Name(id='dict' | 'Mapping'),
                slice=ast.Tuple(elts=[ast.Name(id='str'), value]),
            ):
                return f'Record<string, {self._type(value)}>'
        raise _unknown(kind)

    def _named(self, name: str) -> str:
        """Return a type that has a name; note its declaration if no module of messages has it."""
        if name in _PLAIN:
            return _PLAIN[name]
        if is_dataclass(getattr(self._module, name, None)):
            return name
        home = self
        while name not in home._aliases:
            if name not in home._imported:
                raise _unknown(ast.Name(name))
            home = _Module(import_module(home._imported[name]))
        if _is_plain(home._aliases[name]):
            return home._type(home._aliases[name])
        if home._module not in MESSAGES:
            self.foreign[name] = home._alias(name)
        return name

    def _remark(self, node: ast.stmt) -> str:
        """Return the ``#:`` comment beside a field, or else that above it."""
        beside = self._remarks.get((node.end_lineno or 0, False), '')
        above: list[str] = []
        line = node.lineno - 1
        while (text := self._remarks.get((line, True))) is not None:
            above.insert(0, text)
            line -= 1
        return beside or '\n'.join(above)


def _remarks(text: str) -> Iterator[tuple[tuple[int, bool], str]]:
    """Yield the ``#:`` comments by their line, and whether they have it for themselves."""
    for token in tokenize.generate_tokens(io.StringIO(text).readline):
        if token.type == tokenize.COMMENT and token.string.startswith('#:'):
            alone = not token.line[: token.start[1]].strip()
            yield (token.start[0], alone), token.string[2:].strip()


def _name_of(node: ast.stmt) -> str:
    match node:
        case ast.ClassDef(name=name):
            return name
        case ast.Assign(targets=[ast.Name(id=name)]) | ast.AnnAssign(target=ast.Name(id=name)):
            return name
    return '_'


def _unannotated(kind: ast.expr) -> ast.expr:
    """Return what ``Annotated`` tells two types of one kind apart by: the kind itself."""
    match kind:
        case ast.Subscript(value=ast.Name(id='Annotated'), slice=ast.Tuple(elts=[inner, *_])):
            return inner
    return kind


def _is_plain(kind: ast.expr) -> bool:
    return isinstance(kind, ast.Name) and kind.id in _PLAIN


def _members(kind: ast.expr) -> list[ast.expr]:
    """Return what is left and right of each ``|``."""
    match kind:
        case ast.BinOp(left=left, op=ast.BitOr(), right=right):
            return [*_members(left), *_members(right)]
    return [kind]


def _unknown(kind: ast.expr) -> TypeError:
    text, place = ast.unparse(kind), Path(__file__).name
    return TypeError(f'{text} has no type in TypeScript that {place} knows')


def _elements(inside: ast.expr) -> list[ast.expr]:
    """Return what stands in the brackets of a type."""
    return inside.elts if isinstance(inside, ast.Tuple) else [inside]


def _docstring(after: ast.stmt | None) -> str:
    match after:
        case ast.Expr(value=ast.Constant(value=str(text))):
            return inspect.cleandoc(text)
    return ''


def _constant(name: str, value: str | float) -> str:
    text = f"'{value}'" if isinstance(value, str) else json.dumps(value)
    return f'export const {name} = {text};\n'


def _documentation(text: str, indent: str = '') -> str:
    """Return a comment of a docstring: without the marks of reStructuredText."""
    text = text.replace('``None``', 'null').replace('``', '`').replace('*/', '* /')
    lines = [line.rstrip() for line in text.replace('\n\n::\n', '\n').splitlines()]
    if not lines:
        return ''
    one = f'{indent}/** {lines[0]} */\n'
    if len(lines) == 1 and len(one) <= WIDTH + 1:
        return one
    middle = ''.join(f'{indent} * {line}'.rstrip() + '\n' for line in lines)
    return f'{indent}/**\n{middle}{indent} */\n'


if __name__ == '__main__':
    sys.exit(main())
