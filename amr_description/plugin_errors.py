# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""How exceptions of controllers and hardware components, which may be third-party, are logged."""

from pathlib import Path
import sysconfig
import traceback

from amr_description.errors import AmrError
from amr_description.log import Log, Severity
from amr_description.text import encodable, unwrap

_TRACEBACK_PERIOD = 10.0
"""s between two tracebacks of one component that begin alike."""
_CATCHERS = ('/ros/firewall.py',)
"""They are in each traceback."""
_LIBRARIES = (*(sysconfig.get_path(name) for name in ('stdlib', 'purelib')), '<')


def describe(error: BaseException) -> str:
    """
    Return the text of an error; unless it is one of ours, with its type and its place:
    ``KeyError: 'left' (my_controller.py:6)``.
    """
    if isinstance(error, AmrError):
        return _text_of(error)
    return f'{type(error).__name__}: {error_line(error)}'


def error_line(error: BaseException) -> str:
    """Return the text of an error without line breaks, with its place unless it is of ours."""
    text = unwrap(_text_of(error))
    return text if isinstance(error, AmrError) else f'{text}{place_of(error)}'


def place_of(error: BaseException) -> str:
    """
    Return `` (my_controller.py:6)``: the innermost line outside of libraries; else in one; '' if
    nothing has raised it.
    """
    frames = [
        each
        for each in traceback.extract_tb(error.__traceback__)
        if not each.filename.endswith(_CATCHERS)
    ]
    outside = [each for each in frames if not each.filename.startswith(_LIBRARIES)] or frames
    return f' ({Path(outside[-1].filename).name}:{outside[-1].lineno})' if outside else ''


def log_error(log: Log, error: Exception) -> str:
    """Log an error in one line, and its traceback, :func:`log_traceback`; return the line."""
    line = unwrap(describe(error))
    log(Severity.ERROR, line)
    log_traceback(log, error)
    return line


def log_traceback(log: Log, error: Exception) -> None:
    """Log the traceback, for the author of the plugin that raised; of our own errors at DEBUG."""
    severity = Severity.DEBUG if isinstance(error, AmrError) else Severity.ERROR
    text = ''.join(traceback.format_exception(error))
    log(severity, text.rstrip(), throttle=_TRACEBACK_PERIOD)


def is_traceback(text: str) -> bool:
    """Return whether a line of the log is a traceback, beside the line that has the reason."""
    return 'Traceback (most recent call last):' in text.partition('\n')[0]


def _text_of(error: BaseException) -> str:
    try:
        return encodable(str(error))
    except Exception:  # of its own __str__
        return '(its text cannot be formatted)'
