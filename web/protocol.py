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
- ``type X = …`` becomes an exported type, and those of other modules that are used, such as
  ``Vector``, too; one that stands for a plain type, such as a float, is replaced by it;
- a public constant in capitals, a number or a string, becomes an exported constant;
- docstrings, and comments that begin with ``#:``, become the documentation.
"""

import argparse
import ast
from collections.abc import Iterator, Mapping
from dataclasses import fields, is_dataclass, MISSING
import inspect
import io
import json
from pathlib import Path
import sys
import tokenize
import types
import typing
from typing import Any, get_args, get_origin, Literal, TypeAliasType

from amr_description.viewer import (
    bags,
    introspection,
    navigation,
    protocol,
    requests,
    samples,
    states,
)

MESSAGES = (protocol, introspection, navigation, bags, requests)
"""Modules whose dataclasses and types are in text frames, or in the heads of binary ones."""
BINARY = (states, samples)
"""Modules of binary frames: their constants alone are for the page."""
TARGET = Path(__file__).with_name('src') / 'protocol.ts'
WIDTH = 100
_PLAIN = {
    str: 'string',
    float: 'number',
    int: 'number',
    bool: 'boolean',
    types.NoneType: 'null',
    object: 'unknown',
    Any: 'unknown',
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
            elif isinstance(node, ast.TypeAlias) and not _is_plain(value):
                yield _documentation(_docstring(after)) + self._alias(name, value)

    def _interface(self, node: ast.ClassDef, message: Any) -> str:
        lines = [f'export interface {node.name} {{']
        names = (message.type,) if isinstance(getattr(message, 'type', None), str) else ()
        if names := getattr(message, 'types', names):
            lines.append('  type: ' + ' | '.join(f"'{name}'" for name in names) + ';')
        hints = typing.get_type_hints(message)
        places = {_name_of(each): each for each in node.body}
        for field in fields(message):
            if field.name == 'type':  # of a class with several `types`
                continue
            lines += _documentation(self._remark(places[field.name]), '  ').splitlines()
            may_lack = field.default is not MISSING or field.default_factory is not MISSING
            mark = '?' if may_lack and self._module is requests else ''
            lines.append(f'  {field.name}{mark}: {self._type(hints[field.name])};')
        return '\n'.join([*lines, '}\n'])

    def _alias(self, name: str, value: TypeAliasType) -> str:
        line = f'export type {name} = {self._type(value.__value__)};'
        if len(line) <= WIDTH:
            return line + '\n'
        parts = ''.join(f'\n  | {self._type(part)}' for part in get_args(value.__value__))
        return f'export type {name} ={parts};\n'

    def _type(self, kind: Any) -> str:
        """Return a type as TypeScript writes it. Raises TypeError."""
        origin, arguments = get_origin(kind), get_args(kind)
        if isinstance(kind, TypeAliasType):
            if _is_plain(kind):
                return self._type(kind.__value__)
            if kind.__module__ not in {module.__name__ for module in MESSAGES}:
                self.foreign[kind.__name__] = self._alias(kind.__name__, kind)
            return str(kind.__name__)
        if kind in _PLAIN:
            return _PLAIN[kind]
        if is_dataclass(kind):
            return str(getattr(kind, '__name__', ''))
        if origin is Literal:
            return ' | '.join(json.dumps(each).replace('"', "'") for each in arguments)
        if origin in (types.UnionType, typing.Union):
            return ' | '.join(self._type(each) for each in arguments)
        if origin is tuple and arguments[1:] == (...,):
            inner = self._type(arguments[0])
            return f'({inner})[]' if ' | ' in inner else f'{inner}[]'
        if origin is tuple:
            return f'[{", ".join(self._type(each) for each in arguments)}]'
        if origin in (dict, get_origin(Mapping[str, str])) and arguments[0] is str:
            return f'Record<string, {self._type(arguments[1])}>'
        raise TypeError(f'{kind} has no type in TypeScript that {Path(__file__).name} knows')

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
        case ast.ClassDef(name=name) | ast.TypeAlias(name=ast.Name(id=name)):
            return name
        case ast.Assign(targets=[ast.Name(id=name)]) | ast.AnnAssign(target=ast.Name(id=name)):
            return name
    return '_'


def _is_plain(alias: Any) -> bool:
    return alias.__value__ in _PLAIN


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
