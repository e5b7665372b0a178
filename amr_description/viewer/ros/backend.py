# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
The robots of the ROS graph as the backend of the page's server (viewer/backend.py).

All of it is for the server's thread. It has of the graph what ``threads.py`` lets it have; what it
has done on the ROS thread, and is told from there, is in ``ros_side.py``.
"""

import asyncio
from collections.abc import (
    AsyncIterator,
    Callable,
    Coroutine,
    Mapping,
    Sequence,
    Set as AbstractSet,
)
from contextlib import asynccontextmanager
from dataclasses import replace
from functools import partial
from pathlib import Path
import time
from typing import Any, NoReturn, TypeAlias

from rclpy.executors import Executor
from rclpy.node import Node

from amr_description.clock import NANOSECONDS
from amr_description.errors import AmrError, PartlyDoneError, ViewerError
from amr_description.model.fixing import fixed_to_world
from amr_description.model.frames import Vector
from amr_description.viewer.backend import Answer, Handlers, Hold, Watched
from amr_description.viewer.bags import StartRecording, StopRecording
from amr_description.viewer.entities import entity_among
from amr_description.viewer.forms import CallService, CancelSent, SendGoal
from amr_description.viewer.joint_groups import joint_groups, with_moves
from amr_description.viewer.protocol import (
    Channel,
    ControllerInfo,
    Graph,
    Notice,
    RobotInfo,
    SensorInfo,
    ServerMessage,
    SimulationStatus,
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
from amr_description.viewer.ros.calls import FormCalls
from amr_description.viewer.ros.command_topic import DEFAULT_TIMEOUT
from amr_description.viewer.ros.forms import define
from amr_description.viewer.ros.goals import Goals
from amr_description.viewer.ros.graph_monitor import GraphMonitor
from amr_description.viewer.ros.page_recorder import PageRecorder
from amr_description.viewer.ros.parameters import ParameterClients
from amr_description.viewer.ros.publications import Publications
from amr_description.viewer.ros.ros_side import GraphReporter, RosCalls
from amr_description.viewer.ros.service_clients import (
    command_timeout,
    list_controllers,
    ServiceClients,
    SIMULATOR_REQUESTS,
    SimulatorClient,
    switch_controllers,
)
from amr_description.viewer.ros.setting_up import set_up
from amr_description.viewer.ros.spawned_robots import SpawnedRobots
from amr_description.viewer.ros.states import StateAssembler
from amr_description.viewer.ros.threads import GraphView, ServedRobot
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


class GraphBackend:
    """
    See the module.

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
        self._log_error = log_error
        self._services = ServiceClients(node)
        self._states = StateAssembler()
        self._parameters = ParameterClients(self._services, executor)
        log = node.get_logger().info
        self._publications = Publications(node, executor, self._refusal, self._now, log)
        self._goals = Goals(
            node,
            executor,
            lambda each: self.server.pages.publish(each.robot, each),
            lambda call: self.server.call(call),
        )
        self._calls = FormCalls(
            node,
            executor,
            self._goal_refusal,
            self._now,
            lambda page, progress: self.server.pages.tell(page, progress),
            lambda call: self.server.call(call),
        )
        self._recorder = PageRecorder(
            node,
            executor,
            bags,
            lambda each: self.server.call(lambda: self.server.pages.publish('', each)),
        )
        monitor = GraphMonitor(node, self._states, self._services)
        spawned = SpawnedRobots(executor, publish_description, log_error)
        monitor.observer = GraphReporter(monitor, self, self._goals, spawned)
        self._graph: GraphView = monitor
        self._ros = RosCalls(executor, monitor, spawned)
        self._simulators: dict[str, SimulatorClient] = {}
        self._refresher: asyncio.Task[None] | None = None
        self._tasks: set[asyncio.Task[None]] = set()
        self._status_due = 0.0
        self._controllers: dict[str, tuple[ControllerInfo, ...]] = {}
        self._infos: tuple[RobotInfo, ...] = ()
        self._sensors: tuple[SensorInfo, ...] = ()
        self.handlers = self._make_handlers()

    def disconnect(self) -> None:
        """
        Disconnect from the graph, on the ROS thread, after the server has ended.

        The last stops have arrived. What is held stays so: nobody may drive because this node has
        ended. A bag is completed.
        """
        self._recorder.end()
        self._ros.disconnect(self._node.get_logger().warning)

    # --- called by the server --------------------------------------------------------------------

    def open(self) -> None:
        """Connect with the graph."""
        self._ros.open()
        self.server.pages.publish('', self._recorder.status_now())
        self._refresher = asyncio.create_task(self._refresh_periodically())

    def close(self) -> None:
        """Disconnect from the graph."""
        self._ros.close()
        if self._refresher is not None:
            self._refresher.cancel()

    def watch(self, watched: Watched) -> None:
        """Collect these parts of states, subscribe to these topics, and to nothing else."""
        self._ros.watch(watched)

    def take_state(self) -> tuple[Sequence[ServerMessage], bytes | None]:
        """Return what is new: messages, then a state."""
        messages, state = self._states.take()
        now = time.monotonic()
        if now >= self._status_due:
            self._status_due = now + _STATUS_PERIOD
            commanders = [each.commanded_by(now) for each in self._robots.values()]
            messages = [*messages, *self._statuses(), *commanders]
            if (ages := self._states.ages()) is not None:
                messages.append(ages)
        return messages, state

    def take_samples(self, wanted: AbstractSet[tuple[Channel, str]]) -> Sequence[Sample]:
        """Return new samples of these channels, and of plotted values."""
        return self._graph.take_samples(wanted)

    def robots(self) -> Sequence[str]:
        """Return the robots that take velocity commands."""
        return [name for name, each in self._robots.items() if each.found.command]

    def known(self) -> Sequence[str]:
        """Return all robots."""
        return [*self._robots]

    def hold(self, robots: AbstractSet[str]) -> Mapping[str, Hold]:
        """Hold these robots at rest, and release the others."""
        known, before = self._robots, self._ros.held
        if robots != before:
            self._ros.hold(robots)
            self._goals.stop(robots - before)
            self._calls.stop()
        for name in (before - robots) & known.keys():
            known[name].release()
            self._activate_again(known[name])
        stamp, now = self._now(), time.monotonic()
        held = {name: known[name].hold(stamp, now) for name in robots if name in known}
        return {
            name: replace(each, controllers=self._drive_controllers(known[name]))
            for name, each in held.items()
        }

    def drive(self, robot: str, linear: float, angular: float, sideways: float = 0.0) -> None:
        """Publish one command."""
        self._connection(robot).drive(linear, angular, sideways, self._now())

    def push(self, simulator: str, entity: str, link: str, force: Vector, torque: Vector) -> None:
        """Push a link; no force and no torque: let go."""
        pusher = self._graph.snapshot.pushers.get(simulator)
        if pusher is None:
            raise ViewerError(f'{simulator} does not hear ~/wrench, so that nothing can be pushed')
        pusher.push(entity, link, force, torque)

    def set_joints(self, robot: str, positions: Mapping[str, float]) -> None:
        """Move joints by joint_state_publisher, else by controllers."""
        self._connection(robot).set_joints(positions, self._now())

    def hold_joints(self, robot: str | None) -> None:
        """Stop the joints that pages have moved by controllers."""
        for name, each in self._robots.items():
            if robot in (None, name):
                each.hold_joints()

    def forget(self, page: str) -> None:
        """End what a page published, and cancel the goals that it sent."""
        self._publications.forget(page)
        self._calls.forget(page)

    def latest(self, part: Part) -> ServerMessage | None:
        """Return what is known of a part that is not of the states."""
        return self._graph.latest(part)

    def _refusal(self, topic: str) -> str | None:
        """Return why pages must not publish on a topic by forms; None: they may."""
        for name in self._ros.held:
            each = self._robots.get(name)
            if each is not None and each.found.command and each.found.command.topic == topic:
                return f'{name} is stopped: nothing is published on {topic} until it is released'
        return None

    def _goal_refusal(self, action: str) -> str | None:
        """Return why pages must not send goals to an action by forms; None: they may."""
        owners = [each for each in self._robots if action.startswith(f'{each.rstrip("/")}/')]
        owner = max(owners, key=len, default=None)
        if owner in self._ros.held:
            return f'{owner} is stopped: no goal is sent to {action} until it is released'
        return None

    def _make_handlers(self) -> Handlers:
        """Return what carries out requests, each in one place."""
        handlers = Handlers(_refuse_bag_request)
        handlers.add(Definition, define)
        handlers.add(Publish, self._publications.publish)
        handlers.add(Unpublish, self._publications.unpublish)
        handlers.add(CallService, self._calls.call_service)
        handlers.add(SendGoal, self._calls.send_goal)
        handlers.add(CancelSent, self._calls.cancel)
        handlers.add(ListParameters, self._parameters.list_all)
        handlers.add(SetParameter, self._parameters.set)
        handlers.add(SetGoal, self._set_goal)
        handlers.add(CancelGoal, self._goals.cancel)
        handlers.add(SetInitialPose, self._set_initial_pose)
        handlers.add(StartRecording, self._recorder.start)
        handlers.add(StopRecording, self._recorder.stop)
        handlers.add(Switch, self._switch)
        handlers.add(DeactivateDrive, self._deactivate_drive)
        handlers.add(SetUp, self._set_up_asked)
        handlers.add(Spawn, self._spawn)
        handlers.add(LoadWorld, self._load_world)
        for kind in SIMULATOR_REQUESTS:
            handlers.add(kind, self._simulate)
        return handlers

    async def _set_goal(self, request: SetGoal, page: str) -> str:
        robot = request.robot
        if robot in self._ros.held:
            raise ViewerError(f'{robot} is stopped: it takes no goal until it is released')
        return await self._goals.set_goal(request, page, self._now())

    async def _set_initial_pose(self, request: SetInitialPose, _: str) -> str:
        return self._goals.set_initial_pose(request, self._now())

    async def _switch(self, request: Switch, _: str) -> str:
        manager = self._connection(request.robot).found.manager
        if manager is None:
            raise ViewerError(f'{request.robot} has no controller manager')
        try:
            return await switch_controllers(self._services, manager, request)
        finally:
            self.list_controllers(request.robot)

    async def _set_up_asked(self, request: SetUp, _: str) -> str:
        return await self._set_up(request.robot, request.like, self._controllers)

    @asynccontextmanager
    async def _simulator(self, name: str) -> AsyncIterator[SimulatorClient]:
        """Yield a simulator, which is asked afterwards how it is. Raises ViewerError."""
        simulator = self._simulators.get(name)
        if simulator is None:
            known = ', '.join(self._simulators) or 'none'
            raise ViewerError(f'there is no simulator {name!a}; there are: {known}')
        try:
            yield simulator
        finally:
            self._start(self._refresh(simulator))

    async def _simulate(self, request: SimulatorRequest, _: str) -> Answer | str:
        async with self._simulator(request.simulator) as simulator:
            return await SIMULATOR_REQUESTS[type(request)](simulator, request)

    async def _load_world(self, request: LoadWorld, _: str) -> str:
        async with self._simulator(request.simulator) as simulator:
            spawned = self._graph.snapshot.spawned.get(simulator.name, ())
            residents = residents_of(simulator.name, spawned, self._infos, self._robots)
            return await change_world(self._services, simulator, residents, request)

    async def _spawn(self, request: Spawn, _: str) -> str:
        before = dict(self._controllers)  # a robot in the place of another one begins without any
        if request.fixed:
            urdf = request.urdf or self._description_of(request.like or '')
            request = replace(request, urdf=fixed_to_world(urdf))
        async with self._simulator(request.simulator) as simulator:
            done = await simulator.spawn_asked(request)
        return await self._spawned_by(request, done, before)

    async def _spawned_by(self, request: Spawn, done: str, known: _Controllers) -> str:
        """Give a spawned robot its description, and the active controllers of one it is like."""
        robot = f'/{request.namespace.strip("/")}'
        if robot not in self._robots:  # nobody publishes its description yet
            urdf = request.urdf or self._description_of(request.like or '')
            self._ros.describe(robot, urdf)
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
            self.list_controllers(robot)

    def mesh(self, name: str) -> Path | bytes | None:
        """Return a file that a description names, or its converted data."""
        for each in self._robots.values():
            if each.described is not None and name in each.described.files:
                return each.described.files[name]
        return self._graph.file(name)

    # --- called when the graph has changed -------------------------------------------------------

    def set_graph(
        self,
        robots: Sequence[RobotInfo],
        simulators: Sequence[str],
        sensors: Sequence[SensorInfo],
    ) -> None:
        """Publish what there is."""
        self._set_simulators(simulators)
        self._publish_graph(robots, sensors)

    def list_controllers(self, robot: str) -> None:
        """List the controllers of a robot anew, soon."""
        self._start(self._list_controllers(robot))

    def ask_for_world(self, simulator: str) -> None:
        """Ask a simulator which world it has."""
        if (client := self._simulators.get(simulator)) is not None:
            client.has_new_world = True
            self._start(self._refresh(client))

    # --- all the rest ----------------------------------------------------------------------------

    @property
    def _robots(self) -> Mapping[str, ServedRobot]:
        """Those of the graph, by their ids."""
        return self._graph.snapshot.robots

    def _set_simulators(self, names: Sequence[str]) -> None:
        before = self._simulators
        self._simulators = {
            name: before.get(name) or SimulatorClient(name, self._services, self._description_of)
            for name in names
        }
        for name, simulator in self._simulators.items():
            if name not in before:
                self._start(self._refresh(simulator))

    def _publish_graph(self, found: Sequence[RobotInfo], sensors: Sequence[SensorInfo]) -> None:
        snapshot = self._graph.snapshot
        silent = {
            each.id: self._simulators[each.id].entities
            for each in snapshot.found.simulators
            if each.id in self._simulators and not each.hears_wrenches
        }
        entities = partial(entity_among, snapshot.spawned, silent)
        self._infos = robots = tuple(
            replace(each, entity=entities(each.id, self._urdf_of(each.id))) for each in found
        )
        self._sensors = sensors = tuple(sensors)
        simulators = tuple(each.info for each in self._simulators.values())
        hint = None if robots else self._hint()
        navigators = self._goals.navigators
        self.server.pages.publish('', Graph(robots, simulators, hint, sensors, navigators))

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

    def _connection(self, robot: str) -> ServedRobot:
        connection = self._robots.get(robot)
        if connection is None:
            known = ', '.join(self._robots) or 'none'
            raise ViewerError(f'there is no robot {robot!a}; there are: {known}')
        return connection

    def _urdf_of(self, robot: str) -> str | None:
        connection = self._robots.get(robot)  # None: it has gone meanwhile
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

    async def _list_controllers(self, robot: str) -> None:
        connection = self._robots.get(robot)
        if connection is None or connection.found.manager is None:
            return
        controllers = await list_controllers(self._services, connection.found.manager, robot)
        groups = joint_groups(controllers.controllers, connection.found.joint_commands)
        self._controllers[robot] = controllers.controllers
        self._ros.set_groups(robot, groups)
        self.server.pages.publish(robot, with_moves(controllers, groups))
        if connection.timeout is None and connection.found.drive_parameters:
            await self._find_timeout(connection, connection.found.drive_parameters)

    async def _find_timeout(self, connection: ServedRobot, service: str) -> None:
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

    def _drive_controllers(self, connection: ServedRobot) -> tuple[str, ...]:
        """Return the active controllers that take the commands of a robot."""
        nodes = {each.rpartition('/')[2] for each in connection.drives}
        listed = self._controllers.get(connection.found.id, ())
        return tuple(each.name for each in listed if each.state == 'active' and each.name in nodes)

    async def _deactivate_drive(self, request: DeactivateDrive, _: str) -> str:
        connection = self._connection(request.robot)
        robot, manager = connection.found.id, connection.found.manager
        names = self._drive_controllers(connection)
        if robot not in self._ros.held:
            raise ViewerError(f'{robot} is not stopped; press STOP first')
        if manager is None or not names:
            raise ViewerError(f'no active controller of a controller manager drives {robot}')
        try:
            done = await switch_controllers(self._services, manager, Switch(0, robot, (), names))
        finally:
            self.list_controllers(robot)
        connection.deactivated = (*connection.deactivated, *names)
        if robot not in self._ros.held:  # it was released in the meantime
            self._activate_again(connection)
        return f'{done} until {robot} is released'

    def _activate_again(self, connection: ServedRobot) -> None:
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
                self.server.pages.send_message(Notice('error', text))
            finally:
                self.list_controllers(robot)

        self._start(activate())

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
            for name, each in self._robots.items():
                if each.found.activity is None and each.found.manager is not None:
                    self.list_controllers(name)

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


def _refuse_bag_request(_: Request) -> NoReturn:
    raise ViewerError('no bag is shown here; `viewer --bag PATH` shows one')
