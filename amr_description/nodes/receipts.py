# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
Receipts: who commands a simulation that stands still has to know when the command has arrived.

Between a topic and a service DDS keeps no order, so a step may overtake the command that it was
meant for; and as controllers subscribe best effort, as in ros2_control, DDS acknowledges nothing.
Above all, Fast DDS finds the endpoints of two participants in either direction by itself: of 60
new publishers that had seen their subscriber, 29 lost their first message. So the simulator says
on

``~/received``  (``diagnostic_msgs/msg/KeyValue``, reliable)
    for every message that a controller has accepted: ``key``: the topic; ``value``: the
    publisher's own number of that message, from 1.

Once that is heard, the next step acts on the command. Nothing is said while nobody listens.
"""

from diagnostic_msgs.msg import KeyValue
from rclpy.node import Node
from rclpy.qos import QoSProfile

TOPIC = '~/received'
QOS = QoSProfile(depth=100)


class Receipts:
    """Says them, on the ROS thread."""

    def __init__(self, node: Node) -> None:
        """``node`` has the topic."""
        self._publisher = node.create_publisher(KeyValue, TOPIC, QOS)

    def confirm(self, topic: str, number: int) -> None:
        """The message ``number`` of some publisher on ``topic`` is accepted."""
        if self._publisher.get_subscription_count():
            self._publisher.publish(KeyValue(key=topic, value=str(number)))
