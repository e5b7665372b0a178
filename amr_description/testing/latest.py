# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""The newest message of a topic, taken when it is asked for."""

from typing import Any

from rclpy.node import Node
from rclpy.qos import QoSProfile


class Latest:
    """
    The newest message on one topic.

    ``node`` must not be in an executor: so what is published at a thousand hertz while a
    simulation runs as fast as it can costs this process nothing.
    """

    def __init__(self, node: Node, message_type: Any, topic: str) -> None:
        self._node = node
        self._subscription = node.create_subscription(
            message_type, topic, self._never_called, QoSProfile(depth=1)
        )
        self._message: Any = None

    @property
    def topic(self) -> str:
        """Its full name."""
        return self._subscription.topic_name

    def take(self) -> Any | None:
        """The newest that has come, since :meth:`forget`; None: nothing yet."""
        subscription = self._subscription
        with subscription.handle:
            while taken := subscription.handle.take_message(subscription.msg_type, False):
                self._message = taken[0]
        return self._message

    def forget(self) -> None:
        """Drop what has come."""
        self.take()
        self._message = None

    def close(self) -> None:
        """Remove the subscription."""
        self._node.destroy_subscription(self._subscription)

    @staticmethod
    def _never_called(_: Any) -> None:
        raise AssertionError('the node is in an executor')
