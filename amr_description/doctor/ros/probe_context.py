# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
What the probes of one examination have in common, so that it is subscribed to and asked once.

``/clock`` is subscribed to by best effort, and every node has one client for its parameters.
"""

from bisect import bisect_right
from collections.abc import Iterable
import time

from rcl_interfaces.srv import GetParameters
from rclpy.client import Client
from rclpy.node import Node
from rosgraph_msgs.msg import Clock

from amr_description.doctor.observations.clock import ClockTick
from amr_description.doctor.ros.queries import GET_PARAMETERS, ParameterQuery
from amr_description.doctor.ros.topic_probe import TopicProbe
from amr_description.ros.messages import nanoseconds
from amr_description.ros.service_calls import ServiceReadiness

CLOCK_TOPIC = '/clock'

_DEPTH = 200
"""Ticks between two queries of the graph."""
_MOST_TICKS = 20_000


class ProbeContext:
    """Made by who makes the probes, and destroyed after them."""

    def __init__(self, node: Node) -> None:
        """``node``: has the subscriptions and clients of the probes."""
        self.node = node
        self._clients: dict[str, tuple[Client, ServiceReadiness]] = {}
        self._queries: dict[tuple[str, tuple[str, ...]], ParameterQuery] = {}
        self._clock: TopicProbe | None = None
        self._matched: float | None = None
        self.ticks: list[ClockTick] = []
        """What :meth:`receive` has taken of ``/clock``."""

    def ask(self, node: str, names: Iterable[str]) -> ParameterQuery:
        """Return a query to a node, by its full name; it is asked by being looked at."""
        key = node, tuple(names)
        if key not in self._queries:
            if node not in self._clients:
                service = f'{node}{GET_PARAMETERS}'
                client = self.node.create_client(GetParameters, service)
                self._clients[node] = client, ServiceReadiness(self.node, client)
            self._queries[key] = ParameterQuery(*self._clients[node], key[1])
        return self._queries[key]

    def listen(self) -> None:
        """Subscribe to ``/clock``, once."""
        if self._clock is None:
            self._clock = TopicProbe(self.node, Clock, CLOCK_TOPIC, depth=_DEPTH)

    def receive(self) -> None:
        """Take the ticks that have come."""
        for message, received, _ in self._clock.messages() if self._clock is not None else ():
            if len(self.ticks) < _MOST_TICKS:
                self.ticks.append(ClockTick(nanoseconds(message.clock), received))

    @property
    def seconds(self) -> float:
        """How long ``/clock`` was listened to since its publisher was connected, s."""
        if self._clock is None or not self._clock.has_publisher:
            return 0.0
        self._matched = self._matched or time.monotonic()
        return time.monotonic() - self._matched

    def time_at(self, received: int) -> int | None:
        """Return the time of ``/clock`` at a moment of reception, ns; None: not known."""
        if not self.ticks:
            return None
        place = bisect_right(self.ticks, received, key=lambda tick: tick.received)
        return self.ticks[max(0, place - 1)].time

    def destroy(self) -> None:
        """Ask and listen no more."""
        for client, _ in self._clients.values():
            self.node.destroy_client(client)
        self._clients.clear()
        self._queries.clear()
        if self._clock is not None:
            self._clock.destroy()
            self._clock = None


class RobotTime:
    """What time it was for the robot when a message came: by ``/clock``, or by the system."""

    def __init__(self, context: ProbeContext) -> None:
        """Listen to ``/clock``, if somebody publishes it."""
        self.is_simulated = context.node.count_publishers(CLOCK_TOPIC) > 0
        self._context = context
        self._seen = self._first = 0
        if self.is_simulated:
            self._context.listen()

    def take(self) -> None:
        """Take the ticks that have come. Where time was reset, the earlier ones are left out."""
        self._context.receive()
        ticks = self._context.ticks
        for place in range(max(self._seen, 1), len(ticks)):
            if ticks[place].time < ticks[place - 1].time:
                self._first = place
        self._seen = len(ticks)

    @property
    def is_known(self) -> bool:
        """Whether two ticks have come, or none are needed."""
        return not self.is_simulated or self._seen - self._first > 1

    def age(self, stamp: int, received: int) -> int | None:
        """
        Return how old a stamp was when its message came, ns; None: not known.

        Of what comes between two ticks it is not known which of them it belongs to: the age is
        the one that is nearer to 0.
        """
        if not self.is_simulated:
            return received - stamp
        ticks = self._context.ticks
        place = bisect_right(ticks, received, self._first, key=lambda tick: tick.received)
        if place in (self._first, len(ticks)):
            return None
        before, after = ticks[place - 1].time - stamp, ticks[place].time - stamp
        return 0 if before <= 0 <= after else min(before, after, key=abs)
