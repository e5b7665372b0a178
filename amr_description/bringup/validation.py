# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
Type checks for what users write into a stack.

``parameters={…}`` instead of a list, or ``start_when=node`` instead of a condition, is easily
written; without a check Python would notice it far from there, if at all.
"""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from os import PathLike
import re
import reprlib
from typing import TypeGuard

from amr_description.errors import BringupError

TOKEN = r'[A-Za-z_][A-Za-z0-9_]*'
"""One part of a ROS name, between slashes."""

_NAMESPACE = re.compile(f'/?({TOKEN}(/{TOKEN})*)?/?')


@dataclass(frozen=True)
class Validator:
    """A check of one value."""

    text: str
    """What is expected, as the error message says it: ``it takes a number``."""
    accepts: Callable[[object], bool]

    def or_none(self) -> 'Validator':
        """Return a validator that accepts None as well."""
        return Validator(self.text, lambda value: value is None or self.accepts(value))


def require(what: str, value: object, validator: Validator) -> None:
    """
    Check a value.

    Args:
        what: what it was given for, with ``%s`` in its place: ``Node('arm', name=%s)``.
        value: the value.
        validator: its check.

    Raises:
        BringupError: the validator does not accept it.
    """
    if not validator.accepts(value):
        raise BringupError(f'{what.replace("%s", shortened(value), 1)}: it takes {validator.text}')


def require_fields(begin: str, instance: object, validators: Mapping[str, Validator]) -> None:
    """
    Check the fields of an object.

    Args:
        begin: begin of the error message, ``Node('talker'``.
        instance: the object.
        validators: that of each field, by its name.

    Raises:
        BringupError: a field is not accepted.
    """
    for name, validator in validators.items():
        require(f'{begin}, {name}=%s)', getattr(instance, name), validator)


def shortened(value: object) -> str:
    """Return the repr of a value, shortened for a message."""
    short = reprlib.Repr()
    short.maxother = short.maxstring = 60
    return short.repr(value)


def list_of(what: str, accepts: Callable[[object], bool] = lambda _: True) -> Validator:
    """
    Return a validator for lists and tuples; texts, tables and generators are not accepted.

    Args:
        what: the elements, as the error message names them.
        accepts: the check of an element.
    """

    def is_list(value: object) -> bool:
        return (
            isinstance(value, Sequence) and not isinstance(value, str) and all(map(accepts, value))
        )

    return Validator(f'a list of {what}', is_list)


def is_pair(value: object) -> bool:
    """Return whether a value is a pair of texts."""
    return isinstance(value, tuple | list) and len(value) == 2 and all(map(_is_text, value))


def _is_text(value: object) -> TypeGuard[str]:
    return isinstance(value, str) and '\0' not in value


def _is_number(value: object) -> bool:
    return isinstance(value, int | float) and not isinstance(value, bool)


def _is_word(value: object) -> bool:
    return isinstance(value, str | int | float | PathLike) and '\0' not in str(value)


def _is_environment(value: object) -> bool:
    return isinstance(value, Mapping) and all(
        _is_text(name) and name and '=' not in name and (content is None or _is_text(content))
        for name, content in value.items()
    )


TEXT = Validator('a text', _is_text)
NUMBER = Validator('a number', _is_number)
BOOLEAN = Validator('True or False', lambda value: isinstance(value, bool))
FUNCTION = Validator('a function', callable)
NAME = Validator(
    'a name of letters, digits and _', lambda v: _is_text(v) and bool(re.fullmatch(TOKEN, v))
)
NAMESPACE = Validator(
    'a namespace of letters, digits, _ and /, as robot1/arm',
    lambda value: _is_text(value) and bool(_NAMESPACE.fullmatch(value)),
)
FILE_NAME = Validator('a name without a path', lambda v: _is_text(v) and bool(v) and '/' not in v)
REMAPPINGS = list_of("pairs, as [('/cmd_vel', '/arm/cmd_vel')]", is_pair)
ARGUMENTS = list_of("words, as ['--times', 3]", _is_word)
VALUE = Validator('a text, a number, True, False or a path', _is_word)
ENVIRONMENT = Validator("a table of texts, as {'DEBUG': '1'}", _is_environment)
