# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""The guardian: which processes it ends, and which shared memory it removes."""

import fcntl
import os
import signal
import subprocess
import sys

import pytest

from amr_description.bringup.guardian import (
    end,
    family,
    FamilySearch,
    Process,
    processes,
    remove_unused_segments,
    RUN_VARIABLE,
)

ROOT, GUARDIAN = 10, 11


@pytest.mark.parametrize(
    ('listed', 'expected'),
    [
        ([(20, 1, True), (21, 1, False)], [20]),
        ([(23, 22, False), (22, 21, False), (21, 20, False), (20, 1, True)], [20, 21, 22, 23]),
        ([(ROOT, 1, False), (GUARDIAN, ROOT, False), (20, ROOT, False)], [20]),
        ([(ROOT, 9, True), (9, 1, False)], []),
        ([(GUARDIAN, 1, True), (30, GUARDIAN, False)], []),
        ([(1, 0, False), (2, 0, False)], []),
    ],
    ids=['marked', 'descendants', 'adopted', 'not the parents', 'not the guardian', 'nobody'],
)
def test_family(listed, expected):
    found = family((Process(*entry) for entry in listed), ROOT, GUARDIAN)
    assert [process.pid for process in found] == expected


def test_the_mark_is_read_from_the_environment():
    run = f'run-{os.getpid()}'
    words = [sys.executable, '-I', '-S', '-c', 'print(1, flush=True); input()']
    variables = {**os.environ, RUN_VARIABLE: run}
    with subprocess.Popen(
        words, env=variables, stdin=subprocess.PIPE, stdout=subprocess.PIPE
    ) as process:
        process.stdout.readline()
        (found,) = [p for p in processes(run) if p.marked]
        assert found[:3] == (process.pid, os.getpid(), True)
        assert not any(p.marked for p in processes(run[:-1]))
        assert [p.pid for p in processes(run, since=found.start) if p.marked] == [found.pid]
        assert not any(p.marked for p in processes(run, since=found.start + 1))
        process.kill()
        os.waitid(os.P_PID, process.pid, os.WEXITED | os.WNOWAIT)
        assert process.pid not in [p.pid for p in processes(run)], 'a zombie counts as ended'


def test_a_process_found_once_is_found_again_but_not_another_of_its_pid(monkeypatch):
    looks = iter(
        [
            [Process(20, 1, True, start=5), Process(21, 20, False, start=6)],
            [Process(21, 1, False, start=6)],  # its parent is gone, and it has no mark
            [Process(21, 1, False, start=9)],
        ]
    )
    monkeypatch.setattr(
        'amr_description.bringup.guardian.processes', lambda run, since: next(looks)
    )
    search = FamilySearch('run', ROOT, GUARDIAN)
    assert [search(), search(), search()] == [[20, 21], [21], []]


class Clock:
    """Time that passes only where the guardian waits for it."""

    def __init__(self):
        self.now = 0.0

    def monotonic(self):
        return self.now

    def sleep(self, seconds):
        self.now += seconds


@pytest.mark.parametrize('ends_on', [signal.SIGINT, signal.SIGKILL, None])
def test_sigint_then_sigkill_and_a_limit_of_time(monkeypatch, ends_on):
    sent = []
    clock = Clock()
    monkeypatch.setattr('amr_description.bringup.guardian.time', clock)
    monkeypatch.setattr('os.kill', lambda pid, number: sent.append((pid, number)))
    ended, immortal = end(lambda: [] if (7, ends_on) in sent else [7])
    assert sent[0] == (7, signal.SIGINT)
    assert sent.count((7, signal.SIGINT)) == 1
    assert (ended, immortal) == (({7}, []) if ends_on else (set(), [7]))
    assert clock.now < 5.0


def test_one_empty_poll_is_not_enough(monkeypatch):
    monkeypatch.setattr('amr_description.bringup.guardian.time', Clock())
    monkeypatch.setattr('os.kill', lambda pid, number: None)
    looks = iter([[], [5], [], []])
    assert end(lambda: next(looks)) == ({5}, [])
    assert next(looks, 'all taken') == 'all taken'


def test_shared_memory_without_an_owner_is_removed(tmp_path):
    orphan, owned, port = (
        'fastrtps_0123456789abcdef',
        'fastrtps_fedcba9876543210',
        'fastrtps_port7',
    )
    for name in (orphan, owned, port, 'fastrtps_0123', 'other'):
        (tmp_path / name).touch()
        (tmp_path / f'{name}_el').touch()
    with (tmp_path / f'{owned}_el').open() as lock:
        fcntl.flock(lock, fcntl.LOCK_EX)
        assert remove_unused_segments(str(tmp_path), settled=1000.0) == []
        assert remove_unused_segments(str(tmp_path), settled=0.0) == [orphan]
    left = {path.name.removesuffix('_el') for path in tmp_path.iterdir()}
    assert left == {owned, port, 'fastrtps_0123', 'other'}
    assert remove_unused_segments(str(tmp_path), settled=0.0) == [owned]
