# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""The robots of the ROS graph as the backend of the page's server (viewer/backend.py)."""

import asyncio
from collections.abc import Callable, Coroutine, Mapping, Sequence, Set as AbstractSet
from pathlib import Path
import time
from typing import Any

from diagnostic_msgs.msg import DiagnosticArray
from rclpy.executors import Executor
from rclpy.node import Node
from visualization_msgs.msg import MarkerArray

from amr_description.clock import NANOSECONDS
from amr_description.errors import AmrError, ViewerError
from amr_description.viewer.joint_groups import ControllerJoints, joint_groups, with_moves
from amr_description.viewer.protocol import (
    Graph,
    RobotInfo,
    SensorInfo,
    ServerMessage,
    SimulationStatus,
    World,
)
from amr_description.viewer.requests import Part, Request, Spawn, Switch
from amr_description.viewer.ros.graph_monitor import GraphMonitor, GraphObserver
from amr_description.viewer.ros.markers import LatestDiagnostics, shapes_of
from amr_description.viewer.ros.robot import RobotConnection
from amr_description.viewer.ros.service_clients import (
    activate_same_controllers,
    list_controllers,
    ServiceClients,
    SimulatorClient,
    switch_controllers,
)
from amr_description.viewer.ros.states import StateAssembler
from amr_description.viewer.samples import Sample
from amr_description.viewer.server import Server

_REFRESH_PERIOD = 1.0
"""s between two queries of a simulator, or of a controller manager without ``~/activity``."""
_STATUS_PERIOD = 0.25
"""s between two messages about the time of a simulator."""


class GraphBackend(GraphObserver):
    """
    Runs on the server's thread, except for the callbacks of :class:`GraphObserver`.

    :attr:`server` must be set before the server starts. ``log_error`` logs a line about an
    exception that is a bug.
    """

    server: Server

    def __init__(self, node: Node, executor: Executor, log_error: Callable[[str], object]) -> None:
        self._node = node
        self._executor = executor
        self._log_error = log_error
        self._services = ServiceClients(node)
        self._states = StateAssembler()
        self._monitor = GraphMonitor(node, self._states, self._services)
        self._monitor.observer = self
        self._simulators: dict[str, SimulatorClient] = {}
        self._diagnostics = LatestDiagnostics()
        self._refresher: asyncio.Task[None] | None = None
        self._tasks: set[asyncio.Task[None]] = set()
        self._status_due = 0.0
        self._session_count = 0
        self._session = 0
        """From the first page's connection to the last one's end; 0: no pages."""
        self._watched: tuple[AbstractSet[Part], AbstractSet[str]] = (frozenset(), frozenset())
        self._infos: tuple[RobotInfo, ...] = ()
        self._sensors: tuple[SensorInfo, ...] = ()

    # --- called by the server --------------------------------------------------------------------

    def open(self) -> None:
        """Connect with the graph."""
        self._session_count += 1
        self._session = self._session_count
        self._executor.create_task(self._set_session)
        self._refresher = asyncio.create_task(self._refresh_periodically())

    def close(self) -> None:
        """Disconnect from the graph."""
        self._session = 0
        self._executor.create_task(self._set_session)
        if self._refresher is not None:
            self._refresher.cancel()

    def watch(self, parts: AbstractSet[Part], topics: AbstractSet[str]) -> None:
        """Collect these parts of states, and hear these sensors, and nothing else of the kind."""
        self._watched = parts, topics
        self._executor.create_task(self._set_watched)

    def take_state(self) -> tuple[Sequence[ServerMessage], bytes | None]:
        """Return what is new: messages, then a state."""
        messages, state = self._states.take()
        now = time.monotonic()
        if now >= self._status_due:
            self._status_due = now + _STATUS_PERIOD
            messages = [*messages, *self._statuses()]
        return messages, state

    def take_samples(self, wanted: AbstractSet[str]) -> Sequence[Sample]:
        """Return new samples of these topics."""
        return self._monitor.sensors.take(wanted)

    def robots(self) -> Sequence[str]:
        """Return the robots that take velocity commands."""
        return [name for name, each in self._monitor.connections.items() if each.found.command]

    def drive(self, robot: str, linear: float, angular: float, sideways: float = 0.0) -> None:
        """Publish one command."""
        self._connection(robot).drive(linear, angular, sideways, self._now())

    def set_joints(self, robot: str, positions: Mapping[str, float]) -> None:
        """Move joints by joint_state_publisher, else by controllers."""
        self._connection(robot).set_joints(positions, self._now())

    def hold_joints(self, robot: str | None) -> None:
        """Stop the joints that pages have moved by controllers."""
        for name, each in self._monitor.connections.items():
            if robot in (None, name):
                each.commands.hold(each.topics.positions())

    async def handle(self, request: Request) -> str:
        """Carry out a request."""
        if isinstance(request, Switch):
            manager = self._connection(request.robot).found.manager
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
            done = await simulator.handle(request)
        finally:
            self._start(self._refresh(simulator))
        return f'{done}{await self._set_up(request)}' if isinstance(request, Spawn) else done

    async def _set_up(self, request: Spawn) -> str:
        """Give a spawned robot the description and the active controllers of the other one."""
        like, robot = self._connection(request.like), f'/{request.namespace.strip("/")}'
        self._executor.create_task(
            self._monitor.set_description, robot, self._description_of(request.like)
        )
        if like.found.manager is None:
            return ''
        manager = robot.rstrip('/') + like.found.manager.removeprefix(like.found.id.rstrip('/'))
        try:
            names = await activate_same_controllers(self._services, like.found.manager, manager)
        except ViewerError as error:
            return f', but its controllers are not active: {error}'
        return f'; active: {", ".join(names) or "no controllers"}'

    def mesh(self, name: str) -> Path | bytes | None:
        """Return a file that a description names, or its converted data."""
        for each in self._monitor.connections.values():
            if each.described is not None and name in each.described.files:
                return each.described.files[name]
        return None

    # --- on the ROS thread -----------------------------------------------------------------------

    def _set_session(self) -> None:
        """Pass on the present session: rclpy runs tasks in any order."""
        self._monitor.set_session(self._session)

    def _set_watched(self) -> None:
        """Pass on what is watched at present, for the same reason."""
        self._monitor.watch(*self._watched)

    def _set_groups(self, connection: RobotConnection, groups: Sequence[ControllerJoints]) -> None:
        """Advertise what moves joints, unless the robot has gone in the meantime."""
        if connection in self._monitor.connections.values():
            connection.commands.set_groups(groups)

    def disconnect(self) -> None:
        """Disconnect from the graph, after the server has ended; the last stops have arrived."""
        self._monitor.set_session(0)

    def graph_changed(self) -> None:
        """Publish the graph."""
        connections, found = self._monitor.connections, self._monitor.found
        simulators = [each.id for each in found.simulators]
        infos = tuple(each.info for each in connections.values())
        self.server.call(lambda: self._set_simulators(simulators))
        self.server.retain([*connections, *simulators])
        self.server.call(lambda: self._publish_graph(infos, found.sensors))
        for name, each in connections.items():
            if each.found.manager:
                self.controllers_changed(name)

    def description_changed(self, connection: RobotConnection) -> None:
        """Publish the description."""
        if connection.described is not None:
            self.server.publish(connection.found.id, connection.described.message)

    def controllers_changed(self, robot: str) -> None:
        """List the controllers anew."""
        self.server.call(lambda: self._list_controllers(robot))

    def world_received(self, simulator: str, message: MarkerArray) -> None:
        """Publish the shapes of the world."""
        self.server.publish(simulator, World(simulator, shapes_of(message)))

    def diagnostics_received(self, message: DiagnosticArray) -> None:
        """Publish the diagnostics of each robot."""
        for each in self._diagnostics.update(message, [*self._monitor.connections]):
            self.server.publish(each.robot, each)

    # --- on the server's thread ------------------------------------------------------------------

    def _set_simulators(self, names: Sequence[str]) -> None:
        before = self._simulators
        self._simulators = {
            name: before.get(name) or SimulatorClient(name, self._services, self._description_of)
            for name in names
        }
        for name, simulator in self._simulators.items():
            if name not in before:
                self._start(self._refresh(simulator))

    def _publish_graph(
        self, robots: tuple[RobotInfo, ...], sensors: tuple[SensorInfo, ...]
    ) -> None:
        self._infos, self._sensors = robots, sensors
        simulators = tuple(each.info for each in self._simulators.values())
        hint = None if robots else self._hint()
        self.server.publish_now('', Graph(robots, simulators, hint, sensors))

    def _hint(self) -> str:
        return (
            'nothing publishes /robot_description in ROS domain '
            f'{self._node.context.get_domain_id()}; start a robot, such as: ros2 launch '
            'amr_description simulation'
        )

    def _statuses(self) -> list[SimulationStatus]:
        sources = self._states.sources
        if sources is None:
            return []
        return [
            SimulationStatus(
                simulator=name,
                state=simulator.state,  # type: ignore[arg-type]
                time=(sources.clock.time or 0) / NANOSECONDS,
                factor=simulator.factor,
                real_factor=sources.clock.factor,
            )
            for name, simulator in self._simulators.items()
        ]

    def _connection(self, robot: str) -> RobotConnection:
        connection = self._monitor.connections.get(robot)
        if connection is None:
            known = ', '.join(self._monitor.connections) or 'none'
            raise ViewerError(f'there is no robot {robot!a}; there are: {known}')
        return connection

    def _description_of(self, robot: str) -> str:
        described = self._connection(robot).described
        if described is None:
            raise ViewerError(f'the description of {robot} has not come yet')
        return described.message.urdf

    def _now(self) -> int:
        """Return ROS time, ns: that of /clock if it is published, else the node's."""
        sources = self._states.sources
        if sources is not None:
            sources.clock.poll()
            if sources.clock.time is not None:
                return sources.clock.time
        return self._node.get_clock().now().nanoseconds

    def _list_controllers(self, robot: str) -> None:
        async def list_them() -> None:
            connection = self._monitor.connections.get(robot)
            if connection is not None and connection.found.manager is not None:
                manager = connection.found.manager
                controllers = await list_controllers(self._services, manager, robot)
                groups = joint_groups(controllers.controllers, connection.found.joint_commands)
                self._executor.create_task(self._set_groups, connection, groups)
                self.server.publish_now(robot, with_moves(controllers, groups))

        self._start(list_them())

    async def _refresh(self, simulator: SimulatorClient) -> None:
        before = simulator.info
        await simulator.refresh()
        if simulator.info != before:
            self._publish_graph(self._infos, self._sensors)

    async def _refresh_periodically(self) -> None:
        while True:
            await asyncio.sleep(_REFRESH_PERIOD)
            for simulator in self._simulators.values():
                self._start(self._refresh(simulator))
            for name, each in self._monitor.connections.items():
                if each.found.activity is None and each.found.manager is not None:
                    self._list_controllers(name)

    def _start(self, work: Coroutine[Any, Any, None]) -> None:
        """Start a task; services that do not answer are called again later."""

        async def run() -> None:
            try:
                await work
            except AmrError:
                pass  # the server of the service is starting or ending
            except Exception as error:
                self._log_error(f'{type(error).__name__}: {error}')

        task = asyncio.get_running_loop().create_task(run())
        self._tasks.add(task)
        task.add_done_callback(self._tasks.discard)
