# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""The command in force as pages see it: it expires, and those of others are counted."""

from collections import deque

import pytest

from amr_description.clock import NANOSECONDS
from amr_description.viewer.ros import command_topic
from amr_description.viewer.ros.command_topic import CommandTopic, NO_TWIST

AHEAD = (0.3, 0.0, 0.0)


class Topic:
    """A subscription that has commands, and when they were received, from the test."""

    def __init__(self, *_, **__):
        self.messages = deque()

    def take_timed(self):
        return self.messages.popleft() if self.messages else None


@pytest.fixture
def topic(monkeypatch):
    monkeypatch.setattr(command_topic, 'PolledTopic', Topic)
    return CommandTopic(None, None, '/cmd_vel', None)


def take(topic, seconds, *messages, now=None, received=None):
    """
    What is new at this ROS time, s, after these messages.

    ``now`` is the wall's, if other; so is ``received``, when DDS had the messages.
    """
    received = seconds if received is None else received
    topic._topic.messages.extend((each, round(received * NANOSECONDS)) for each in messages)
    return topic.take(round(seconds * NANOSECONDS), seconds if now is None else now)


def test_a_command_is_in_force_until_its_time_out_and_then_unknown_once(topic):
    topic.timeout = 0.25
    assert take(topic, 5.0, (0.1, 0.0, 0.0), AHEAD) == AHEAD
    assert take(topic, 5.25) is None
    assert take(topic, 5.26) is NO_TWIST
    assert take(topic, 5.27) is None
    assert take(topic, 6.0, AHEAD) == AHEAD


def test_it_is_ros_time_that_counts(topic):
    """In a paused simulation a command stays in force, as it does in its controller."""
    take(topic, 5.0, AHEAD)
    assert take(topic, 5.0, now=50.0) is None
    assert take(topic, 0.1, now=50.1) is NO_TWIST  # the simulation was reset


def test_without_a_time_out_it_stays(topic):
    topic.timeout = 0.0
    take(topic, 5.0, AHEAD)
    assert take(topic, 500.0) is None


def test_commands_of_others_are_counted_and_those_of_pages_are_not(topic):
    assert topic.rate(0.0) == 0.0
    for count in range(30):
        if count % 2:
            topic.sent(AHEAD)
            take(topic, 0.1 * count, AHEAD)
        take(topic, 0.1 * count, (0.2, 0.0, 0.0))
    assert topic.rate(2.9) == pytest.approx(10.0)
    assert topic.rate(4.0) == 0.0


def test_polls_that_come_late_leave_the_rate_what_it_is(topic):
    for count in range(30):
        sent = 0.1 * count
        take(topic, sent, (0.2, 0.0, 0.0), now=max(sent, 0.25), received=sent)
    assert topic.rate(2.9) == pytest.approx(10.0)


def test_a_single_command_is_somebody(topic):
    take(topic, 5.0, AHEAD)
    assert 0.0 < topic.rate(5.1) < 1.0
    assert topic.rate(6.1) == 0.0
