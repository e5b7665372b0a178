# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""A message -> YAML or CSV, as ``ros2 topic echo`` prints it."""

import array
from contextlib import suppress
from dataclasses import dataclass
from functools import lru_cache
import math
import sys
from typing import Any

from rosidl_parser.definition import (
    AbstractGenericString,
    AbstractSequence,
    AbstractWString,
    Array,
    BoundedSequence,
    NamespacedType,
)
import yaml

from amr_description.ros.message_fields import of_numpy

_CUT = '...'
_KEPT = 200  # letters of a string whose text in YAML is kept for the next message


class _MessageDumper(yaml.SafeDumper):
    """
    Writes each value where it stands, never a reference to an equal one.

    (libyaml's dumper is three times as fast, but escapes emoji and other letters that PyYAML's
    writes as they are. This one takes 0.4 ms for a JointState of four wheels.)
    """

    def ignore_aliases(self, _data: Any) -> bool:
        return True

    def represent_block(self, data: dict[str, Any]) -> yaml.MappingNode:
        """Write the fields of a message below each other, also where arrays are in one line."""
        return self.represent_mapping('tag:yaml.org,2002:map', data, flow_style=False)


_MessageDumper.add_representer(dict, _MessageDumper.represent_block)


@dataclass(frozen=True)
class Style:
    """What of a message is written, and how."""

    truncate_length: int | None = 128
    """Arrays, strings and bytes are cut after so many elements; None: never."""
    arrays: bool = True
    """False: an array's type and length in its place."""
    strings: bool = True
    """False: a string's length in its place."""
    flow_style: bool = False
    """Arrays in one line, ``[a, b]``."""


def to_yaml(message: Any, style: Style = Style()) -> str:  # noqa: B008 (frozen)
    """Return the fields of a message as YAML."""
    return dump_yaml(_mapping(message, style), flow_style=style.flow_style)


def to_plain(message: Any, style: Style) -> dict[str, Any]:
    """Return a message as what YAML knows: mappings, lists, strings, numbers, truths."""
    return _mapping(message, style)


def dump_yaml(value: Any, *, flow_style: bool = False, sort_keys: bool = False) -> str:
    """
    Return plain data as YAML, as PyYAML writes it.

    Most messages are written here, a line for each value: 0.03 ms for a JointState of four wheels,
    for which PyYAML takes 0.45. What may need several lines for a value is left to it.
    """
    if isinstance(value, dict) and value and not (flow_style or sort_keys):
        with suppress(_NotPlainError):
            lines: list[str] = []
            _write(lines, value, '', '')
            return '\n'.join((*lines, ''))
    return dump_with_pyyaml(value, flow_style=flow_style, sort_keys=sort_keys)


def dump_with_pyyaml(value: Any, *, flow_style: bool = False, sort_keys: bool = False) -> str:
    """Return plain data as YAML."""
    return yaml.dump(
        value,
        Dumper=_MessageDumper,
        allow_unicode=True,
        width=sys.maxsize,
        default_flow_style=flow_style,
        sort_keys=sort_keys,
    )


class _NotPlainError(Exception):
    """A value may take several lines, or is of an unusual type."""


def _write(lines: list[str], mapping: dict[str, Any], lead: str, indent: str) -> None:
    """Add the lines of a mapping; ``lead`` stands before the first one, ``indent`` the others."""
    for key, value in mapping.items():
        head = lead + _key(key)
        lead = indent
        if not value or not isinstance(value, dict | list):
            lines.append(f'{head}: {_scalar(value)}')
            continue
        lines.append(f'{head}:')
        if isinstance(value, dict):
            _write(lines, value, indent + '  ', indent + '  ')
            continue
        for element in value:
            if isinstance(element, dict) and element:
                _write(lines, element, indent + '- ', indent + '  ')
            else:
                lines.append(f'{indent}- {_scalar(element)}')


def _scalar(value: Any) -> str:
    """Return a string, number, truth, or an empty list or mapping. Raises _NotPlainError."""
    kind = type(value)
    if kind is float and math.isfinite(value):
        text = repr(value)
        return text if '.' in text else text.replace('e', '.0e')
    if kind is int:
        return str(value)
    if kind is str:
        return (_string if len(value) <= _KEPT else _string.__wrapped__)(value)
    if kind is bool:
        return 'true' if value else 'false'
    if value in ({}, []):
        return str(value)
    raise _NotPlainError


@lru_cache(maxsize=1024)
def _string(text: str) -> str:
    return _line(dump_with_pyyaml([text])).removeprefix('- ')


@lru_cache(maxsize=1024)
def _key(name: str) -> str:
    return _line(dump_with_pyyaml({name: 0})).removesuffix(': 0')


def _line(text: str) -> str:
    line, _, rest = text.partition('\n')
    if rest or line.startswith('?'):
        raise _NotPlainError
    return line


def to_csv(message: Any, style: Style = Style()) -> str:  # noqa: B008 (frozen)
    """Return all values of a message in one line, separated by commas."""
    slots = zip(message.get_fields_and_field_types(), message.SLOT_TYPES, strict=True)
    return ','.join(_cell(getattr(message, name), slot, style) for name, slot in slots)


def _mapping(message: Any, style: Style) -> dict[str, Any]:
    slots = zip(message.get_fields_and_field_types(), message.SLOT_TYPES, strict=True)
    return {name: _plain(getattr(message, name), slot, style) for name, slot in slots}


def _is_array(value: Any) -> bool:
    return isinstance(value, list | tuple | array.array) or of_numpy(value, 'ndarray')


def _plain(value: Any, slot: Any, style: Style) -> Any:
    """Return a value as what YAML knows: mapping, list, string, number, truth."""
    if isinstance(value, str | bytes):
        return _text(value, style)
    if isinstance(value, bool | int | float):
        return value
    if _is_array(value):
        if not style.arrays and slot is not None:
            return _array_summary(value, slot)
        return _list(value, style)
    return value.item() if of_numpy(value, 'number') else _mapping(value, style)


def _list(value: Any, style: Style) -> list[Any]:
    kept = value[: style.truncate_length]
    if isinstance(kept, array.array) or of_numpy(kept, 'ndarray'):
        plain = kept.tolist()
    else:
        plain = [_plain(element, None, style) for element in kept]
    return plain if len(kept) == len(value) else [*plain, _CUT]


def _text(value: str | bytes, style: Style) -> str:
    text = value if isinstance(value, str) else value.decode('latin-1')
    if isinstance(value, str) and not style.strings:
        return f'<string length: <{len(value)}>>'
    if style.truncate_length is None or len(text) <= style.truncate_length:
        return text
    return text[: style.truncate_length] + _CUT


def _cell(value: Any, slot: Any, style: Style) -> str:
    if isinstance(value, str):
        return _text(value, style)
    if isinstance(value, bytes):
        kept = value[: style.truncate_length]
        return str(kept if len(kept) == len(value) else kept + _CUT.encode())
    if _is_array(value):
        if not style.arrays and slot is not None:
            return _array_summary(value, slot)
        kept = value[: style.truncate_length]
        cells = [_cell(element, None, style) for element in kept]
        return ','.join(cells if len(kept) == len(value) else [*cells, _CUT])
    if isinstance(value, bool | int | float) or of_numpy(value, 'number'):
        return str(value)
    return to_csv(value, style)


def _array_summary(value: Any, slot: Any) -> str:
    name = _slot_name(slot.value_type)
    if isinstance(slot, Array):
        return f'<array type: {name}[{slot.size}]>'
    bound = f'[{slot.maximum_size}]' if isinstance(slot, BoundedSequence) else ''
    assert isinstance(slot, AbstractSequence)  # the third kind of nested type there is
    return f'<sequence type: {name}{bound}, length: {len(value)}>'


def _slot_name(slot: Any) -> str:
    if isinstance(slot, NamespacedType):
        return '/'.join(slot.namespaced_name())
    if isinstance(slot, AbstractGenericString):
        return 'wstring' if isinstance(slot, AbstractWString) else 'string'
    return slot.typename
