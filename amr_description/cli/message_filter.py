# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""``--filter``: a Python expression on ``m``, the message."""

from collections.abc import Callable
from typing import Any

from amr_description.errors import AmrError, UsageError

Filter = Callable[[Any], bool]


def make_filter(expression: str | None) -> Filter:
    """Return the predicate of an expression; None accepts all messages. Raises UsageError."""
    if expression is None:
        return lambda _message: True
    try:
        code = compile(expression, '--filter', 'eval')
    except (SyntaxError, ValueError) as error:
        raise UsageError(f"--filter '{expression}' is not a Python expression: {error}") from error

    def wanted(message: Any) -> bool:
        try:
            return bool(eval(code, {'m': message}))  # typed by the user who runs us
        except Exception as error:
            raise AmrError(
                f"--filter '{expression}' fails on a message: {type(error).__name__}: {error}"
            ) from error

    return wanted
