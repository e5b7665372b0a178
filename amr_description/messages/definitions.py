# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
What the messages consist of that controllers and sensors use.

``definitions.txt`` has their ``.msg`` files, word for word, each behind a line with its type; a
test holds it to be that of the installed packages.
"""

from collections.abc import Mapping
from dataclasses import dataclass
from functools import cache
from pathlib import Path
import re
from typing import Any

import yaml

_FILE = Path(__file__).with_name('definitions.txt')
_MARK = re.compile(r'^=== (\S+)\n', re.MULTILINE)
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
    _, *parts = _MARK.split(_FILE.read_text(encoding='utf-8'))
    return dict(zip(parts[::2], parts[1::2], strict=True))


@cache
def fields_of(name: str) -> tuple[Field, ...]:
    """Return the fields of a message; raises KeyError: its type is not here."""
    package = name.partition('/')[0]
    lines = (line.partition('#')[0].strip() for line in texts()[name].split('\n'))
    found = map(_FIELD.fullmatch, lines)
    return tuple(_field(match, package) for match in found if match)


def _field(match: re.Match[str], package: str) -> Field:
    kind, array = match['type'], match['array']
    if kind == 'Header':
        kind = 'std_msgs/msg/Header'
    elif kind not in NUMBERS and kind not in TEXTS:
        kind = kind.replace('/', '/msg/') if '/' in kind else f'{package}/msg/{kind}'
    count = array and array.strip('[<=]')
    default = None if match['default'] is None else yaml.safe_load(match['default'])
    return Field(match['name'], kind, int(count) if count else None, array is not None, default)
