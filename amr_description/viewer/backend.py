# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""What the server asks of whoever knows the robots."""

from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Protocol

from amr_description.viewer.protocol import ServerMessage
from amr_description.viewer.requests import Request


class Backend(Protocol):
    """
    The robots, as pages see and move them.

    Everything is called on the server's thread, and nothing may block. A ViewerError is told to
    the page that asked.
    """

    def opened(self) -> None:
        """The first page has come: from now on there is somebody to look."""

    def closed(self) -> None:
        """The last page has gone."""

    def state(self) -> tuple[Sequence[ServerMessage], bytes | None]:
        """
        What is new since the last call: messages, then a state; None where nothing has moved.

        A state's layout comes as a message with or before it.
        """

    def robots(self) -> Sequence[str]:
        """Return those that take commands."""

    def drive(self, robot: str, linear: float, angular: float) -> None:
        """Publish one command now, m/s and rad/s. Raises ViewerError."""

    def set_joints(self, robot: str, positions: Mapping[str, float]) -> None:
        """Move joints that joint_state_publisher publishes, rad or m. Raises ViewerError."""

    async def answer(self, request: Request) -> str:
        """Do what is asked; say in one line what was done. Raises ViewerError."""

    def mesh(self, name: str) -> Path | bytes | None:
        """Return what a model calls ``/mesh/<name>``, or its file; None: no model names it."""
