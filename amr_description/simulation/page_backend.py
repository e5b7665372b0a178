# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
A simulation in this process as the backend of the page's server (viewer/backend.py).

Its server has a thread of its own, and the simulation belongs to that of the program: what pages
ask waits in :attr:`PageBackend.calls` until the simulation is between two steps, and what they are
shown was made there (``shown.py``).
"""

import asyncio
from collections.abc import Callable, Mapping, Sequence, Set as AbstractSet
from pathlib import Path
from queue import SimpleQueue
import threading
import time
from typing import NoReturn, Protocol

from amr_description.errors import AmrError, ViewerError
from amr_description.model.frames import Vector
from amr_description.viewer.backend import Handlers, Hold, Watched
from amr_description.viewer.bags import StartRecording, StopRecording
from amr_description.viewer.description import DescribedRobot
from amr_description.viewer.protocol import Channel, Graph, Notice, ServerMessage, World
from amr_description.viewer.requests import (
    Delete,
    Part,
    Place,
    Play,
    Request,
    ResetSimulation,
    SetFactor,
    Spawn,
    Step,
)
from amr_description.viewer.samples import Sample
from amr_description.viewer.server import Server

SIMULATOR = '/mujoco_sim'
"""Its name on pages."""
_STILL_PERIOD = 0.25
"""s between two states while nothing moves: for pages that have come in between."""
_LONGEST_WAIT = 5.0
"""s that a page waits for an answer, while one step of the program lasts."""
IDLE = 'this page only watches now: it drives while the program is in sim.play()'
_NEEDS_ROS = 'needs ROS, and this simulation has none; `bringup simulation` starts one over ROS'

_SPAWNED = 'robots come and go by the program: sim.spawn, sim.remove'
_RECORDED = 'the program records: sim.record, sim.end_recording'
_BY_THE_PROGRAM: Mapping[type[Request], str] = {
    Spawn: _SPAWNED,
    Delete: _SPAWNED,
    StartRecording: _RECORDED,
    StopRecording: _RECORDED,
    Place: 'a robot is put elsewhere by the program: sim.spawn with a pose',
}
"""What does it instead, of requests that are not carried out for pages."""


class Controls(Protocol):
    """What pages can do to a simulation; all of it between two steps, and raises AmrError."""

    @property
    def is_playing(self) -> bool:
        """Whether pages may do it: the program is in ``sim.play()``; asked by any thread."""

    def drive(self, robot: str, linear: float, angular: float, sideways: float) -> None: ...
    def push(self, entity: str, link: str, force: Vector, torque: Vector) -> None: ...
    def play(self, *, paused: bool) -> str: ...
    def step(self, steps: int) -> str: ...
    def reset(self) -> str: ...
    def set_factor(self, factor: float) -> str: ...


class PageBackend:
    """See the module; without another remark, for the thread of the server."""

    server: Server
    """Set before it starts."""

    def __init__(self, controls: Controls) -> None:
        """Show nothing yet."""
        self._controls = controls
        self.handlers = self._make_handlers()
        self.calls: SimpleQueue[Callable[[], None]] = SimpleQueue()
        """For the thread of the simulation; none of them raises."""
        self.watched = Watched()
        """Of all pages; read by the thread of the simulation, as what follows."""
        self.has_pages = False
        self.held: frozenset[str] = frozenset()
        """Robots that STOP holds."""
        self._lock = threading.Lock()  # of all that show() hands over
        self._graph: Graph | None = None
        self._world: World | None = None
        self._described: Mapping[str, DescribedRobot] = {}
        self._holds: Mapping[str, Hold] = {}
        self._messages: list[ServerMessage] = []
        self._layout: ServerMessage | None = None
        self._state: bytes | None = None
        self._is_new = False
        self._samples: dict[tuple[Channel, str], Sample] = {}
        self._due = 0.0

    # --- on the thread of the simulation ------------------------------------------------------

    def show_scene(
        self,
        graph: Graph,
        world: World,
        robots: Mapping[str, DescribedRobot],
        layout: ServerMessage,
    ) -> None:
        """Show what there is, from now on: its robots have changed, or the world."""
        with self._lock:
            self._graph, self._world, self._described = graph, world, robots
            self._layout = layout
            self._messages.append(layout)
            self._state = None
        if self.has_pages:
            self.server.call(self._publish_scene)

    def show_state(
        self, state: bytes, messages: Sequence[ServerMessage], holds: Mapping[str, Hold]
    ) -> None:
        """Show where everything is."""
        with self._lock:
            self._state, self._is_new, self._holds = state, True, holds
            self._messages += messages

    def show_sample(self, sample: Sample) -> None:
        """Show what a sensor sees."""
        with self._lock:
            self._samples[sample.channel, sample.topic] = sample

    # --- the page's life ----------------------------------------------------------------------

    def open(self) -> None:
        """Tell the first page, and those after it, what there is."""
        self.has_pages = True
        self._publish_scene()
        with self._lock:
            self._messages = [] if self._layout is None else [self._layout]
            self._is_new = True

    def close(self) -> None:
        """Nobody looks."""
        self.has_pages = False

    def watch(self, watched: Watched) -> None:
        """Have samples of these topics made."""
        self.watched = watched

    def forget(self, page: str) -> None:
        """Do nothing: what a page began ends with it by itself."""

    def _publish_scene(self) -> None:
        with self._lock:
            graph, world, described = self._graph, self._world, self._described
        if graph is None or world is None:
            return
        self.server.pages.publish('', graph)
        self.server.pages.publish(SIMULATOR, world)
        for name, each in described.items():
            self.server.pages.publish(name, each.message)

    # --- what is shown ------------------------------------------------------------------------

    def take_state(self) -> tuple[Sequence[ServerMessage], bytes | None]:
        """Return what is new: messages, then a state."""
        now = time.monotonic()
        with self._lock:
            messages, self._messages = self._messages, []
            if not self._is_new and now < self._due:
                return messages, None
            self._is_new, self._due = False, now + _STILL_PERIOD
            return messages, self._state

    def take_samples(self, wanted: AbstractSet[tuple[Channel, str]]) -> Sequence[Sample]:
        """Return the new samples of these channels."""
        with self._lock:
            return [self._samples.pop(key) for key in [*self._samples] if key in wanted]

    def latest(self, part: Part) -> ServerMessage | None:  # noqa: ARG002
        """Return nothing: there is no graph of ROS."""
        return None

    def mesh(self, name: str) -> Path | bytes | None:
        """Return a file that a description names, or its converted data."""
        for each in self._described.values():
            if name in each.files:
                return each.files[name]
        return None

    def robots(self) -> Sequence[str]:
        """Return the robots that take velocity commands."""
        graph = self._graph
        return [each.id for each in graph.robots if each.command] if graph else []

    def known(self) -> Sequence[str]:
        """Return all robots."""
        return [*self._described]

    # --- what pages ask -----------------------------------------------------------------------

    def hold(self, robots: AbstractSet[str]) -> Mapping[str, Hold]:
        """Have these robots held at rest from the next step on, whatever lets time pass."""
        self.held = frozenset(robots)
        holds = self._holds
        return {name: holds[name] for name in robots if name in holds}

    def drive(self, robot: str, linear: float, angular: float, sideways: float = 0.0) -> None:
        """Command a robot in the next step. Raises ViewerError."""
        if robot not in self.robots():
            raise ViewerError(f'nothing drives {robot}; is its drive controller active?')
        if not any((linear, angular, sideways)) and not self._controls.is_playing:
            return  # what pages have sent does not act any more
        self._put(lambda: self._controls.drive(robot, linear, angular, sideways))

    def push(self, simulator: str, entity: str, link: str, force: Vector, torque: Vector) -> None:  # noqa: ARG002
        """Push a link, until the next call for it. Raises ViewerError."""
        self._put(lambda: self._controls.push(entity, link, force, torque))

    def set_joints(self, robot: str, positions: Mapping[str, float]) -> None:  # noqa: ARG002
        """Refuse. Raises ViewerError."""
        self._refuse('to move joints')

    def hold_joints(self, robot: str | None) -> None:
        """Do nothing: no joint moves by what a page says."""

    def _make_handlers(self) -> Handlers:
        """Return what carries out requests; it may raise what the simulation raises."""
        controls = self._controls
        handlers = Handlers(self._refuse_request)
        handlers.add(
            Play,
            lambda request, _: self._ask(lambda: controls.play(paused=request.type != 'play')),
        )
        handlers.add(Step, lambda request, _: self._ask(lambda: controls.step(request.steps)))
        handlers.add(ResetSimulation, lambda *_: self._ask(controls.reset))
        handlers.add(
            SetFactor, lambda request, _: self._ask(lambda: controls.set_factor(request.factor))
        )
        return handlers

    def _refuse_request(self, request: Request) -> NoReturn:
        if (instead := _BY_THE_PROGRAM.get(type(request))) is not None:
            raise ViewerError(instead)
        self._refuse(f"'{request.types[0]}'")

    def _refuse(self, what: str) -> NoReturn:
        raise ViewerError(f'{what} {_NEEDS_ROS}')

    def _put(self, call: Callable[[], None]) -> None:
        """Have a call made between two steps; its error becomes a notice. Raises ViewerError."""
        self._require_playing()

        def attempt() -> None:
            if self._controls.is_playing:
                try:
                    call()
                except AmrError as error:
                    with self._lock:
                        self._messages.append(Notice('warning', str(error)))

        self.calls.put(attempt)

    async def _ask(self, call: Callable[[], str]) -> str:
        """Have a call made between two steps, and return its answer."""
        self._require_playing()
        loop = asyncio.get_running_loop()
        answer: asyncio.Future[str] = loop.create_future()

        def settle(said: str | Exception) -> None:
            if answer.done():  # nobody waits any more
                return
            if isinstance(said, str):
                answer.set_result(said)
            else:
                answer.set_exception(said)

        def attempt() -> None:
            said: str | Exception = ViewerError(IDLE)
            if self._controls.is_playing:
                try:
                    said = call()
                except Exception as error:  # the page hears of it
                    said = error
            self.server.call(lambda: settle(said))

        self.calls.put(attempt)
        try:
            async with asyncio.timeout(_LONGEST_WAIT):
                return await answer
        except TimeoutError:
            raise ViewerError(
                f'the simulation has not answered for {_LONGEST_WAIT:g} s: {IDLE}'
            ) from None

    def _require_playing(self) -> None:
        if not self._controls.is_playing:
            raise ViewerError(IDLE)
