# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""How exceptions of controllers and hardware components, which may be third-party, are logged."""

import traceback

from amr_description.control.contracts import Log, Severity
from amr_description.errors import AmrError
from amr_description.text import encodable, unwrap


def describe(error: Exception) -> str:
    """Return the text of an error, with its type in front unless it is one of ours."""
    if isinstance(error, AmrError):
        return _text_of(error)
    return f'{type(error).__name__}: {error_line(error)}'


def error_line(error: Exception) -> str:
    """Return the text of an error without line breaks."""
    return unwrap(_text_of(error))


def log_error(log: Log, error: Exception) -> str:
    """Log an error in one line, and its traceback at DEBUG; return the line."""
    line = unwrap(describe(error))
    log(Severity.ERROR, line)
    log_traceback(log, error)
    return line


def log_traceback(log: Log, error: Exception) -> None:
    """Log the traceback at DEBUG, for the author of the plugin that raised."""
    log(Severity.DEBUG, ''.join(traceback.format_exception(error)))


def _text_of(error: Exception) -> str:
    try:
        return encodable(str(error))
    except Exception:  # of its own __str__
        return '(its text cannot be formatted)'
