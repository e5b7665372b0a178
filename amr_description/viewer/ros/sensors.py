# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
The topics of sensors: subscribed while a page shows them, polled when a page can take a sample.

Whoever hears a sensor of a simulator has it measured, and a driver may do so, too. So what no page
shows is not subscribed. As with states, the ROS thread assigns what is polled, as a whole, and the
server's thread polls it; pictures and clouds are made small by another thread.
"""

import asyncio
from collections import deque
from collections.abc import Mapping, Sequence, Set as AbstractSet
from concurrent.futures import Future
import time

from rclpy.node import Node

from amr_description.clock import NANOSECONDS
from amr_description.errors import AmrError
from amr_description.ros.message_types import message_type
from amr_description.ros.polled_topic import NumberedMessage, PolledTopic
from amr_description.viewer.protocol import SensorInfo
from amr_description.viewer.ros.sensor_samples import sample_of, unreadable
from amr_description.viewer.samples import Sample

_FASTEST = {'picture': 15.0, 'cloud': 10.0, 'scan': 30.0, 'range': 30.0, 'contacts': 30.0}
"""Samples per second that pages are sent, at most."""
_SLOW = {'picture', 'cloud'}
"""What takes long enough to be left to another thread."""
_WINDOW = 3.0
"""s of wall-clock time over which the rate of a topic is measured."""


class Rate:
    """Messages per second of a topic, those that were not taken, too, as DDS numbers them."""

    def __init__(self) -> None:
        self._marks: deque[tuple[int, int]] = deque()
        """(when it was received, ns; number)."""

    def add(self, message: NumberedMessage) -> None:
        """Count a message that was taken."""
        last = self._marks[-1] if self._marks else (0, 0)
        number = last[1] + 1 if message.number is None else message.number
        if number <= last[1] or message.received < last[0]:  # of another publisher
            self._marks.clear()
        self._marks.append((message.received, number))
        while message.received - self._marks[0][0] > _WINDOW * NANOSECONDS:
            self._marks.popleft()

    @property
    def value(self) -> float | None:
        """Hz; None: not known yet."""
        if len(self._marks) < 2:  # noqa: PLR2004
            return None
        (received_0, number_0), (received_1, number_1) = self._marks[0], self._marks[-1]
        elapsed = received_1 - received_0
        return (number_1 - number_0) * NANOSECONDS / elapsed if elapsed > 0 else None


class SensorFeed:
    """One topic; made and destroyed on the ROS thread, polled on the server's thread."""

    def __init__(self, node: Node, info: SensorInfo) -> None:
        self.info = info
        self._topic: PolledTopic[bytes] | None = None
        self._fault: bytes | None = None
        """A sample that says why there are none."""
        try:
            self._topic = PolledTopic(node, message_type(info.message), info.topic, bytes)
        except AmrError as error:  # a message package that is not installed here
            self._fault = unreadable(info.topic, str(error))
        self._rate = Rate()
        self._period = 1.0 / _FASTEST[info.kind]
        self._due = 0.0
        self._work: Future[bytes] | asyncio.Future[bytes] | None = None

    def take(self, now: float, *, is_wanted: bool) -> bytes | None:
        """
        Return a new sample; None: there is none yet, or none is due.

        Args:
            now: s, of a clock that goes on.
            is_wanted: Whether a page can take one now: else no message is taken.
        """
        if self._work is not None:
            return self._result()
        if self._fault is not None:
            fault, self._fault = self._fault, None
            return fault
        if self._topic is None or not is_wanted or now < self._due:
            return None
        message = self._topic.take_numbered()
        if message is None:
            return None
        self._due = max(self._due + self._period, now)
        self._rate.add(message)
        arguments = (self.info.message, message.data, self.info.topic, self._rate.value)
        if self.info.kind not in _SLOW:
            return sample_of(*arguments)
        self._work = asyncio.get_running_loop().run_in_executor(None, sample_of, *arguments)
        return None

    def _result(self) -> bytes | None:
        assert self._work is not None, 'asked for when there is work'
        if not self._work.done():
            return None
        work, self._work = self._work, None
        return work.result()

    def destroy(self) -> None:
        """Unsubscribe."""
        if self._topic is not None:
            self._topic.destroy()


class SensorFeeds:
    """
    The topics that pages show, of those that there are.

    :meth:`watch` and :meth:`find` are called on the ROS thread, :meth:`take` on the server's.
    """

    def __init__(self, node: Node) -> None:
        self._node = node
        self._found: Mapping[str, SensorInfo] = {}
        self._watched: AbstractSet[str] = frozenset()
        self._feeds: tuple[SensorFeed, ...] = ()

    def find(self, sensors: Sequence[SensorInfo]) -> None:
        """Follow a change of the graph: these are the topics of sensors."""
        self._found = {each.topic: each for each in sensors}
        self._update()

    def watch(self, topics: AbstractSet[str]) -> None:
        """Subscribe to these topics, as far as there are, and to no others."""
        self._watched = topics
        self._update()

    def take(self, wanted: AbstractSet[str]) -> list[Sample]:
        """Poll; return new samples, of these topics alone."""
        feeds = self._feeds
        if not feeds:
            return []
        now = time.monotonic()
        taken = (
            (each.info.topic, each.take(now, is_wanted=each.info.topic in wanted))
            for each in feeds
        )
        return [Sample(topic, frame) for topic, frame in taken if frame is not None]

    def _update(self) -> None:
        shown = {info for topic, info in self._found.items() if topic in self._watched}
        before = {each.info: each for each in self._feeds}
        if before.keys() == shown:
            return
        for info in before.keys() - shown:  # first: in one process a topic can only have one type
            before.pop(info).destroy()
        new = {info: SensorFeed(self._node, info) for info in shown - before.keys()}
        self._feeds = tuple({**before, **new}.values())
