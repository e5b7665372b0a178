# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
What the doctor finds while a stack that failed to start still runs: the cause, where it knows it.

It is a child process, ``nodes/start_failure.py``: the supervisor loads no DDS. It is asked only
where executables of this package were started, the stack never got ready, and the failure does not
explain itself: somebody waits for the end.
"""

from collections.abc import Callable, Collection, Mapping, Sequence
import contextlib
import re
import signal
from typing import TypeAlias

from amr_description.bringup.description import Node
from amr_description.bringup.process import RunningProcess
from amr_description.bringup.scheduler import Expired, Failure
from amr_description.entry import python_command

COMMAND = python_command(
    'from amr_description.entry import nodes; sys.exit(nodes.start_failure.main())'
)
TIMEOUT = 20.0
"""s after which a failure is reported without it, as on a machine that is too busy."""
NOT_STARTED = 'could not be started: '
"""How the line begins that says why there is no process."""
_MARK = 'doctor: '
_SAYS_WHY = re.compile(rf'\[(?:ERROR|FATAL)\] \[[\d.]+\] \[(?!rcl|rmw)|^{NOT_STARTED}')

Spawn: TypeAlias = Callable[[Sequence[str], Callable[[str], None]], RunningProcess]
"""Starts a command; takes the callback for the lines of its output; may raise OSError."""


def is_unexplained(
    failure: Failure | Expired | None, last_lines: Mapping[Node, Collection[str]]
) -> bool:
    """
    Return whether a cause is to be looked for.

    Not after a signal, as of somebody's ``kill``, nor where the last line says why there is no
    process, or is an error that the program has logged itself: executables of this package so say
    what would do.
    """
    if not isinstance(failure, Failure):
        return failure is not None
    written = [line for line in last_lines[failure.node] if line.strip()]
    return failure.returncode > 0 and not (written and _SAYS_WHY.search(written[-1]))


class Diagnosis:
    """The process, and the lines that it has printed."""

    def __init__(self, spawn: Spawn) -> None:
        """Start it."""
        self._lines: list[str] = []
        self.process: RunningProcess | None = None
        with contextlib.suppress(OSError):
            self.process = spawn(COMMAND, self._on_line)

    @property
    def text(self) -> str:
        """What it has found: what, why, what mends it, where to read more; empty: nothing."""
        return '\n    '.join(line.strip() for line in self._lines)

    def is_over(self) -> bool:
        """Return whether it has ended, or was never there."""
        return self.process is None or self.process.poll()

    def kill(self) -> None:
        """End it at once; :meth:`is_over` then tells when."""
        if self.process is not None:
            self.process.send(signal.SIGKILL)

    def close(self) -> None:
        """Free what it used, once it is over."""
        if self.process is not None:
            self.process.close()

    def _on_line(self, line: str) -> None:
        if line.startswith(_MARK):  # others are those of libraries
            self._lines.append(line.removeprefix(_MARK))
