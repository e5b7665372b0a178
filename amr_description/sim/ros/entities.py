# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
The entities of the simulated world: robots are spawned and removed, with controller managers.

A robot whose URDF has a ``<ros2_control>`` block gets a controller manager of its own, in its
namespace.
"""

from collections.abc import Callable, Coroutine, Iterator
from dataclasses import dataclass
import enum
from typing import Any

from rclpy.executors import Executor
from rclpy.task import Future

from amr_description.control.controller_manager import ControllerManager
from amr_description.control.ros.controller_manager_node import (
    ControllerManagerNode,
    PreparedManagerNode,
    RunningManager,
)
from amr_description.control.ros.loop_thread import LoopContext
from amr_description.control.ros.robot_description import DescriptionSource
from amr_description.errors import RequestError
from amr_description.log import Log
from amr_description.model.frames import Transform
from amr_description.model.robot import Robot
from amr_description.model.ros2_control_tag import hardware_of
from amr_description.ros.runtime import argument_errors, ExecutorThread, run_in_thread
from amr_description.sim.robot_spec import WORLD_LINK
from amr_description.sim.spawning import SpawnCode
from amr_description.simulation.engine import Arrival, SimulationEngine, Spawned
from amr_description.simulation.plugin_controllers import start_controllers
from amr_description.simulation.topics.ground_truth import GroundTruth
from amr_description.simulation.topics.sensor_manager import SensorManager


def run_in(executor: Executor, work: Coroutine[Any, Any, None], waiting: Executor) -> Future:
    """
    Run a coroutine in one executor; return what a coroutine of another one can await.

    Args:
        executor: Of the node that the coroutine is about; its thread runs.
        work: The coroutine.
        waiting: The executor of the one that awaits.
    """
    done = Future(executor=waiting)

    async def run() -> None:
        try:
            await work
        except Exception as error:  # raised again where the future is awaited
            done.set_exception(error)
        finally:  # it may be closed, as its robot is removed
            if not done.done():
                done.set_result(None)
            waiting.wake()  # a task that awaits is looked at only when the executor wakes

    executor.create_task(run())
    return done


def abandon(done: Future, waiting: Executor) -> None:
    """
    End the wait for what :func:`run_in` was to run, where its executor runs no more.

    Args:
        done: What :func:`run_in` has returned; it may be done.
        waiting: The executor of the one that awaits it.
    """
    if not done.done():
        done.set_result(None)
        waiting.wake()


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


@dataclass(slots=True)
class Entity:
    """A robot in the world, completely spawned."""

    name: str
    info: EntityRecord
    manager: RunningManager | None
    """None: its URDF has no ``<ros2_control>`` block."""
    thread: ExecutorThread | None
    """Runs the callbacks of the manager, its components and controllers."""
    origin: Spawned[PreparedManagerNode] | None = None
    """With what it was spawned."""


class EntityManager:
    """
    Spawns and removes entities.

    The coroutines run on the ROS thread and await the control thread. It makes the managers for
    the engine: a :class:`~amr_description.simulation.engine.ManagerHost`.
    """

    def __init__(
        self,
        context: LoopContext,
        engine: SimulationEngine,
        ground_truth: GroundTruth,
        sensors: SensorManager,
        executor: Executor,
        log: Log,
    ) -> None:
        """
        Manage the entities of a world that has none yet.

        Args:
            context: Of the control loop.
            engine: Of the simulation.
            ground_truth: Gets every entity.
            sensors: Gets the sensors of every entity.
            executor: Of the ROS thread.
            log: Of the simulator.
        """
        self._context = context
        self._loop_thread = context.loop_thread
        self._engine = engine
        self._ground_truth = ground_truth
        self._sensors = sensors
        self._executor = executor
        self._log = log
        self.ask = context.loop_thread.submit
        self.on_change: Callable[[], None] = lambda: None
        """Called when an entity was spawned, before its controllers start, or removed."""
        self._entities: dict[str, Entity] = {}
        self._starting: dict[str, Future] = {}
        """Of entities whose controllers are being started: done when they are."""

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
        Put a robot into the world and start its controller manager; return its name.

        See :meth:`~amr_description.simulation.engine.SimulationEngine.spawn`.
        """
        spawned: Spawned[PreparedManagerNode] = await self._engine.spawn(
            self, name, robot, pose, namespace, allow_renaming=allow_renaming
        )
        given, translation = spawned.name, spawned.translation
        running = thread = None
        if spawned.running is not None:
            running, thread = self._serve(*spawned.running, given)
        self._ground_truth.add(given, spawned.namespace)
        self._sensors.add(given, spawned.namespace, translation.sensors)
        record = EntityRecord(_category_of(robot))
        self._entities[given] = Entity(given, record, running, thread, spawned)
        self.on_change()
        if running is not None and thread is not None:
            requests, at = running.requests, running.node.get_namespace()
            starting = start_controllers(requests, translation.controllers, at, self._log)
            self._starting[given] = started = run_in(thread.executor, starting, self._executor)
            await started
            if self._starting.get(given) is started:  # not removed meanwhile, and spawned again
                del self._starting[given]
        return given

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
        await self._loop_thread.submit(lambda: self._engine.remove(name))
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
        self, prepared: PreparedManagerNode, manager: ControllerManager, name: str
    ) -> tuple[RunningManager, ExecutorThread]:
        """Create the services of a robot's manager, and the thread that runs their callbacks."""
        thread = ExecutorThread(name, self._loop_thread.fail)
        node, log = prepared.manager_node.node, prepared.manager_node.log
        thread.executor.add_node(node)
        DescriptionSource(node, log, robot=prepared.robot)
        running = prepared.serve(manager)
        thread.start()
        return running, thread

    def prepare(self, arrival: Arrival) -> PreparedManagerNode:
        """Make the nodes of a robot's manager and of its components. Raises ParameterError."""
        with argument_errors():
            node = ControllerManagerNode(
                self._context,
                name=arrival.manager_name,
                namespace=arrival.namespace,
                arguments=arrival.arguments,
            )
        return node.prepare(arrival.robot, arrival.hardware)


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
