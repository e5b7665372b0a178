# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
Messages as plain objects: of their defaults, and of what a dict says in the form of the message.

A dict is read as ``ros2 topic pub`` reads its YAML: fields that are not named keep their defaults,
a value of another type is converted as Python does it, what does not fit is an error that names
the field.
"""

from collections.abc import Mapping, Sequence
from functools import cache
import importlib
from typing import Any, TYPE_CHECKING

from amr_description.errors import AmrError
from amr_description.messages.definitions import Field, fields_of, NUMBERS, TEXTS, texts
from amr_description.text import shorten

_TRUTHS = {'true': True, 'yes': True, 'on': True, 'false': False, 'no': False, 'off': False}
_BITS = {'byte': 8, 'char': 8}
_WORDS = {'bool': 'boolean', 'float32': 'float', 'float64': 'double', 'byte': 'octet'}
"""What other messages of ROS call these types."""


class PlainMessage:
    """A message; its fields are attributes."""

    def __init__(self, type_name: str) -> None:
        """Make a message of defaults; raises KeyError: its type is not known."""
        simple, made = _template(type_name)
        values = self.__dict__
        values.update(simple)
        for field in made:
            values[field.name] = _default(field)

    def __repr__(self) -> str:
        return f'PlainMessage({self.__dict__})'

    if TYPE_CHECKING:  # which fields it has, only its definition says

        def __getattr__(self, name: str) -> Any: ...
        def __setattr__(self, name: str, value: Any) -> None: ...


class Unknown:
    """A message of a type that is not known: the fields that it was given, and no others."""

    def __init__(self, values: Mapping[str, Any]) -> None:
        for name, value in values.items():
            setattr(self, name, _unknown(value))


def message_of(type_name: str, values: Mapping[str, Any]) -> Any:
    """
    Return a message.

    Args:
        type_name: ``package/msg/Name``; of one that is not in the definitions, such as one of the
            user, nothing is checked, and there are no defaults.
        values: Of its fields, by name; messages in it are mappings, too.

    Raises:
        AmrError: A value does not fit; the line names its field.
    """
    if type_name not in texts():
        return Unknown(values)
    return _filled(type_name, values, '')


def message_like(message: Any, type_name: str, **values: Any) -> Any:
    """
    Return a message to be put into another one: a plain one if that is plain, else of rclpy.

    Args:
        message: The other one.
        type_name: ``package/msg/Name``.
        **values: Of its fields.
    """
    if isinstance(message, PlainMessage):
        made: Any = PlainMessage(type_name)
    else:
        package, kind, name = type_name.split('/')
        made = getattr(importlib.import_module(f'{package}.{kind}'), name)()
    for name, value in values.items():
        setattr(made, name, value)
    return made


def has_stamp(type_name: str) -> bool:
    """Return whether messages of a type have a header, and so a stamp; True: it is not known."""
    if type_name not in texts():
        return True
    return any(each.name == 'header' for each in fields_of(type_name))


def _filled(type_name: str, values: Any, path: str) -> PlainMessage:
    if not isinstance(values, Mapping):
        raise _misfit(
            f"Value '{values}' is expected to be a dictionary but is a {type(values).__name__}",
            path,
        )
    fields = _fields_by_name(type_name)
    given: dict[str, Any] = {}
    for name, value in values.items():
        if name not in fields:
            last = type_name.rpartition('/')[2]
            raise _misfit(
                f"'{last}' object has no attribute '{name}'; it has {', '.join(fields)}", path
            )
        given[name] = _value(fields[name], value, f'{path}.{name}'.lstrip('.'))
    message = PlainMessage.__new__(PlainMessage)
    simple, made = _template(type_name)
    message.__dict__.update(simple)  # in the order of the fields; then what takes their places
    message.__dict__.update({f.name: _default(f) for f in made if f.name not in given})
    message.__dict__.update(given)
    return message


@cache
def _fields_by_name(type_name: str) -> dict[str, Field]:
    return {each.name: each for each in fields_of(type_name)}


@cache
def _template(type_name: str) -> tuple[dict[str, Any], tuple[Field, ...]]:
    """Return the defaults of all fields, and those whose default is made anew each time."""
    fields = fields_of(type_name)
    made = [each for each in fields if each.is_array or each.type not in {*NUMBERS, *TEXTS}]
    simple = {each.name: None if each in made else _default(each) for each in fields}
    return simple, tuple(made)


def _value(field: Field, value: Any, path: str) -> Any:
    if not field.is_array:
        return _element(field, value, path)
    if isinstance(value, str) or not isinstance(value, Sequence):
        raise _misfit(f"expected a list, found the {type(value).__name__} '{value}'", path)
    if field.count is not None and len(value) != field.count:
        raise _misfit(f'expected {field.count} elements, found {len(value)}', path)
    return [_element(field, each, f'{path}[{index}]') for index, each in enumerate(value)]


def _element(field: Field, value: Any, path: str) -> Any:
    kind = field.type
    if kind not in NUMBERS and kind not in TEXTS:
        return _filled(kind, value, path)
    if value is None or isinstance(value, Mapping | list):
        found = 'nothing' if value is None else f"'{value}'"
        raise _misfit(f'expected a {_WORDS.get(kind, kind)}, found {found}', path)
    if kind in TEXTS:
        return str(value)
    try:
        return _number(kind, value)
    except (OverflowError, TypeError, ValueError) as error:
        raise _misfit(str(error), path) from error


def _number(kind: str, value: Any) -> Any:
    if kind == 'bool' and isinstance(value, str):
        if value.lower() not in _TRUTHS:
            raise ValueError(f"'{value}' is neither true nor false")
        return _TRUTHS[value.lower()]
    number = NUMBERS[kind](value)
    if NUMBERS[kind] is int:
        bits = _BITS.get(kind) or int(kind.lstrip('uint'))
        low, high = (-(2 ** (bits - 1)), 2 ** (bits - 1)) if kind[0] == 'i' else (0, 2**bits)
        if not low <= number < high:
            raise ValueError(f'{number} is no {kind}: {low} to {high - 1}')
    return number


def _default(field: Field) -> Any:
    kind = field.type
    if field.is_array and field.count is None:
        return list(field.default or ())
    if field.default is not None:
        return field.default
    if field.is_array:
        return [_zero(kind) for _ in range(field.count or 0)]
    return _zero(kind)


def _zero(kind: str) -> Any:
    if kind in NUMBERS:
        return NUMBERS[kind]()
    return '' if kind in TEXTS else PlainMessage(kind)


def _unknown(value: Any) -> Any:
    if isinstance(value, Mapping):
        return Unknown(value)
    return [_unknown(each) for each in value] if isinstance(value, list | tuple) else value


def _misfit(reason: str, path: str) -> AmrError:
    where = f' (field {path})' if path else ''
    return AmrError(f'Failed to populate field: {shorten(reason)}{where}')
