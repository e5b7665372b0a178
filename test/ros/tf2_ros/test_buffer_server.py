# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""A buffer that is asked by an action, and the client that asks."""

from geometry_msgs.msg import TransformStamped
import pytest
from rclpy.duration import Duration
from rclpy.executors import SingleThreadedExecutor
from rclpy.node import Node
from rclpy.time import Time
from support.manager_host import ros_in_this_process
from support.running_programs import PATIENCE
from support.serving import serving

from amr_description import tf2_ros

PADDING = Duration(seconds=PATIENCE)


def transform(child='base', x=1.0):
    message = TransformStamped(child_frame_id=child)
    message.header.frame_id = 'odom'
    message.header.stamp.sec = 1
    message.transform.translation.x = x
    return message


@pytest.fixture(scope='module')
def ros():
    with ros_in_this_process():
        node, asker = Node('buffer_server'), Node('asker')
        buffer = tf2_ros.Buffer()
        buffer.set_transform(transform(), 'me')
        server = tf2_ros.BufferServer(buffer, node, 'tf2_buffer_server')
        executor = SingleThreadedExecutor()
        executor.add_node(node)
        executor.add_node(asker)
        with serving(executor):
            yield buffer, tf2_ros.BufferClient(asker, 'tf2_buffer_server', timeout_padding=PADDING)
        server.destroy()
        node.destroy_node()
        asker.destroy_node()


def test_what_is_known_is_answered(ros):
    _, client = ros
    found = client.lookup_transform('odom', 'base', Time())
    assert found.transform.translation.x == 1.0
    assert client.can_transform('odom', 'base', Time())
    back = client.lookup_transform_full('base', Time(seconds=1), 'base', Time(seconds=1), 'odom')
    assert back.transform.translation.x == 0.0


def test_what_is_not_known_is_said_as_the_buffer_says_it(ros):
    buffer, client = ros
    with pytest.raises(tf2_ros.LookupException) as there:
        client.lookup_transform('odom', 'nowhere', Time())
    with pytest.raises(tf2_ros.LookupException) as here:
        buffer.lookup_transform('odom', 'nowhere', Time())
    assert str(there.value) == str(here.value)
    assert not client.can_transform_full('odom', Time(), 'nowhere', Time(), 'odom')
    with pytest.raises(tf2_ros.ExtrapolationException):
        client.lookup_transform('odom', 'base', Time(seconds=99), Duration(seconds=0.05))


def test_what_becomes_known_while_it_is_waited_for_is_answered_then(ros):
    buffer, client = ros

    # The client asks from this thread; the server's buffer is filled by its own timer.
    node = client.node
    timer = node.create_timer(0.05, lambda: buffer.set_transform(transform('late', 3.0), 'me'))
    found = client.lookup_transform('odom', 'late', Time(), Duration(seconds=PATIENCE))
    node.destroy_timer(timer)
    assert found.transform.translation.x == 3.0


def test_without_a_server_it_is_said_in_time(ros):
    _, client = ros
    alone = tf2_ros.BufferClient(client.node, 'nobody', timeout_padding=Duration(seconds=0.1))
    with pytest.raises(tf2_ros.TimeoutException, match="no action server 'nobody' after 0.1 s"):
        alone.lookup_transform('odom', 'base', Time())
    alone.destroy()
