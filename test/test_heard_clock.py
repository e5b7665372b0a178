# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""Another's /clock as stepper and pacer."""

from control_fakes import MS
import pytest

from amr_description.nodes.heard_clock import HeardClock

PERIOD = 10 * MS


class Box:
    """A mailbox that is never waited for in vain: ``during`` is what the ROS thread does."""

    def __init__(self):
        self.calls = []
        self.during = []

    def put(self, call):
        self.calls.append(call)

    def wake(self):
        pass

    def wait(self):
        assert self.during, 'it would wait for ever'
        self.during.pop(0)()


@pytest.fixture
def box():
    return Box()


def started(box):
    clock = HeardClock(box)
    clock.hear(1000 * MS)
    clock.resume(0)
    return clock


def test_nothing_is_due_before_the_first_time_is_heard(box):
    clock = HeardClock(box)
    clock.advance(PERIOD)
    box.during.append(lambda: None)
    assert not clock.pace(clock.time)
    clock.hear(0)
    assert box.calls == [clock.on_start]


def test_a_cycle_begins_once_its_instant_is_heard(box):
    clock = started(box)
    clock.advance(PERIOD)
    due = clock.time
    box.during += [lambda: clock.hear(1004 * MS), lambda: clock.hear(1013 * MS)]
    assert [clock.pace(due) for _ in range(3)] == [False, False, True]
    assert clock.time == 1013 * MS


def test_an_instant_that_is_over_is_not_waited_for(box):
    clock = started(box)
    clock.hear(2000 * MS)
    clock.advance(PERIOD)
    assert clock.pace(clock.time)
    assert clock.time == 2000 * MS


def test_time_that_goes_back_is_told_to_the_owner(box):
    clock = started(box)
    clock.hear(5 * MS)
    assert box.calls[-1] == clock.on_step
    clock.resume(0)
    assert clock.time == 5 * MS
