# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
A topic whose messages are taken when its user wants one, instead of each by a callback.

A callback costs an executor 0.2 to 0.3 ms; taking the bytes of a message 20 µs. Who draws sixty
pictures a second needs of a topic of 1 kHz only the latest message; DDS drops the others.
"""

from collections.abc import Callable, Iterator
from contextlib import suppress
from typing import Any, Generic, NamedTuple, TypeVar

from rclpy.callback_groups import CallbackGroup
from rclpy.clock import ROSClock
from rclpy.exceptions import InvalidHandle
from rclpy.node import Node
from rclpy.qos import QoSProfile, ReliabilityPolicy
from rclpy.subscription import Subscription

from amr_description.ros.rclpy_internals import (
    clock_subscription,
    take_message,
    take_with_info,
)

Sample = TypeVar('Sample')


class NumberedMessage(NamedTuple):
    """
    The bytes of a message.

    Attributes:
        data: They.
        received: The system time when DDS received it, ns.
        number: Its number among all that its publisher has sent; None: the middleware counts none.
        sent: The system time when its publisher sent it, ns; 0: the middleware does not tell.
    """

    data: bytes
    received: int
    number: int | None
    sent: int = 0


class PolledTopic(Generic[Sample]):
    """A subscription without a callback; made and destroyed on the ROS thread."""

    def __init__(
        self,
        node: Node,
        message_type: Any,
        topic: str,
        read: Callable[[bytes], Sample],
        *,
        depth: int = 1,
        qos: QoSProfile | None = None,
    ) -> None:
        """
        Subscribe.

        Args:
            node: It may be in an executor, which leaves the subscription alone; EventsExecutor
                does so with that of a :class:`PollingNode` only.
            message_type: The class of the messages.
            topic: Its name.
            read: Makes a sample of the bytes of a message; one that raises ValueError is skipped.
            depth: How many messages are kept, the latest.
            qos: In place of a best-effort profile of that depth.
        """
        self._read = read
        self._node = node
        if qos is None:
            qos = QoSProfile(depth=depth, reliability=ReliabilityPolicy.BEST_EFFORT)
        self.subscription = node.create_subscription(
            message_type, topic, _ignore, qos, callback_group=NeverCalled(), raw=True
        )

    @property
    def topic(self) -> str:
        """Its full name."""
        return self.subscription.topic_name

    def take(self) -> Sample | None:
        """
        Return the next message that was not taken yet; None: there is none, or no subscription.

        On any thread.
        """
        while True:
            try:
                data = take_message(self.subscription)
            except InvalidHandle:
                return None
            if data is None:
                return None
            with suppress(ValueError):
                return self._read(data)

    def take_timed(self) -> tuple[Sample, int] | None:
        """Return what :meth:`take` does, with the system time when DDS received it, ns."""
        while (message := self.take_numbered()) is not None:
            with suppress(ValueError):
                return self._read(message.data), message.received
        return None

    def take_numbered(self) -> NumberedMessage | None:
        """Return the next message as it came, as :meth:`take` does a sample of it."""
        try:
            taken = take_with_info(self.subscription)
        except InvalidHandle:
            return None
        if taken is None:
            return None
        data, info = taken
        number = info.get('publication_sequence_number')
        return NumberedMessage(data, info['received_timestamp'], number, info['source_timestamp'])

    def destroy(self) -> None:
        """Unsubscribe."""
        self._node.destroy_subscription(self.subscription)


class PollingNode(Node):
    """
    A node whose polled topics no executor of any kind serves, and whose clock is polled, too.

    With ``use_sim_time``, rclpy has the executor serve every message of ``/clock``. This node
    takes the last one when its clock is asked for. So nothing may wait by that clock: no timer of
    it would end, and who keeps the clock, rather than the node, sees it stand.
    """

    def get_clock(self) -> ROSClock:
        """Return the clock, with the time of now."""
        subscription = clock_subscription(self)
        if subscription is not None:
            with suppress(InvalidHandle):  # use_sim_time has just become false
                message = take_message(subscription)
                if message is not None:
                    subscription.callback(message)
        return super().get_clock()

    @property
    def subscriptions(self) -> Iterator[Subscription]:
        """Those that an executor is to serve."""
        clock = clock_subscription(self)
        for each in super().subscriptions:
            if each is not clock and not isinstance(each.callback_group, NeverCalled):
                yield each


class NeverCalled(CallbackGroup):
    """Keeps an executor from waiting for what is in it (but for EventsExecutor, which does)."""

    def can_execute(self, entity: Any) -> bool:
        return False

    def beginning_execution(self, entity: Any) -> bool:
        return False

    def ending_execution(self, entity: Any) -> None:
        pass


def _ignore(_: Any) -> None:
    pass
