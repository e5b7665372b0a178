# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""``launch_testing_ros``: what tests of nodes need: messages waited for, changed, or pumped."""

from collections import deque
from collections.abc import Callable, Collection, Sequence
from contextlib import suppress
import threading
from typing import Any, Self
import uuid

import rclpy
from rclpy.context import Context
from rclpy.executors import ExternalShutdownException, SingleThreadedExecutor
from rclpy.node import Node

from amr_description.launch_testing.text import basic_output_filter

_QUEUE = 10
"""Depth of all publishers and subscriptions."""


class MessagePump:
    """Spins a node on a thread."""

    def __init__(self, node: Node, context: Context | None = None) -> None:
        """Nothing runs yet. ``context``: that of the node; None: the default one."""
        self._executor = SingleThreadedExecutor(context=context)
        self._executor.add_node(node)
        self._thread = threading.Thread(target=self._spin, name='message_pump', daemon=True)

    def start(self) -> None:
        """Begin."""
        self._thread.start()

    def stop(self) -> None:
        """End; raise RuntimeError if a callback does not return within 5 s."""
        self._executor.shutdown(timeout_sec=5.0)
        self._thread.join(5.0)
        if self._thread.is_alive():
            raise RuntimeError('a callback of the node has not returned in 5 s')

    def _spin(self) -> None:
        with suppress(ExternalShutdownException):
            self._executor.spin()


class DataRepublisher:
    """Publishes on a topic what it hears on another one, changed by a function."""

    def __init__(
        self,
        node: Node,
        listen_topic: str,
        publish_topic: str,
        msg_type: Any,
        transform_fn: Callable[[Any], Any],
    ) -> None:
        """
        Begin.

        Args:
            node: Who listens and publishes; somebody spins it.
            listen_topic: What it hears.
            publish_topic: Where the results go.
            msg_type: Of both.
            transform_fn: Message → message, or None: nothing is published.
        """
        self._node, self._transform = node, transform_fn
        self._received = 0
        self._sent: list[Any] = []
        self._publisher = node.create_publisher(msg_type, publish_topic, _QUEUE)
        self._subscription = node.create_subscription(msg_type, listen_topic, self._take, _QUEUE)

    def shutdown(self) -> None:
        """End."""
        self._node.destroy_subscription(self._subscription)
        self._node.destroy_publisher(self._publisher)

    def get_num_received(self) -> int:
        """Return how many messages were heard."""
        return self._received

    def get_num_republished(self) -> int:
        """Return how many were published."""
        return len(self._sent)

    def get_republished(self) -> Sequence[Any]:
        """Return these."""
        return self._sent

    def _take(self, message: Any) -> None:
        self._received += 1
        changed = self._transform(message)
        if changed is not None:
            self._sent.append(changed)
            self._publisher.publish(changed)


class WaitForTopics:
    """
    Waits until something was heard on each of some topics, in a context of ROS of its own.

    ::

        with WaitForTopics([('scan', LaserScan), ('odom', Odometry)], timeout=10.0) as topics:
            assert topics.received_messages('scan')
    """

    def __init__(
        self,
        topic_tuples: Collection[tuple[str, Any]],
        timeout: float = 5.0,
        messages_received_buffer_length: int = 10,
    ) -> None:
        """
        Hear nothing yet.

        Args:
            topic_tuples: Names and types.
            timeout: s until all have to be heard.
            messages_received_buffer_length: How many messages of each are kept, the last ones.
        """
        self._topics, self._timeout = dict(topic_tuples), timeout
        self._kept: dict[str, deque[Any]] = {
            name: deque(maxlen=messages_received_buffer_length) for name in self._topics
        }
        self._complete = threading.Event()
        self._context = Context()
        rclpy.init(context=self._context)
        name = f'wait_for_topics_{uuid.uuid4().hex[:10]}'
        self._node = Node(name, context=self._context, use_global_arguments=False)
        self._pump = MessagePump(self._node, self._context)
        self._pump.start()

    def wait(self) -> bool:
        """Wait; return whether all were heard."""
        self._complete.clear()
        for messages in self._kept.values():
            messages.clear()
        subscriptions = [
            self._node.create_subscription(kind, name, self._taker(name), _QUEUE)
            for name, kind in self._topics.items()
        ]
        try:
            return self._complete.wait(self._timeout)
        finally:
            for each in subscriptions:
                self._node.destroy_subscription(each)

    def shutdown(self) -> None:
        """End what was made for it."""
        self._pump.stop()
        self._node.destroy_node()
        self._context.try_shutdown()

    def topics_received(self) -> set[str]:
        """Return those on which something was heard."""
        return {name for name, messages in self._kept.items() if messages}

    def topics_not_received(self) -> set[str]:
        """Return the others."""
        return {*self._topics} - self.topics_received()

    def received_messages(self, topic_name: str) -> list[Any]:
        """Return the messages of a topic that were kept. Raises KeyError."""
        if topic_name not in self._kept:
            raise KeyError(f"'{topic_name}' is none of the topics {sorted(self._topics)}")
        return list(self._kept[topic_name])

    def _taker(self, name: str) -> Callable[[Any], None]:
        def take(message: Any) -> None:
            self._kept[name].append(message)
            if all(self._kept.values()):
                self._complete.set()

        return take

    def __enter__(self) -> Self:
        if not self.wait():
            missing = ', '.join(sorted(self.topics_not_received()))
            self.shutdown()
            raise RuntimeError(f'nothing was heard in {self._timeout:g} s on {missing}')
        return self

    def __exit__(self, *_args: object) -> None:
        self.shutdown()


__all__ = ['DataRepublisher', 'MessagePump', 'WaitForTopics', 'basic_output_filter']
