# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""How an exception in a user's code is reported: one line, with its location in that code."""

from pathlib import Path
import sysconfig
import traceback

from amr_description.errors import AmrError
from amr_description.stand_ins import hint_of_module
from amr_description.text import unwrap

_NOT_OF_USERS = (
    str(Path(__file__).parents[1]),
    *(sysconfig.get_path(name) for name in ('stdlib', 'purelib')),
    '<',  # frozen, or generated
)


def describe(error: BaseException) -> str:
    """
    Return ``ValueError: no such arm (my_arm.py, line 7)``; without the type for an AmrError.

    Of a module of ROS that is not here, what would do is said, too.
    """
    text = unwrap(str(error))
    if isinstance(error, ModuleNotFoundError) and (hint := hint_of_module(error.name or '')):
        text = f'{text}; {hint}'
    if isinstance(error, AmrError):
        return f'{text}{location(error)}'
    name = type(error).__name__
    return f'{name}: {text}{location(error)}' if text else f'{name}{location(error)}'


def location(error: BaseException) -> str:
    """Return `` (my_arm.py, line 7)``: the innermost frame outside of libraries; '' if none is."""
    if isinstance(error, SyntaxError) and error.filename:
        return ''  # its text contains it
    for frame in reversed(traceback.extract_tb(error.__traceback__)):
        if not frame.filename.startswith(_NOT_OF_USERS):
            return f' ({Path(frame.filename).name}, line {frame.lineno})'
    return ''
