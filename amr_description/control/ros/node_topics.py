# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
Topics of a node on which bytes go out at the end of a cycle.

They are the :class:`~amr_description.simulation.topics.advertising.Topics` of ROS.
"""

from collections.abc import Callable
from typing import Any

from rclpy.exceptions import InvalidTopicNameException
from rclpy.node import Node
from rclpy.qos import QoSProfile

from amr_description.control.ros.loop_publisher import LoopPublisher, LoopTopic
from amr_description.errors import SimulationError
from amr_description.ros.message_types import message_type
from amr_description.ros.rclpy_internals import RCLError

QOS = QoSProfile(depth=10)
"""Reliable: who subscribes best effort, as SensorDataQoS does, is served as well."""


class NodeTopics:
    """See the module; topics are made and removed on the ROS thread."""

    def __init__(self, node: Node, publisher: LoopPublisher) -> None:
        """
        Make no topic yet.

        Args:
            node: Has the publishers.
            publisher: Publishes at the end of a cycle.
        """
        self._node, self._publisher = node, publisher
        self.reporters, self.followers = publisher.reporters, publisher.followers

    def advertise(self, name: str, message: str, encode: Callable[[Any], bytes]) -> LoopTopic:
        """Make a topic. Raises AmrError: its name or type is no good."""
        kind = message_type(message)
        try:
            publisher = self._node.create_publisher(kind, name, QOS)
        except (RCLError, InvalidTopicNameException) as error:
            raise SimulationError(_reason(error)) from error
        return self._publisher.topic(publisher, encode)

    def withdraw(self, topic: LoopTopic) -> None:
        """Remove a topic."""
        self._node.destroy_publisher(topic.publisher)


def _reason(error: Exception) -> str:
    """Say why there is no such topic, without the line of C that rcl names, and what would do."""
    what = ' '.join(map(str.strip, str(error).splitlines()[:2])).partition(', at ')[0]
    return f'{what}; give it another <topic>, or its robot a namespace'
