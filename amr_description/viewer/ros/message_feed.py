# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""Any topic, the latest message of which pages show whole."""

from collections.abc import Callable
from functools import partial
import json

from rclpy.node import Node

from amr_description.cdr.layouts import FieldGroup
from amr_description.cdr.tree import read_tree
from amr_description.ros.layouts import layout_of
from amr_description.ros.polled_topic import NumberedMessage
from amr_description.text import shorten
from amr_description.viewer.protocol import AnyMessage, Channel, Origin, Unreadable
from amr_description.viewer.ros.newest_feed import NewestFeed
from amr_description.viewer.ros.source import SourceTopic, TopicSource
from amr_description.viewer.samples import encode_sample

_PERIOD = 0.1
"""s between two messages that are shown."""
_FASTEST = 10e6
"""Bytes per second of messages that are taken: each is copied."""
_LARGE = 8 * 1024
"""Bytes of a message that is left to another thread."""


class MessageFeed(NewestFeed):
    """Any topic."""

    def __init__(self, node: Node, source: TopicSource) -> None:
        self._source = source

        def subscribe() -> SourceTopic:
            kind = source.message_type()
            self._layout = layout_of(kind)
            return SourceTopic(node, source, kind, 1)

        super().__init__(subscribe)

    def _unreadable(self, reason: str) -> bytes:
        return unreadable(self._source.topic, 'message', reason)

    def _next_due(self, due: float, now: float, message: NumberedMessage) -> float:  # noqa: ARG002
        return now + max(_PERIOD, len(message.data) / _FASTEST)

    def _conversion(self, message: NumberedMessage) -> Callable[[], bytes]:
        rate = self._rate.value if self._source.is_alone else None
        return partial(sample_of, self._layout, message.data, self._source.topic, rate)

    def _takes_long(self, message: NumberedMessage) -> bool:
        return len(message.data) >= _LARGE


def sample_of(layout: FieldGroup, data: bytes, topic: str, rate: float | None) -> bytes:
    """Return the frame of a sample of a message; one that is broken says so in one line."""
    try:
        tree = json.dumps(read_tree(layout, data), ensure_ascii=False, separators=(',', ':'))
    except ValueError as error:
        return unreadable(topic, 'message', str(error))
    head = AnyMessage(Origin(topic, '', 0.0, rate), layout.name, len(data))
    return encode_sample(head, [tree.encode('utf-8', 'replace')])


def unreadable(topic: str, channel: Channel, text: str) -> bytes:
    """Return a sample that says why there is none."""
    return encode_sample(Unreadable(Origin(topic, '', 0.0, None), shorten(text), channel))
