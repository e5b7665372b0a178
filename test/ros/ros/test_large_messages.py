# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""The node for pictures and clouds."""

import os
import re

import pytest
import rclpy
from rclpy.node import Node
from rclpy.qos import QoSProfile
from std_msgs.msg import ByteMultiArray
from support.ros_processes import PATIENCE

from amr_description.ros import large_messages
from amr_description.ros.large_messages import LargeMessageNode
from amr_description.ros.service_calls import wait_until
from amr_description.ros.transport import UDP, UDP_LOCALHOST, UDP_LOOPBACK, udp_only

MODE = 'RMW_FASTRTPS_PUBLICATION_MODE'
QOS = QoSProfile(depth=1)


@pytest.fixture
def node():
    with udp_only():
        rclpy.init(args=[])
        node = Node('sim', namespace='/hall', cli_args=['--ros-args', '-r', 'cloud:=/points'])
    yield node
    node.destroy_node()
    rclpy.try_shutdown()


@pytest.fixture
def modes(monkeypatch):
    """What the environment says while participants are made."""
    seen = []

    class Watched(Node):
        def __init__(self, *args, **options):
            seen.append(os.environ.get(MODE))
            super().__init__(*args, **options)

    monkeypatch.setattr(large_messages, 'Node', Watched)
    return seen


def until(node, condition):
    assert wait_until(node, lambda: condition() or None, timeout=PATIENCE)


def test_it_publishes_under_the_names_of_the_node_beside_it(node):
    large = LargeMessageNode(node, 'sensors')
    publisher = large.create_publisher(ByteMultiArray, 'cloud', QOS)
    heard = []
    node.create_subscription(ByteMultiArray, '/points', heard.append, QOS)
    names = ('sim_sensors', '/hall')
    until(node, lambda: names in node.get_node_names_and_namespaces())
    until(node, publisher.get_subscription_count)
    message = ByteMultiArray(data=[bytes([number % 251]) for number in range(300_000)])
    publisher.publish(message)
    until(node, lambda: heard)
    assert heard == [message]
    assert large.destroy_publisher(publisher)
    large.destroy()


@pytest.mark.parametrize('given', [None, 'SYNCHRONOUS'])
def test_it_alone_is_asynchronous_and_the_choice_of_a_user_holds(node, modes, monkeypatch, given):
    if given:
        monkeypatch.setenv(MODE, given)
    else:
        monkeypatch.delenv(MODE, raising=False)
    LargeMessageNode(node, 'sensors').destroy()
    assert modes == [given or 'ASYNCHRONOUS']
    assert os.environ.get(MODE) == given


@pytest.mark.parametrize('profile', [UDP, UDP_LOCALHOST, UDP_LOOPBACK])
def test_no_more_is_sent_at_once_than_a_socket_holds(profile):
    text = profile.read_text(encoding='utf-8')
    limits = re.search(r'<bytesPerPeriod>(\d+)<.*\s*<periodMillisecs>(\d+)<', text)
    assert int(limits[1]) < 212_992 and int(limits[2]) == 1
