# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
POSIX extended regular expressions, as in ``grep -E`` and ``simulation_interfaces``.

Python's ``re`` has another syntax, in which ``[[:digit:]]`` is a set of brackets and letters.
Therefore the C library is used.
"""

import ctypes
from functools import cache
from typing import Self

from amr_description.errors import UsageError

_REG_EXTENDED, _REG_NOSUB = 1, 8
_BUFFER_SIZE = 1024
"""Bytes; a ``regex_t`` has 64 in glibc, 48 in musl; error messages are short."""


@cache
def _libc() -> ctypes.CDLL:
    return ctypes.CDLL(None)


class PosixRegex:
    """A compiled expression; it may match any part of a text, as with ``grep -E``."""

    def __init__(self, expression: str) -> None:
        """Compile an expression. Raises UsageError."""
        self._compiled = None
        compiled = ctypes.create_string_buffer(_BUFFER_SIZE)
        flags = _REG_EXTENDED | _REG_NOSUB
        if '\0' in expression:
            raise UsageError(f'{expression!r} is no regular expression: it holds a NUL character')
        error = _libc().regcomp(compiled, expression.encode(), flags)
        if error:
            reason = ctypes.create_string_buffer(_BUFFER_SIZE)
            _libc().regerror(error, compiled, reason, ctypes.c_size_t(_BUFFER_SIZE))
            raise UsageError(
                f"'{expression}' is no POSIX extended regular expression: {reason.value.decode()}"
            )
        self._compiled = compiled

    def __enter__(self) -> Self:
        return self

    def __exit__(self, *_: object) -> None:
        """Free the memory of the compiled expression."""
        compiled, self._compiled = self._compiled, None
        if compiled is not None:
            _libc().regfree(compiled)

    def is_in(self, text: str) -> bool:
        """Return whether the expression matches any part of a text."""
        none = ctypes.c_size_t(0)
        return _libc().regexec(self._compiled, text.encode(), none, None, 0) == 0
