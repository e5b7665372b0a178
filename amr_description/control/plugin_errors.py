# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""What a stranger's controller or hardware component raises: one line, and where it was raised."""

import traceback

from amr_description.control.contracts import Log, Severity
from amr_description.errors import AmrError
from amr_description.text import encodable, unwrap


def describe(error: Exception) -> str:
    """Return the text of an error; one that was not raised on purpose begins with its type."""
    if isinstance(error, AmrError):
        return _text_of(error)
    return f'{type(error).__name__}: {one_line(error)}'


def one_line(error: Exception) -> str:
    """Return the text of an error without line breaks, as a log of lines needs it."""
    return unwrap(_text_of(error))


def log_traceback(log: Log, error: Exception) -> None:
    """Say at DEBUG where an error comes from: for whoever writes the class that raises it."""
    log(Severity.DEBUG, ''.join(traceback.format_exception(error)))


def _text_of(error: Exception) -> str:
    try:
        return encodable(str(error))
    except Exception:  # of its own __str__
        return '(it cannot be put in words)'
