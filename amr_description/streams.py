# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""The standard streams of a command: opened where closed, buffered, kept free of noise."""

import contextlib
import os
import select
import stat
import sys
import traceback

_STDOUT = 1
_STDERR = 2


def open_missing() -> None:
    """
    Open /dev/null where the caller closed a stream (``<&-``, ``>&-``), and Python has None.

    Otherwise the next file or socket gets the number 0, 1 or 2, and what is printed goes there.
    """
    for number, (name, mode) in enumerate((('stdin', 'r'), ('stdout', 'w'), ('stderr', 'w'))):
        try:
            os.fstat(number)
        except OSError:
            os.open(os.devnull, os.O_RDWR)  # takes the lowest number that is free
        if getattr(sys, name) is None:
            setattr(sys, name, open(number, mode, closefd=False))  # noqa: SIM115 - stays open


def make_line_buffered() -> None:
    """
    Write each line of stdout at once, so that ``| grep`` shows it live.

    Characters that cannot be encoded are escaped: names of files and topics may contain any.
    """
    if hasattr(sys.stdout, 'reconfigure'):
        sys.stdout.reconfigure(line_buffering=True, errors='backslashreplace')


def make_fully_buffered() -> None:
    """Undo :func:`make_line_buffered`, for ``--use-python-default-buffering``."""
    if hasattr(sys.stdout, 'reconfigure'):
        sys.stdout.reconfigure(line_buffering=sys.stdout.isatty())


def keep_libraries_off_stdout() -> None:
    """
    Redirect to stderr what C++ libraries write to stdout; ``sys.stdout`` stays as it is.

    Fast DDS warns about locks of shared memory that a killed process left behind, on file
    descriptor 1, where a script parses the output.
    """
    try:
        if sys.stdout.fileno() != _STDOUT:
            return
        sys.stdout.flush()
        ours = os.dup(_STDOUT)
        os.dup2(_STDERR, _STDOUT)
    except (AttributeError, OSError, ValueError):  # no stdout, no stderr, or not files
        return
    previous = sys.stdout
    sys.stdout = os.fdopen(ours, 'w', encoding=previous.encoding, errors=previous.errors)
    sys.stdout.reconfigure(line_buffering=bool(previous.line_buffering))


def never_wait_for_stderr() -> None:
    """
    Have a write to stderr fail, rather than wait, while its reader takes nothing.

    For a process that controls a robot: rclpy holds the interpreter's lock while it logs, so a
    terminal that was stopped with Ctrl-S, or a full pipe, would hold up every thread. The stream
    is opened anew, as other processes share the present one. A file never makes us wait; a socket,
    or the terminal of another user, cannot be opened and stays as it is.
    """
    with contextlib.suppress(OSError):
        if stat.S_ISFIFO(os.fstat(_STDERR).st_mode) or os.isatty(_STDERR):
            flags = os.O_WRONLY | os.O_NONBLOCK | os.O_NOCTTY
            ours = os.open(f'/proc/self/fd/{_STDERR}', flags)
            os.dup2(ours, _STDERR)
            os.close(ours)


def print_traceback() -> None:
    """Print the exception that is handled, unless nobody takes it."""
    with contextlib.suppress(OSError):
        traceback.print_exc()


def wait_for_stderr() -> None:
    """Block until stderr takes a line, without the interpreter's lock."""
    poll = select.poll()
    poll.register(_STDERR, select.POLLOUT)
    poll.poll()


def abandon_stdout() -> None:
    """Keep Python from writing to a closed pipe again at its exit."""
    with contextlib.suppress(OSError, ValueError):
        nowhere = os.open(os.devnull, os.O_WRONLY)
        os.dup2(nowhere, sys.stdout.fileno())
        os.close(nowhere)
