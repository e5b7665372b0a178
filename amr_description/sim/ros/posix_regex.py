# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
POSIX extended regular expressions, as ``grep -E`` and ``simulation_interfaces`` have them.

Python's own are another language: ``[[:digit:]]`` is a set of brackets and letters there. So the C
library is asked, which every Linux has.
"""

import ctypes
from functools import cache
from typing import Self

from amr_description.errors import UsageError

_REG_EXTENDED, _REG_NOSUB = 1, 8
_ROOM = 1024
"""Bytes; a ``regex_t`` has 64 in glibc, 48 in musl, and its messages are short."""


@cache
def _libc() -> ctypes.CDLL:
    return ctypes.CDLL(None)


class PosixRegex:
    """One expression; it is found anywhere in a text, unless it begins with ^ or ends with $."""

    def __init__(self, expression: str) -> None:
        """Raises UsageError."""
        self._compiled = None
        compiled = ctypes.create_string_buffer(_ROOM)
        flags = _REG_EXTENDED | _REG_NOSUB
        if '\0' in expression:
            raise UsageError(f'{expression!r} is no regular expression: it holds a NUL character')
        error = _libc().regcomp(compiled, expression.encode(), flags)
        if error:
            reason = ctypes.create_string_buffer(_ROOM)
            _libc().regerror(error, compiled, reason, ctypes.c_size_t(_ROOM))
            raise UsageError(
                f"'{expression}' is no POSIX extended regular expression: {reason.value.decode()}"
            )
        self._compiled = compiled

    def __enter__(self) -> Self:
        return self

    def __exit__(self, *_: object) -> None:
        """Free what the C library holds."""
        compiled, self._compiled = self._compiled, None
        if compiled is not None:
            _libc().regfree(compiled)

    def is_in(self, text: str) -> bool:
        """Whether the expression is found in a text."""
        none = ctypes.c_size_t(0)
        return _libc().regexec(self._compiled, text.encode(), none, None, 0) == 0
