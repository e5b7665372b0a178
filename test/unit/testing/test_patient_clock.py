# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""A simulator that works on an answer has more time for it than one that does nothing."""

from pathlib import Path
import subprocess
import sys
import time
from types import SimpleNamespace

import pytest

from amr_description.testing import lock_step
from amr_description.testing.lock_step import PatientClock
from amr_description.testing.program import SimulatorProcess


@pytest.mark.parametrize(
    ('worked', 'counted'), [(0.0, 10.0), (9.5, 0.5), (25.0, 0.0), (-1.0, 10.0)]
)
def test_only_the_time_counts_in_which_it_does_not_work(monkeypatch, worked, counted):
    """s; of two threads that work both count, of one that has ended nothing."""
    wall, process = [5.0], SimpleNamespace(worked=lambda: 3.0)
    monkeypatch.setattr(time, 'monotonic', lambda: wall[0])
    clock = PatientClock(process)
    began = clock.now()
    wall[0] += 10.0
    process.worked = lambda: 3.0 + worked
    assert clock.now() - began == pytest.approx(counted)


def test_one_that_never_ends_what_it_does_is_not_waited_for_without_end(monkeypatch):
    wall, process = [5.0], SimpleNamespace(worked=lambda: wall[0])
    monkeypatch.setattr(time, 'monotonic', lambda: wall[0])
    clock = PatientClock(process)
    began = clock.now()
    wall[0] += lock_step._LONGEST_WORK + 40.0
    assert clock.now() - began == pytest.approx(40.0)


def test_what_a_process_works_is_read_of_it():
    with subprocess.Popen([sys.executable, '-c', 'while True: pass']) as process:
        simulator = SimulatorProcess(process, Path('none.log'))
        try:
            deadline = time.monotonic() + 60.0
            while simulator.worked() < 0.5 and time.monotonic() < deadline:
                process.poll()
            assert simulator.worked() >= 0.5
        finally:
            process.kill()
    assert simulator.worked() == 0.0
