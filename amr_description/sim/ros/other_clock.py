# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
Notices another simulator in the ROS domain, by the times on ``/clock`` that cannot be our own.

Two of them make the time of every node jump. Whoever finds, in its first seconds, a time ahead of
its own is the younger one, and ends; whoever finds one behind warns. That somebody else publishes
``/clock`` is not enough: DDS keeps a simulator that was killed in the graph for twenty seconds,
and one that is just ending publishes for a moment. While nobody else does, this costs five looks
at the graph a second, for five seconds.
"""

from collections.abc import Callable
import enum
import time as wall

from rclpy.clock import Clock as SystemClock
from rclpy.clock_type import ClockType
from rclpy.node import Node
from rclpy.serialization import deserialize_message
from rosgraph_msgs.msg import Clock

from amr_description.ros.endpoints import endpoint_node
from amr_description.ros.messages import nanoseconds
from amr_description.ros.polled_topic import PolledTopic

WINDOW = 5.0
"""s for which another publisher is looked for, and its messages after that."""

SPAN = 1.0
"""s for which another clock has to go on: one that is ending, or that we have reset, does not."""

_LOOKS = 3
"""Times of another clock that are needed beside that."""

_PERIOD = 0.2
"""s between two looks at the graph; a tenth of that between two messages."""


class Other(enum.Enum):
    """Where the time of the other clock is."""

    AHEAD = enum.auto()
    BEHIND = enum.auto()


class ClockEvidence:
    """What was received on ``/clock``, while we publish there too."""

    def __init__(self) -> None:
        self._seen: dict[Other, list[float]] = {other: [] for other in Other}
        self._last = 0

    def add(self, instant: float, received: int, own: int) -> None:
        """
        Take in a message.

        Args:
            instant: Of the wall clock, s.
            received: The time in the message, ns.
            own: Our time after the message was received, ns; ours is never ahead of that.
        """
        if received > own:
            self._seen[Other.AHEAD].append(instant)
        elif received < self._last:
            self._seen[Other.BEHIND].append(instant)
        self._last = received

    @property
    def verdict(self) -> Other | None:
        """Where the other clock is; None: there is none so far."""
        # After a message that is ahead, our own is behind.
        other = Other.AHEAD if self._seen[Other.AHEAD] else Other.BEHIND
        instants = self._seen[other]
        if len(instants) >= _LOOKS and instants[-1] - instants[0] >= SPAN:
            return other
        return None


class OtherClock:
    """Looks for another clock, from the beginning on; on the ROS thread."""

    def __init__(
        self, node: Node, own_time: Callable[[], int], on_found: Callable[[Other, str], None]
    ) -> None:
        """
        Begin to look.

        Args:
            node: Publishes ``/clock``.
            own_time: Returns its time, ns.
            on_found: Called once, with one line that says what is wrong and what would do.
        """
        self._node = node
        self._name = node.resolve_topic_name('/clock')  # which may be remapped
        self._own_time = own_time
        self._on_found = on_found
        self._evidence = ClockEvidence()
        self._topic: PolledTopic[int] | None = None
        self._until = wall.monotonic() + WINDOW
        steady = SystemClock(clock_type=ClockType.STEADY_TIME)
        self._timer = node.create_timer(_PERIOD, self._look, clock=steady)

    def _look(self) -> None:
        now = wall.monotonic()
        others = self._others()
        if not others or now > self._until:
            self._forget()
            if now > self._until:
                self._node.destroy_timer(self._timer)
            return
        if self._topic is None:
            self._topic = PolledTopic(self._node, Clock, self._name, _time_of)
            self._timer.timer_period_ns //= 10
            self._until = now + WINDOW
        received = self._topic.take()
        if received is None:
            return
        self._evidence.add(now, received, self._own_time())
        if verdict := self._evidence.verdict:
            self._forget()
            self._node.destroy_timer(self._timer)
            self._on_found(verdict, self._describe(others))

    def _others(self) -> list[str]:
        """Return the nodes that publish on our topic, but for one of our name."""
        own = self._node.get_fully_qualified_name()
        found = [
            endpoint_node(each) or 'a node'
            for each in self._node.get_publishers_info_by_topic(self._name)
        ]
        if own in found:
            found.remove(own)
        return found

    def _forget(self) -> None:
        if self._topic is not None:
            self._topic.destroy()
            self._topic = None
            self._timer.timer_period_ns *= 10
        self._evidence = ClockEvidence()

    def _describe(self, others: list[str]) -> str:
        return (
            f'{" and ".join(sorted(set(others)))} publishes {self._name} in ROS domain '
            f'{self._node.context.get_domain_id()} already, and with two clocks the time of every '
            'node jumps; end the other simulator, or give this one another ROS_DOMAIN_ID'
        )


def _time_of(data: bytes) -> int:
    return nanoseconds(deserialize_message(data, Clock).clock)
