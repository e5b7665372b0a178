# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
How the topics of a simulation are made, with ROS or without: the contract.

A topic takes samples; its encoder makes the bytes of a message of each that has subscribers.
"""

from collections.abc import Callable
from typing import Any, Protocol, TypeAlias

Encode: TypeAlias = Callable[[Any], bytes]
"""Makes the bytes of a message of a sample."""


class Topic(Protocol):
    """A topic on which samples go out at the end of a cycle."""

    @property
    def has_subscribers(self) -> bool:
        """Whether somebody subscribes, or records."""

    def send(self, sample: Any) -> None:
        """Publish a sample at the end of this cycle; on the control thread."""

    def write_aside(self, sample: Any) -> None:
        """Publish a big sample now; on any thread."""


class Topics(Protocol):
    """Makes topics; reliable ones that keep ten messages and nothing for who comes later."""

    reporters: list[Callable[[int], None]]
    """Called at the end of a cycle with its time, ns; what they send goes out with it."""
    followers: list[Callable[[], None]]
    """Called when all of a cycle has gone out."""

    def advertise(self, name: str, message: str, encode: Encode) -> Topic:
        """
        Make a topic.

        Args:
            name: Its full name.
            message: ``package/msg/Name``.
            encode: Called for each sample that has subscribers.

        Raises:
            AmrError: It cannot be made.
        """

    def withdraw(self, topic: Any) -> None:
        """Remove a topic."""
