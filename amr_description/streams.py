# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""The standard streams of a command: opened where closed, buffered, kept free of noise."""

import contextlib
import os
import sys

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

    What cannot be encoded is written escaped: no name of a file or a topic stops a command.
    """
    if hasattr(sys.stdout, 'reconfigure'):
        sys.stdout.reconfigure(line_buffering=True, errors='backslashreplace')


def make_fully_buffered() -> None:
    """Undo :func:`make_line_buffered`, for ``--use-python-default-buffering``."""
    if hasattr(sys.stdout, 'reconfigure'):
        sys.stdout.reconfigure(line_buffering=sys.stdout.isatty())


def keep_libraries_off_stdout() -> None:
    """
    From here on what C++ libraries write to stdout goes to stderr; Python's is not touched.

    Fast DDS complains about locks of shared memory that a killed process left behind, and it
    does so on file descriptor 1, amid what a script parses.
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
    sys.stdout.reconfigure(line_buffering=previous.line_buffering)


def abandon_stdout() -> None:
    """Have Python not try again, at its exit, to write what nobody reads."""
    with contextlib.suppress(OSError, ValueError):
        nowhere = os.open(os.devnull, os.O_WRONLY)
        os.dup2(nowhere, sys.stdout.fileno())
        os.close(nowhere)
