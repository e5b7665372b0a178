# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
Subscriptions whose callbacks a thread of their own calls, instead of the executor of their node.

An executor of rclpy looks at all that it serves whenever something comes: with the 47 services and
40 event handlers of one robot that takes 1.4 ms for each message, during most of which no other
thread of the process has the interpreter's lock. Here a message takes 0.1 ms.
"""

from collections.abc import Callable, Mapping
import threading
from typing import Any, TypeAlias

from rclpy.node import Node
from rclpy.qos import QoSProfile
from rclpy.subscription import Subscription

from amr_description.errors import CallbackError
from amr_description.ros.firewall import caught
from amr_description.ros.polled_topic import NeverCalled
from amr_description.ros.rclpy_internals import SubscriptionWaiter, take_with_info
from amr_description.streams import print_traceback

Callback: TypeAlias = Callable[[Any, Mapping[str, int]], object]
"""Called with a message, and what rclpy tells of it: its number, its stamps."""


class CallbackThread:
    """Subscriptions of a node, and the thread that serves them; to be ended before the node."""

    def __init__(self, node: Node, on_failure: Callable[[], object]) -> None:
        """
        Begin without subscriptions.

        Args:
            node: Has them. It may be in an executor, which leaves them alone (but for
                EventsExecutor, which does not).
            on_failure: Called in the thread when callbacks raise again and again.
        """
        self._node = node
        self._on_failure = on_failure
        self._served: list[tuple[Subscription, Callback]] = []
        self._is_ending = False
        self._waiter: SubscriptionWaiter | None = None
        self._thread = threading.Thread(target=self._run, name=f'{node.get_name()} subscriptions')

    def subscribe(
        self, message_type: Any, topic: str, callback: Callback, qos: QoSProfile
    ) -> Subscription:
        """Add a subscription, before :meth:`start`; as ``Node.create_subscription()``."""
        subscription = self._node.create_subscription(
            message_type, topic, _ignore, qos, callback_group=NeverCalled()
        )
        self._served.append((subscription, callback))
        return subscription

    def start(self) -> None:
        """Begin to serve."""
        subscriptions = [subscription for subscription, _ in self._served]
        self._waiter = SubscriptionWaiter(subscriptions, self._node.context)
        self._thread.start()

    def end(self) -> None:
        """Serve no more, wait for the callback that runs, and remove the subscriptions."""
        self._is_ending = True
        if self._waiter is not None:
            self._waiter.wake()
            self._thread.join()
            self._waiter.destroy()
            self._waiter = None
        for subscription, _ in self._served:
            self._node.destroy_subscription(subscription)
        self._served.clear()

    def _run(self) -> None:
        assert self._waiter is not None, 'start() has made it'
        try:
            while not self._is_ending:
                if not self._serve_one_each():
                    self._waiter.wait()
        except CallbackError as error:
            self._node.get_logger().fatal(str(error))
            self._on_failure()
        except BaseException:  # sys.exit() in a plugin, too: nobody else would see it
            if self._node.context.ok():  # otherwise: it was shut down in the midst of that
                print_traceback()
                self._on_failure()

    def _serve_one_each(self) -> bool:
        """Serve a message of each subscription; return whether there was one."""
        has_come = False
        for subscription, callback in self._served:
            taken = take_with_info(subscription)
            if taken is not None:
                has_come = True
                try:
                    callback(*taken)
                except Exception as error:
                    if not self._node.context.ok():
                        raise
                    what = f'the callback of {subscription.topic_name}'
                    caught(error, what, self._node.get_logger())
        return has_come


def _ignore(_: Any) -> None:
    """Stand for the callback, which rclpy is not to call."""
