# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
The engine of a simulation: its world, its loop, and robots that come and go with their managers.

It knows no ROS and no clock. Around it is the simulator's node (``sim/ros``), or a simulation in a
process (``in_process.py``): they let time pass, make the controller managers, and serve their
controllers. All but the coroutine :meth:`SimulationEngine.spawn` is for the control thread.
"""

from collections.abc import Awaitable, Callable, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Generic, Protocol, TypeVar

from amr_description.clock import NANOSECONDS
from amr_description.control.controller_manager import ControllerManager
from amr_description.control.loop import Commands, Loop, Pacer, Publisher, Stepper
from amr_description.errors import SpawnError
from amr_description.log import Log, Severity
from amr_description.model.frames import Transform
from amr_description.model.gazebo.bridge import bridge_of, bridged
from amr_description.model.gazebo.builder import CLAIMED_JOINTS, GazeboTranslation
from amr_description.model.gazebo.tags import ros2_control_host_of
from amr_description.model.gazebo.translation import translate
from amr_description.model.hardware_info import HardwareInfo
from amr_description.model.robot import Robot
from amr_description.model.ros2_control_tag import hardware_of
from amr_description.model.wheels import Rollers
from amr_description.parameter_files import file_names
from amr_description.plugin_errors import describe
from amr_description.sim.engine import physics_stepping, steps_in
from amr_description.sim.robot_view import RobotView
from amr_description.sim.spawning import (
    check_name,
    checked_namespace,
    free_name,
    read_description,
    SpawnCode,
)
from amr_description.sim.world import MujocoWorld
from amr_description.simulation.manager_arguments import manager_arguments, rollers_of
from amr_description.simulation.parameters import CLOCK_PERIOD, SimulationParameters
from amr_description.simulation.plugin_controllers import log_translation
from amr_description.simulation.spawn_cost import announce, cost_of
from amr_description.text import plain_name

_Result = TypeVar('_Result')


class PreparedManager(Protocol):
    """A controller manager whose robot is not in the world yet."""

    @property
    def namespace(self) -> str:
        """Absolute."""

    @property
    def update_rate(self) -> int:
        """Hz."""

    def bring_up(self, world: RobotView, period: int, simulates_mocks: bool) -> ControllerManager:
        """
        Start its hardware, and return the manager; on the control thread.

        Raises HardwareError, or what a component of a third party raises.
        """

    def destroy(self) -> None:
        """Remove what was made: its robot does not come."""


PreparedType = TypeVar('PreparedType', bound=PreparedManager)
MadeType = TypeVar('MadeType', bound=PreparedManager, covariant=True)


@dataclass(frozen=True)
class Arrival:
    """A robot with hardware that is to come, as its manager has to know it."""

    robot: Robot
    hardware: Sequence[HardwareInfo]
    """What its ``<ros2_control>`` blocks say."""
    manager_name: str
    namespace: str
    """Of the manager, absolute."""
    arguments: Sequence[str]
    """ROS arguments for the manager and for every controller."""


@dataclass(frozen=True)
class Spawned(Generic[PreparedType]):
    """A robot in the world, whose hardware is started; its controllers are not."""

    name: str
    robot: Robot
    namespace: str
    """Absolute."""
    pose: Transform
    """Of its root link in the world, as it was asked."""
    translation: GazeboTranslation
    """What stands for plugins of Gazebo."""
    running: tuple[PreparedType, ControllerManager] | None
    """None: it has no hardware."""


class ManagerHost(Protocol[MadeType]):
    """Makes the managers of robots, and says where the engine is called."""

    def prepare(self, arrival: Arrival) -> MadeType:
        """Make the manager of a robot. Raises ParameterError."""

    def ask(self, call: Callable[[], _Result]) -> Awaitable[_Result]:
        """Have the control thread make a call between two cycles; what it raises is raised."""


class Calls(Commands, Protocol):
    """The queue of calls that the control thread makes."""

    def put(self, call: Callable[[], None]) -> None:
        """Have a call made before the next cycle."""


class SimulationEngine:
    """World, loop and robots; see the module."""

    def __init__(
        self,
        settings: SimulationParameters,
        log: Log,
        calls: Calls,
        ports: Callable[[MujocoWorld], tuple[Stepper, Pacer, Publisher]],
        *,
        ros_args: Sequence[str] = (),
        remedy: str,
    ) -> None:
        """
        Load the world; it has no robots.

        Args:
            settings: At the start.
            log: Of the simulator.
            calls: The queue of the loop.
            ports: Returns what steps a world, paces it, and publishes what happens in it.
            ros_args: ROS arguments for every manager and controller.
            remedy: How time goes on after a fault has paused it, for the log.

        Raises:
            SimulationError: There is no such world, MuJoCo rejects it, or the file of a bridge
                cannot be used.
        """
        self.settings = settings
        self.world_name = settings.world
        """Of the present world: a shipped name, or a path."""
        self.pauses_on_fault = settings.on_fault == 'pause'
        """May be set at any time, by any thread."""
        self._log, self._ros_args, self._remedy = log, ros_args, remedy
        self._bridge = bridge_of(settings.bridge)
        self.world = MujocoWorld(
            settings.world,
            settings=settings.physics,
            seed=settings.seed,
            strict=settings.strict,
            log=log,
        )
        """The physics."""
        stepper, pacer, publisher = ports(self.world)
        self.loop = Loop(stepper, pacer, calls, publisher, CLOCK_PERIOD)
        if settings.paused:
            self.loop.pause()
        self.world.faults.on_fault = lambda: calls.put(self._on_fault)
        self._managers: dict[str, tuple[str, ControllerManager]] = {}
        """Namespace and manager, by the name of the robot."""

    # --- the world ----------------------------------------------------------------------------

    def check_world(self, world: str) -> None:
        """Raise SimulationError: there is no such world, or MuJoCo rejects it."""
        MujocoWorld(world, settings=self.settings.physics)

    def load_world(self, world: str) -> None:
        """Load a world in the place of this one, in which no robot is. Raises SimulationError."""
        self.world.load(world)
        self.world_name = world

    def reset(self, *, time: bool = True, state: bool = True) -> None:
        """
        Reset; active controllers stay active.

        Args:
            time: Set the time to 0.
            state: Put every robot where it was spawned, at rest, with odometry at zero.
        """
        world, loop = self.world, self.loop
        now = world.time
        if state:
            world.reset()
        world.time = 0 if time else now
        if state:
            loop.reset()
        else:
            loop.set_clock()

    def missing_steps(self, missing: int) -> int:
        """Return how many physics steps a part of a period has, ns, that was not stepped."""
        return -(-missing // self.world.timestep)

    def _on_fault(self) -> None:
        """Pause after a fault, if ``on_fault`` says so."""
        if self.pauses_on_fault:
            self.loop.pause()
            self._log(Severity.WARN, f'paused, as on_fault says; {self._remedy}')

    # --- robots -------------------------------------------------------------------------------

    def read(self, text: str, source: str, namespace: str = '') -> Robot:
        """
        Read the description of a robot, as it is to be spawned.

        Args:
            text: The URDF.
            source: What messages call it.
            namespace: As that of :meth:`spawn`.

        Raises:
            SpawnError: It is no good, or the namespace is none.
        """
        strict, files = self.settings.strict, self._parameter_files
        inside = checked_namespace(namespace) if namespace else ''
        return read_description(text, source, self._log, strict, files, inside)

    @property
    def _parameter_files(self) -> list[Path] | None:
        """Those that it was given for all robots; None: each names its own."""
        return [Path(each) for each in file_names(self.settings.controllers)] or None

    async def spawn(
        self,
        host: ManagerHost[PreparedType],
        name: str,
        robot: Robot,
        pose: Transform,
        namespace: str,
        *,
        allow_renaming: bool = False,
    ) -> Spawned[PreparedType]:
        """
        Put a robot into the world, and start its hardware; not on the control thread.

        Args:
            host: Makes its controller manager, if it has hardware.
            name: Of the entity; empty: that of the description, with _ for blanks and the like.
            robot: Its description, as :meth:`read`.
            pose: Transform from its root link to the world.
            namespace: Of the controller manager; empty: that of the description.
            allow_renaming: Use another name if this one is taken.

        Raises:
            SpawnError, DescriptionError, HardwareError, ParameterError: or whatever the
                constructor of a third-party component raises; nothing is left of the robot then.
        """
        name = name or plain_name(robot.name)
        announce(name, cost_of(robot), self._log)
        namespace = checked_namespace(namespace or ros2_control_host_of(robot).namespace)
        translation = bridged(translate(robot, self._parameter_files, namespace), self._bridge)
        prepared: PreparedType | None = None
        rollers: Mapping[str, Rollers] = {}
        if hardware := self._hardware_of(robot, namespace):
            arrival = self._arrival(robot, hardware, namespace, translation)
            rollers = rollers_of(robot, translation, self.settings.controllers)
            prepared = host.prepare(arrival)

        def insert() -> tuple[str, ControllerManager | None]:
            given = free_name(name, self.world.names) if allow_renaming else name
            check_name(given, self.world.names)
            return given, self._insert(given, robot, pose, prepared, rollers)

        try:
            given, manager = await host.ask(insert)
        except BaseException:
            if prepared is not None:
                prepared.destroy()
            raise
        log_translation(given, translation, namespace, self._log)
        running = None if prepared is None or manager is None else (prepared, manager)
        return Spawned(given, robot, namespace, pose, translation, running)

    def _hardware_of(self, robot: Robot, namespace: str) -> Sequence[HardwareInfo]:
        """Return the hardware of a robot; none where only controllers that another has want it."""
        hardware = hardware_of(robot)
        is_asked_for = [each.name for each in hardware] != [CLAIMED_JOINTS]
        return hardware if is_asked_for or not self._is_taken(namespace) else ()

    def _arrival(
        self,
        robot: Robot,
        hardware: Sequence[HardwareInfo],
        namespace: str,
        translation: GazeboTranslation,
    ) -> Arrival:
        arguments = manager_arguments(
            robot,
            namespace,
            translation,
            controllers=self.settings.controllers,
            ros_args=self._ros_args,
            log=self._log,
        )
        name = ros2_control_host_of(robot).controller_manager_name
        return Arrival(robot, hardware, name, namespace, arguments)

    def _insert(
        self,
        name: str,
        robot: Robot,
        pose: Transform,
        prepared: PreparedManager | None,
        rollers: Mapping[str, Rollers],
    ) -> ControllerManager | None:
        """Add a robot, components (all of them active) and manager; ``rollers``: by joint."""
        loop, world, lift = self.loop, self.world, self.settings.lift
        if prepared is None:
            world.spawn(name, robot, pose, lift=lift)
            return None
        self._check_namespace(prepared.namespace)
        if not loop.managers:
            step = physics_stepping(_period_of(prepared.update_rate), world.longest_step).step
            world.timestep = step
        view = world.spawn(name, robot, pose, lift=lift, rollers=rollers)
        simulates_mocks = self.settings.mock_hardware == 'simulate'
        try:
            manager = prepared.bring_up(view, self._period(prepared.update_rate), simulates_mocks)
        except Exception:
            world.remove(name)
            raise
        manager.begin(loop.time)
        loop.managers.append(manager)
        self._managers[name] = (prepared.namespace, manager)
        return manager

    def remove(self, name: str) -> None:
        """Shut a robot's manager down, motors first, and remove the robot from the world."""
        _, manager = self._managers.pop(name, ('', None))
        if manager is not None:
            self.loop.managers.remove(manager)
            try:
                manager.shut_down(self.loop.time)
            except Exception as error:  # of a third party's plugin; it is removed all the same
                self._log(
                    Severity.ERROR, f"'{name}' is removed, though it raised: {describe(error)}"
                )
        self.world.remove(name)

    def _is_taken(self, namespace: str) -> bool:
        return any(namespace == each for each, _ in [*self._managers.values()])

    def _check_namespace(self, namespace: str) -> None:
        """Raise SpawnError: a second controller manager would have the same name."""
        if self._is_taken(namespace):
            raise SpawnError(
                f"the namespace '{namespace}' has a controller manager already; give the robot "
                'one of its own (entity_namespace; create: --ros-args -r __ns:=/other)',
                SpawnCode.NAMESPACE_INVALID,
            )

    def _period(self, rate: int) -> int:
        """Return the period of a manager at ``rate`` Hz in whole physics steps, ns."""
        asked = _period_of(rate)
        period = steps_in(asked, self.world.timestep).period
        if period != asked:
            self._log(
                Severity.WARN,
                f'an update rate of {rate} Hz is {asked} ns, which physics steps of '
                f'{self.world.timestep} ns do not divide; the controllers run every {period} ns',
            )
        return period


def _period_of(rate: int) -> int:
    return round(NANOSECONDS / rate)
