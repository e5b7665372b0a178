# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""The markers of a topic for pages: what was drawn by all messages, not by the newest alone."""

import asyncio
from collections import deque
from collections.abc import Callable, Mapping, Sequence
from functools import partial
from pathlib import Path
import time

from rclpy.node import Node
from rclpy.qos import DurabilityPolicy, QoSProfile

from amr_description.ros import readers
from amr_description.ros.message_types import message_type
from amr_description.ros.polled_topic import NumberedMessage, PolledTopic
from amr_description.viewer.graph import MARKERS
from amr_description.viewer.protocol import Origin, SensorInfo
from amr_description.viewer.ros.marker_store import MarkerStore
from amr_description.viewer.ros.marks import Drawn
from amr_description.viewer.ros.newest_feed import NewestFeed
from amr_description.viewer.ros.sensor_samples import converted, unreadable

_DEPTH = 100
"""Messages that wait: one that deletes a marker must not be lost."""
_PERIOD = 0.1
"""s between two samples."""


class MarkerTopic:
    """
    All messages of a topic, those that publishers have kept first, whoever publishes and when.

    Publishers come and go, as ``ros2 topic pub --once`` does; what they drew stays.
    """

    def __init__(self, node: Node, info: SensorInfo) -> None:
        """Subscribe. Raises AmrError."""
        kind = message_type(info.message)
        qos = QoSProfile(depth=_DEPTH, durability=DurabilityPolicy.TRANSIENT_LOCAL)
        self._topics = (
            PolledTopic(node, kind, info.topic, bytes, qos=qos),
            PolledTopic(node, kind, info.topic, bytes, depth=_DEPTH),
        )
        self._taken: deque[tuple[int, int | None]] = deque(maxlen=2 * _DEPTH)

    def take_numbered(self) -> NumberedMessage | None:
        """Return the next message; None: none came. On any thread."""
        for topic in self._topics:
            while (message := topic.take_numbered()) is not None:
                key = message.sent, message.number
                if key not in self._taken or not message.sent:
                    self._taken.append(key)
                    return message
        return None

    def destroy(self) -> None:
        """Unsubscribe."""
        for topic in self._topics:
            topic.destroy()


class MarkerFeed(NewestFeed):
    """Made and destroyed on the ROS thread, polled on the server's thread."""

    def __init__(self, node: Node, info: SensorInfo, receive_time: Callable[[int], float]) -> None:
        """``receive_time`` returns the time of the states, s, for a system time, ns."""
        self.info = info
        self._time = receive_time
        self._store = MarkerStore()
        self._read = readers.MARKERS.read if info.message == MARKERS else _read_one
        super().__init__(partial(MarkerTopic, node, info))

    @property
    def files(self) -> Mapping[str, Path | bytes]:
        """The meshes that markers name, by the names in their addresses; on any thread."""
        return self._store.files

    @property
    def is_drawn(self) -> bool:
        """Whether there are markers; on any thread."""
        return not self._store.is_empty

    def take(self, now: float, *, is_wanted: bool) -> bytes | None:
        """Return a new sample, also when a marker has ended."""
        found = super().take(now, is_wanted=is_wanted)
        if found is not None or self._work is not None or now < self._due or not is_wanted:
            return found
        at = self._time(time.time_ns())
        if self._store.expires <= at or at < self._store.time:
            self._due = now + _PERIOD
            self._work = self._start(partial(self._sample, (), self._rate.value, at))
        return None

    def _unreadable(self, reason: str) -> bytes:
        return unreadable(self.info.topic, reason)

    def _next_due(self, due: float, now: float, message: NumberedMessage) -> float:  # noqa: ARG002
        return now + _PERIOD

    def _conversion(self, message: NumberedMessage) -> Callable[[], bytes]:
        messages = [message]
        while self._topic is not None and (more := self._topic.take_numbered()) is not None:
            messages.append(more)
        timed = [(each.data, self._time(each.received)) for each in messages]
        return partial(self._sample, timed, self._rate.value, self._time(time.time_ns()))

    def _takes_long(self, message: NumberedMessage) -> bool:  # noqa: ARG002
        return True

    def _start(self, convert: Callable[[], bytes]) -> 'asyncio.Future[bytes]':
        return asyncio.get_running_loop().run_in_executor(None, convert)

    def _sample(
        self, messages: Sequence[tuple[bytes, float]], rate: float | None, now: float
    ) -> bytes:
        """Take messages in, with the time of each, and return what is there now."""

        def draw(_: bytes, origin: Origin) -> Drawn:
            for data, at in messages:
                self._store.apply(self._read(data), min(at, now))
            return self._store.draw(origin, now)

        return converted(draw, b'', self.info.topic, rate)


def _read_one(data: bytes) -> list[readers.MarkerData]:
    return [readers.MARKER.read(data)]
