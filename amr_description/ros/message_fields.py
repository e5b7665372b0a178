# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
What was typed -> the fields of a message.

A value of another type is converted as Python does it: ``1`` into a float64 is 1.0, ``5`` into a
string is '5'. What a message does not hold, a field that it does not have, a number out of range
or an array of another length, is an error that names the field. Two words are filled in at each
publication: ``auto`` for a std_msgs/Header, ``now`` for a builtin_interfaces/Time.
"""

from collections.abc import Callable, Mapping
from dataclasses import dataclass
import sys
from typing import Any

from rosidl_parser.definition import (
    AbstractGenericString,
    AbstractNestedType,
    BasicType,
    NamespacedType,
)

from amr_description.errors import AmrError
from amr_description.ros.message_types import message_type
from amr_description.text import shorten

Stamp = Callable[[Any], None]
"""Sets one time of a message to a given builtin_interfaces/Time."""


@dataclass(frozen=True)
class Words:
    """Which of the two words are filled in at each publication."""

    auto: bool = True
    now: bool = True


_BOTH = Words()


class FieldError(AmrError):
    """A value does not fit its field; ``kind`` is what Python calls such a fault."""

    def __init__(self, reason: str, path: str, kind: type[Exception]) -> None:
        super().__init__(f'Failed to populate field: {reason}{f" (field {path})" if path else ""}')
        self.reason, self.kind = reason, kind


_YAML_BOOLEANS = {'true': True, 'yes': True, 'on': True, 'false': False, 'no': False, 'off': False}


def set_fields(message: Any, values: Any, words: Words = _BOTH) -> list[Stamp]:
    """
    Set the fields of a message; those not mentioned keep their defaults.

    :param values: A mapping from field names, as YAML gives it; a field may be a message, too.
    :param words: Which words stand for the time of a publication.
    :returns: What is to be called with the time of each publication.
    :raises FieldError: A value does not fit; the line names its field.
    """
    stamps: list[Stamp] = []
    _FieldSetter(words, stamps).fill(message, values, '')
    return stamps


class _FieldSetter:
    """Sets fields; collects what is to be done at each publication."""

    def __init__(self, words: Words, stamps: list[Stamp]) -> None:
        self._words = words
        self._stamps = stamps

    def fill(self, message: Any, values: Any, path: str) -> None:
        if not isinstance(values, Mapping):
            raise _misfit(
                f"Value '{values}' is expected to be a dictionary but is a "
                f'{type(values).__name__}',
                path,
                TypeError,
            )
        names = list(message.get_fields_and_field_types())
        slots = dict(zip(names, message.SLOT_TYPES, strict=True))
        for name, value in values.items():
            if name not in slots:
                unknown = f"'{type(message).__name__}' object has no attribute '{name}'"
                field, colon, _ = str(name).partition(':')
                if colon and field in slots:
                    unknown += ': a blank is lacking behind the colon'
                raise _misfit(f'{unknown}; it has {", ".join(names)}', path, AttributeError)
            self._set(message, name, slots[name], value, f'{path}.{name}'.lstrip('.'))

    def _set(self, message: Any, name: str, slot: Any, value: Any, path: str) -> None:
        field = getattr(message, name)
        if self._words.auto and _is(slot, 'std_msgs/msg/Header') and value == 'auto':
            self._stamps.append(lambda time: setattr(field, 'stamp', time))
        elif self._words.now and _is(slot, 'builtin_interfaces/msg/Time') and value == 'now':
            self._stamps.append(lambda time: setattr(message, name, time))
        elif isinstance(slot, NamespacedType):
            if type(value) is type(field):
                setattr(message, name, value)
            else:
                self.fill(field, value, path)
        elif isinstance(slot, AbstractNestedType):
            _assign(message, name, self._array(field, slot, value, path), path)
        else:
            _assign(message, name, _scalar(slot, value, path), path)

    def _array(self, field: Any, slot: Any, value: Any, path: str) -> Any:
        """Return a list, array.array or numpy array: what the field holds."""
        if isinstance(value, bytes):  # !!binary
            value = list(value)
        if not isinstance(value, list):
            raise _misfit(f"expected a list, found the {type(value).__name__} '{value}'", path)
        elements = [
            self._element(slot.value_type, element, f'{path}[{index}]')
            for index, element in enumerate(value)
        ]
        try:
            if of_numpy(field, 'ndarray'):
                import numpy as np

                return np.array(elements, dtype=field.dtype)
            return (
                type(field)(field.typecode, elements) if hasattr(field, 'typecode') else elements
            )
        except (OverflowError, TypeError, ValueError) as error:
            raise _misfit(str(error), path) from error

    def _element(self, slot: Any, value: Any, path: str) -> Any:
        if not isinstance(slot, NamespacedType):
            return _scalar(slot, value, path)
        kind = message_type('/'.join(slot.namespaced_name()))
        if type(value) is kind:
            return value
        element = kind()
        self.fill(element, value, path)
        return element


def _assign(message: Any, name: str, value: Any, path: str) -> None:
    """Set a field with the checks of the generated class, which are off by default."""
    message._check_fields = True
    try:
        setattr(message, name, value)
    except AssertionError as error:
        raise _misfit(str(error), path) from error
    finally:
        message._check_fields = False


def _scalar(slot: BasicType | AbstractGenericString, value: Any, path: str) -> Any:
    if value is None or isinstance(value, dict | list):
        found = 'nothing' if value is None else f"'{value}'"
        raise _misfit(f'expected a {_slot_name(slot)}, found {found}', path)
    try:
        return _converted(slot, value)
    except (OverflowError, TypeError, ValueError) as error:
        raise _misfit(str(error), path) from error


def _converted(slot: BasicType | AbstractGenericString, value: Any) -> Any:
    if isinstance(slot, AbstractGenericString):
        return str(value)
    if slot.typename == 'boolean':
        if isinstance(value, str):
            return _boolean(value)
        return bool(value)
    if slot.typename == 'octet':
        return bytes([int(value)]) if not isinstance(value, bytes) else value
    if slot.typename in ('float', 'double', 'long double'):
        return float(value)
    return int(value)


def _boolean(word: str) -> bool:
    """Read a quoted word: Python would take 'false' for true."""
    try:
        return _YAML_BOOLEANS[word.lower()]
    except KeyError:
        raise ValueError(f"'{word}' is neither true nor false") from None


def _slot_name(slot: Any) -> str:
    return 'string' if isinstance(slot, AbstractGenericString) else slot.typename


def _is(slot: Any, name: str) -> bool:
    return isinstance(slot, NamespacedType) and '/'.join(slot.namespaced_name()) == name


def _misfit(reason: str, path: str, kind: type[Exception] = ValueError) -> FieldError:
    return FieldError(shorten(reason), path, kind)


def of_numpy(value: Any, kind: str) -> bool:
    """
    Whether a value is of a class of numpy.

    numpy takes a third of the start of ``ros2 topic echo``; only messages with arrays of fixed
    length load it.
    """
    numpy = sys.modules.get('numpy')
    return numpy is not None and isinstance(value, getattr(numpy, kind))
