# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
The topics that pages show: subscribed while they do, polled when a page can take a sample.

Whoever hears a sensor of a simulator has it measured, and a driver may do so, too. So what no page
shows is not subscribed. As with states, the ROS thread assigns what is polled, as a whole, and the
server's thread polls it.
"""

from collections.abc import Callable, Iterable, Mapping, Sequence, Set as AbstractSet
from dataclasses import dataclass
from pathlib import Path
import time
from typing import TypeAlias

from rclpy.node import Node

from amr_description.viewer.backend import Watched
from amr_description.viewer.protocol import Channel, SensorInfo
from amr_description.viewer.ros.field_feed import FieldFeed
from amr_description.viewer.ros.marker_feed import MarkerFeed
from amr_description.viewer.ros.message_feed import MessageFeed
from amr_description.viewer.ros.sensors import KEPT, SensorFeed
from amr_description.viewer.ros.source import source_of, TopicSource
from amr_description.viewer.samples import Sample

Feed: TypeAlias = SensorFeed | MarkerFeed | MessageFeed | FieldFeed
ReceiveTime: TypeAlias = Callable[[int], float]
"""When something was received, system time, ns -> the time of the states then, s."""


@dataclass(frozen=True, slots=True)
class _Key:
    """What a feed was made for; another one is another feed."""

    channel: Channel
    topic: str
    of: SensorInfo | TopicSource
    source: TopicSource | None = None
    """Of a sensor that is subscribed to as its publishers are."""

    @property
    def is_lasting(self) -> bool:
        """Whether what it shows stays as it is for long."""
        return isinstance(self.of, SensorInfo) and self.of.kind == 'map'


class TopicFeeds:
    """
    The topics that pages show, of those that there are.

    :meth:`watch`, :meth:`find` and :meth:`refresh` are called on the ROS thread, :meth:`take` on
    the server's.
    """

    def __init__(self, node: Node, receive_time: ReceiveTime) -> None:
        self._node = node
        self._receive_time = receive_time
        self._sensors: Mapping[str, SensorInfo] = {}
        self._watched = Watched()
        self._feeds: Mapping[_Key, Feed] = {}

    def find(self, sensors: Sequence[SensorInfo]) -> None:
        """Follow a change of the graph: these are the topics of sensors."""
        self._sensors = {each.topic: each for each in sensors}
        self.refresh()

    def watch(self, watched: Watched) -> None:
        """Subscribe to these topics, as far as there are, and to no others."""
        self._watched = watched
        self.refresh()

    def take(self, wanted: AbstractSet[tuple[Channel, str]]) -> list[Sample]:
        """Poll; return new samples, but for ``values`` of these channels alone."""
        feeds = self._feeds
        if not feeds:
            return []
        now = time.monotonic()
        taken = (
            (key, feed.take(now, is_wanted=(key.channel, key.topic) in wanted))
            for key, feed in feeds.items()
        )
        return [
            Sample(key.topic, frame, key.channel, key.is_lasting)
            for key, frame in taken
            if frame is not None
        ]

    def file(self, name: str) -> Path | bytes | None:
        """Return a mesh that a marker names, by the name in its address; None: none does."""
        found = (each.files.get(name) for each in self._markers)
        return next((each for each in found if each is not None), None)

    def drawn(self) -> list[SensorInfo]:
        """Return the topics by which markers were drawn that are there."""
        return [each.info for each in self._markers if each.is_drawn]

    @property
    def _markers(self) -> list[MarkerFeed]:
        return [each for each in self._feeds.values() if isinstance(each, MarkerFeed)]

    def refresh(self) -> None:
        """Look again for the topics that are shown, and subscribe to what has come or changed."""
        watched, before = self._watched, self._feeds
        if not (watched.sensors or watched.messages or watched.fields or before):
            return
        keys = {*self._keys(watched)}
        if before.keys() != keys:
            feeds = {key: each for key, each in before.items() if key in keys}
            for key in before.keys() - keys:  # first: a topic can only have one type in a process
                before[key].destroy()
            self._feeds = feeds | {key: self._feed(key) for key in keys - before.keys()}
        for key, feed in self._feeds.items():
            feed.settle()
            if isinstance(feed, FieldFeed):
                feed.set_paths(watched.fields[key.topic])
            elif isinstance(feed, SensorFeed):
                feed.set_whole(is_whole=key.topic in watched.whole)

    def _keys(self, watched: Watched) -> Iterable[_Key]:
        for topic in watched.sensors & self._sensors.keys():
            info = self._sensors[topic]
            yield _Key(
                'sensor', topic, info, source_of(self._node, topic) if info.kind in KEPT else None
            )
        for topic in watched.messages:
            if (source := source_of(self._node, topic)) is not None:
                yield _Key('message', topic, source)
        for topic in watched.fields:
            if (source := source_of(self._node, topic)) is not None:
                yield _Key('values', topic, source)

    def _feed(self, key: _Key) -> Feed:
        if isinstance(key.of, SensorInfo) and key.of.kind == 'markers':
            return MarkerFeed(self._node, key.of, self._receive_time)
        if isinstance(key.of, SensorInfo):
            return SensorFeed(self._node, key.of, key.source)
        if key.channel == 'message':
            return MessageFeed(self._node, key.of)
        return FieldFeed(self._node, key.of, self._receive_time)
