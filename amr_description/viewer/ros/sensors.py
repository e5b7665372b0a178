# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""A topic of a sensor for pages; another thread makes pictures, clouds and maps small."""

from collections.abc import Callable
from functools import partial

from rclpy.node import Node

from amr_description.ros.message_types import message_type
from amr_description.ros.polled_topic import NumberedMessage, PolledTopic
from amr_description.viewer.protocol import SensorInfo
from amr_description.viewer.ros.newest_feed import NewestFeed
from amr_description.viewer.ros.sensor_samples import sample_of, unreadable
from amr_description.viewer.ros.source import SourceTopic, TopicSource

_FASTEST = {
    'picture': 15.0,
    'cloud': 10.0,
    'scan': 30.0,
    'range': 30.0,
    'contacts': 30.0,
    'map': 2.0,
    'path': 10.0,
    'poses': 10.0,
    'polygon': 10.0,
    'point': 10.0,
}
"""Samples per second that pages are sent, at most."""
_SLOW = {'picture', 'cloud', 'map', 'path', 'poses'}
"""What takes long enough to be left to another thread."""
_WHOLE_PERIOD = 0.5
"""s between two clouds of which all points are sent, at least."""
KEPT = {'map', 'path', 'poses', 'polygon', 'point'}
"""What may be published once, for those who subscribe later, too."""


class SensorFeed(NewestFeed):
    """The topic of a sensor; ``source`` is what publishes it, if that may keep messages."""

    def __init__(self, node: Node, info: SensorInfo, source: TopicSource | None = None) -> None:
        self.info = info
        self._is_whole = False
        super().__init__(partial(_subscribe, node, info, source))

    def set_whole(self, *, is_whole: bool) -> None:
        """Show all points of a cloud, or some, from now on."""
        if self._is_whole and not is_whole:
            self._due = 0.0
        self._is_whole = is_whole

    def _unreadable(self, reason: str) -> bytes:
        return unreadable(self.info.topic, reason)

    def _next_due(self, due: float, now: float, message: NumberedMessage) -> float:  # noqa: ARG002
        period = _WHOLE_PERIOD if self._is_whole else 1.0 / _FASTEST[self.info.kind]
        return max(due + period, now)

    def _conversion(self, message: NumberedMessage) -> Callable[[], bytes]:
        rate = self._rate.value
        return partial(
            sample_of,
            self.info.message,
            message.data,
            self.info.topic,
            rate,
            is_whole=self._is_whole,
        )

    def _takes_long(self, message: NumberedMessage) -> bool:  # noqa: ARG002
        return self.info.kind in _SLOW


def _subscribe(
    node: Node, info: SensorInfo, source: TopicSource | None
) -> PolledTopic[bytes] | SourceTopic:
    """Subscribe to a topic. Raises AmrError."""
    kind = message_type(info.message)  # its package need not be installed here
    if source is not None:
        return SourceTopic(node, source, kind, 1)
    return PolledTopic(node, kind, info.topic, bytes)
