# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""The talker and the listener, as the tutorial shows them."""

import re
import signal

import pytest
import rclpy
from std_msgs.msg import String
from support.running_programs import Program

from amr_description.nodes.listener import MinimalSubscriber
from amr_description.nodes.talker import MinimalPublisher


@pytest.fixture
def context():
    rclpy.init(args=[])
    yield
    rclpy.try_shutdown()


def test_the_talker_counts_and_ends_cleanly():
    with Program.module('talker') as talker:
        for count in range(3):
            said = rf'Publishing: "Hello World: {count}"\n'
            talker.expect(rf'\[INFO\] \[[\d.]+\] \[minimal_publisher\]: {said}')
        assert talker.end(signal.SIGINT) == 0
        assert all('Publishing: "Hello World: ' in line for line in talker.lines)


def test_the_listener_hears_every_word_from_the_moment_it_is_there():
    with Program.module('listener') as listener, Program.module('talker') as talker:
        heard = r'\[INFO\] \[[\d.]+\] \[minimal_subscriber\]: I heard: "Hello World: (\d+)"'
        first = listener.expect(heard)
        second = listener.expect(heard, since=first.end())
        assert int(second[1]) == int(first[1]) + 1
        assert talker.end(signal.SIGINT) == 0
        assert listener.end(signal.SIGINT) == 0
        assert re.search('Traceback|ERROR', listener.output) is None


def test_node_names_topic_and_period_are_those_of_the_tutorial(context):
    talker, listener = MinimalPublisher(), MinimalSubscriber()
    assert talker.get_fully_qualified_name() == '/minimal_publisher'
    assert listener.get_fully_qualified_name() == '/minimal_subscriber'
    assert (talker.publisher.topic_name, talker.publisher.msg_type) == ('/topic', String)
    assert (listener.subscription.topic_name, listener.subscription.msg_type) == ('/topic', String)
    assert talker.timer.timer_period_ns == 500_000_000
    for end in (talker.publisher, listener.subscription):
        assert end.qos_profile.depth == 10
    talker.destroy_node()
    listener.destroy_node()


def test_names_can_be_remapped_as_of_any_node():
    arguments = ['--ros-args', '-r', '__node:=radio', '-r', '__ns:=/berlin', '-r', 'topic:=news']
    with Program.module('listener', *arguments) as listener:
        with Program.module('talker', *arguments) as talker:
            listener.expect(r'\[berlin\.radio\]: I heard: "Hello World: ')
            assert talker.end(signal.SIGTERM) == 0
        assert listener.end(signal.SIGTERM) == 0
