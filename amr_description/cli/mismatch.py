# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
Tells who is on a topic but uses another type: DDS connects only what has the same.

The classic is Twist where a controller wants TwistStamped; without a word nothing moves.
"""

from collections.abc import Callable
import sys
from typing import Any

from rclpy.node import Node
from rclpy.topic_endpoint_info import TopicEndpointInfo

from amr_description.ros.message_types import type_name
from amr_description.ros.type_mismatch import mismatches


class Mismatch:
    """Looks at the other side of a topic and tells, once each, who will never be reached."""

    def __init__(self, node: Node, topic: str, message_class: Any, *, publishing: bool) -> None:
        """Watch a topic, given by its absolute name, that ``node`` uses with a message class."""
        self._type_name = type_name(message_class)
        self._topic = topic
        self._publishing = publishing
        self._endpoints: Callable[[str], list[TopicEndpointInfo]] = (
            node.get_subscriptions_info_by_topic
            if publishing
            else node.get_publishers_info_by_topic
        )
        self._told: set[str] = set()

    def tell(self) -> None:
        """Print a line on stderr for each node that came with another type since the last call."""
        for line in mismatches(
            self._type_name, self._topic, self._endpoints(self._topic), self._publishing
        ):
            if line not in self._told:
                self._told.add(line)
                print(line, file=sys.stderr)
