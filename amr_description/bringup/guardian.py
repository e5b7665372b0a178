# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
The guardian, a reaper process: ends what is left of a bring-up, however the orchestrator ended.

``lifeline.py`` starts it as ``python -I -S guardian.py LIFELINE_FD RUN ORCHESTRATOR_PID``. It
waits until the writing end of the lifeline is closed, as happens at every end of the orchestrator,
even by SIGKILL. Then it ends every process that carries the mark of the run in its environment,
and their descendants: those that ignore SIGINT, that left their session, whose parent is gone.
Finally it removes the shared memory that killed ROS nodes have left, in this run or before.

It is the parent of none of them, so it polls ``/proc``; pidfds would save that, but need Linux 5.3
(the ROS wheels run from RHEL 8's 4.18 on). It imports neither this package nor ``site``: it starts
in 20 ms and needs no PYTHONPATH.
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
NOBODY = -1
"""In place of the orchestrator's pid: it has children that are not of the run."""
_KILL_DELAY = 2.0  # s from SIGINT to SIGKILL
_GIVE_UP = 4.0  # s after which a process that even SIGKILL does not end is reported
_POLL_PERIOD = 0.02  # s, at first: most end at once
_SLOWEST_POLL_PERIOD = 0.1  # s; a look at all processes costs about 10 ms of processor time
_SHARED_MEMORY = '/dev/shm'
_SETTLED = 5.0  # s of age; a younger lock file may be just about to be locked


class Process(NamedTuple):
    """A running process."""

    pid: int
    parent: int
    marked: bool
    """Whether it carries the mark of the run."""
    start: int = 0
    """Clock ticks from boot to its start; with the pid, which is reused, its identity."""


def processes(run: str, since: int = 0) -> Iterator[Process]:
    """
    Yield the processes of this machine, without zombies.

    Args:
        run: whose mark to look for.
        since: clock ticks from boot; those that started before are known to have no mark. To read
            the environment of a process takes longer than all else.
    """
    mark = os.fsencode(f'{RUN_VARIABLE}={run}')
    for name in os.listdir('/proc'):
        if name.isdecimal():
            with contextlib.suppress(OSError):  # it ended meanwhile
                with open(f'/proc/{name}/stat', 'rb') as file:
                    # 'pid (any name) state parent …', 22 fields up to the start
                    state, parent, *rest = file.read().rpartition(b')')[2].split()
                if state not in b'ZX':
                    start = int(rest[17])
                    marked = start >= since and mark in _environment(name)
                    yield Process(int(name), int(parent), marked, start)


def _environment(pid: str) -> list[bytes]:
    try:
        with open(f'/proc/{pid}/environ', 'rb') as file:
            return file.read().split(b'\0')
    except PermissionError:  # another user's
        return []


def _start(pid: int) -> int:
    """Return when a process started, in clock ticks from boot; 0: it has ended."""
    with contextlib.suppress(OSError), open(f'/proc/{pid}/stat', 'rb') as file:
        return int(file.read().rpartition(b')')[2].split()[19])
    return 0


def family(processes: Iterable[Process], root: int, spare: int) -> list[Process]:
    """
    Return all marked processes, and the descendants of those and of ``root``, sorted by pid.

    Args:
        processes: all processes.
        root: pid of the orchestrator, which is not included.
        spare: pid of the guardian, which is left out with its descendants.
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


class FamilySearch:
    """Finds the family of a run, with those once found in it whose parent is gone since."""

    def __init__(self, run: str, root: int, spare: int) -> None:
        """Take the arguments of :func:`processes` and :func:`family`."""
        self._run, self._root, self._spare = run, root, spare
        # The programs of a run start after its orchestrator, whose pid is its own while it lives.
        self._since = _start(root) if os.getppid() == root else 0
        self._known: set[tuple[int, int]] = set()  # (pid, start)

    def __call__(self) -> list[int]:
        """Return the pids of those that are running now."""
        listed = [
            process._replace(marked=process.marked or (process.pid, process.start) in self._known)
            for process in processes(self._run, self._since)
        ]
        found = family(listed, self._root, self._spare)
        self._known.update((process.pid, process.start) for process in found)
        return [process.pid for process in found]


def end(find: Callable[[], list[int]]) -> tuple[set[int], list[int]]:
    """
    End the processes that ``find`` returns, until it returns none; return (ended, not ended).

    It must return none twice in a row: during exec() a process has no environment.
    """
    begin = time.monotonic()
    known: set[int] = set()
    empty_polls = 0
    while empty_polls < 2:
        pids = find()
        empty_polls = 0 if pids else empty_polls + 1
        elapsed = time.monotonic() - begin
        if elapsed > _GIVE_UP:
            return known - set(pids), pids
        for pid in pids:
            if elapsed > _KILL_DELAY:
                _send(pid, signal.SIGKILL)
            elif pid not in known:
                _send(pid, signal.SIGINT)
        known.update(pids)
        time.sleep(_poll_period(elapsed) if pids else _POLL_PERIOD)
    return known, []


def _poll_period(elapsed: float) -> float:
    """Return a tenth of the wait since the last signal, within bounds, s."""
    waited = elapsed if elapsed <= _KILL_DELAY else elapsed - _KILL_DELAY
    return min(max(_POLL_PERIOD, waited / 10.0), _SLOWEST_POLL_PERIOD)


def _send(pid: int, number: signal.Signals) -> None:
    with contextlib.suppress(ProcessLookupError, PermissionError):
        os.kill(pid, number)
        os.kill(pid, signal.SIGCONT)  # one that is stopped does not hear of it


def remove_unused_segments(folder: str = _SHARED_MEMORY, settled: float = _SETTLED) -> list[str]:
    """
    Remove the segments of Fast DDS's shared memory that no process owns; return their names.

    A participant that is killed leaves its segment, half a megabyte, which no later participant
    removes. The owner of a segment holds a lock (flock) on ``<segment>_el``; as ``fastdds shm
    clean`` does, a segment counts as unused if that lock is free. Ports stay: later participants
    reuse them.

    Args:
        folder: where the segments are.
        settled: s of age that a lock file must have; see ``_SETTLED``.
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
    """Return whether it is a name as ``fastrtps_5fcf25dfbd682471``; ports have others."""
    prefix, _, digits = name.partition('_')
    return prefix == 'fastrtps' and len(digits) == 16 and not digits.strip('0123456789abcdef')


def main(lifeline: int, run: str, orchestrator: int) -> int:
    """Wait for the end of the orchestrator and end the rest; return 1 if something is left."""
    for number in (signal.SIGINT, signal.SIGTERM, signal.SIGHUP):
        signal.signal(number, signal.SIG_IGN)
    find = FamilySearch(run, orchestrator, os.getpid())
    os.read(lifeline, 1)  # nobody ever writes: it returns when the writing end is closed
    ended, not_ended = end(find)
    remove_unused_segments()
    if ended:
        _log(f'[WARNING] [guardian]: ended what was left: pid {_list(ended)}')
    if not_ended:
        _log(f'[ERROR] [guardian]: could not end: pid {_list(not_ended)}')
    return 1 if not_ended else 0


def _log(text: str) -> None:
    with contextlib.suppress(OSError):  # the terminal may be gone
        print(text, file=sys.stderr, flush=True)


def _list(pids: Iterable[int]) -> str:
    return ', '.join(map(str, sorted(pids)))


if __name__ == '__main__':
    sys.exit(main(int(sys.argv[1]), sys.argv[2], int(sys.argv[3])))
