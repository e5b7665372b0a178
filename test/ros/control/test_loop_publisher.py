# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""What leaves a turn: only what somebody hears, or may come to hear later."""

import pytest
import rclpy
from rclpy.node import Node
from rclpy.qos import DurabilityPolicy, QoSProfile
from std_msgs.msg import String
from support.ros_processes import PATIENCE

from amr_description.control.ros.loop_publisher import LoopPublisher
from amr_description.ros.service_calls import wait_until

LATCHED = QoSProfile(depth=1, durability=DurabilityPolicy.TRANSIENT_LOCAL)


@pytest.fixture
def node():
    rclpy.init(args=[])
    node = Node('test_loop_publisher')
    yield node
    node.destroy_node()
    rclpy.try_shutdown()


def fill(sample, message):
    message.data = sample


def say(loop_publisher, publisher, sample):
    """Say it at the end of a turn; return what was made of it."""
    message = String(data='nothing')
    loop_publisher.send(fill, sample, message, publisher)
    loop_publisher.publish(0)
    return message.data


def test_what_nobody_hears_is_not_even_made_a_message_of(node):
    loop_publisher = LoopPublisher(node.get_logger())
    publisher = node.create_publisher(String, 'said', 1)
    assert say(loop_publisher, publisher, 'first') == 'nothing'
    heard = []
    node.create_subscription(String, 'said', lambda message: heard.append(message.data), 1)
    wait_until(node, lambda: publisher.get_subscription_count() or None, timeout=PATIENCE)
    assert say(loop_publisher, publisher, 'second') == 'second'
    wait_until(node, lambda: heard or None, timeout=PATIENCE)
    assert heard == ['second']


def test_what_is_kept_for_who_comes_later_is_said(node):
    loop_publisher = LoopPublisher(node.get_logger())
    publisher = node.create_publisher(String, 'kept', LATCHED)
    assert say(loop_publisher, publisher, 'first') == 'first'
    heard = []
    node.create_subscription(String, 'kept', lambda message: heard.append(message.data), LATCHED)
    wait_until(node, lambda: heard or None, timeout=PATIENCE)
    assert heard == ['first']
