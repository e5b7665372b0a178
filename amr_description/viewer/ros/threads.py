# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
What the two threads of the viewer have of each other, as types.

The server's thread sees the graph as a :class:`GraphView`, and its robots as
:class:`ServedRobot`: what these do not have is the ROS thread's. All else it has done by
:func:`on_ros_thread`, or by the calls of ``ros_side.py``.
"""

import asyncio
from collections.abc import Callable, Mapping, Sequence, Set as AbstractSet
from dataclasses import dataclass, field
from pathlib import Path
from typing import Protocol, TypeVar

from rclpy.executors import Executor

from amr_description.errors import AmrError, ViewerError
from amr_description.model.frames import Vector
from amr_description.text import shorten
from amr_description.viewer.backend import Hold
from amr_description.viewer.description import DescribedRobot
from amr_description.viewer.entities import SpawnedEntity
from amr_description.viewer.graph import DiscoveredGraph, FoundRobot
from amr_description.viewer.protocol import Channel, Commanders, ServerMessage
from amr_description.viewer.requests import Part
from amr_description.viewer.samples import Sample

T = TypeVar('T')

_TIMEOUT = 5.0
"""s"""


class ServedRobot(Protocol):
    """A robot of the graph, as the server's thread has it; the ROS thread may destroy it."""

    deactivated: tuple[str, ...]
    """The controllers that were deactivated to stop it; the server's thread alone has them."""

    @property
    def found(self) -> FoundRobot:
        """Its topics and nodes."""

    @property
    def described(self) -> DescribedRobot | None:
        """Its description; None: it has not come yet."""

    @property
    def drives(self) -> frozenset[str]:
        """The nodes that take its commands."""

    @property
    def timeout(self) -> float | None:
        """s after which its controller takes a command for outdated; None: not known."""

    def set_timeout(self, timeout: float) -> None:
        """Have commands expire after this many s, 0: never."""

    def commanded_by(self, now: float) -> Commanders:
        """Return who else commands it, at a time of a monotonic clock, s."""

    def hold(self, time: int, now: float) -> Hold:
        """Hold it at rest, at a ROS time (ns) and one of a monotonic clock, s: again and again."""

    def release(self) -> None:
        """Hold it no more."""

    def drive(self, linear: float, angular: float, sideways: float, time: int) -> None:
        """Publish a command, m/s, rad/s and m/s, stamped ``time`` (ns). Raises ViewerError."""

    def set_joints(self, positions: Mapping[str, float], time: int) -> None:
        """Move joints, rad or m. Raises ViewerError."""

    def hold_joints(self) -> None:
        """Stop the joints that pages have moved by controllers."""


class Pusher(Protocol):
    """Pushes the robots of a simulator."""

    def push(self, entity: str, link: str, force: Vector, torque: Vector) -> None:
        """Push a link, N and N m in the axes of the world; without any, let it go."""


@dataclass(frozen=True, slots=True)
class GraphSnapshot:
    """What was found in the graph, at one moment; nothing in it is ever replaced."""

    found: DiscoveredGraph = field(default_factory=DiscoveredGraph)
    robots: Mapping[str, ServedRobot] = field(default_factory=dict)
    """By their ids."""
    pushers: Mapping[str, Pusher] = field(default_factory=dict)
    """By the simulator."""
    spawned: Mapping[str, tuple[SpawnedEntity, ...]] = field(default_factory=dict)
    """With what simulators say to have spawned their entities, by the simulator."""


class GraphView(Protocol):
    """The graph, as the server's thread has it."""

    @property
    def snapshot(self) -> GraphSnapshot:
        """What is found; the ROS thread replaces it as a whole."""

    def take_samples(self, wanted: AbstractSet[tuple[Channel, str]]) -> Sequence[Sample]:
        """Return new samples of these channels, and of plotted values."""

    def file(self, name: str) -> Path | bytes | None:
        """Return a mesh that a marker names, by the name in its address; None: none does."""

    def latest(self, part: Part) -> ServerMessage | None:
        """Return what a page that begins to show a part is sent at once; None: nothing yet."""


async def on_ros_thread(executor: Executor, call: Callable[[], T]) -> T:
    """Return what ``call`` returned on the ROS thread. Raises ViewerError: it failed."""
    loop = asyncio.get_running_loop()
    done: asyncio.Future[T] = loop.create_future()

    def settle(result: T | None, error: Exception | None) -> None:
        if done.done():
            return
        if error is None:
            done.set_result(result)  # type: ignore[arg-type]
        else:
            done.set_exception(error)

    def run() -> None:
        result, failed = None, None
        try:
            result = call()
        except AmrError as error:
            failed = ViewerError(str(error))
        except Exception as error:  # rclpy's, such as of a type that the topic does not have
            failed = ViewerError(shorten(f'{type(error).__name__}: {error}'))
        loop.call_soon_threadsafe(settle, result, failed)

    executor.create_task(run)
    try:
        return await asyncio.wait_for(done, _TIMEOUT)
    except TimeoutError:
        raise ViewerError(f'ROS has not answered within {_TIMEOUT:g} s') from None
