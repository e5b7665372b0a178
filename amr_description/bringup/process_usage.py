# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
CPU and memory of processes with all their descendants, read from ``/proc``.

psutil would not make this shorter: it has no sessions, and :func:`start_time`, which every start
of a stack calls, should not load it.
"""

from collections.abc import Collection, Iterable, Mapping
import contextlib
from dataclasses import dataclass
import os
from pathlib import Path
import time

_TICKS = os.sysconf('SC_CLK_TCK')  # per s


@dataclass(frozen=True)
class ProcessStat:
    """What ``/proc/<pid>/stat`` says of a process (proc(5))."""

    pid: int
    parent: int
    session: int
    cpu: float
    """CPU time, user and system, s."""
    start_time: int
    """Clock ticks from boot to its start; with the pid, its identity."""


@dataclass(frozen=True)
class Usage:
    """The usage of a tree of processes."""

    cpu: float
    """Share of one core, 1.0 for all of it, over the interval of the measurement."""
    memory: int
    """Proportional set size, bytes: shared memory is divided among its users."""


def read_stat(pid: int) -> ProcessStat | None:
    """Return the stat of a process; None: it is gone, or a zombie."""
    try:
        text = Path(f'/proc/{pid}/stat').read_bytes()
    except OSError:
        return None
    words = text.rpartition(b')')[2].split()  # after 'pid (any name)'
    if words[0] in (b'Z', b'X'):
        return None
    cpu = (int(words[11]) + int(words[12])) / _TICKS
    return ProcessStat(pid, int(words[1]), int(words[3]), cpu, int(words[19]))


def start_time(pid: int) -> int | None:
    """Return when a process was started, in clock ticks since boot; None: it is gone."""
    process = read_stat(pid)
    return process.start_time if process else None


def all_processes() -> dict[int, ProcessStat]:
    """Return the processes of this machine by pid."""
    pids = [int(name) for name in os.listdir('/proc') if name.isdecimal()]
    return {process.pid: process for pid in pids if (process := read_stat(pid))}


def tree(processes: Iterable[ProcessStat], root: int) -> set[int]:
    """Return the pids of ``root``, of its session, and of all descendants of these."""
    listed = list(processes)
    found = {p.pid for p in listed if root in (p.pid, p.session)}
    while more := {p.pid for p in listed if p.parent in found and p.pid not in found}:
        found |= more
    return found


def memory(pid: int) -> int:
    """Return the proportional set size of a process, bytes; 0 if it is gone."""
    for file, field in (('smaps_rollup', 'Pss:'), ('status', 'VmRSS:')):
        with contextlib.suppress(OSError):
            for line in Path(f'/proc/{pid}/{file}').read_text().splitlines():
                if line.startswith(field):
                    return int(line.split()[1]) * 1024
    return 0


def usages(roots: Collection[int], seconds: float) -> dict[int, Usage]:
    """
    Measure the usage of process trees; takes as long as the interval.

    Args:
        roots: the pid of each tree's root.
        seconds: the interval over which CPU usage is measured.

    Returns:
        The usage by root.
    """
    before, begin = all_processes(), time.monotonic()
    time.sleep(seconds)
    after, elapsed = all_processes(), time.monotonic() - begin
    return {root: _usage(tree(after.values(), root), before, after, elapsed) for root in roots}


def _usage(
    pids: Collection[int],
    before: Mapping[int, ProcessStat],
    after: Mapping[int, ProcessStat],
    elapsed: float,
) -> Usage:
    used = sum(after[pid].cpu - (before[pid].cpu if pid in before else 0.0) for pid in pids)
    return Usage(used / elapsed, sum(map(memory, pids)))
