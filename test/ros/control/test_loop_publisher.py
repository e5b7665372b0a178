# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""What leaves a cycle: only what somebody hears, or may come to hear later."""

import pytest
import rclpy
from rclpy.node import Node
from rclpy.qos import DurabilityPolicy, HistoryPolicy, QoSProfile, ReliabilityPolicy
from std_msgs.msg import String
from support.running_programs import PATIENCE

from amr_description.control.ros.loop_publisher import LOOK_PERIOD, LoopPublisher, TOPICS_A_LOOK
from amr_description.messages.encoders import filling
from amr_description.ros.service_calls import wait_until

LATCHED = QoSProfile(depth=1, durability=DurabilityPolicy.TRANSIENT_LOCAL)
SYSTEM_DEFAULT = QoSProfile(
    depth=0,
    history=HistoryPolicy.SYSTEM_DEFAULT,
    reliability=ReliabilityPolicy.SYSTEM_DEFAULT,
    durability=DurabilityPolicy.SYSTEM_DEFAULT,
)
"""As the topics of controllers have it."""


@pytest.fixture
def node():
    rclpy.init(args=[])
    node = Node('test_loop_publisher')
    yield node
    node.destroy_node()
    rclpy.try_shutdown()


def fill(sample, message):
    message.data = sample


class Cycles:
    """The ends of cycles of 1 ms, simulated and wall time alike, with one topic."""

    def __init__(self, node, name, qos):
        self.wall = self.time = 10**9
        self.loop_publisher = LoopPublisher(node.get_logger(), clock=lambda: self.wall)
        self.publisher = node.create_publisher(String, name, qos)
        self.message = String(data='nothing')
        self.topic = self.loop_publisher.topic(self.publisher, filling(fill, self.message))

    def say(self, *samples):
        """Say them in a cycle; return what was made of them."""
        for sample in samples:
            self.topic.send(sample)
        self.loop_publisher.publish(self.time)
        self.wall += 1_000_000
        self.time += 1_000_000
        return self.message.data

    def stand_still(self):
        """Publish the time of the last cycle again, at once; return what was made."""
        self.loop_publisher.publish(self.time - 1_000_000)
        return self.message.data

    def pass_look_period(self):
        self.wall += LOOK_PERIOD


def hear(node, cycles, qos=1):
    """Subscribe; return the list of what is heard, once the publisher knows of it."""
    heard = []
    node.create_subscription(
        String, cycles.publisher.topic_name, lambda message: heard.append(message.data), qos
    )
    wait_until(node, lambda: cycles.publisher.get_subscription_count() or None, timeout=PATIENCE)
    return heard


def test_what_nobody_hears_is_not_even_made_a_message_of(node):
    cycles = Cycles(node, 'said', 1)
    assert cycles.say('first') == 'nothing'
    heard = hear(node, cycles)
    cycles.pass_look_period()
    assert cycles.say('second') == 'second'
    wait_until(node, lambda: heard or None, timeout=PATIENCE)
    assert heard == ['second']


def test_what_is_kept_for_who_comes_later_is_said(node):
    cycles = Cycles(node, 'kept', LATCHED)
    assert cycles.say('first') == 'first'
    heard = hear(node, cycles, LATCHED)
    wait_until(node, lambda: heard or None, timeout=PATIENCE)
    assert heard == ['first']


@pytest.mark.parametrize('qos', [LATCHED, SYSTEM_DEFAULT])
def test_of_what_is_kept_and_not_heard_the_newest_is_made_once_in_a_look_period(node, qos):
    cycles = Cycles(node, 'kept', qos)
    made = [cycles.say(str(number)) for number in range(12)]
    assert made == ['0'] * 5 + ['5'] * 5 + ['10'] * 2
    assert cycles.stand_still() == '11'
    heard = hear(node, cycles, LATCHED)
    wait_until(node, lambda: heard or None, timeout=PATIENCE)
    assert heard == ['11']


def test_a_cycle_after_time_stood_still_is_heard_at_once(node):
    """Somebody subscribes while it is paused, and has a single cycle made."""
    cycles = Cycles(node, 'said', 1)
    cycles.say('first')
    cycles.stand_still()
    heard = hear(node, cycles)
    assert cycles.say('second') == 'second'
    wait_until(node, lambda: heard or None, timeout=PATIENCE)
    assert heard == ['second']


def test_a_topic_that_keeps_more_than_the_last_has_each_sample_made(node):
    kept = QoSProfile(depth=3, durability=DurabilityPolicy.TRANSIENT_LOCAL)
    cycles = Cycles(node, 'kept', kept)
    made = [cycles.say(str(number)) for number in range(4)]
    assert made == ['0', '1', '2', '3']
    heard = hear(node, cycles, kept)
    wait_until(node, lambda: len(heard) == 3 or None, timeout=PATIENCE)
    assert heard == ['1', '2', '3']


def test_what_was_kept_is_heard_before_what_is_new(node):
    cycles = Cycles(node, 'kept', SYSTEM_DEFAULT)
    cycles.say('first')
    assert cycles.say('second') == 'first'
    heard = hear(node, cycles, QoSProfile(depth=10))
    cycles.pass_look_period()
    assert cycles.say('third', 'fourth') == 'fourth'
    wait_until(node, lambda: 'fourth' in heard or None, timeout=PATIENCE)
    assert heard == ['second', 'third', 'fourth']


def test_many_topics_are_looked_at_less_often(node):
    cycles = Cycles(node, 'kept', SYSTEM_DEFAULT)
    for _ in range(TOPICS_A_LOOK):
        cycles.loop_publisher.topic(cycles.publisher, filling(fill, cycles.message))
    made = [cycles.say(str(number)) for number in range(12)]
    assert made == ['0'] * 10 + ['10'] * 2
    assert cycles.stand_still() == '11'
