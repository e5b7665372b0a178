# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""What publishes on a topic, and a subscription that hears all of it at the least cost."""

from collections import deque
from dataclasses import dataclass
from typing import Any

from rclpy.exceptions import InvalidTopicNameException
from rclpy.node import Node
from rclpy.qos import DurabilityPolicy, QoSProfile, ReliabilityPolicy
from rclpy.validate_full_topic_name import validate_full_topic_name

from amr_description.clock import NANOSECONDS
from amr_description.errors import AmrError
from amr_description.ros.message_types import message_type
from amr_description.ros.polled_topic import NumberedMessage, PolledTopic
from amr_description.ros.rclpy_internals import RCLError
from amr_description.text import quote_all, shorten

_FREQUENT = 5
"""Messages within a second that make a topic frequent."""


@dataclass(frozen=True, slots=True)
class TopicSource:
    """
    What publishes on a topic.

    Attributes:
        topic: Its name.
        types: Of the messages; usually one.
        keeps: Whether all publishers keep messages for those who subscribe later, and send again
            what was lost.
        is_alone: Whether there is one publisher.
    """

    topic: str
    types: tuple[str, ...]
    keeps: bool
    is_alone: bool

    def message_type(self) -> Any:
        """Return the class of the messages. Raises AmrError."""
        if len(self.types) > 1:
            raise AmrError(f'{self.topic} has messages of several types: {quote_all(self.types)}')
        return message_type(self.types[0], f'The type of {self.topic}')


def source_of(node: Node, topic: str) -> TopicSource | None:
    """Return what publishes on a topic; None: nothing does, or it is no name."""
    try:
        validate_full_topic_name(topic)  # what a page asks for need not be a name
    except InvalidTopicNameException:
        return None
    found = node.get_publishers_info_by_topic(topic)
    if not found:
        return None
    qos = [each.qos_profile for each in found]
    return TopicSource(
        topic,
        tuple(sorted({each.topic_type for each in found})),
        keeps=all(
            each.reliability == ReliabilityPolicy.RELIABLE
            and each.durability == DurabilityPolicy.TRANSIENT_LOCAL
            for each in qos
        ),
        is_alone=len(found) == 1,
    )


class SourceTopic:
    """
    A topic that all its publishers match; made and destroyed on the ROS thread.

    It asks for no message again: to acknowledge one costs more than to read it. Only what its
    publishers keep is asked for, by a subscription of its own, until the topic proves to be
    frequent: ros2_control keeps the last message of every topic, also of one of 1 kHz.
    """

    def __init__(self, node: Node, source: TopicSource, message_class: Any, depth: int) -> None:
        """
        Subscribe. Raises AmrError.

        Args:
            node: That subscribes.
            source: The topic.
            message_class: The class of the messages.
            depth: How many messages wait to be taken, the latest.
        """
        self._sent: deque[int] = deque(maxlen=_FREQUENT)
        """When the latest messages were sent that came by :attr:`_kept`, ns."""
        self._given: deque[tuple[int, int | None]] = deque(maxlen=depth)
        """What came by :attr:`_kept` last, and waits in :attr:`_live`, too."""
        self._kept: PolledTopic[bytes] | None = None
        try:
            self._live = PolledTopic(node, message_class, source.topic, bytes, depth=depth)
            if source.keeps:
                qos = QoSProfile(depth=depth, durability=DurabilityPolicy.TRANSIENT_LOCAL)
                self._kept = PolledTopic(node, message_class, source.topic, bytes, qos=qos)
        except RCLError as error:  # such as another type that this process has the topic with
            raise AmrError(f'{source.topic}: {shorten(str(error))}') from error

    def take_numbered(self) -> NumberedMessage | None:
        """Return the next message; None: none came. On any thread."""
        if (kept := self._kept) is not None:
            message = kept.take_numbered()
            if message is not None:
                self._sent.append(message.sent)
                self._given.append((message.sent, message.number))
            return message
        while (message := self._live.take_numbered()) is not None:
            if (message.sent, message.number) not in self._given:
                return message
        self._given.clear()
        return None

    def settle(self) -> None:
        """Ask for nothing more once the topic is frequent; now and then, on the ROS thread."""
        kept, sent = self._kept, self._sent
        if kept is not None and len(sent) == _FREQUENT and sent[-1] - sent[0] < NANOSECONDS:
            self._kept = None
            kept.destroy()

    def destroy(self) -> None:
        """Unsubscribe."""
        self._live.destroy()
        if self._kept is not None:
            self._kept.destroy()
