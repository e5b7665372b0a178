# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
What the words of a stack take: a value of a wrong kind is told where it stands.

A stack is written by hand, and ``parameters={…}`` or ``start_when=node`` is soon written. Python
would notice it far from there, if at all.
"""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from os import PathLike
import re
import reprlib

from amr_description.errors import BringupError

TOKEN = r'[A-Za-z_][A-Za-z0-9_]*'
"""What names in ROS are made of, between slashes."""

_NAMESPACE = re.compile(f'/?({TOKEN}(/{TOKEN})*)?/?')


@dataclass(frozen=True)
class Validator:
    """What a value can be."""

    text: str
    """As a person would say it."""
    fits: Callable[[object], bool]

    def or_none(self) -> 'Validator':
        """Return the kind that has None, too."""
        return Validator(self.text, lambda value: value is None or self.fits(value))


def require(what: str, value: object, kind: Validator) -> None:
    """Raise BringupError unless the value is of the kind; ``what``: ``Node('arm', name=%s)``."""
    if not kind.fits(value):
        raise BringupError(f'{what.replace("%s", shortened(value), 1)}: it takes {kind.text}')


def require_fields(begin: str, word: object, kinds: Mapping[str, Validator]) -> None:
    """Require what each field of a word takes; ``begin``: ``Node('talker'``."""
    for name, kind in kinds.items():
        require(f'{begin}, {name}=%s)', getattr(word, name), kind)


def shortened(value: object) -> str:
    """Return a value in few characters."""
    short = reprlib.Repr()
    short.maxother = short.maxstring = 60
    return short.repr(value)


def _is_text(value: object) -> bool:
    return isinstance(value, str) and '\0' not in value


def _is_number(value: object) -> bool:
    return isinstance(value, int | float) and not isinstance(value, bool)


def _is_word(value: object) -> bool:
    return isinstance(value, str | int | float | PathLike) and '\0' not in str(value)


def list_of(of: str, fits: Callable[[object], bool] = lambda _: True) -> Validator:
    """Return the kind of lists and tuples; a text or a table is none, nor is a generator."""

    def is_list(value: object) -> bool:
        return isinstance(value, Sequence) and not isinstance(value, str) and all(map(fits, value))

    return Validator(f'a list of {of}', is_list)


def _is_environment(value: object) -> bool:
    return isinstance(value, Mapping) and all(
        _is_text(name) and name and '=' not in name and _is_text(content)
        for name, content in value.items()
    )


def is_pair(value: object) -> bool:
    """Tell a pair of texts."""
    return isinstance(value, tuple | list) and len(value) == 2 and all(map(_is_text, value))


TEXT = Validator('a text', _is_text)
NUMBER = Validator('a number', _is_number)
TRUTH = Validator('True or False', lambda value: isinstance(value, bool))
FUNCTION = Validator('a function', callable)
NAME = Validator(
    'a name of letters, digits and _', lambda v: _is_text(v) and bool(re.fullmatch(TOKEN, v))
)
NAMESPACE = Validator(
    'a namespace of letters, digits, _ and /, as robot1/arm',
    lambda value: _is_text(value) and bool(_NAMESPACE.fullmatch(value)),
)
FILE_NAME = Validator('a name without a path', lambda v: _is_text(v) and bool(v) and '/' not in v)
PARAMETERS = list_of(
    "tables and files, as [{'speed': 1.0}, 'arm.yaml']",
    lambda entry: isinstance(entry, Mapping | str | PathLike),
)
REMAPPINGS = list_of("pairs, as [('/cmd_vel', '/arm/cmd_vel')]", is_pair)
ARGUMENTS = list_of("words, as ['--times', 3]", _is_word)
VALUE = Validator('a text, a number, True, False or a path', _is_word)
ENVIRONMENT = Validator("a table of texts, as {'DEBUG': '1'}", _is_environment)
