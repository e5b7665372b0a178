# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
What the messages consist of that controllers and sensors use.

``definitions.txt`` has their ``.msg`` files, word for word, each behind a line with its type and
the hash of that; a test holds it to be that of the installed packages. Parts of services and
actions are there likewise, without a hash.
"""

from collections.abc import Mapping
from dataclasses import dataclass
from functools import cache
from pathlib import Path
import re
from typing import Any

import yaml

from amr_description.cdr.layouts import CODES, FieldGroup, group, Layout, many, Number, Text

FILE = Path(__file__).with_name('definitions.txt')
_MARK = re.compile(r'^=== (\S+)(?: (\S+))?\n', re.MULTILINE)
_FIELD = re.compile(
    r'(?P<type>[A-Za-z][\w/]*)(?:<=\d+)?(?P<array>\[(?:<=)?\d*\])?\s+(?P<name>[a-z]\w*)'
    r'(?:\s+(?P<default>[^\s=].*))?'
)
NUMBERS: Mapping[str, type] = {
    'bool': bool,
    **dict.fromkeys(('float32', 'float64'), float),
    **dict.fromkeys(('byte', 'char', 'int8', 'uint8', 'int16', 'uint16', 'int32', 'uint32'), int),
    **dict.fromkeys(('int64', 'uint64'), int),
}
"""What a number of these types is in Python."""
_NAMES = {'bool': 'boolean', 'byte': 'octet', 'float32': 'float', 'float64': 'double'}
"""What :data:`CODES` calls these types."""
TEXTS = ('string', 'wstring')


@dataclass(frozen=True, slots=True)
class Field:
    """One field of a message."""

    name: str
    type: str
    """Of :data:`NUMBERS` or :data:`TEXTS`, or ``package/msg/Name``."""
    count: int | None
    """Of an array; None: it is none, or may have any length."""
    is_array: bool
    default: Any
    """As the definition says; None: it does not."""


@cache
def texts() -> dict[str, str]:
    """Return all definitions, by the names of their types."""
    _, *parts = _MARK.split(FILE.read_text(encoding='utf-8'))
    return dict(zip(parts[::3], parts[2::3], strict=True))


@cache
def hashes() -> dict[str, str]:
    """Return the hashes of all types, ``RIHS01_…``, by their names."""
    found = _MARK.findall(FILE.read_text(encoding='utf-8'))
    return {name: value for name, value in found if value}


@cache
def fields_of(name: str) -> tuple[Field, ...]:
    """Return the fields of a message; raises KeyError: its type is not here."""
    package = name.partition('/')[0]
    lines = (line.partition('#')[0].strip() for line in texts()[name].split('\n'))
    found = map(_FIELD.fullmatch, lines)
    return tuple(_field(match, package) for match in found if match)


@cache
def layout_of(name: str) -> FieldGroup:
    """Return how a message is laid out; raises KeyError: its type is not here."""
    return group(name, [(each.name, _layout(each)) for each in fields_of(name)])


def _layout(field: Field) -> Layout:
    element: Layout
    if field.type in NUMBERS:
        name = _NAMES.get(field.type, field.type)
        element = Number(CODES[name], name)
    elif field.type in TEXTS:
        element = Text() if field.type == 'string' else Text(width=4)
    else:
        element = layout_of(field.type)
    return many(element, field.count) if field.is_array else element


def _field(match: re.Match[str], package: str) -> Field:
    kind, array = match['type'], match['array']
    if kind == 'Header':
        kind = 'std_msgs/msg/Header'
    elif kind not in NUMBERS and kind not in TEXTS:
        kind = kind.replace('/', '/msg/') if '/' in kind else f'{package}/msg/{kind}'
    count = array[1:-1] if array and '<' not in array else ''
    default = None if match['default'] is None else yaml.safe_load(match['default'])
    return Field(match['name'], kind, int(count) if count else None, array is not None, default)
