# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
Messages of topics that no executor serves, with their publishers and the time when they came.

A callback costs an executor 0.2 ms, and of ``/tf`` there are hundreds; what is polled costs 20 µs.
Whoever asks whether a probe is done takes what has come.
"""

from bisect import bisect_right
from collections.abc import Iterator
from typing import Any

from rclpy.exceptions import InvalidHandle
from rclpy.node import Node
from rclpy.qos import QoSProfile, ReliabilityPolicy
from rclpy.serialization import deserialize_message
from rosgraph_msgs.msg import Clock

from amr_description.ros.endpoints import endpoint_node
from amr_description.ros.messages import nanoseconds
from amr_description.ros.polled_topic import NeverCalled
from amr_description.ros.publisher_gids import MessageOfPublisher, take_with_gid
from amr_description.ros.rclpy_internals import RCLError

CLOCK = '/clock'
_TICKS = 200
"""Kept between two looks."""
UNKNOWN = ''


class HeardTopic:
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
        self.topic = topic
        self._node = node
        self._type = message_type
        self._subscription = node.create_subscription(
            message_type,
            topic,
            _ignore,
            qos or QoSProfile(depth=depth, reliability=ReliabilityPolicy.BEST_EFFORT),
            callback_group=NeverCalled(),
            raw=True,
        )
        self._names: dict[bytes, str] = {}

    def take(self) -> Iterator[tuple[Any, int, bytes]]:
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
                taken = take_with_gid(self._subscription)
            except InvalidHandle:
                return
            if taken is None:
                return
            yield taken

    @property
    def has_publisher(self) -> bool:
        """Whether a publisher is connected."""
        return self._subscription.get_publisher_count() > 0

    def destroy(self) -> None:
        """Hear nothing more."""
        self._node.destroy_subscription(self._subscription)

    def publishers(self) -> dict[bytes, str]:
        """Return the nodes of all publishers that are there, by gid; '' is one without a name."""
        return {
            bytes(each.endpoint_gid): endpoint_node(each) or UNKNOWN
            for each in self._node.get_publishers_info_by_topic(self.topic)
        }


class RobotTime:
    """What time it was for the robot when a message came: by ``/clock``, or by the system."""

    def __init__(self, node: Node) -> None:
        """Subscribe to ``/clock``, if somebody publishes it."""
        self.is_simulated = node.count_publishers(CLOCK) > 0
        self._heard = HeardTopic(node, Clock, CLOCK, depth=_TICKS) if self.is_simulated else None
        self._received: list[int] = []
        self._times: list[int] = []

    def take(self) -> None:
        """Take the ticks that have come. Where time was reset, the earlier ones are forgotten."""
        for message, received, _ in self._heard.take() if self._heard is not None else ():
            time = nanoseconds(message.clock)
            if self._times and time < self._times[-1]:
                self._times.clear()
                self._received.clear()
            self._times.append(time)
            self._received.append(received)

    @property
    def is_known(self) -> bool:
        """Whether two ticks have come, or none are needed."""
        return not self.is_simulated or len(self._times) > 1

    def age(self, stamp: int, received: int) -> int | None:
        """
        Return how old a stamp was when its message came, ns; None: not known.

        Of what comes between two ticks it is not known which of them it belongs to: the age is
        the one that is nearer to 0.
        """
        if not self.is_simulated:
            return received - stamp
        place = bisect_right(self._received, received)
        if place in (0, len(self._times)):
            return None
        before, after = self._times[place - 1] - stamp, self._times[place] - stamp
        return 0 if before <= 0 <= after else min(before, after, key=abs)


def _ignore(_: Any) -> None:
    pass
