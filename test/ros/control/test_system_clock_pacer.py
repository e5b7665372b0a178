# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""The machine's clock as stepper and pacer: instants, overruns, and a clock that is set."""

import pytest
from support.control_fakes import FakeLog, MS

from amr_description.control.ros import pacing
from amr_description.control.ros.pacing import SystemClockPacer

PERIOD = 10 * MS
EPOCH = 1_700_000_000_000_000_000


class Machine:
    """``time`` and the queue as the clock uses them, without waiting."""

    def __init__(self):
        self.monotonic = 5_000 * MS
        self.offset = EPOCH
        self.lateness = 0
        self.hold_up = 0
        """ns for which the thread is held up before it reads the system clock next."""
        self.calls_come = False
        self.calls = []

    def monotonic_ns(self):
        return self.monotonic

    def time_ns(self):
        self.monotonic += self.hold_up
        self.hold_up = 0
        return self.monotonic + self.offset

    def wait(self, delay):
        if self.calls_come:
            return True
        self.monotonic += round(delay * 1e9) + self.lateness
        return False

    def put(self, call):
        self.calls.append(call)


@pytest.fixture
def machine(monkeypatch):
    machine = Machine()
    monkeypatch.setattr(pacing, 'time', machine)
    return machine


def make(machine, **options):
    log = FakeLog()
    return SystemClockPacer(machine, log, 100, **options), log


def test_time_is_the_system_clocks(machine):
    clock, _ = make(machine)
    assert clock.time == machine.time_ns()


def test_a_cycle_begins_when_it_is_due_and_says_when_that_truly_was(machine):
    clock, log = make(machine)
    start = clock.time
    machine.lateness = 70_000
    clock.advance(PERIOD)
    assert clock.time == start + PERIOD
    assert clock.pace(clock.time)
    assert clock.time == start + PERIOD + 70_000
    assert log.lines == []


def test_a_call_ends_the_wait_and_the_instant_stays(machine):
    clock, _ = make(machine)
    clock.advance(PERIOD)
    due = clock.time
    machine.calls_come = True
    assert not clock.pace(due)
    assert clock.time == due
    machine.calls_come = False
    assert clock.pace(due)


def test_missed_cycles_are_left_out_and_told_in_ros2_controls_words(machine):
    clock, log = make(machine)
    start = clock.time
    clock.advance(PERIOD)
    machine.monotonic += 25 * MS
    assert not clock.pace(clock.time)
    assert clock.time == start + 3 * PERIOD
    assert log.texts() == [
        'Overrun detected! The controller manager missed its desired rate of 100 Hz. The loop '
        'took 25.000000 ms (missed cycles : 3).'
    ]
    assert clock.pace(clock.time)
    assert machine.time_ns() == start + 3 * PERIOD


def test_without_overrun_handling_they_are_made_good(machine):
    clock, log = make(machine, manages_overruns=False)
    start = clock.time
    machine.monotonic += 25 * MS
    times = []
    for _ in range(3):
        clock.advance(PERIOD)
        assert clock.pace(clock.time)
        times.append(clock.time - start)
    assert times == [PERIOD, 2 * PERIOD, 3 * PERIOD]
    assert log.lines == []


@pytest.mark.parametrize('step', [3600, -3600])
def test_a_clock_that_is_set_is_followed_at_once(machine, step):
    clock, log = make(machine)
    machine.offset += step * 1_000_000_000
    clock.advance(PERIOD)
    assert not clock.pace(clock.time)
    assert machine.calls == [clock.on_time_jump]
    assert clock.time == machine.time_ns()
    assert log.texts() == [
        f'The system clock was set by {step:+.3f} s: controllers begin anew at its time'
    ]


def test_slow_drift_is_no_step(machine):
    clock, log = make(machine)
    machine.offset += 10 * MS
    clock.advance(PERIOD)
    assert clock.pace(clock.time)
    assert log.lines == []


def test_a_thread_held_up_between_the_two_clocks_sees_no_step(machine):
    clock, log = make(machine)
    clock.advance(PERIOD)
    machine.hold_up = 500 * MS
    assert not clock.pace(clock.time)
    assert machine.calls == []
    (said,) = log.texts()
    assert said.startswith('Overrun detected!')
