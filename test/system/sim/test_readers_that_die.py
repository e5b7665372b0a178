# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""Readers that come, go and are killed: the simulator neither waits for them nor stays behind."""

from dataclasses import dataclass
import os
from pathlib import Path
import signal
import time

import pytest
from rclpy.executors import SingleThreadedExecutor
from rclpy.node import Node
from support.ros_processes import PATIENCE
from support.waiting import until

from amr_description.bringup.guardian import remove_unused_segments
from amr_description.ros.runtime import ros, spinning
from benchmarks.churn import Churn, ClockObserver, LATE, processor_waits, simulator

ROUNDS = 2
MOST_GROWTH = 20.0
"""MB."""
STANDS = 1.5
"""s without /clock, or to the end, and no wait for a processor: dead readers cost 2 s or more."""


@pytest.fixture
def churn():
    """The readers; what the killed ones have left is taken away, as others would wait for it."""
    churn = Churn(seed=1, domain=int(os.environ['ROS_DOMAIN_ID']))
    yield churn
    churn.remove_ports()
    remove_unused_segments()


@dataclass(frozen=True)
class Outcome:
    """How the simulator was off."""

    observer: ClockObserver
    silent: float
    """s since the last message when the readers had gone."""
    ended: float
    """s from SIGINT to its end, with 0; without the waits for a processor."""
    maps: str
    """What is mapped into its memory."""
    growth: float
    """MB that it needs more than after the first tenth of the rounds."""


def outcome_of(churn, factor, rounds):
    """Have rounds of readers come and go, then ask the simulator to stop."""
    with simulator(factor) as process, ros([]):
        node = Node('clock_observer')
        observer = ClockObserver(node, process.pid)
        with spinning(node, executor=SingleThreadedExecutor):
            for number in range(rounds):
                if number == rounds // 10:
                    before = resident(process.pid)
                churn.run_round()
            until(lambda: observer.count > 100)  # it goes on
            silent = time.monotonic() - observer.last_heard
            growth = resident(process.pid) - before
        maps = Path(f'/proc/{process.pid}/maps').read_text(encoding='utf-8')
        return Outcome(observer, silent, time_to_end(process), maps, growth)


def time_to_end(process):
    """Interrupt the simulator; return s to its end, without its and our waits for a processor."""
    own, at_first, waited = os.getpid(), processor_waits(process.pid), 0.0
    waited_here = processor_waits(own).get(str(own), 0)
    begin = time.monotonic()
    process.send_signal(signal.SIGINT)

    def has_ended():
        nonlocal waited
        now = processor_waits(process.pid)  # of threads that have ended it says no more
        times = sorted(ns - at_first.get(thread, 0) for thread, ns in now.items())
        waited = max(waited, sum(times[-2:]) * 1e-9)
        return process.poll() is not None

    until(has_ended)
    took = time.monotonic() - begin
    assert process.returncode == 0
    waited_here = processor_waits(own).get(str(own), 0) - waited_here
    return took - waited - waited_here * 1e-9


def resident(process):
    """MB of memory that a process has."""
    pages = int(Path(f'/proc/{process}/statm').read_text(encoding='utf-8').split()[1])
    return pages * os.sysconf('SC_PAGESIZE') / 1e6


def unexplained(observer):
    """s: the longest time without /clock that was no wait for a processor."""
    return max((gap.length - gap.waited for gap in observer.gaps), default=0.0)


def test_readers_that_are_killed_hold_nothing_up(churn):
    found = outcome_of(churn, 1.0, ROUNDS)
    assert found.ended < STANDS
    assert found.observer.count > 100
    assert unexplained(found.observer) < STANDS
    assert found.silent < PATIENCE
    assert '/dev/shm/fastrtps' not in found.maps  # so none of it can stay behind either


@pytest.mark.long
@pytest.mark.parametrize('factor', [1.0, 5.0])
def test_five_hundred_rounds_of_them_make_no_tick_late(churn, factor):
    found = outcome_of(churn, factor, 500)
    assert unexplained(found.observer) <= LATE
    assert found.silent < 1.0
    assert found.ended < 1.0
    assert '/dev/shm/fastrtps' not in found.maps
    assert found.growth < MOST_GROWTH
