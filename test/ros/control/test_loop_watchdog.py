# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""A control loop that stands: what is logged, and how the process ends without it."""

import os
import threading
import time
from types import SimpleNamespace

import pytest

from amr_description.control.contracts import Severity
from amr_description.control.loop import Loop
from amr_description.control.ros import loop_thread, loop_watchdog
from amr_description.control.ros.loop_thread import CallQueue, LoopThread

PATIENCE = 10.0
STANDS = 'The control loop has stood for '
GOES_ON = 'The control loop goes on after '


class World:
    """A stepper, pacer and publisher; :attr:`gate`, when closed, holds up who publishes."""

    def __init__(self, calls):
        self.time = 0
        self.gate = threading.Event()
        self.gate.set()
        self.is_held = False
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
        self.is_held = not self.gate.is_set()
        self.gate.wait()


@pytest.fixture
def running():
    calls = CallQueue()
    world = World(calls)
    thread = LoopThread(calls, SimpleNamespace(wake=lambda: None))
    thread.loop = Loop(world, world, calls, world, 10_000_000)
    lines = []
    thread.log = lambda severity, text: lines.append((severity, text))
    thread.start()
    yield thread, world, lines
    world.gate.set()
    thread.stop()


def wait(condition):
    deadline = time.monotonic() + PATIENCE
    while not condition():
        assert time.monotonic() < deadline
        time.sleep(0.01)


def test_a_loop_that_stands_is_logged_once_with_its_call_and_so_is_its_going_on(running):
    _, world, lines = running
    world.gate.clear()
    wait(lambda: lines)
    severity, text = lines[0]
    assert severity is Severity.ERROR
    assert text.startswith(STANDS)
    assert 'World.publish (control/test_loop_watchdog.py, line ' in text
    assert len(text.splitlines()) == 1
    time.sleep(0.5)
    assert len(lines) == 1
    world.gate.set()
    wait(lambda: len(lines) == 2)
    assert lines[1][1].startswith(GOES_ON)


def test_a_loop_that_waits_does_not_stand(running):
    thread, _, lines = running
    thread._calls.put(thread.loop.pause)
    time.sleep(loop_watchdog.LIMIT + 0.5)
    assert lines == []


def test_a_call_between_two_cycles_may_take_as_long_as_it_takes(running):
    thread, _, lines = running
    done = threading.Event()
    thread._calls.put(lambda: (time.sleep(loop_watchdog.LIMIT + 0.5), done.set()))
    assert done.wait(PATIENCE)
    time.sleep(0.3)
    assert lines == []


@pytest.mark.parametrize('is_ticking', [False, True])
def test_the_process_ends_without_a_loop_that_stands(running, monkeypatch, capfd, is_ticking):
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
    world.gate.clear()
    wait(lambda: world.is_held)
    begin = time.monotonic()
    thread.stop()
    assert time.monotonic() - begin < 5.0  # 0.6 s, on a machine that has the time
    assert codes == [1]
    line, *rest = capfd.readouterr().err.splitlines()
    assert not rest
    assert 'the control loop stands in ' in line
    assert 'World.publish' in line
    assert line.endswith('motors: left to their own watchdog' if is_ticking else 'motors: stopped')
    assert len(stopped) == (0 if is_ticking else 1)
