# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""Processes: which there are, and what they take, from ``/proc``."""

from collections.abc import Mapping
import os
from pathlib import Path

from amr_description.clock import NANOSECONDS

_PAGE_SIZE = os.sysconf('SC_PAGE_SIZE')
_TICK = os.sysconf('SC_CLK_TCK')


def descendants(pid: int, parents: Mapping[int, int]) -> set[int]:
    """Return a process and all below it; ``parents``: the parent of each process."""
    found = {pid}
    while more := {each for each, parent in parents.items() if parent in found} - found:
        found |= more
    return found


def processes_below(pid: int) -> set[int]:
    """Return a process and all below it."""
    parents = {}
    for entry in os.listdir('/proc'):
        if entry.isdecimal():
            try:
                stat = Path('/proc', entry, 'stat').read_text(encoding='utf-8', errors='replace')
            except OSError:  # it has ended
                continue
            parents[int(entry)] = int(stat.rpartition(')')[2].split()[1])
    return descendants(pid, parents)


def name_of(pid: int) -> str:
    """Return what a process is, by its command line, and its number."""
    words = Path(f'/proc/{pid}/cmdline').read_text(encoding='utf-8', errors='replace').split('\0')
    stems = [Path(word).stem for word in words[:3] if word and not word.startswith('-')]
    named = [stem for stem in stems if not stem.startswith('python')]
    return f'  {(named or stems or ["process"])[0][:24]} [{pid}]'


def processor_time(pid: int) -> float:
    """Return the processor time of a process so far, s (proc(5): utime and stime)."""
    with open(f'/proc/{pid}/stat', encoding='ascii', errors='replace') as file:
        fields = file.read().rpartition(')')[2].split()
    return (int(fields[11]) + int(fields[12])) / _TICK


def thread_times(pid: int) -> float:
    """Return the processor time of a process's threads so far, s, to the ns (schedstat)."""
    total = 0
    for thread in Path(f'/proc/{pid}/task').iterdir():
        try:
            total += int((thread / 'schedstat').read_text(encoding='ascii').split()[0])
        except OSError:  # it has ended
            continue
    return total / NANOSECONDS


def resident(pid: int) -> int:
    """Return the resident memory of a process, bytes (proc(5): statm)."""
    return int(Path(f'/proc/{pid}/statm').read_text(encoding='ascii').split()[1]) * _PAGE_SIZE
