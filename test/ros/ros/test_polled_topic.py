# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""Topics that no executor serves: polled, and taken in a thread that may rest."""

from collections import deque
import threading

import pytest
import rclpy
from rclpy.executors import SingleThreadedExecutor
from rclpy.experimental import EventsExecutor
from rclpy.node import Node
from rclpy.parameter import Parameter
from rclpy.serialization import deserialize_message
from rosgraph_msgs.msg import Clock
from std_msgs.msg import String
from support.ros_processes import PATIENCE

from amr_description.errors import CallbackError
from amr_description.ros import firewall
from amr_description.ros.firewall import Firewall
from amr_description.ros.polled_topic import PolledTopic, PollingNode
from amr_description.ros.runtime import spin, spinning
from amr_description.ros.service_calls import wait_until
from amr_description.ros.subscription_thread import SubscriptionThread

LONG = 600.0  # s of rest


class Talker(Node):
    def __init__(self):
        super().__init__('talker')
        self.publisher = self.create_publisher(String, 'words', 10)
        self.clock = self.create_publisher(Clock, '/clock', 10)

    def until(self, condition):
        assert wait_until(self, lambda: condition() or None, every=0.02, timeout=PATIENCE)

    def say(self, *words):
        self.until(self.publisher.get_subscription_count)
        for word in words:
            self.publisher.publish(String(data=word))

    def set_clock(self, seconds):
        message = Clock()
        message.clock.sec = seconds
        self.clock.publish(message)


@pytest.fixture
def talker():
    rclpy.init(args=[])
    node = Talker()
    yield node
    node.destroy_node()
    rclpy.try_shutdown()


class Listener(PollingNode):
    """Has a thread for ``words``; rests after the words in ``rests``."""

    def __init__(self, rests=(), **options):
        super().__init__('listener', **options)
        self.words, self.arrivals, self.rests = [], [], rests
        self.thread = SubscriptionThread(self)
        self.subscription = self.thread.subscribe(String, 'words', self.hear, 10, raw=True)
        self.thread.start()

    def hear(self, data, info):
        if (word := deserialize_message(data, String).data) == 'bug':
            raise ValueError(word)
        self.words.append(word)
        self.arrivals.append(info['received_timestamp'])
        return LONG if word in self.rests else None

    def destroy_node(self):
        self.thread.end()
        super().destroy_node()


def test_the_thread_of_a_node_that_nobody_destroys_ends_with_the_context(talker):
    """As when a request to stop comes while the node is made."""
    listener = Listener()
    threads = {each for each in threading.enumerate() if each.name == 'listener subscriptions'}
    assert len(threads) == 1
    rclpy.try_shutdown()
    for thread in threads:
        thread.join(PATIENCE)
        assert not thread.is_alive()
    listener.destroy_node()


@pytest.mark.parametrize('executor', [EventsExecutor, SingleThreadedExecutor])
def test_messages_are_handled_once_each_in_their_order(talker, executor):
    words = [str(number) for number in range(10)]
    listener = Listener()
    with spinning(listener, executor=executor):
        talker.say(*words)
        talker.until(lambda: len(listener.words) == len(words))
    assert listener.words == words
    assert listener.arrivals == sorted(listener.arrivals)


def test_what_comes_in_a_rest_waits_for_its_end(talker):
    listener = Listener(rests=['two'])
    with spinning(listener):
        talker.say('one', 'two', 'three', 'four')
        talker.until(lambda: len(listener.words) == 2)
        listener.thread.wake()
        talker.until(lambda: len(listener.words) == 4)
        assert listener.subscription.get_publisher_count() == 1
    assert listener.words == ['one', 'two', 'three', 'four']


def test_the_end_of_the_node_ends_a_rest_and_a_wait(talker):
    listener = Listener(rests=['one'])
    talker.say('one')
    talker.until(lambda: listener.words)
    listener.destroy_node()
    Listener().destroy_node()
    assert not [each for each in threading.enumerate() if each.name == 'listener subscriptions']


@pytest.mark.parametrize('executor', [EventsExecutor, SingleThreadedExecutor])
def test_bugs_again_and_again_are_raised_where_the_node_is_served(talker, executor, monkeypatch):
    monkeypatch.setattr(firewall, 'FIREWALL', Firewall(lambda: 0.0))
    monkeypatch.setattr(firewall, 'MOST_A_SECOND', 3)
    monkeypatch.setattr(firewall.FIREWALL, '_latest', deque(maxlen=4))
    listener = Listener()
    talker.say('bug', 'bug', 'one')
    talker.until(lambda: listener.words)
    server = executor()
    server.add_node(listener)
    talker.say('bug', 'bug')
    with pytest.raises(CallbackError, match='ValueError: bug'):
        spin(server, lambda: False)
    server.shutdown()
    listener.destroy_node()


@pytest.mark.parametrize('executor', [EventsExecutor, SingleThreadedExecutor])
def test_polled_topics_and_the_clock_are_left_to_their_node(talker, executor):
    node = PollingNode('poller', parameter_overrides=[Parameter('use_sim_time', value=True)])
    topic = PolledTopic(node, String, 'words', bytes, depth=10)
    served = []
    node.create_subscription(String, 'words', served.append, 10)
    with spinning(node, executor=executor):
        talker.until(lambda: talker.publisher.get_subscription_count() == 2)
        talker.publisher.publish(String(data='word'))
        talker.until(lambda: served)
        talker.until(topic.take)
        for seconds in (5, 3):
            talker.until(
                lambda s=seconds: (
                    talker.set_clock(s) or node.get_clock().now().nanoseconds == s * 10**9
                )
            )
        assert node.set_parameters([Parameter('use_sim_time', value=False)])[0].successful
        assert node.get_clock().now().nanoseconds > 10**18
        assert node.set_parameters([Parameter('use_sim_time', value=True)])[0].successful
        talker.until(
            lambda: talker.set_clock(7) or node.get_clock().now().nanoseconds == 7 * 10**9
        )
