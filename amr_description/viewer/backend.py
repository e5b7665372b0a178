# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""What the server needs from whatever knows the robots."""

from collections.abc import Mapping, Sequence, Set as AbstractSet
from pathlib import Path
from typing import Protocol

from amr_description.viewer.protocol import ServerMessage
from amr_description.viewer.requests import Part, Request
from amr_description.viewer.samples import Sample


class Backend(Protocol):
    """
    The robots, as pages see and move them.

    Every method is called on the server's thread and must not block. The message of a ViewerError
    is sent to the page that asked.
    """

    def open(self) -> None:
        """The first page has connected: start to collect data."""

    def close(self) -> None:
        """The last page has disconnected: stop."""

    def watch(self, parts: AbstractSet[Part], topics: AbstractSet[str]) -> None:
        """
        Collect these parts of states, too, for all robots, and no other part of this kind.

        None is collected at first. A part that is not collected is not known, NaN. And subscribe
        to these topics of sensors, of those that there are, and to no others.
        """

    def take_state(self) -> tuple[Sequence[ServerMessage], bytes | None]:
        """
        Return what is new since the last call: messages, then a state, None if nothing moved.

        The layout of a state is among the messages of the same call or of an earlier one.
        """

    def take_samples(self, wanted: AbstractSet[str]) -> Sequence[Sample]:
        """
        Return the new samples of sensors since the last call, at most one a topic.

        Args:
            wanted: Of the topics that are watched, those of which a page can take a sample now. Of
                others none need be made.
        """

    def robots(self) -> Sequence[str]:
        """Return the robots that take velocity commands."""

    def drive(self, robot: str, linear: float, angular: float, sideways: float = 0.0) -> None:
        """Publish one command now, m/s, rad/s and m/s to the left. Raises ViewerError."""

    def set_joints(self, robot: str, positions: Mapping[str, float]) -> None:
        """
        Move joints, rad or m: by joint_state_publisher, else by controllers. Raises ViewerError.
        """

    def hold_joints(self, robot: str | None) -> None:
        """Stop the joints of a robot, None: of all, that pages have moved by controllers."""

    async def handle(self, request: Request) -> str:
        """Carry out a request; return one line about what was done. Raises ViewerError."""

    def mesh(self, name: str) -> Path | bytes | None:
        """Return what a model calls ``/mesh/<name>``, or its file; None: no model names it."""
