# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""What the server needs from whatever knows the robots."""

from collections.abc import Awaitable, Callable, Mapping, Sequence, Set as AbstractSet
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any, NoReturn, Protocol, TypeAlias, TypeVar

from amr_description.model.frames import Vector
from amr_description.viewer.protocol import Channel, ServerMessage
from amr_description.viewer.requests import Part, Request
from amr_description.viewer.samples import Sample


@dataclass(frozen=True, slots=True)
class Watched:
    """
    What one page, or any page, shows of what is collected on demand.

    Attributes:
        parts: Of the states, beyond what every state has.
        sensors: Topics of sensors.
        messages: Topics whose latest message is shown.
        fields: By topic, the paths of the numbers that are plotted.
        whole: Topics of clouds that are shown with all their points.
    """

    parts: frozenset[Part] = frozenset()
    sensors: frozenset[str] = frozenset()
    messages: frozenset[str] = frozenset()
    fields: Mapping[str, frozenset[str]] = field(default_factory=dict)
    whole: frozenset[str] = frozenset()

    @property
    def latest(self) -> frozenset[tuple[Channel, str]]:
        """The channels of which a page gets the newest sample alone."""
        return frozenset(
            [('sensor', each) for each in self.sensors]
            + [('message', each) for each in self.messages]
        )


@dataclass(frozen=True, slots=True)
class Hold:
    """How a stopped robot is held."""

    motion: float | None
    """How it moves, in multiples of what counts as still; None: nothing has measured it lately."""
    is_locked: bool
    """What drives it takes part in the lock."""
    controllers: tuple[str, ...]
    """The active controllers that drive it."""
    deactivated: tuple[str, ...]
    """Those that were deactivated for it."""


@dataclass(frozen=True, slots=True)
class Answer:
    """What was done, on one line, or what was asked for."""

    message: str
    data: Any = None


R = TypeVar('R', bound=Request)
Handler: TypeAlias = Callable[[R, str], Awaitable[Answer | str]]
"""Carries out a request of a page, which is named; returns what was done. Raises AmrError."""


class Handlers:
    """
    What carries out the requests of pages, by their types: the one way from a request to its code.

    Args:
        refuse: raises why a request is not carried out here, for those that nothing is added for.
    """

    def __init__(self, refuse: Callable[[Request], NoReturn]) -> None:
        self._refuse = refuse
        self._handlers: dict[type, Handler[Any]] = {}

    def add(self, kind: type[R], handler: Handler[R]) -> None:
        """Have requests of a type carried out so."""
        self._handlers[kind] = handler

    async def carry_out(self, request: Request, page: str) -> Answer:
        """Carry out a request of a page, which is named. Raises AmrError."""
        handler = self._handlers.get(type(request))
        if handler is None:
            self._refuse(request)
        done = await handler(request, page)
        return Answer(done) if isinstance(done, str) else done


class Backend(Protocol):
    """
    The robots, as pages see and move them.

    Every method is called on the server's thread and must not block. The message of a ViewerError
    is sent to the page that asked.
    """

    handlers: Handlers
    """Of the requests of pages."""

    def open(self) -> None:
        """The first page has connected: start to collect data."""

    def close(self) -> None:
        """The last page has disconnected: stop."""

    def watch(self, watched: Watched) -> None:
        """
        Collect these parts of states, too, for all robots, and no other part of this kind.

        None is collected at first. A part that is not collected is not known, NaN. And subscribe
        to these topics, of those that there are, and to no others.
        """

    def take_state(self) -> tuple[Sequence[ServerMessage], bytes | None]:
        """
        Return what is new since the last call: messages, then a state, None if nothing moved.

        The layout of a state is among the messages of the same call or of an earlier one.
        """

    def take_samples(self, wanted: AbstractSet[tuple[Channel, str]]) -> Sequence[Sample]:
        """
        Return the new samples since the last call, at most one a topic and channel.

        Args:
            wanted: Of the channels that are watched, those of which a page can take a sample now.
                Of others none need be made; those of ``values`` always are.
        """

    def robots(self) -> Sequence[str]:
        """Return the robots that take velocity commands."""

    def known(self) -> Sequence[str]:
        """Return all robots."""

    def hold(self, robots: AbstractSet[str]) -> Mapping[str, Hold]:
        """
        Hold these robots at rest, and release those that were held and are not among them.

        To be called 20 times per second while there are any. The first call commands them to stop
        before it returns.
        """

    def drive(self, robot: str, linear: float, angular: float, sideways: float = 0.0) -> None:
        """Publish one command now, m/s, rad/s and m/s to the left. Raises ViewerError."""

    def push(self, simulator: str, entity: str, link: str, force: Vector, torque: Vector) -> None:
        """
        Push a link, N and N m in the axes of ``world``, until the next call for it.

        No force and no torque let it go. Raises ViewerError.
        """

    def set_joints(self, robot: str, positions: Mapping[str, float]) -> None:
        """
        Move joints, rad or m: by joint_state_publisher, else by controllers. Raises ViewerError.
        """

    def hold_joints(self, robot: str | None) -> None:
        """Stop the joints of a robot, None: of all, that pages have moved by controllers."""

    def forget(self, page: str) -> None:
        """A page has disconnected: end what it alone wanted."""

    def latest(self, part: Part) -> ServerMessage | None:
        """Return what a page that begins to show a part is sent at once; None: nothing yet."""

    def mesh(self, name: str) -> Path | bytes | None:
        """Return what a model calls ``/mesh/<name>``, or its file; None: no model names it."""
