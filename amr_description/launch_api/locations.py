# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""Where something stands in a launch file, for messages: ``my.launch.py:7``."""

from pathlib import Path
import sys
from types import FrameType
from typing import Any, Self, TypeVar

from amr_description.errors import BringupError

E = TypeVar('E', bound=BringupError)

_HERE = str(Path(__file__).parent)
_PACKAGE = str(Path(__file__).parents[1])


def caller() -> str:
    """Return the place in the launch file from which this package was called; '' if none."""
    frame: FrameType | None = sys._getframe(1)
    while frame is not None:
        name = frame.f_code.co_filename
        if not name.startswith((_HERE, '<')):
            return '' if name.startswith(_PACKAGE) else f'{Path(name).name}:{frame.f_lineno}'
        frame = frame.f_back
    return ''


def refusal(text: str, where: str | None = None) -> BringupError:
    """Return an error that begins with a place, by default that of the caller."""
    return at(BringupError(text), caller() if where is None else where)


def at(error: E, where: str) -> E:
    """Have an error begin with a place, unless it does."""
    if where and not error.is_located:
        error.args = (f'{where}: {error}',)
        error.is_located = True
    return error


class Located:
    """What a launch file makes; it knows where."""

    where: str

    def __new__(cls, *_args: Any, **_kwargs: Any) -> Self:
        """Note the place, whether or not a subclass of the user calls ``__init__``."""
        made = super().__new__(cls)
        made.where = caller()
        return made
