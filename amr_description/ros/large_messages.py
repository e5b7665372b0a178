# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
A node for messages of more than some 100 kB: pictures and clouds.

By UDP such a message leaves as datagrams of 64 kB, one after the other. A reader whose socket has
the buffer that Linux gives by default (208 kB) cannot hold 1.8 MB of them; so it loses some, and
if it is best effort the whole message: 2 of 10 a second arrived. Therefore Fast DDS sends them in
a thread of its own, never faster than the ``throughputController`` of the profiles allows, 128 KiB
a millisecond: 10 of 10 arrived, for 0.9 ms of the publisher's time in place of 1.9.

With rmw_fastrtps a whole participant publishes in one way or the other, as
``RMW_FASTRTPS_PUBLICATION_MODE`` says when it is made; so this node has a participant of its own.
All others publish at once, and no limit holds for them.
"""

from collections.abc import Iterator
from contextlib import contextmanager
import os

import rclpy
from rclpy.context import Context
from rclpy.node import Node
from rclpy.publisher import Publisher
from rclpy.qos import QoSProfile

from amr_description.ros.transport import udp_only

_MODE = 'RMW_FASTRTPS_PUBLICATION_MODE'


class LargeMessageNode:
    """A node beside another one, which publishes large messages; see the module."""

    def __init__(self, node: Node, suffix: str) -> None:
        """
        Make it.

        Args:
            node: The one beside it, after which it is named, and whose remappings hold for it.
            suffix: Of its name.
        """
        self._beside = node
        self._context = Context()
        with udp_only(), _asynchronous():
            rclpy.init(args=[], context=self._context)
            self._node = Node(
                f'{node.get_name()}_{suffix}',
                context=self._context,
                namespace=node.get_namespace(),
                use_global_arguments=False,
                enable_rosout=False,
                start_parameter_services=False,
            )

    @property
    def publishers(self) -> Iterator[Publisher]:
        """All of its publishers."""
        return self._node.publishers

    def create_publisher(self, message_type: type, topic: str, qos: QoSProfile) -> Publisher:
        """Create a publisher of the topic that it would be of the other node."""
        resolved = self._beside.resolve_topic_name(topic)
        return self._node.create_publisher(message_type, resolved, qos)

    def destroy_publisher(self, publisher: Publisher) -> bool:
        """Remove a publisher; return whether it was there."""
        return self._node.destroy_publisher(publisher)

    def destroy(self) -> None:
        """Remove the node, with all publishers."""
        self._node.destroy_node()
        self._context.try_shutdown()


@contextmanager
def _asynchronous() -> Iterator[None]:
    """Inside, make a participant that sends in a thread of its own; a user's choice holds."""
    given = os.environ.get(_MODE)
    os.environ.setdefault(_MODE, 'ASYNCHRONOUS')
    try:
        yield
    finally:
        if given is None:
            del os.environ[_MODE]
