# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""A control loop that stands: what is logged, and how the process ends without it."""

import os
import threading
import time
from types import SimpleNamespace

import pytest
from rclpy.impl.rcutils_logger import RcutilsLogger

from amr_description.control.loop import Loop
from amr_description.control.ros import loop_thread
from amr_description.control.ros.loop_publisher import LoopPublisher
from amr_description.control.ros.loop_thread import CallQueue, LoopThread
from amr_description.control.ros.loop_watchdog import WatchdogClock
from amr_description.log import Severity

PATIENCE = 10.0
STANDS = 'The control loop has stood for '
GOES_ON = 'The control loop goes on after '


class ManualClock(WatchdogClock):
    """Time passes by :meth:`look` alone."""

    def __init__(self):
        self.time = self.missed = 0.0
        self._looks, self._is_done = threading.Semaphore(0), threading.Semaphore(0)

    def now(self):
        return self.time

    def time_without_processor(self, _native_id):
        return self.missed

    def wait(self, ended):
        self._is_done.release()
        self._looks.acquire()
        return ended.is_set()

    def look(self, times=1, *, period=0.1, missed=0.0):
        """Have the watchdog look so often, each time ``period`` s later; return after the last."""
        for _ in range(times):
            assert self._is_done.acquire(timeout=PATIENCE)
            self.time += period
            self.missed += missed
            self._looks.release()
        assert self._is_done.acquire(timeout=PATIENCE)
        self._is_done.release()

    def end(self):
        """Let a watchdog that has ended notice it."""
        self._looks.release()


class World:
    """A stepper, pacer and publisher; :attr:`gate`, when closed, holds up who publishes."""

    def __init__(self, calls):
        self.time = 0
        self.gate = threading.Event()
        self.gate.set()
        self.held = threading.Event()
        self._calls = calls

    def advance(self, period):
        self.time += period

    def pace(self, _):
        return not self._calls.wait(0.01)

    def resume(self, _):
        pass

    def set_clocks(self, _):
        pass

    def publish(self, _):
        if not self.gate.is_set():
            self.held.set()
        self.gate.wait()

    def hold(self):
        """Hold up who publishes; return when it is held up."""
        self.gate.clear()
        assert self.held.wait(PATIENCE)


@pytest.fixture
def clock():
    return ManualClock()


@pytest.fixture
def running(clock):
    calls = CallQueue()
    world = World(calls)
    thread = LoopThread(calls, SimpleNamespace(wake=lambda: None), watchdog_clock=clock)
    thread.loop = Loop(world, world, calls, world, 10_000_000)
    lines = []
    thread.log = lambda severity, text: lines.append((severity, text))
    thread.start()
    yield thread, world, lines
    world.gate.set()
    thread.stop()
    clock.end()


def run_a_cycle(thread):
    """Return when the loop has begun another cycle."""
    begun = threading.Event()
    thread._calls.put(begun.set)
    assert begun.wait(PATIENCE)


def test_a_loop_that_stands_is_logged_once_with_its_call_and_so_is_its_going_on(running, clock):
    thread, world, lines = running
    world.hold()
    clock.look(5)
    assert lines == []
    clock.look(2)
    severity, text = lines[0]
    assert severity is Severity.ERROR
    assert text.startswith(STANDS)
    assert 'World.publish (control/test_loop_watchdog.py, line ' in text
    assert len(text.splitlines()) == 1
    clock.look(50)
    assert len(lines) == 1
    world.gate.set()
    run_a_cycle(thread)
    clock.look()
    assert len(lines) == 2
    assert lines[1][1].startswith(GOES_ON)


def test_a_loop_that_waits_does_not_stand(running, clock):
    thread, _, lines = running
    paused, tick = threading.Event(), threading.Event()
    thread._calls.put(lambda: (thread.loop.pause(), paused.set()))
    assert paused.wait(PATIENCE)
    while not thread._calls.is_waiting:
        tick.wait(0.001)
    clock.look(20)
    assert lines == []


def test_a_call_between_two_cycles_may_take_as_long_as_it_takes(running, clock):
    thread, _, lines = running
    begun, done = threading.Event(), threading.Event()
    thread._calls.put(lambda: (begun.set(), done.wait(PATIENCE)))
    assert begun.wait(PATIENCE)
    clock.look(20)
    done.set()
    run_a_cycle(thread)
    clock.look(3)
    assert lines == []


def test_what_follows_a_cycle_may_take_as_long_as_it_takes(running, clock):
    """Time waits for a picture, and the end of the process does not."""
    _, world, lines = running
    publisher = LoopPublisher(RcutilsLogger('test'))
    publisher.followers.append(lambda: World.publish(world, 0))
    world.publish = lambda _: publisher.follow()
    world.hold()
    clock.look(20)
    assert lines == []


def test_a_loop_without_a_processor_does_not_stand(running, clock):
    _, world, lines = running
    world.hold()
    clock.look(20, missed=0.1)
    assert lines == []


def test_a_process_that_stood_as_a_whole_is_logged_when_it_goes_on(running, clock):
    """The watchdog did not look either."""
    thread, _, lines = running
    run_a_cycle(thread)
    clock.look()
    run_a_cycle(thread)
    tick = threading.Event()
    while thread._calls.has_calls:
        tick.wait(0.001)
    clock.look(period=2.0)
    (line,) = lines
    assert line[0] is Severity.ERROR
    assert line[1].startswith('The control loop stood for 2.0 s, and all of this process with it')


@pytest.mark.parametrize('is_ticking', [False, True])
def test_the_process_ends_without_a_loop_that_stands(
    running, clock, monkeypatch, capfd, is_ticking
):
    thread, world, _ = running
    codes, stopped = [], []

    def leave(code):
        codes.append(code)
        world.gate.set()  # in the test the thread is joined after all

    monkeypatch.setattr(os, '_exit', leave)
    manager = SimpleNamespace(
        resources=SimpleNamespace(shut_down=lambda: stopped.append(threading.get_ident())),
        is_due=lambda _: False,
        next_tick=1 << 62,
        shut_down=lambda _: None,
    )
    thread._calls.put(lambda: thread.loop.managers.append(manager))
    if is_ticking:
        monkeypatch.setattr(loop_thread, 'is_in', lambda *_: True)
    world.hold()
    clock.look(7)
    begin = time.monotonic()
    thread.stop()
    assert time.monotonic() - begin < 5.0  # 0.05 s, on a machine that has the time
    assert codes == [1]
    line, *rest = capfd.readouterr().err.splitlines()
    assert not rest
    assert 'the control loop stands in ' in line
    assert 'World.publish' in line
    assert line.endswith('motors: left to their own watchdog' if is_ticking else 'motors: stopped')
    assert len(stopped) == (0 if is_ticking else 1)
