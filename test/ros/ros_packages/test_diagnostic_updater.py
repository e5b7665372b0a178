# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""``diagnostic_updater``: statuses as Jazzy's has them."""

import time
from types import SimpleNamespace

from diagnostic_msgs.msg import DiagnosticArray, DiagnosticStatus
from geometry_msgs.msg import TwistStamped
import pytest
import rclpy
from rclpy.clock import Clock
from rclpy.executors import SingleThreadedExecutor
from rclpy.node import Node
from rclpy.time import Time
from support.ros_processes import PATIENCE

from amr_description.clock import NANOSECONDS
from amr_description.ros.service_calls import wait_until
from amr_description.ros_packages.diagnostic_updater import (
    CompositeDiagnosticTask,
    DiagnosedPublisher,
    DiagnosticStatusWrapper,
    FrequencyStatus,
    FrequencyStatusParam,
    FunctionDiagnosticTask,
    Heartbeat,
    TimeStampStatus,
    TimeStampStatusParam,
    Updater,
)

OK, WARN, ERROR = DiagnosticStatus.OK, DiagnosticStatus.WARN, DiagnosticStatus.ERROR


@pytest.fixture
def clock(monkeypatch):
    """The clock of all tasks, which stands at ``ns`` until it is set."""
    standing = SimpleNamespace(ns=100 * NANOSECONDS)
    monkeypatch.setattr(Clock, 'now', lambda _: Time(nanoseconds=standing.ns))
    return standing


def run(task):
    status = task.run(DiagnosticStatusWrapper(level=OK))
    return status.level, status.message, {each.key: each.value for each in status.values}


def test_summaries_are_merged_by_their_kind():
    status = DiagnosticStatusWrapper(level=OK, message='a')
    status.mergeSummary(OK, 'b')
    assert (status.level, status.message) == (OK, 'a; b')
    status.mergeSummary(DiagnosticStatus(level=WARN, message='c'))
    assert (status.level, status.message) == (WARN, 'c')
    status.mergeSummary(OK, 'd')
    status.mergeSummary(ERROR, 'e')
    assert (status.level, status.message) == (ERROR, 'c; e')
    status.clearSummary()
    assert (status.level, status.message) == (OK, '')


@pytest.mark.parametrize(
    ('events', 'expected'),
    [
        (0, (ERROR, 'No events recorded.')),
        (2, (WARN, 'Frequency too low.')),
        (10, (OK, 'Desired frequency met')),
        (31, (WARN, 'Frequency too high.')),
    ],
)
def test_a_frequency_is_judged_over_the_window(clock, events, expected):
    task = FrequencyStatus(FrequencyStatusParam({'min': 5.0, 'max': 20.0}, 0.5, 2))
    for _ in range(events):
        task.tick()
    clock.ns += NANOSECONDS
    *summary, values = run(task)
    assert tuple(summary) == expected
    assert values['Events in window'] == str(events)
    assert values['Actual frequency (Hz)'] == f'{events:f}'
    assert values['Minimum acceptable frequency (Hz)'] == '2.500000'
    assert values['Maximum acceptable frequency (Hz)'] == '30.000000'


def test_old_and_future_and_zero_stamps_are_counted(clock):
    task = TimeStampStatus(TimeStampStatusParam(-1, 5))
    assert run(task)[:2] == (WARN, 'No data since last update.')
    task.tick(99.0)
    assert run(task)[:2] == (OK, 'Timestamps are reasonable.')
    task.tick(Time(seconds=90))
    assert run(task)[:2] == (ERROR, 'Timestamps too far in past seen.')
    task.tick(102.0)
    *summary, values = run(task)
    assert tuple(summary) == (ERROR, 'Timestamps too far in future seen.')
    assert values['Late diagnostic update count:'] == '1'
    assert values['Early diagnostic update count:'] == '1'
    task.tick(0.0)
    task.tick(100.0)
    assert run(task)[1] == 'Zero timestamp seen.'


def test_tasks_together_have_the_worst_level():
    def of(level, text):
        def fill(status):
            status.summary(level, text)
            status.add(text, 1)
            return status

        return fill

    both = CompositeDiagnosticTask('both')
    both.addTask(FunctionDiagnosticTask('a', of(OK, 'fine')))
    both.addTask(FunctionDiagnosticTask('b', of(WARN, 'hot')))
    both.addTask(Heartbeat())
    assert run(both) == (WARN, 'hot', {'fine': '1', 'hot': '1'})


def test_a_node_says_how_it_is_and_how_its_topic_is():
    rclpy.init(args=[])
    node, listener = Node('driver'), Node('listener')
    heard = []
    listener.create_subscription(DiagnosticArray, '/diagnostics', heard.append, 10)
    updater = Updater(node, period=0.05)
    updater.setHardwareID('motor 1')
    publisher = DiagnosedPublisher(
        node.create_publisher(TwistStamped, 'cmd_vel', 1),
        updater,
        FrequencyStatusParam({'min': 0.1}),
        TimeStampStatusParam(),
    )
    updater.add('Motor', lambda status: status.summary(WARN, 'hot') or status)
    executor = SingleThreadedExecutor()
    executor.add_node(node)

    def found():
        message = TwistStamped()
        message.header.stamp = node.get_clock().now().to_msg()
        publisher.publish(message)
        executor.spin_once(timeout_sec=0.02)
        seen = {each.name: each for array in heard for each in array.status}
        last = seen.get('driver: /cmd_vel topic status')
        return seen if last is not None and last.level == OK and last.hardware_id else None

    seen = wait_until(listener, found, every=0.02, timeout=PATIENCE)
    assert seen['driver: Motor'].message == 'hot'
    assert seen['driver: Motor'].hardware_id == 'motor 1'
    assert seen['driver: /cmd_vel topic status'].message.startswith('Desired frequency met; Time')
    assert updater.removeByName('Motor')
    assert not updater.removeByName('Motor')
    executor.shutdown()
    node.destroy_node()
    listener.destroy_node()
    rclpy.try_shutdown()
    assert heard[0].header.stamp.sec <= time.time()
