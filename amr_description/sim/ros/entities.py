# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
The entities of the simulated world: robots are spawned and removed, with controller managers.

A robot whose URDF has a ``<ros2_control>`` block gets a controller manager of its own, in its
namespace.
"""

from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass
import enum
from pathlib import Path

from rclpy.executors import Executor
from rclpy.task import Future

from amr_description.clock import NANOSECONDS
from amr_description.control.contracts import Log, Severity
from amr_description.control.controller_manager import ControllerManager
from amr_description.control.plugin_errors import describe
from amr_description.control.ros.controller_manager_node import (
    ControllerManagerNode,
    PreparedManager,
    RunningManager,
)
from amr_description.control.ros.loop_thread import LoopContext
from amr_description.control.ros.robot_description import DescriptionSource
from amr_description.controllers.drive_files import drive_warnings
from amr_description.controllers.roller_files import rollers_of_controllers, rollers_of_plugins
from amr_description.errors import RequestError, SpawnError
from amr_description.model.controller_files import files_of, missing_files, named_files
from amr_description.model.frames import Transform
from amr_description.model.gazebo import ros2_control_host_of
from amr_description.model.gazebo_bridge import Bridge, bridged
from amr_description.model.gazebo_builder import GazeboTranslation
from amr_description.model.gazebo_translation import translate
from amr_description.model.hardware_info import HardwareInfo
from amr_description.model.robot import Robot
from amr_description.model.rollers import Rollers
from amr_description.model.ros2_control_tag import hardware_of
from amr_description.parameter_files import read_parameter_file
from amr_description.ros.runtime import argument_errors, ExecutorThread, run_in_thread
from amr_description.sim.engine import physics_stepping, steps_in
from amr_description.sim.robot_spec import WORLD_LINK
from amr_description.sim.ros.ground_truth import GroundTruth
from amr_description.sim.ros.plugin_controllers import (
    abandon,
    log_translation,
    run_in,
    start_controllers,
)
from amr_description.sim.ros.sensors.manager import SensorManager
from amr_description.sim.spawning import check_name, free_name, SpawnCode
from amr_description.sim.world import MujocoWorld
from amr_description.text import quote_all


class Category(enum.IntEnum):
    """The kind of an entity, as in ``simulation_interfaces/msg/EntityCategory``."""

    OBJECT = 0
    ROBOT = 1
    HUMAN = 2
    DYNAMIC_OBJECT = 4
    STATIC_OBJECT = 5


@dataclass(frozen=True, slots=True)
class EntityRecord:
    """What ``simulation_interfaces/msg/EntityInfo`` says of an entity; clients may set it."""

    category: Category
    description: str = ''
    tags: tuple[str, ...] = ()


@dataclass(frozen=True, slots=True)
class Spawned:
    """With what an entity was spawned."""

    robot: Robot
    namespace: str
    """Absolute."""
    pose: Transform


@dataclass(slots=True)
class Entity:
    """A robot in the world, completely spawned."""

    name: str
    info: EntityRecord
    manager: RunningManager | None
    """None: its URDF has no ``<ros2_control>`` block."""
    thread: ExecutorThread | None
    """Runs the callbacks of the manager, its components and controllers."""
    origin: Spawned | None = None


class EntityManager:
    """
    Spawns and removes entities.

    The coroutines run on the ROS thread and await the control thread.
    """

    def __init__(
        self,
        context: LoopContext,
        world: MujocoWorld,
        ground_truth: GroundTruth,
        sensors: SensorManager,
        *,
        executor: Executor,
        log: Log,
        controllers: str,
        bridge: Bridge,
        simulates_mocks: bool,
        lift: bool,
        ros_args: Sequence[str],
    ) -> None:
        """
        Manage the entities of a world that has none yet.

        Args:
            context: Of the control loop.
            world: The simulated world.
            ground_truth: Gets every entity.
            sensors: Gets the sensors of every entity.
            executor: Of the ROS thread.
            log: Of the simulator.
            controllers: Path of the managers' parameter file, or empty.
            bridge: What topics of Gazebo are called.
            simulates_mocks: Mock hardware is simulated; False: it stays a mock.
            lift: Whether a robot that would be inside the world is lifted until it is free.
            ros_args: ROS arguments for every manager and controller.
        """
        self._context = context
        self._loop_thread = context.loop_thread
        self._world = world
        self._ground_truth = ground_truth
        self._sensors = sensors
        self._executor = executor
        self._log = log
        self._controllers = controllers
        self._bridge = bridge
        self._simulates_mocks = simulates_mocks
        self._lift = lift
        self._ros_args = ros_args
        self.on_change: Callable[[], None] = lambda: None
        """Called when an entity was spawned, before its controllers start, or removed."""
        self._entities: dict[str, Entity] = {}
        self._starting: dict[str, Future] = {}
        """Of entities whose controllers are being started: done when they are."""
        self._namespaces: set[str] = set()
        """The namespaces that have a controller manager; used on the control thread only."""

    def __iter__(self) -> Iterator[Entity]:
        """Iterate over all entities, in the order in which they were spawned."""
        return iter(tuple(self._entities.values()))

    def find(self, name: str) -> Entity:
        """Return an entity by name. Raises RequestError, which lists the names that exist."""
        try:
            return self._entities[name]
        except KeyError:
            raise RequestError(
                f"there is no entity '{name}'; there are: {', '.join(self._entities) or 'none'}",
                SpawnCode.NOT_FOUND,
            ) from None

    async def spawn(
        self,
        name: str,
        robot: Robot,
        pose: Transform,
        namespace: str,
        *,
        allow_renaming: bool = False,
    ) -> str:
        """
        Put a robot into the world and start its controller manager, if it has hardware.

        Args:
            name: Of the entity.
            robot: Its description.
            pose: Transform from its root link to the world.
            namespace: Of the controller manager, absolute.
            allow_renaming: Use another name if this one is taken.

        Returns:
            The name of the entity.

        Raises:
            SpawnError, DescriptionError, HardwareError, ParameterError: or whatever the
                constructor of a third-party component raises; nothing is left of the robot then.
        """
        hardware = hardware_of(robot)
        translation = bridged(translate(robot), self._bridge)
        prepared = self._prepare(robot, hardware, namespace, translation) if hardware else None
        rollers: Mapping[str, Rollers] = {}
        if hardware:
            rollers = self._rollers_of(robot) | rollers_of_plugins(translation)

        def insert() -> tuple[str, ControllerManager | None]:
            given = free_name(name, self._world.names) if allow_renaming else name
            check_name(given, self._world.names)
            return given, self._insert(given, robot, pose, prepared, rollers)

        try:
            given, manager = await self._loop_thread.submit(insert)
        except Exception:
            if prepared is not None:
                prepared.destroy()
            raise
        running = thread = None
        log_translation(given, translation, namespace, self._log)
        if prepared is not None:
            running, thread = self._serve(prepared, manager, given)
        self._ground_truth.add(given, namespace)
        self._sensors.add(given, namespace, translation.sensors)
        self._add(given, Spawned(robot, namespace, pose), running, thread)
        if running is not None and thread is not None:
            starting = start_controllers(running, translation.controllers, self._log)
            self._starting[given] = started = run_in(thread.executor, starting, self._executor)
            await started
            if self._starting.get(given) is started:  # not removed meanwhile, and spawned again
                del self._starting[given]
        return given

    def _add(
        self,
        name: str,
        origin: Spawned,
        running: RunningManager | None,
        thread: ExecutorThread | None,
    ) -> None:
        record = EntityRecord(_category_of(origin.robot))
        self._entities[name] = Entity(name, record, running, thread, origin)
        self.on_change()

    async def remove(self, name: str) -> None:
        """
        Stop a robot's controller manager and remove the robot, so that its names are free again.

        Raises RequestError: there is no such entity, or it is already being removed.
        """
        self.find(name)
        entity = self._entities.pop(name)
        self._ground_truth.remove(name)
        self._sensors.remove(name)
        if entity.thread is not None:
            await run_in_thread(entity.thread.end, self._executor, f'end of {name}')
        if name in self._starting:  # who spawns it still waits for the thread that has ended
            abandon(self._starting.pop(name), self._executor)
        await self._loop_thread.submit(lambda: self._detach(entity))
        _destroy(entity)
        self.on_change()

    async def remove_all(self) -> int:
        """Remove all robots; return how many."""
        count = 0
        while self._entities:
            await self.remove(next(iter(self._entities)))
            count += 1
        return count

    def destroy(self) -> None:
        """Destroy all nodes, after the control thread has stopped."""
        threads = [each.thread for each in self._entities.values() if each.thread is not None]
        for thread in threads:
            thread.ask_to_end()  # all at once: each may have a callback to finish
        for thread in threads:
            thread.end()
        for entity in self._entities.values():
            _destroy(entity)

    def _serve(
        self, prepared: PreparedManager, manager: ControllerManager, name: str
    ) -> tuple[RunningManager, ExecutorThread]:
        """Create the services of a robot's manager, and the thread that runs their callbacks."""
        thread = ExecutorThread(name, self._loop_thread.fail)
        node, log = prepared.manager_node.node, prepared.manager_node.log
        thread.executor.add_node(node)
        DescriptionSource(node, log, robot=prepared.robot)
        running = prepared.serve(manager)
        thread.start()
        return running, thread

    # --- on the control thread ----------------------------------------------------------------

    def _insert(
        self,
        name: str,
        robot: Robot,
        pose: Transform,
        prepared: PreparedManager | None,
        rollers: Mapping[str, Rollers],
    ) -> ControllerManager | None:
        """Add robot, components (all of them active) and manager, between two cycles."""
        loop, world = self._loop_thread.loop, self._world
        if prepared is None:
            world.spawn(name, robot, pose, lift=self._lift)
            return None
        namespace = prepared.manager_node.node.get_namespace()
        rate = prepared.manager_node.parameters.update_rate
        self._check_namespace(namespace)
        if not loop.managers:
            world.timestep = physics_stepping(_period_of(rate), world.longest_step).step
        view = world.spawn(name, robot, pose, lift=self._lift, rollers=rollers)
        try:
            manager = prepared.bring_up(view, self._period(rate), self._simulates_mocks)
        except Exception:
            world.remove(name)
            raise
        manager.begin(loop.time)
        loop.managers.append(manager)
        self._namespaces.add(namespace)
        return manager

    def _detach(self, entity: Entity) -> None:
        """Shut a robot's manager down, motors first, and remove the robot from the world."""
        running, loop = entity.manager, self._loop_thread.loop
        if running is not None:
            loop.managers.remove(running.manager)
            self._namespaces.discard(running.node.get_namespace())
            try:
                running.manager.shut_down(loop.time)
            except (
                Exception
            ) as error:  # of a third-party plugin; the robot is removed all the same
                self._log(
                    Severity.ERROR,
                    f"'{entity.name}' is removed, though it raised: {describe(error)}",
                )
        self._world.remove(entity.name)

    def _check_namespace(self, namespace: str) -> None:
        """Raise SpawnError: a second controller manager would have the same name."""
        if namespace in self._namespaces:
            raise SpawnError(
                f"the namespace '{namespace}' has a controller manager already; give the robot "
                'one of its own (entity_namespace; create: --ros-args -r __ns:=/other)',
                SpawnCode.NAMESPACE_INVALID,
            )

    def _period(self, rate: int) -> int:
        """Return the period of a manager at ``rate`` Hz in whole physics steps, ns."""
        asked = _period_of(rate)
        period = steps_in(asked, self._world.timestep).period
        if period != asked:
            self._log(
                Severity.WARN,
                f'an update rate of {rate} Hz is {asked} ns, which physics steps of '
                f'{self._world.timestep} ns do not divide; the controllers run every {period} ns',
            )
        return period

    # --- the manager's node -------------------------------------------------------------------

    def _prepare(
        self,
        robot: Robot,
        hardware: Sequence[HardwareInfo],
        namespace: str,
        translation: GazeboTranslation,
    ) -> PreparedManager:
        host = ros2_control_host_of(robot)
        rules = [word for rule in host.remappings for word in ('-r', rule)]
        arguments = [*self._ros_args, *rules]
        if namespace.strip('/'):  # several managers publish on one /diagnostics
            arguments += ['-p', 'diagnostic_updater.use_fqn:=true']
        if len(hardware) > len(robot.plugin_hardware) or self._controllers:
            arguments += self._parameter_files(robot)
        else:  # Gazebo's plugins are all that it has
            arguments += ['-p', f'update_rate:={translation.update_rate}']
        with argument_errors():
            node = ControllerManagerNode(
                self._context,
                name=host.controller_manager_name,
                namespace=namespace,
                arguments=arguments,
            )
        return node.prepare(robot, hardware)

    def _parameter_files(self, robot: Robot) -> Sequence[str]:
        """Return ``--params-file`` arguments: of the parameter, else the URDF, else shipped."""
        paths = [self._controllers] if self._controllers else self._files_of(robot)
        for path in paths:
            read_parameter_file(Path(path))  # its errors have a line number, rcl's have none
        for finding in drive_warnings(robot, paths):
            self._log(Severity.WARN, finding.text)
        return [argument for path in paths for argument in ('--params-file', path)]

    def _rollers_of(self, robot: Robot) -> dict[str, Rollers]:
        """Return the rollers of wheels of which only the parameters of a controller tell."""
        paths = [self._controllers] if self._controllers else files_of(robot)
        return rollers_of_controllers(robot, [str(path) for path in paths])

    def _files_of(self, robot: Robot) -> list[str]:
        """Return the parameter files of a robot for which none is given; say if it has none."""
        found, missing = files_of(robot), missing_files(named_files(robot))
        remedy = 'is given by the parameter controllers of the simulator'
        if missing:
            why = f'a parameter file that it names is not there: {quote_all(missing)}; another one'
            self._log(Severity.WARN, f'{robot.source}: {why} {remedy}')
        elif not found:
            why = 'it names no parameter file for its controllers; one'
            self._log(Severity.WARN, f'{robot.source}: {why} {remedy}')
        return [str(path) for path in found]


def _destroy(entity: Entity) -> None:
    """Remove the nodes of a robot that no thread uses any more."""
    if entity.manager is not None:
        entity.manager.destroy()
    if entity.thread is not None:
        entity.thread.executor.shutdown()


def _category_of(robot: Robot) -> Category:
    """Return the category of a robot until a client sets another."""
    if hardware_of(robot):
        return Category.ROBOT
    moves = any(joint.has_position for joint in robot.joints)
    if robot.root.name == WORLD_LINK and not moves:
        return Category.STATIC_OBJECT
    return Category.DYNAMIC_OBJECT


def _period_of(rate: int) -> int:
    return round(NANOSECONDS / rate)
