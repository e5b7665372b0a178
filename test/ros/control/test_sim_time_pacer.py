# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""Another's /clock as stepper and pacer."""

import pytest
from support.control_fakes import FakeHardware, FakeLog, MS

from amr_description.control.controller_manager import ControllerManager
from amr_description.control.loop import Loop
from amr_description.control.resource_manager import ResourceManager
from amr_description.control.ros.pacing import SimTimePacer

PERIOD = 10 * MS


class Box:
    """A queue that is never waited for in vain: ``during`` is what the ROS thread does."""

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
    clock = SimTimePacer(box)
    clock.receive(1000 * MS)
    clock.resume(0)
    return clock


def test_nothing_is_due_before_the_first_time_is_heard(box):
    clock = SimTimePacer(box)
    clock.advance(PERIOD)
    box.during.append(lambda: None)
    assert not clock.pace(clock.time)
    clock.receive(0)
    assert box.calls == [clock.on_start]


def test_a_cycle_begins_once_its_instant_is_heard(box):
    clock = started(box)
    clock.advance(PERIOD)
    due = clock.time
    box.during += [lambda: clock.receive(1004 * MS), lambda: clock.receive(1013 * MS)]
    assert [clock.pace(due) for _ in range(3)] == [False, False, True]
    assert clock.time == 1013 * MS


def test_an_instant_that_is_over_is_not_waited_for(box):
    clock = started(box)
    clock.receive(2000 * MS)
    clock.advance(PERIOD)
    assert clock.pace(clock.time)
    assert clock.time == 2000 * MS


def test_time_that_goes_back_is_told_to_the_control_thread(box):
    clock = started(box)
    clock.advance(PERIOD)
    told = []
    clock.on_time_jump = lambda: told.append(clock.time)
    clock.receive(5 * MS)
    assert told == []
    box.calls[-1]()
    assert told == [5 * MS]


class Nobody:
    """A publisher port that nobody hears."""

    def set_clocks(self, time):
        pass

    def publish(self, time):
        pass


def test_a_manager_ticks_on_at_once_when_time_goes_back(box):
    box.take = lambda: [box.calls.pop(0) for _ in range(len(box.calls))]
    clock = started(box)
    loop = Loop(clock, clock, box, Nobody(), PERIOD)
    clock.on_time_jump = loop.reset
    resources = ResourceManager(FakeLog())
    resources.add(FakeHardware())
    resources.start_components()
    manager = ControllerManager(resources, 100, FakeLog())
    manager.begin(clock.time)
    loop.managers.append(manager)
    ticks = []
    manager.on_tick = ticks.append
    heard = [1010, 1020, 0, 10, 20]
    box.during += [lambda each=each: clock.receive(each * MS) for each in heard]
    while box.during:
        loop.run_once()
    assert ticks == [1000 * MS, 1010 * MS, 1020 * MS, 0, 10 * MS]
