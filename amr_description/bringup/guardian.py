# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
The guardian: a program that ends what is left of a bring-up, whatever became of the orchestrator.

``python -I -S guardian.py LIFELINE_FD RUN ORCHESTRATOR_PID``, started by ``lifeline.py``. It waits
until the lifeline breaks: at every end of the orchestrator, by SIGKILL too. Then it ends every
process that carries the mark of the run in its environment, and their descendants: a process that
ignores SIGINT, one that left its session, one whose parent is gone. Last it takes away the shared
memory that killed ROS nodes have left, of this run or of one before.

It is not the parent of any of them, so it looks into ``/proc`` again and again; pidfds would save
the looking, but need Linux 5.3 (the ROS wheels run from RHEL 8's 4.18 on). It imports neither this
package nor ``site``: it is up in 20 ms and needs no PYTHONPATH.
"""

from collections.abc import Callable, Iterable, Iterator
import contextlib
import fcntl
import os
import signal
import sys
import time
from typing import NamedTuple

RUN_VARIABLE = 'AMR_BRINGUP_RUN'
_PATIENCE = 2.0  # s from SIGINT to SIGKILL
_GIVE_UP = 4.0  # s after which a process that even SIGKILL does not end is reported
_INTERVAL = 0.02  # s between two looks
_SHARED_MEMORY = '/dev/shm'
_SETTLED = 5.0  # s of age from which a lock that nobody holds is not just about to be taken


class Process(NamedTuple):
    """A process that is no zombie."""

    pid: int
    parent: int
    marked: bool
    """Whether it carries the mark of the run."""
    start: int = 0
    """When it began, in clock ticks since boot: a pid may be used again."""


def processes(run: str) -> Iterator[Process]:
    """Yield the processes of this machine."""
    mark = os.fsencode(f'{RUN_VARIABLE}={run}')
    for name in os.listdir('/proc'):
        if name.isdecimal():
            with contextlib.suppress(OSError):  # it ended meanwhile
                with open(f'/proc/{name}/stat', 'rb') as file:
                    # 'pid (any name) state parent …', 22 fields up to the start
                    state, parent, *rest = file.read().rpartition(b')')[2].split()
                if state not in b'ZX':
                    marked = mark in _environment(name)
                    yield Process(int(name), int(parent), marked, int(rest[17]))


def _environment(pid: str) -> list[bytes]:
    try:
        with open(f'/proc/{pid}/environ', 'rb') as file:
            return file.read().split(b'\0')
    except PermissionError:  # another user's
        return []


def family(processes: Iterable[Process], root: int, spare: int) -> list[Process]:
    """
    Return all marked processes, and the descendants of those and of ``root``, by pid.

    :param root: The orchestrator, which is not in the family.
    :param spare: A process, the guardian, to leave out with its descendants.
    """
    listed = [process for process in processes if process.pid not in (root, spare)]
    found = {process.pid: process for process in listed if process.marked}
    while more := {
        process.pid: process
        for process in listed
        if process.pid not in found and (process.parent in found or process.parent == root)
    }:
        found |= more
    return [found[pid] for pid in sorted(found)]


class Search:
    """Finds the family of a run, and whoever was in it once: its parent may be gone since."""

    def __init__(self, run: str, root: int, spare: int) -> None:
        """See :func:`processes` and :func:`family`."""
        self._run, self._root, self._spare = run, root, spare
        self._met: set[tuple[int, int]] = set()

    def __call__(self) -> list[int]:
        """Look; return pids."""
        listed = [
            process._replace(marked=process.marked or (process.pid, process.start) in self._met)
            for process in processes(self._run)
        ]
        found = family(listed, self._root, self._spare)
        self._met.update((process.pid, process.start) for process in found)
        return [process.pid for process in found]


def end(find: Callable[[], list[int]]) -> tuple[set[int], list[int]]:
    """
    End the processes that ``find`` finds, until it finds none; return (ended ones, immortals).

    Two looks in a row must find none: a process is without environment while it starts a program.
    """
    begin = time.monotonic()
    met: set[int] = set()
    looks_without_find = 0
    while looks_without_find < 2:
        pids = find()
        looks_without_find = 0 if pids else looks_without_find + 1
        elapsed = time.monotonic() - begin
        if elapsed > _GIVE_UP:
            return met - set(pids), pids
        for pid in pids:
            if elapsed > _PATIENCE:
                _send(pid, signal.SIGKILL)
            elif pid not in met:
                _send(pid, signal.SIGINT)
        met.update(pids)
        time.sleep(_INTERVAL)
    return met, []


def _send(pid: int, number: signal.Signals) -> None:
    with contextlib.suppress(ProcessLookupError, PermissionError):
        os.kill(pid, number)


def remove_unused_segments(folder: str = _SHARED_MEMORY, settled: float = _SETTLED) -> list[str]:
    """
    Remove the segments of Fast DDS's shared memory that nobody owns; return their names.

    A participant that is killed leaves its own, half a megabyte, for ever: no later one takes it
    away. Its owner holds a lock (flock) on ``<segment>_el``; as with ``fastdds shm clean``, a
    segment is unused if that lock can be had. Ports, which later participants take over, stay.
    """
    removed = []
    for name in os.listdir(folder) if os.path.isdir(folder) else []:
        segment = name.removesuffix('_el')
        if segment == name or not _is_segment(segment):
            continue
        path = f'{folder}/{name}'
        with contextlib.suppress(OSError), open(path, 'rb') as file:  # gone, used, another user's
            if time.time() - os.fstat(file.fileno()).st_ctime >= settled:
                fcntl.flock(file, fcntl.LOCK_EX | fcntl.LOCK_NB)
                os.unlink(f'{folder}/{segment}')
                os.unlink(path)
                removed.append(segment)
    return removed


def _is_segment(name: str) -> bool:
    """Tell names as ``fastrtps_5fcf25dfbd682471`` from those of ports and others."""
    prefix, _, digits = name.partition('_')
    return prefix == 'fastrtps' and len(digits) == 16 and not digits.strip('0123456789abcdef')


def main(lifeline: int, run: str, orchestrator: int) -> int:
    """Wait for the end of the orchestrator and end the rest; exit code 1 if something stays."""
    for number in (signal.SIGINT, signal.SIGTERM, signal.SIGHUP):
        signal.signal(number, signal.SIG_IGN)
    os.read(lifeline, 1)  # nobody ever writes: this returns when the last writer is gone
    ended, immortal = end(Search(run, orchestrator, os.getpid()))
    remove_unused_segments()
    if ended:
        _say(f'[WARNING] [guardian]: ended what was left: pid {_list(ended)}')
    if immortal:
        _say(f'[ERROR] [guardian]: could not end: pid {_list(immortal)}')
    return 1 if immortal else 0


def _say(text: str) -> None:
    with contextlib.suppress(OSError):  # the terminal may be gone
        print(text, file=sys.stderr, flush=True)


def _list(pids: Iterable[int]) -> str:
    return ', '.join(map(str, sorted(pids)))


if __name__ == '__main__':
    sys.exit(main(int(sys.argv[1]), sys.argv[2], int(sys.argv[3])))
