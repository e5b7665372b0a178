# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""What is told of an error in the code of a user: one line, with its place there."""

from pathlib import Path
import sysconfig
import traceback

from amr_description.errors import AmrError
from amr_description.text import unwrap

_NOT_OF_USERS = (
    str(Path(__file__).parents[1]),
    *(sysconfig.get_path(name) for name in ('stdlib', 'purelib')),
    '<',  # frozen, or generated
)


def describe(error: BaseException) -> str:
    """Return ``ValueError: no such arm (my_arm.py, line 7)``; of errors on purpose no type."""
    text = unwrap(str(error))
    if isinstance(error, AmrError):
        return f'{text}{location(error)}'
    name = type(error).__name__
    return f'{name}: {text}{location(error)}' if text else f'{name}{location(error)}'


def location(error: BaseException) -> str:
    """Return `` (my_arm.py, line 7)``: the innermost place that is not of a library."""
    if isinstance(error, SyntaxError) and error.filename:
        return ''  # its text says it
    for frame in reversed(traceback.extract_tb(error.__traceback__)):
        if not frame.filename.startswith(_NOT_OF_USERS):
            return f' ({Path(frame.filename).name}, line {frame.lineno})'
    return ''
