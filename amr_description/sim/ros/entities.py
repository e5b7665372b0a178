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

from rclpy.executors import Executor
from rclpy.task import Future

from amr_description.control.contracts import Log
from amr_description.control.controller_manager import ControllerManager
from amr_description.control.ros.controller_manager_node import (
    ControllerManagerNode,
    PreparedManager,
    RunningManager,
)
from amr_description.control.ros.loop_thread import LoopContext
from amr_description.control.ros.robot_description import DescriptionSource
from amr_description.errors import RequestError
from amr_description.model.frames import Transform
from amr_description.model.gazebo import ros2_control_host_of
from amr_description.model.gazebo_bridge import Bridge, bridged
from amr_description.model.gazebo_builder import GazeboTranslation
from amr_description.model.gazebo_translation import translate
from amr_description.model.hardware_info import HardwareInfo
from amr_description.model.robot import Robot
from amr_description.model.rollers import Rollers
from amr_description.model.ros2_control_tag import hardware_of
from amr_description.ros.runtime import argument_errors, ExecutorThread, run_in_thread
from amr_description.sim.robot_spec import WORLD_LINK
from amr_description.sim.ros.executor_tasks import abandon, run_in
from amr_description.sim.ros.ground_truth import GroundTruth
from amr_description.sim.ros.sensors.manager import SensorManager
from amr_description.sim.spawning import check_name, free_name, SpawnCode
from amr_description.sim.world import MujocoWorld
from amr_description.simulation.managed_robots import ManagedRobots, ManagerStart
from amr_description.simulation.manager_arguments import manager_arguments, rollers_of
from amr_description.simulation.plugin_controllers import log_translation, start_controllers


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
        self._ros_args = ros_args
        self.on_change: Callable[[], None] = lambda: None
        """Called when an entity was spawned, before its controllers start, or removed."""
        self._entities: dict[str, Entity] = {}
        self._starting: dict[str, Future] = {}
        """Of entities whose controllers are being started: done when they are."""
        self._robots = ManagedRobots(world, context.loop_thread.loop, log, lift=lift)
        """Used on the control thread only."""

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
            rollers = rollers_of(robot, translation, self._controllers)
        start = self._start_of(prepared) if prepared is not None else None

        def insert() -> tuple[str, ControllerManager | None]:
            given = free_name(name, self._world.names) if allow_renaming else name
            check_name(given, self._world.names)
            return given, self._robots.insert(given, robot, pose, start, rollers)

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
            requests, at = running.requests, running.node.get_namespace()
            starting = start_controllers(requests, translation.controllers, at, self._log)
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
        await self._loop_thread.submit(lambda: self._robots.remove(name))
        _destroy(entity)
        self.on_change()

    async def remove_all(self) -> int:
        """Remove all robots; return how many."""
        count = 0
        while self._entities:
            await self.remove(next(iter(self._entities)))
            count += 1
        return count

    def reset(self, *, time: bool, state: bool) -> None:
        """Reset world and managers; on the control thread. See :meth:`ManagedRobots.reset`."""
        self._robots.reset(time=time, state=state)

    def destroy(self) -> None:
        """Destroy all nodes, after the control thread has stopped."""
        threads = [each.thread for each in self._entities.values() if each.thread is not None]
        for thread in threads:
            thread.ask_to_end()  # all at once: each may have a callback to finish
        for thread in threads:
            thread.end()
        for entity in self._entities.values():
            _destroy(entity)

    def _start_of(self, prepared: PreparedManager) -> ManagerStart:
        """Return what brings a manager up, on the control thread."""
        return ManagerStart(
            prepared.manager_node.node.get_namespace(),
            prepared.manager_node.parameters.update_rate,
            lambda view, period: prepared.bring_up(view, period, self._simulates_mocks),
        )

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

    # --- the manager's node -------------------------------------------------------------------

    def _prepare(
        self,
        robot: Robot,
        hardware: Sequence[HardwareInfo],
        namespace: str,
        translation: GazeboTranslation,
    ) -> PreparedManager:
        arguments = manager_arguments(
            robot,
            hardware,
            namespace,
            translation,
            controllers=self._controllers,
            ros_args=self._ros_args,
            log=self._log,
        )
        with argument_errors():
            node = ControllerManagerNode(
                self._context,
                name=ros2_control_host_of(robot).controller_manager_name,
                namespace=namespace,
                arguments=arguments,
            )
        return node.prepare(robot, hardware)


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
