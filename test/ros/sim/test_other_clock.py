# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""Another simulator's time on /clock, and what only looks like it."""

import itertools
import time

import pytest
from rclpy.executors import SingleThreadedExecutor
from rclpy.node import Node
from rosgraph_msgs.msg import Clock
from support.manager_host import ros_in_this_process
from support.running_programs import PATIENCE

from amr_description.clock import NANOSECONDS
from amr_description.ros.messages import fill_stamp
from amr_description.sim.ros import other_clock
from amr_description.sim.ros.other_clock import ClockEvidence, Other, OtherClock

PERIOD = 0.02
"""s between two messages that are heard."""


def verdict_of(seconds, *clocks):
    """Of clocks that are heard in turn, each from an instant to another, with a lead (s)."""
    evidence = ClockEvidence()
    ticks = range(round(seconds / PERIOD))
    for tick, (begin, end, lead) in zip(ticks, itertools.cycle(clocks), strict=False):
        now = tick * PERIOD
        if begin <= now < end:
            evidence.add(now, round((now + lead) * NANOSECONDS), round(now * NANOSECONDS))
    return evidence.verdict


OWN = (0.0, 9.0, -0.001)


@pytest.mark.parametrize(
    ('others', 'verdict'),
    [
        ([], None),
        ([(0.0, 9.0, 60.0)], Other.AHEAD),
        ([(0.0, 9.0, 0.1)], Other.AHEAD),
        ([(0.0, 9.0, -0.5)], Other.BEHIND),
        ([(0.5, 1.2, 60.0)], None),  # it is just ending
        ([(0.3, 0.34, 60.0)], None),  # ours, from before a reset
    ],
)
def test_times_that_are_not_ours(others, verdict):
    assert verdict_of(3.0, OWN, *others) is verdict


def test_a_clock_that_stands_is_ours_while_we_are_paused():
    evidence = ClockEvidence()
    for tick in range(100):
        evidence.add(tick * 0.1, 5 * NANOSECONDS, 5 * NANOSECONDS)
    assert evidence.verdict is None


class Host:
    """A node with a clock of its own at 1 s, which looks for another."""

    def __init__(self, *arguments):
        self.node = Node('ours', cli_args=['--ros-args', *arguments])
        self.other = Node('theirs')
        self.executor = SingleThreadedExecutor()
        self.executor.add_node(self.node)
        self.found = []
        self.deadline = time.monotonic() + PATIENCE
        self.publishers = [
            node.create_publisher(Clock, '/clock', 10) for node in (self.node, self.other)
        ]
        OtherClock(self.node, lambda: NANOSECONDS, lambda *found: self.found.append(found))

    def publish(self, *times):
        for publisher, each in zip(self.publishers, times, strict=True):
            message = Clock()
            fill_stamp(each, message.clock)
            publisher.publish(message)

    def spin(self):
        assert time.monotonic() < self.deadline, 'it still looks, or somebody else hears /clock'
        self.executor.spin_once(timeout_sec=0.01)

    @property
    def is_looking(self):
        return bool(list(self.node.timers)) or self.node.count_subscribers('/clock') > 0


@pytest.fixture
def window():
    """s; where nobody is found, a test lasts as long as that."""
    return 5.0


@pytest.fixture
def arguments():
    """ROS arguments of our node."""
    return ()


@pytest.fixture
def host(window, arguments, monkeypatch):
    monkeypatch.setattr(other_clock, 'WINDOW', window)
    monkeypatch.setattr(other_clock, 'SPAN', 0.1)
    with ros_in_this_process():
        host = Host(*arguments)
        yield host
        host.executor.shutdown()
        host.node.destroy_node()
        host.other.destroy_node()


def test_who_publishes_there_is_named_once_with_what_would_do(host):
    while host.is_looking:
        host.publish(NANOSECONDS, 2 * NANOSECONDS)
        host.spin()
    ((other, line),) = host.found
    assert other is Other.AHEAD
    domain = host.node.context.get_domain_id()
    assert line == (
        f'/theirs publishes /clock in ROS domain {domain} already, and with two clocks the time '
        'of every node jumps; end the other simulator, or give this one another ROS_DOMAIN_ID'
    )


@pytest.mark.parametrize('window', [0.5])
@pytest.mark.parametrize('said', [None, NANOSECONDS])
def test_a_publisher_that_is_silent_or_agrees_is_no_other_clock(host, said):
    while host.is_looking:
        if said:
            host.publish(NANOSECONDS, said)
        host.spin()
    assert host.found == []


@pytest.mark.parametrize('window', [0.5])
@pytest.mark.parametrize('arguments', [('-r', '/clock:=/other/clock')])
def test_who_has_a_clock_of_its_own_is_not_disturbed_by_that_of_others(host):
    assert host.publishers[0].topic_name == '/other/clock'
    while host.is_looking:
        host.publish(NANOSECONDS, 2 * NANOSECONDS)
        host.spin()
    assert host.found == []


@pytest.mark.parametrize('window', [0.5])
def test_nobody_looks_longer_than_needed(host):
    host.other.destroy_publisher(host.publishers[1])
    while host.is_looking:
        host.spin()
        assert host.node.count_subscribers('/clock') == 0
    assert host.found == []
