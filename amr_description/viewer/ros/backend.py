# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""The robots of the ROS graph as the backend of the page's server (viewer/backend.py)."""

import asyncio
from collections.abc import Callable, Coroutine, Mapping, Sequence, Set as AbstractSet
from dataclasses import replace
from pathlib import Path
import time
from typing import Any, TypeAlias

from diagnostic_msgs.msg import DiagnosticArray
from rclpy.executors import Executor
from rclpy.node import Node
from visualization_msgs.msg import MarkerArray

from amr_description.clock import NANOSECONDS
from amr_description.errors import AmrError, PartlyDoneError, ViewerError
from amr_description.model.frames import Vector
from amr_description.viewer.backend import Answer, Hold, Watched
from amr_description.viewer.bags import BAG_REQUESTS
from amr_description.viewer.joint_groups import ControllerJoints, joint_groups, with_moves
from amr_description.viewer.protocol import (
    Channel,
    ControllerInfo,
    Graph,
    Notice,
    RobotInfo,
    SensorInfo,
    ServerMessage,
    SimulationStatus,
    World,
)
from amr_description.viewer.requests import (
    CancelGoal,
    DeactivateDrive,
    Definition,
    ListParameters,
    LoadWorld,
    Part,
    Publish,
    Request,
    SetGoal,
    SetInitialPose,
    SetParameter,
    SetUp,
    SimulatorRequest,
    Spawn,
    Switch,
    Unpublish,
)
from amr_description.viewer.ros.command_topic import DEFAULT_TIMEOUT
from amr_description.viewer.ros.goals import Goals
from amr_description.viewer.ros.graph_monitor import GraphMonitor, GraphObserver
from amr_description.viewer.ros.introspection import GraphMessage
from amr_description.viewer.ros.markers import LatestDiagnostics, shapes_of
from amr_description.viewer.ros.page_recorder import PageRecorder
from amr_description.viewer.ros.parameters import ParameterClients
from amr_description.viewer.ros.publications import fields_of_type, Publications
from amr_description.viewer.ros.robot import commanders_of, RobotConnection, still_held
from amr_description.viewer.ros.service_clients import (
    command_timeout,
    list_controllers,
    ServiceClients,
    SimulatorClient,
    switch_controllers,
)
from amr_description.viewer.ros.setting_up import set_up
from amr_description.viewer.ros.spawned_robots import SpawnedRobots
from amr_description.viewer.ros.states import StateAssembler
from amr_description.viewer.ros.world_change import change_world, residents_of
from amr_description.viewer.samples import Sample
from amr_description.viewer.server import Server

_NEVER_EXPIRING = 'amr_description/Gazebo'
"""What types of controllers begin with whose commands are in force until the next one."""
_REFRESH_PERIOD = 1.0
"""s between two queries of a simulator, or of a controller manager without ``~/activity``."""
_STATUS_PERIOD = 0.25
"""s between two messages about the time of a simulator."""

_Controllers: TypeAlias = Mapping[str, Sequence[ControllerInfo]]
"""The last known ones, by the robot."""


class GraphBackend(GraphObserver):
    """
    Runs on the server's thread, except for the callbacks of :class:`GraphObserver`.

    :attr:`server` must be set before the server starts.

    Args:
        node: of the viewer.
        executor: that spins it.
        log_error: logs a line about an exception that is a bug.
        publish_description: returns a node that publishes a description and the transforms of its
            links in a namespace, ``(namespace, urdf)``; for robots that nobody else describes.
            Raises AmrError.
        bags: the folder in which pages have bags recorded.
    """

    server: Server

    def __init__(
        self,
        node: Node,
        executor: Executor,
        log_error: Callable[[str], object],
        publish_description: Callable[[str, str], Node],
        bags: Path,
    ) -> None:
        self._node = node
        self._executor = executor
        self._log_error = log_error
        self._spawned = SpawnedRobots(executor, publish_description, log_error)
        self._services = ServiceClients(node)
        self._states = StateAssembler()
        self._monitor = GraphMonitor(node, self._states, self._services)
        self._monitor.observer = self
        self._parameters = ParameterClients(self._services, executor)
        log = node.get_logger().info
        self._publications = Publications(node, executor, self._refusal, self._now, log)
        self._goals = Goals(
            node,
            executor,
            lambda each: self.server.publish_now(each.robot, each),
            lambda call: self.server.call(call),
        )
        self._recorder = PageRecorder(
            node, executor, bags, lambda each: self.server.publish('', each)
        )
        self._simulators: dict[str, SimulatorClient] = {}
        self._diagnostics = LatestDiagnostics()
        self._refresher: asyncio.Task[None] | None = None
        self._tasks: set[asyncio.Task[None]] = set()
        self._status_due = 0.0
        self._session_count = 0
        self._session = 0
        """From the first page's connection to the last one's end; 0: no pages."""
        self._watched = Watched()
        self._held: frozenset[str] = frozenset()
        """The robots that are held at rest."""
        self._controllers: dict[str, tuple[ControllerInfo, ...]] = {}
        self._infos: tuple[RobotInfo, ...] = ()
        self._sensors: tuple[SensorInfo, ...] = ()

    # --- called by the server --------------------------------------------------------------------

    def open(self) -> None:
        """Connect with the graph."""
        self._session_count += 1
        self._session = self._session_count
        self._executor.create_task(self._set_session)
        self.server.publish_now('', self._recorder.status_now())
        self._refresher = asyncio.create_task(self._refresh_periodically())

    def close(self) -> None:
        """Disconnect from the graph."""
        self._session = 0
        self._executor.create_task(self._set_session)
        if self._refresher is not None:
            self._refresher.cancel()

    def watch(self, watched: Watched) -> None:
        """Collect these parts of states, and hear these topics, and nothing else of the kind."""
        self._watched = watched
        self._executor.create_task(self._set_watched)

    def take_state(self) -> tuple[Sequence[ServerMessage], bytes | None]:
        """Return what is new: messages, then a state."""
        messages, state = self._states.take()
        now = time.monotonic()
        if now >= self._status_due:
            self._status_due = now + _STATUS_PERIOD
            messages = [
                *messages,
                *self._statuses(),
                *commanders_of(self._monitor.connections, now),
            ]
            if (ages := self._states.ages()) is not None:
                messages.append(ages)
        return messages, state

    def take_samples(self, wanted: AbstractSet[tuple[Channel, str]]) -> Sequence[Sample]:
        """Return new samples of these channels, and of plotted values."""
        return self._monitor.topics.take(wanted)

    def robots(self) -> Sequence[str]:
        """Return the robots that take velocity commands."""
        return [name for name, each in self._monitor.connections.items() if each.found.command]

    def known(self) -> Sequence[str]:
        """Return all robots."""
        return [*self._monitor.connections]

    def hold(self, robots: AbstractSet[str]) -> Mapping[str, Hold]:
        """Hold these robots at rest, and release the others."""
        connections, before, self._held = self._monitor.connections, self._held, frozenset(robots)
        for name in before - self._held:
            if name in connections:
                connections[name].release()
                self._activate_again(connections[name])
        stamp, now = self._now(), time.monotonic()
        held = {name: connections[name].hold(stamp, now) for name in robots if name in connections}
        if self._held != before:
            self._executor.create_task(self._set_held)
            self._goals.stop(self._held - before)
        return {
            name: replace(each, controllers=self._drive_controllers(connections[name]))
            for name, each in held.items()
        }

    def drive(self, robot: str, linear: float, angular: float, sideways: float = 0.0) -> None:
        """Publish one command."""
        self._connection(robot).drive(linear, angular, sideways, self._now())

    def push(self, simulator: str, entity: str, link: str, force: Vector, torque: Vector) -> None:
        """Push a link; no force and no torque: let go."""
        pushing = self._monitor.pushing.get(simulator)
        if pushing is None:
            raise ViewerError(f'{simulator} does not hear ~/wrench, so that nothing can be pushed')
        pushing.push(entity, link, force, torque)

    def set_joints(self, robot: str, positions: Mapping[str, float]) -> None:
        """Move joints by joint_state_publisher, else by controllers."""
        self._connection(robot).set_joints(positions, self._now())

    def hold_joints(self, robot: str | None) -> None:
        """Stop the joints that pages have moved by controllers."""
        for name, each in self._monitor.connections.items():
            if robot in (None, name):
                each.commands.hold(each.topics.positions())

    async def handle(self, request: Request, page: str) -> Answer:
        """Carry out a request of a page."""
        if isinstance(request, BAG_REQUESTS):
            return Answer(await self._recorder.handle(request))
        match request:
            case Definition():
                return Answer(request.message, fields_of_type(request.message))
            case Publish():
                return Answer(await self._publications.publish(page, request))
            case Unpublish():
                return Answer(self._publications.unpublish(page, request.topic))
            case ListParameters():
                parameters = await self._parameters.all_of(request.node)
                return Answer(f'{request.node} has {len(parameters)} parameters', parameters)
            case SetParameter():
                found = await self._parameters.set(request)
                return Answer(f'{request.node} has taken {request.name}', found)
            case SetGoal(robot=robot):
                if robot in self._held:
                    raise ViewerError(f'{robot} is stopped: it takes no goal until it is released')
                return Answer(await self._goals.set_goal(request, page, self._now()))
            case CancelGoal():
                return Answer(await self._goals.cancel(request.robot))
            case SetInitialPose():
                return Answer(self._goals.set_initial_pose(request, self._now()))
            case DeactivateDrive():
                return Answer(await self._deactivate_drive(self._connection(request.robot)))
            case _:
                return Answer(await self._simulate(request))

    def forget(self, page: str) -> None:
        """End what a page published."""
        self._publications.forget(page)

    def latest(self, part: Part) -> ServerMessage | None:
        """Return what is known of a part that is not of the states."""
        return self._monitor.introspection.latest(part)

    def _refusal(self, topic: str) -> str | None:
        """Return why pages must not publish on a topic by forms; None: they may."""
        for name in self._held:
            each = self._monitor.connections.get(name)
            if each is not None and each.found.command and each.found.command.topic == topic:
                return f'{name} is stopped: nothing is published on {topic} until it is released'
        return None

    async def _simulate(self, request: SimulatorRequest | SetUp | Switch) -> str:
        """Have controllers switched, or a simulator do something; return what was done."""
        if isinstance(request, SetUp):
            return await self._set_up(request.robot, request.like, self._controllers)
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
        before = dict(self._controllers)  # a robot in the place of another one begins without any
        try:
            if isinstance(request, LoadWorld):
                spawned = self._monitor.entities.spawned.get(simulator.name, ())
                connections = self._monitor.connections
                residents = residents_of(simulator.name, spawned, self._infos, connections)
                return await change_world(self._services, simulator, residents, request)
            done = await simulator.handle(request)
        finally:
            self._start(self._refresh(simulator))
        return (
            await self._spawned_by(request, done, before) if isinstance(request, Spawn) else done
        )

    async def _spawned_by(self, request: Spawn, done: str, known: _Controllers) -> str:
        """Give a spawned robot its description, and the active controllers of one it is like."""
        robot = f'/{request.namespace.strip("/")}'
        if robot not in self._monitor.connections:  # nobody publishes its description yet
            urdf = request.urdf if request.like is None else self._description_of(request.like)
            self._executor.create_task(self._spawned.add, robot, urdf)
        if request.like is None:
            return done
        try:
            active = await self._set_up(robot, request.like, known)
        except PartlyDoneError as error:
            raise PartlyDoneError(f'{done}, but {error}', error.again) from error
        return f'{done}; {active}' if active else done

    async def _set_up(self, robot: str, like: str, known: _Controllers) -> str:
        try:
            return await set_up(self._services, robot, self._connection(like), known.get(like))
        finally:
            self._list_controllers(robot)

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
        self._monitor.watch(self._watched)

    def _set_held(self) -> None:
        """Pass on what is held at present, for the same reason."""
        self._monitor.hold(self._held)

    def _set_groups(self, connection: RobotConnection, groups: Sequence[ControllerJoints]) -> None:
        """Advertise what moves joints, unless the robot has gone in the meantime."""
        if connection in self._monitor.connections.values():
            connection.commands.set_groups(groups)

    def disconnect(self) -> None:
        """
        Disconnect from the graph, after the server has ended; the last stops have arrived.

        What is held stays so: nobody may drive because this node has ended. A bag is completed.
        """
        self._recorder.end()
        for name in sorted(self._held & self._monitor.connections.keys()):
            connection = self._monitor.connections[name]
            if connection.is_locked or connection.deactivated:
                self._node.get_logger().warning(still_held(connection))
        self._monitor.set_session(0)
        self._spawned.retain(())

    def graph_changed(self) -> None:
        """Publish the graph."""
        connections, found = self._monitor.connections, self._monitor.found
        self._spawned.forget_deleted(found.robots)
        simulators = [each.id for each in found.simulators]
        infos = tuple(each.info for each in connections.values())
        self.server.call(lambda: self._set_simulators(simulators))
        self.server.retain([*connections, *simulators])
        self._goals.find(found.navigators, found.tf_namespaces)
        self.server.call(lambda: self._publish_graph(infos, found.sensors))
        for name, each in connections.items():
            if each.found.manager:
                self.controllers_changed(name)
        if self._held:
            self._executor.create_task(self._set_held)

    def graph_polled(self) -> None:
        """Describe the robots of worlds that nobody describes."""
        spawned = [each for all in self._monitor.entities.spawned.values() for each in all]
        self._spawned.look(spawned, self._monitor.found.robots, time.monotonic())

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
        self.server.call(lambda: self._ask_for_world(simulator))

    def diagnostics_received(self, message: DiagnosticArray) -> None:
        """Publish the diagnostics of each robot."""
        present = [each.id for each in self._monitor.found.robots if each.is_present]
        for each in self._diagnostics.update(message, present):
            self.server.publish(each.robot, each)

    def graph_shown(self, part: Part, message: GraphMessage) -> None:
        """Send news of the graph to the pages that show them."""
        self.server.send_to(part, message)

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
        silent = {
            each.id: self._simulators[each.id].entities
            for each in self._monitor.found.simulators
            if each.id in self._simulators and not each.hears_wrenches
        }
        entity_of = self._monitor.entities.entity_of
        robots = tuple(
            replace(each, entity=entity_of(each.id, self._urdf_of(each.id), silent))
            for each in robots
        )
        self._infos, self._sensors = robots, sensors
        simulators = tuple(each.info for each in self._simulators.values())
        hint = None if robots else self._hint()
        navigators = self._goals.navigators
        self.server.publish_now('', Graph(robots, simulators, hint, sensors, navigators))

    def _hint(self) -> str:
        return (
            'nothing publishes /robot_description in ROS domain '
            f'{self._node.context.get_domain_id()}; start a robot, such as: `ros2 '
            'launch amr_description simulation`'
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

    def _urdf_of(self, robot: str) -> str | None:
        connection = self._monitor.connections.get(robot)  # None: it has gone meanwhile
        described = None if connection is None else connection.described
        return None if described is None else described.message.urdf

    def _description_of(self, robot: str) -> str:
        self._connection(robot)  # raises: it is not known
        if (urdf := self._urdf_of(robot)) is None:
            raise ViewerError(f'the description of {robot} has not come yet')
        return urdf

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
                self._controllers[robot] = controllers.controllers
                self._executor.create_task(self._set_groups, connection, groups)
                self.server.publish_now(robot, with_moves(controllers, groups))
                if connection.timeout is None and connection.found.drive_parameters:
                    await self._find_timeout(connection, connection.found.drive_parameters)

        self._start(list_them())

    async def _find_timeout(self, connection: RobotConnection, service: str) -> None:
        """Have the commands of a robot expire when its controller has them expire."""
        kinds = [
            each.kind
            for each in self._controllers.get(connection.found.id, ())
            if each.name == service.split('/')[-2]
        ]
        if any(kind.startswith(_NEVER_EXPIRING) for kind in kinds):
            connection.set_timeout(0.0)
            return
        timeout = await command_timeout(self._services, service)
        connection.set_timeout(timeout or DEFAULT_TIMEOUT)

    def _drive_controllers(self, connection: RobotConnection) -> tuple[str, ...]:
        """Return the active controllers that take the commands of a robot."""
        nodes = {each.rpartition('/')[2] for each in connection.drives}
        listed = self._controllers.get(connection.found.id, ())
        return tuple(each.name for each in listed if each.state == 'active' and each.name in nodes)

    async def _deactivate_drive(self, connection: RobotConnection) -> str:
        robot, manager = connection.found.id, connection.found.manager
        names = self._drive_controllers(connection)
        if robot not in self._held:
            raise ViewerError(f'{robot} is not stopped; press STOP first')
        if manager is None or not names:
            raise ViewerError(f'no active controller of a controller manager drives {robot}')
        try:
            done = await switch_controllers(self._services, manager, Switch(0, robot, (), names))
        finally:
            self._list_controllers(robot)
        connection.deactivated = (*connection.deactivated, *names)
        if robot not in self._held:  # it was released in the meantime
            self._activate_again(connection)
        return f'{done} until {robot} is released'

    def _activate_again(self, connection: RobotConnection) -> None:
        """Activate what was deactivated to stop a robot, and say so if that fails."""
        robot, manager, names = (
            connection.found.id,
            connection.found.manager,
            connection.deactivated,
        )
        connection.deactivated = ()
        if manager is None or not names:
            return

        async def activate() -> None:
            try:
                await switch_controllers(self._services, manager, Switch(0, robot, names, ()))
            except ViewerError as error:
                text = f'{", ".join(names)} of {robot} stays inactive: {error}'
                self.server.send_now(Notice('error', text))
            finally:
                self._list_controllers(robot)

        self._start(activate())

    def _ask_for_world(self, simulator: str) -> None:
        if (client := self._simulators.get(simulator)) is not None:
            client.has_new_world = True
            self._start(self._refresh(client))

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
