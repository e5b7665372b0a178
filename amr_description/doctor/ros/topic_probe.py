# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
Messages of topics that no executor serves, with their publishers and the time when they came.

A callback costs an executor 0.2 ms, and of ``/tf`` there are hundreds; what is polled costs 20 µs.
Whoever asks whether a probe is done takes what has come.
"""

from collections.abc import Iterator
from typing import Any

from rclpy.exceptions import InvalidHandle
from rclpy.node import Node
from rclpy.qos import QoSProfile
from rclpy.serialization import deserialize_message

from amr_description.ros.endpoints import endpoint_node
from amr_description.ros.polled_topic import PolledTopic
from amr_description.ros.publisher_gids import MessageOfPublisher, take_with_gid
from amr_description.ros.rclpy_internals import RCLError

UNKNOWN = ''


class TopicProbe(PolledTopic[bytes]):
    """A subscription by best effort, which holds up nobody; only what is latched is reliable."""

    def __init__(
        self,
        node: Node,
        message_type: Any,
        topic: str,
        *,
        depth: int,
        qos: QoSProfile | None = None,
    ) -> None:
        """``qos``: in place of best effort of that depth."""
        super().__init__(node, message_type, topic, bytes, depth=depth, qos=qos)
        self._type = message_type

    def messages(self) -> Iterator[tuple[Any, int, bytes]]:
        """
        Yield what has come since: a message, when it came (system time, ns), its publisher.

        What cannot be read, as of another definition of the type, is left out.
        """
        for taken in self.take_bytes():
            try:
                message = deserialize_message(taken.data, self._type)
            except (RCLError, RuntimeError, ValueError):
                continue
            yield message, taken.received, taken.gid

    def take_bytes(self) -> Iterator[MessageOfPublisher]:
        """Yield what has come since, as bytes."""
        while True:
            try:
                taken = take_with_gid(self.subscription)
            except InvalidHandle:
                return
            if taken is None:
                return
            yield taken

    @property
    def has_publisher(self) -> bool:
        """Whether a publisher is connected."""
        return self.subscription.get_publisher_count() > 0

    @property
    def is_connected(self) -> bool:
        """Whether all publishers of the graph are connected; one with another QoS never is."""
        return self.subscription.get_publisher_count() >= self._node.count_publishers(self.topic)

    def publishers(self) -> dict[bytes, str]:
        """Return the nodes of all publishers that are there, by gid; '' is one without a name."""
        return {
            bytes(each.endpoint_gid): endpoint_node(each) or UNKNOWN
            for each in self._node.get_publishers_info_by_topic(self.topic)
        }
