# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""The control thread, its queue and its pace."""

import threading
import time
from types import SimpleNamespace

import pytest
from support.running_programs import PATIENCE

from amr_description.clock import NANOSECONDS
from amr_description.control.ros import pacing
from amr_description.control.ros.loop_thread import CallQueue, LoopThread
from amr_description.control.ros.pacing import WallPacer


class WallClock:
    """``time`` and an empty queue as the pacer uses them, without waiting."""

    def __init__(self):
        self.now = 100.0
        self.slept = []

    def monotonic(self):
        return self.now

    def wait(self, delay):
        self.slept.append(delay)
        self.now += delay
        return False


def paced(monkeypatch, factor):
    clock = WallClock()
    monkeypatch.setattr(pacing, 'time', clock)
    pacer = WallPacer(factor, clock)
    pacer.resume(0)
    return clock, pacer


def test_calls_come_out_in_the_order_in_which_they_were_put():
    box = CallQueue()
    for number in range(3):
        box.put(number)
    assert list(box.take()) == [0, 1, 2]
    assert list(box.take()) == []


def test_waiting_ends_with_a_call_and_only_with_a_call():
    box = CallQueue()
    box.put(1)
    box.take()
    arrived = []
    waiter = threading.Thread(target=lambda: (box.wait(), arrived.extend(box.take())))
    waiter.start()
    assert arrived == []
    box.put(2)
    waiter.join(5.0)
    assert arrived == [2]


def test_a_call_that_was_taken_already_does_not_keep_the_control_thread_awake():
    box = CallQueue()
    box.put(1)
    box._calls.clear()  # taken by a turn that had cleared the event before the put set it
    assert list(box.take()) == []
    assert not box._arrived.is_set()


def test_a_wait_that_was_ended_without_a_call_ends_no_other_one():
    box = CallQueue(timeout=0.0)
    box.wake()
    assert box.wait()
    assert list(box.take()) == []
    assert not box.wait()


def test_the_pace_is_absolute_so_that_errors_do_not_add_up(monkeypatch):
    clock, pacer = paced(monkeypatch, factor=2.0)
    for tick in range(1, 101):
        clock.now += 0.001  # the work of a turn
        pacer.pace(tick * NANOSECONDS // 100)
    assert abs(clock.now - (100.0 + 0.5)) < 1e-9


def test_a_late_turn_is_made_good_but_a_stop_of_the_machine_is_not(monkeypatch):
    clock, pacer = paced(monkeypatch, factor=1.0)
    clock.now += 0.05
    pacer.pace(NANOSECONDS // 100)
    assert clock.slept == []
    clock.now += 10.0
    pacer.pace(2 * NANOSECONDS // 100)
    pacer.pace(3 * NANOSECONDS // 100)
    assert clock.slept[-1] > 0.0099


def test_as_fast_as_possible_still_yields_now_and_then():
    pacer = WallPacer(0.0, CallQueue())
    pacer.resume(0)
    begin = time.monotonic()
    for tick in range(1000):
        pacer.pace(tick * NANOSECONDS)
    assert time.monotonic() - begin < 1000.0  # a thousand simulated seconds, not waited for


def test_another_factor_counts_from_now_on(monkeypatch):
    clock, pacer = paced(monkeypatch, factor=0.001)
    pacer.set_factor(10.0, NANOSECONDS)
    before = clock.now
    assert pacer.pace(NANOSECONDS)
    assert clock.now == before
    pacer.pace(2 * NANOSECONDS)
    assert clock.now == pytest.approx(before + 0.1)


def test_a_queue_with_a_timeout_ends_a_wait_with_nothing():
    assert CallQueue(timeout=0.001).wait() is False


def test_a_call_ends_the_sleep_of_slow_motion():
    box = CallQueue()
    pacer = WallPacer(1e-9, box)
    pacer.resume(0)
    box.put(print)
    assert pacer.pace(NANOSECONDS) is False


class Manager:
    """Is shut down, and raises then what it is given."""

    def __init__(self, error=None):
        self.error = error
        self.is_down = False

    def shut_down(self, time):
        self.is_down = True
        if self.error is not None:
            raise self.error


class EndingLoop:
    """A loop that raises in its first turn."""

    time = 0

    def __init__(self, error, managers):
        self.error = error
        self.managers = managers

    def run(self):
        raise self.error

    def stop(self):
        pass


@pytest.mark.parametrize('error', [ValueError('a bug'), SystemExit(3)])
def test_whatever_ends_the_loop_every_robot_is_stopped_and_the_process_hears_of_it(error, capfd):
    ended = threading.Event()
    dead = LoopThread(CallQueue(), SimpleNamespace(wake=ended.set))
    dead.loop = EndingLoop(error, [Manager(SystemExit(4)), Manager()])
    dead.start()
    assert ended.wait(PATIENCE)
    dead.stop()
    assert dead.failed
    assert all(manager.is_down for manager in dead.loop.managers)
    assert type(error).__name__ in capfd.readouterr().err
