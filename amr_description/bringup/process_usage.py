# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""What processes use of the machine, with all that they have started; from ``/proc``."""

from collections.abc import Collection, Iterable, Mapping
import contextlib
from dataclasses import dataclass
import os
from pathlib import Path
import time

_TICKS = os.sysconf('SC_CLK_TCK')  # per s


@dataclass(frozen=True)
class Process:
    """A line of ``/proc/<pid>/stat`` (proc(5))."""

    pid: int
    parent: int
    session: int
    cpu: float
    """s that it has used, user and system."""
    start_time: int
    """ticks since the boot of the machine; with the pid, its identity."""


@dataclass(frozen=True)
class Usage:
    """What a tree of processes uses."""

    cpu: float
    """Share of one core, 1.0 is all of it; over the time that was looked at."""
    memory: int
    """bytes; what several processes share is counted once, shared out among them (PSS)."""


def read(pid: int) -> Process | None:
    """Return a process; None: it is gone, or a zombie."""
    try:
        text = Path(f'/proc/{pid}/stat').read_bytes()
    except OSError:
        return None
    words = text.rpartition(b')')[2].split()  # after 'pid (any name)'
    if words[0] in (b'Z', b'X'):
        return None
    cpu = (int(words[11]) + int(words[12])) / _TICKS
    return Process(pid, int(words[1]), int(words[3]), cpu, int(words[19]))


def start_time(pid: int) -> int | None:
    """Return when a process was started, in ticks since the boot; None: it is gone."""
    process = read(pid)
    return process and process.start_time


def everything() -> dict[int, Process]:
    """Return the processes of this machine by their pid."""
    pids = [int(name) for name in os.listdir('/proc') if name.isdecimal()]
    return {process.pid: process for pid in pids if (process := read(pid))}


def tree(processes: Iterable[Process], root: int) -> set[int]:
    """Return the pids of a process, its session's, and all their descendants'."""
    listed = list(processes)
    found = {p.pid for p in listed if root in (p.pid, p.session)}
    while more := {p.pid for p in listed if p.parent in found and p.pid not in found}:
        found |= more
    return found


def memory(pid: int) -> int:
    """Return the proportional set size of a process, bytes; 0: it is gone."""
    for file, field in (('smaps_rollup', 'Pss:'), ('status', 'VmRSS:')):
        with contextlib.suppress(OSError):
            for line in Path(f'/proc/{pid}/{file}').read_text().splitlines():
                if line.startswith(field):
                    return int(line.split()[1]) * 1024
    return 0


def usages(roots: Collection[int], seconds: float) -> dict[int, Usage]:
    """Return what the trees of some processes use, by looking twice, ``seconds`` apart."""
    before, begin = everything(), time.monotonic()
    time.sleep(seconds)
    after, elapsed = everything(), time.monotonic() - begin
    return {root: _usage(tree(after.values(), root), before, after, elapsed) for root in roots}


def _usage(
    pids: Collection[int],
    before: Mapping[int, Process],
    after: Mapping[int, Process],
    elapsed: float,
) -> Usage:
    used = sum(after[pid].cpu - (before[pid].cpu if pid in before else 0.0) for pid in pids)
    return Usage(used / elapsed, sum(map(memory, pids)))
