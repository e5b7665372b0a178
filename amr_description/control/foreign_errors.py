# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""What a stranger's controller or hardware component raises: one line, and where it was raised."""

import traceback

from amr_description.control.contracts import Log, Severity
from amr_description.errors import AmrError


def describe(error: Exception) -> str:
    """Return the text of an error; one that was not raised on purpose begins with its type."""
    if isinstance(error, AmrError):
        return str(error)
    return f'{type(error).__name__}: {one_line(error)}'


def one_line(error: Exception) -> str:
    """Return the text of an error without line breaks, as a log of lines needs it."""
    return ' '.join(str(error).split())


def log_traceback(log: Log, error: Exception) -> None:
    """Say at DEBUG where an error comes from: for whoever writes the class that raises it."""
    log(Severity.DEBUG, ''.join(traceback.format_exception(error)))
