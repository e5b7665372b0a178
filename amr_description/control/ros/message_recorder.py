# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
What a process with a control loop hands to who records its messages in the process itself.

A message is handed over with the bytes that are published, at the simulated time at which it is:
none can be lost on the way, and equal runs have equal recordings.
"""

from collections.abc import Callable
from typing import Any, Protocol, TypeAlias

from rclpy.publisher import Publisher
from rclpy.subscription import Subscription

from amr_description.control.contracts import Input
from amr_description.control.recorded_commands import each_new
from amr_description.ros.layouts import serialize
from amr_description.ros.message_types import type_name

Sink: TypeAlias = Callable[[bytes], None]
"""Takes a serialized message; on any thread."""


class MessageRecorder(Protocol):
    """Records; :meth:`set_time` and the cycles are called on the control thread."""

    def prepare(self, name: str) -> None:
        """Read what has to be known of a type of messages; the control thread has no time."""

    def set_time(self, time: int) -> None:
        """Give what follows a time, ns; it has jumped, where it is before the last one."""

    def begin_cycle(self, time: int) -> None:
        """Begin the messages of the end of a cycle."""

    def end_cycle(self) -> None:
        """Take note that all of a cycle was sent."""

    def forget(self, publisher: Publisher) -> None:
        """Keep nothing that a publisher has latched, for it is destroyed; on any thread."""

    def samples_of(self, publisher: Publisher) -> Sink | None:
        """Return what takes the samples of cycles; None: this topic is not wanted."""

    def messages_of(self, publisher: Publisher) -> Sink | None:
        """Return what takes messages that are published now and then, likewise."""

    def commands_of(self, subscription: Subscription) -> Sink | None:
        """Return what takes the messages that a controller acts on, likewise."""


class RecordedMessagePublisher:
    """A publisher of messages that are published now and then; :meth:`LoopPublisher.recorded`."""

    def __init__(self, publisher: Publisher, *, is_latched: bool) -> None:
        self.publisher = publisher
        self._is_latched = is_latched
        self._latest: Any = None
        self._sink: Sink | None = None

    @property
    def type_name(self) -> str:
        """Of its messages."""
        return type_name(self.publisher.msg_type)

    def publish(self, message: Any) -> None:
        """Publish a message, or the bytes of one, now, and record."""
        if self._is_latched:
            self._latest = message
        sink = self._sink
        if sink is None:
            self.publisher.publish(message)
        else:
            data = _bytes_of(message)
            sink(data)
            self.publisher.publish(data)

    def attach(self, recorder: MessageRecorder | None) -> None:
        """Record from now on, what is latched first; None: no more."""
        self._sink = None if recorder is None else recorder.messages_of(self.publisher)
        if self._sink is not None and self._latest is not None:
            self._sink(_bytes_of(self._latest))


def _bytes_of(message: Any) -> bytes:
    return message if isinstance(message, bytes) else serialize(message)


class RecordedInput:
    """An input of a controller whose commands are recorded when the controller takes them."""

    def __init__(self, port: Input[Any], subscription: Subscription) -> None:
        self.port = port
        self._subscription = subscription

    @property
    def type_name(self) -> str:
        """Of its messages."""
        return type_name(self._subscription.msg_type)

    def attach(self, recorder: MessageRecorder | None) -> None:
        """Record from now on; None: no more."""
        sink = None if recorder is None else recorder.commands_of(self._subscription)
        self.port.on_drain = None if sink is None else each_new(sink)
