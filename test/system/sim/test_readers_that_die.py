# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""Readers that come, go and are killed: the simulator neither waits for them nor stays behind."""

import os
from pathlib import Path
import signal
import time

import pytest
from rclpy.executors import SingleThreadedExecutor
from rclpy.node import Node
from support.ros_processes import PATIENCE

from amr_description.bringup.guardian import remove_unused_segments
from amr_description.ros.runtime import ros, spinning
from benchmarks.churn import Churn, ClockObserver, simulator

ROUNDS = 3
STANDS = 1.5
"""s without /clock: dead readers cost 2 s or more, a busy machine hopefully less."""


@pytest.fixture
def churn():
    """The readers; what the killed ones have left is taken away, as others would wait for it."""
    churn = Churn(seed=1, domain=int(os.environ['ROS_DOMAIN_ID']))
    yield churn
    churn.remove_ports()
    remove_unused_segments()


def test_readers_that_are_killed_hold_nothing_up(churn):
    with simulator(1.0) as process, ros([]):
        node = Node('clock_observer')
        observer = ClockObserver(node, process.pid)
        with spinning(node, executor=SingleThreadedExecutor):
            for _ in range(ROUNDS):
                churn.run_round()
        maps = Path(f'/proc/{process.pid}/maps').read_text(encoding='utf-8')
        process.send_signal(signal.SIGINT)
        begin = time.monotonic()
        assert process.wait(PATIENCE) == 0
        assert time.monotonic() - begin < STANDS
    assert observer.count > 100
    assert max((gap.length - gap.waited for gap in observer.gaps), default=0.0) < STANDS
    assert time.monotonic() - observer.last_heard < PATIENCE
    assert '/dev/shm/fastrtps' not in maps  # so none of it can stay behind either
