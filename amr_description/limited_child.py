# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
A program that works on a file of others, in a process of its own, with limits of time and memory.

It ends by its limits even where nobody is left who waits for it.
"""

from collections.abc import Mapping, Sequence
import contextlib
from dataclasses import dataclass
import resource
import signal
import subprocess

from amr_description.errors import LimitError


@dataclass(frozen=True)
class Limits:
    """What a program may take."""

    seconds: int
    """Of processor time."""
    memory: int = 4 * 2**30
    """Bytes of address space."""
    wall: float | None = None
    """s of the wall clock; None: no limit."""


@dataclass(frozen=True)
class Ended:
    """A program that has ended by itself."""

    code: int
    text: str
    """What it has written to stdout."""
    log: str
    """To stderr."""


def run_limited(
    command: Sequence[str], limits: Limits, environment: Mapping[str, str] | None = None
) -> Ended:
    """
    Run a program to its end.

    Args:
        command: Its words.
        limits: Of it.
        environment: All its variables; None: those of this process.

    Raises:
        LimitError: It has taken too long.
        KeyboardInterrupt: Ctrl-C; the program is killed.
    """
    with subprocess.Popen(
        command,
        stdin=subprocess.DEVNULL,
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        env=environment,
    ) as process:
        _limit(process.pid, limits)
        try:
            out, err = process.communicate(timeout=limits.wall)
        except subprocess.TimeoutExpired:
            process.kill()
            raise LimitError(f'no end after {limits.wall:g} s') from None
        except BaseException:
            process.kill()
            raise
    if process.returncode == -signal.SIGXCPU:
        raise LimitError(f'no end after {limits.seconds} s')
    return Ended(process.returncode, out.decode(errors='replace'), err.decode(errors='replace'))


def _limit(pid: int, limits: Limits) -> None:
    kinds = {
        resource.RLIMIT_CPU: (limits.seconds, limits.seconds + 1),
        resource.RLIMIT_AS: (limits.memory, limits.memory),
        resource.RLIMIT_CORE: (0, 0),
    }
    for kind, limit in kinds.items():
        # It may have ended already, or a lower limit may be set.
        with contextlib.suppress(ProcessLookupError, PermissionError, ValueError):
            resource.prlimit(pid, kind, limit)
