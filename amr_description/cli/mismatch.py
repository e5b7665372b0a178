# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
Warns about nodes on a topic that use another type: DDS connects only endpoints of the same type.

The classic case: Twist for a controller that expects TwistStamped, and the robot does not move.
"""

from collections.abc import Callable
import sys
from typing import Any

from rclpy.node import Node
from rclpy.topic_endpoint_info import TopicEndpointInfo

from amr_description.ros.message_types import type_name
from amr_description.ros.type_mismatch import mismatches


class TypeMismatchReporter:
    """Prints each node on the other side of a topic with another type, once."""

    def __init__(self, node: Node, topic: str, message_class: Any, *, publishing: bool) -> None:
        """Watch a topic (absolute name) that ``node`` publishes, or subscribes to."""
        self._type_name = type_name(message_class)
        self._topic = topic
        self._publishing = publishing
        self._endpoints: Callable[[str], list[TopicEndpointInfo]] = (
            node.get_subscriptions_info_by_topic
            if publishing
            else node.get_publishers_info_by_topic
        )
        self._printed: set[str] = set()

    def report(self) -> None:
        """Print a line on stderr for each new node with another type."""
        for line in mismatches(
            self._type_name, self._topic, self._endpoints(self._topic), self._publishing
        ):
            if line not in self._printed:
                self._printed.add(line)
                print(line, file=sys.stderr)
