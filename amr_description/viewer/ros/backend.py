# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""The robots of the ROS graph, as the page's server wants them (viewer/backend.py)."""

import asyncio
from collections.abc import Callable, Coroutine, Mapping, Sequence
from pathlib import Path
import time
from typing import Any

from diagnostic_msgs.msg import DiagnosticArray
from rclpy.executors import Executor
from rclpy.node import Node
from visualization_msgs.msg import MarkerArray

from amr_description.errors import AmrError, ViewerError
from amr_description.viewer.protocol import (
    Graph,
    RobotInfo,
    ServerMessage,
    SimulationStatus,
    World,
)
from amr_description.viewer.requests import Request, Spawn, Switch
from amr_description.viewer.ros.graph_monitor import GraphMonitor, GraphObserver
from amr_description.viewer.ros.markers import DiagnosticsBoard, shapes_of
from amr_description.viewer.ros.robot import RobotLink
from amr_description.viewer.ros.service_clients import (
    list_controllers,
    Services,
    Simulator,
    start_like,
    switch_controllers,
)
from amr_description.viewer.ros.states import States
from amr_description.viewer.server import Server

_REFRESH_PERIOD = 1.0
"""s between two questions to a simulator, or to a manager that does not tell its activity."""
_STATUS_PERIOD = 0.25
"""s between two messages about a simulator's time."""


class GraphBackend(GraphObserver):
    """
    On the server's thread, but for what :class:`GraphObserver` has.

    :attr:`server` has to be set before the server starts; ``say`` logs a fault of ours.
    """

    server: Server

    def __init__(self, node: Node, executor: Executor, say: Callable[[str], object]) -> None:
        self._node = node
        self._executor = executor
        self._say = say
        self._services = Services(node)
        self._states = States()
        self._stage = GraphMonitor(node, self._states, self._services)
        self._stage.audience = self
        self._simulators: dict[str, Simulator] = {}
        self._diagnostics = DiagnosticsBoard()
        self._watch: asyncio.Task[None] | None = None
        self._tasks: set[asyncio.Task[None]] = set()
        self._status_due = 0.0
        self._sessions = 0
        self._session = 0
        """From the first page's coming to the last one's going; 0: nobody looks."""
        self._infos: tuple[RobotInfo, ...] = ()

    # --- what the server asks --------------------------------------------------------------------

    def opened(self) -> None:
        """Somebody looks: connect."""
        self._sessions += 1
        self._session = self._sessions
        self._executor.create_task(self._catch_up)
        self._watch = asyncio.create_task(self._refresh_for_ever())

    def closed(self) -> None:
        """Nobody looks any more: part with everything."""
        self._session = 0
        self._executor.create_task(self._catch_up)
        if self._watch is not None:
            self._watch.cancel()

    def state(self) -> tuple[Sequence[ServerMessage], bytes | None]:
        """Return what is new."""
        messages, state = self._states.take()
        now = time.monotonic()
        if now >= self._status_due:
            self._status_due = now + _STATUS_PERIOD
            messages = [*messages, *self._statuses()]
        return messages, state

    def robots(self) -> Sequence[str]:
        """Return those that take commands."""
        return [name for name, link in self._stage.links.items() if link.found.command]

    def drive(self, robot: str, linear: float, angular: float) -> None:
        """Publish one command."""
        self._link(robot).drive(linear, angular, self._now())

    def set_joints(self, robot: str, positions: Mapping[str, float]) -> None:
        """Move joints that joint_state_publisher publishes."""
        self._link(robot).set_joints(positions, self._now())

    async def answer(self, request: Request) -> str:
        """Do what is asked."""
        if isinstance(request, Switch):
            manager = self._link(request.robot).found.manager
            if manager is None:
                raise ViewerError(f'{request.robot} has no controller manager')
            try:
                return await switch_controllers(self._services, manager, request)
            finally:
                self._list_controllers(request.robot)
        simulator = self._simulators.get(request.simulator)
        if simulator is None:
            known = ', '.join(self._simulators) or 'none'
            raise ViewerError(f'there is no simulator {request.simulator!a}; there are: {known}')
        try:
            done = await simulator.answer(request)
        finally:
            self._do(self._refresh(simulator))
        return f'{done}{await self._join(request)}' if isinstance(request, Spawn) else done

    async def _join(self, request: Spawn) -> str:
        """Have a robot that was just spawned drawn and driven as the one that it is like."""
        like, place = self._link(request.like), f'/{request.namespace.strip("/")}'
        self._executor.create_task(self._stage.describe, place, self._description_of(request.like))
        if like.found.manager is None:
            return ''
        manager = place.rstrip('/') + like.found.manager.removeprefix(like.found.id.rstrip('/'))
        try:
            names = await start_like(self._services, like.found.manager, manager)
        except ViewerError as error:
            return f', but its controllers are not active: {error}'
        return f'; active: {", ".join(names) or "no controllers"}'

    def mesh(self, name: str) -> Path | bytes | None:
        """Return what a description names, or its file."""
        for link in self._stage.links.values():
            if link.described is not None and name in link.described.files:
                return link.described.files[name]
        return None

    # --- on the ROS thread -----------------------------------------------------------------------

    def _catch_up(self) -> None:
        """Be open for the present session alone; rclpy runs tasks in any order."""
        self._stage.attend(self._session)

    def graph_changed(self) -> None:
        """Tell the pages."""
        links, simulators = self._stage.links, self._stage.found.simulators
        subjects = [*links, *(each.id for each in simulators)]
        infos = tuple(link.info for link in links.values())
        names = [each.id for each in simulators]
        self.server.call(lambda: self._follow(names))
        self.server.forget(subjects)
        self.server.call(lambda: self._show_graph(infos))
        for link in links.values():
            if link.found.manager:
                self.controllers_changed(link.found.id)

    def model_came(self, link: RobotLink) -> None:
        """Tell the pages."""
        if link.described is not None:
            self.server.show(link.found.id, link.described.message)

    def controllers_changed(self, robot: str) -> None:
        """Ask for the whole list."""
        self.server.call(lambda: self._list_controllers(robot))

    def world_came(self, simulator: str, message: MarkerArray) -> None:
        """Tell the pages."""
        self.server.show(simulator, World(simulator, shapes_of(message)))

    def diagnostics_came(self, message: DiagnosticArray) -> None:
        """Tell the pages what is new."""
        robots = [*self._stage.links]
        for each in self._diagnostics.take(message, robots):
            self.server.show(each.robot, each)

    # --- on the server's thread ------------------------------------------------------------------

    def _follow(self, names: Sequence[str]) -> None:
        known = self._simulators
        self._simulators = {
            name: known.get(name) or Simulator(name, self._services, self._description_of)
            for name in names
        }
        for name, simulator in self._simulators.items():
            if name not in known:
                self._do(self._refresh(simulator))

    def _show_graph(self, robots: tuple[RobotInfo, ...]) -> None:
        self._infos = robots
        simulators = tuple(each.info for each in self._simulators.values())
        self.server.show_now('', Graph(robots, simulators, None if robots else self._hint()))

    def _hint(self) -> str:
        return (
            'nothing publishes /robot_description in ROS domain '
            f'{self._node.context.get_domain_id()}; start a robot, such as: ros2 launch '
            'amr_description simulation'
        )

    def _statuses(self) -> list[SimulationStatus]:
        scene = self._states.scene
        if scene is None:
            return []
        return [
            SimulationStatus(
                simulator=name,
                state=simulator.state,  # type: ignore[arg-type]
                time=(scene.clock.time or 0) / 1e9,
                factor=simulator.factor,
                real_factor=scene.clock.factor,
            )
            for name, simulator in self._simulators.items()
        ]

    def _link(self, robot: str) -> RobotLink:
        link = self._stage.links.get(robot)
        if link is None:
            known = ', '.join(self._stage.links) or 'none'
            raise ViewerError(f'there is no robot {robot!a}; there are: {known}')
        return link

    def _description_of(self, robot: str) -> str:
        described = self._link(robot).described
        if described is None:
            raise ViewerError(f'the description of {robot} has not come yet')
        return described.message.urdf

    def _now(self) -> int:
        """ROS time, ns: of /clock, where there is one, as of just now."""
        scene = self._states.scene
        if scene is not None:
            scene.clock.look()
            if scene.clock.time is not None:
                return scene.clock.time
        return self._node.get_clock().now().nanoseconds

    def _list_controllers(self, robot: str) -> None:
        async def ask() -> None:
            link = self._stage.links.get(robot)
            if link is not None and link.found.manager is not None:
                found = await list_controllers(self._services, link.found.manager, robot)
                self.server.show_now(robot, found)

        self._do(ask())

    async def _refresh(self, simulator: Simulator) -> None:
        before = simulator.info
        await simulator.refresh()
        if simulator.info != before:
            self._show_graph(self._infos)

    async def _refresh_for_ever(self) -> None:
        while True:
            await asyncio.sleep(_REFRESH_PERIOD)
            for simulator in self._simulators.values():
                self._do(self._refresh(simulator))
            for name, link in self._stage.links.items():
                if link.found.activity is None and link.found.manager is not None:
                    self._list_controllers(name)

    def _do(self, work: Coroutine[Any, Any, None]) -> None:
        """Have something done; a service that does not answer is asked again later."""

        async def do() -> None:
            try:
                await work
            except AmrError:
                pass  # who is asked is just going, or coming
            except Exception as error:
                self._say(f'{type(error).__name__}: {error}')

        task = asyncio.get_running_loop().create_task(do())
        self._tasks.add(task)
        task.add_done_callback(self._tasks.discard)
