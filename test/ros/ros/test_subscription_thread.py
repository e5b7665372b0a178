# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""Subscriptions that a thread of their own serves."""

import threading

import pytest
import rclpy
from rclpy.executors import SingleThreadedExecutor
from rclpy.node import Node
from rclpy.qos import QoSProfile
from std_msgs.msg import String
from support.ros_processes import PATIENCE

from amr_description.ros import firewall
from amr_description.ros.firewall import Firewall
from amr_description.ros.service_calls import wait_until
from amr_description.ros.subscription_thread import SubscriptionThread

QOS = QoSProfile(depth=10)


@pytest.fixture
def talker():
    rclpy.init(args=[])
    node = Node('talker')
    yield node
    node.destroy_node()
    rclpy.try_shutdown()


class Listener(Node):
    """Serves two topics in a thread, and notes in which thread."""

    def __init__(self, topics=('left', 'right')):
        super().__init__('listener')
        self.heard = {topic: [] for topic in topics}
        self.numbers, self.threads, self.failures = [], set(), []
        self.serving = SubscriptionThread(self, lambda: self.failures.append('bug'))
        for topic in topics:
            self.serving.subscribe(String, topic, self.callback_of(topic), QOS)
        self.serving.start()

    def callback_of(self, topic):
        def hear(message, info):
            if message.data == 'bug':
                raise ValueError(message.data)
            self.threads.add(threading.current_thread().name)
            self.numbers.append(info['publication_sequence_number'])
            self.heard[topic].append(message.data)

        return hear

    def destroy_node(self):
        self.serving.end()
        super().destroy_node()


def until(node, condition):
    assert wait_until(node, lambda: condition() or None, every=0.02, timeout=PATIENCE)


def say(node, topic, *words):
    publisher = node.create_publisher(String, topic, QOS)
    until(node, publisher.get_subscription_count)
    for word in words:
        publisher.publish(String(data=word))


def test_each_message_is_handled_once_in_its_order_whether_or_not_the_node_is_spun(talker):
    words = [str(number) for number in range(8)]
    listener = Listener()
    executor = SingleThreadedExecutor()
    executor.add_node(listener)
    say(talker, 'left', *words)
    until(talker, lambda: len(listener.heard['left']) == len(words))
    say(talker, 'right', *words)
    executor.spin_once(timeout_sec=0.0)
    until(talker, lambda: len(listener.heard['right']) == len(words))
    executor.spin_once(timeout_sec=0.0)  # it leaves them alone
    executor.shutdown()
    listener.destroy_node()
    assert listener.heard == {'left': words, 'right': words}
    assert listener.numbers == 2 * [*range(1, len(words) + 1)]
    assert listener.threads == {'listener subscriptions'}


def test_the_end_removes_thread_and_subscriptions(talker):
    listener = Listener()
    until(talker, lambda: talker.count_subscribers('left') == 1)
    listener.serving.end()
    until(talker, lambda: talker.count_subscribers('left') == 0)
    assert not [each for each in threading.enumerate() if 'subscriptions' in each.name]
    listener.destroy_node()  # a second end does nothing


def test_one_that_was_never_started_ends_too(talker):
    node = Node('listener')
    serving = SubscriptionThread(node, list)
    serving.subscribe(String, 'left', print, QOS)
    serving.end()
    assert not list(node.subscriptions)
    node.destroy_node()


def test_bugs_are_printed_and_again_and_again_reported(talker, capfd, monkeypatch):
    monkeypatch.setattr(firewall, 'FIREWALL', Firewall())
    monkeypatch.setattr(firewall, 'MOST_A_SECOND', 0)
    listener = Listener()
    say(talker, 'left', 'bug')
    until(talker, lambda: listener.failures)
    listener.destroy_node()
    assert listener.failures == ['bug']
    said = capfd.readouterr().err
    assert 'ValueError: bug' in said
    assert 'callbacks have raised more than 0 times within a second' in said
