# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
The simulation in a process: the world, its owner, and the robots with their managers.

A robot whose URDF has a ``<ros2_control>`` block gets a controller manager of its own, in its
namespace.
"""

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

from rclpy.executors import Executor
from rclpy.node import Node

from amr_description.control.contracts import Severity
from amr_description.control.interfaces import NANOSECONDS
from amr_description.control.loop import Loop
from amr_description.errors import SpawnError
from amr_description.model.frames import Transform
from amr_description.model.gazebo_tag import gazebo_plugins_of
from amr_description.model.hardware_info import HardwareInfo
from amr_description.model.robot import Robot
from amr_description.model.ros2_control_tag import hardware_of
from amr_description.nodes.controller_manager_node import ControllerManagerNode
from amr_description.nodes.description_source import DescriptionSource
from amr_description.nodes.ground_truth import GroundTruth
from amr_description.nodes.node_log import LogThread
from amr_description.nodes.outgoing import SimulatedOutgoing
from amr_description.nodes.owner import Mailbox, Owner, WallPacer
from amr_description.nodes.parameter_files import read_parameter_file
from amr_description.nodes.runtime import argument_errors
from amr_description.parameters import parameter
from amr_description.sim.resources import package_share
from amr_description.sim.spawning import check_name, free_name, SpawnCode
from amr_description.sim.stepping import physics_stepping, steps_in
from amr_description.sim.world import MujocoWorld

CLOCK_PERIOD = 10_000_000
"""ns: the longest time between two messages on ``/clock``."""


@dataclass(frozen=True)
class SimulationParameters:
    """The parameters of the node ``mujoco_sim``."""

    world: str = parameter('empty', 'A shipped world, or the path of an MJCF file', read_only=True)
    real_time_factor: float = parameter(
        1.0,
        'Simulated seconds per second of the wall clock; 0: as fast as possible',
        minimum=0.0,
        read_only=True,
    )
    controllers: str = parameter(
        '',
        'Parameter file of the controller managers; empty: what the <gazebo> block of the URDF '
        'names, else that of this package',
        read_only=True,
    )
    ground_truth_rate: float = parameter(
        50.0,
        'Rate of ground_truth/odom and ground_truth/wheels of every robot; 0: none',
        unit='Hz',
        minimum=0.0,
        read_only=True,
    )


class WorldStepper:
    """The ``Stepper`` port of the loop over a MuJoCo world."""

    def __init__(self, world: MujocoWorld) -> None:
        self._world = world

    @property
    def time(self) -> int:
        """Simulated time, ns."""
        return self._world.time

    def advance(self, period: int) -> None:
        """Step the physics by ``period`` (ns), rounded to its steps, by one at least."""
        self._world.step(max(1, round(period / self._world.timestep)))


class Simulation:
    """
    World, loop and managers; ``node`` publishes ``/clock`` and lends its logger.

    The coroutines run on the ROS thread and await the owner.
    """

    def __init__(
        self, node: Node, executor: Executor, parameters: SimulationParameters, ros_args: list[str]
    ) -> None:
        """``ros_args`` go on to every manager and controller. Raises SimulationError."""
        self.logs = LogThread()
        try:
            self.log = self.logs.log_of(node.get_logger())
            self._parameters = parameters
            self._ros_args = ros_args
            self._executor = executor
            self._managers: dict[str, ControllerManagerNode] = {}
            self._outgoing = SimulatedOutgoing(node)
            self._outgoing.adopt(node)
            self.world = MujocoWorld(parameters.world, log=self.log)
            self.ground_truth = GroundTruth(
                node, self._outgoing, self.world, parameters.ground_truth_rate
            )
            mailbox = Mailbox()
            self.owner = Owner(mailbox, executor)
            self.owner.loop = Loop(
                WorldStepper(self.world),
                WallPacer(parameters.real_time_factor, mailbox),
                mailbox,
                self._outgoing,
                CLOCK_PERIOD,
            )
        except Exception:
            self.logs.stop()
            raise

    def start(self) -> None:
        """Let time begin."""
        self.owner.start()

    def close(self) -> None:
        """Let time end; then remove the managers' nodes."""
        self.owner.stop()
        for manager in self._managers.values():
            manager.destroy()
        self.logs.stop()

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
        Put a robot into the world and, if it asks for control, start its controller manager.

        Return its name: another than ``name`` where that is taken and ``allow_renaming``. Raises
        SpawnError, DescriptionError, HardwareError, ParameterError, or whatever the constructor
        of a foreign component raises; nothing is then left of the robot.
        """
        hardware = hardware_of(robot)
        node = self._manager_node(robot, hardware, namespace) if hardware else None

        def insert() -> str:
            given = free_name(name, self.world.names) if allow_renaming else name
            check_name(given, self.world.names)
            if node is not None:
                self._check_namespace(node.node.get_namespace())
            self._insert(given, robot, pose, node)
            return given

        try:
            given = await self.owner.submit(insert)
        except Exception:
            if node is not None:
                node.destroy()
            raise
        if node is not None:
            self._executor.add_node(node.node)
            DescriptionSource(node.node, node.log, robot=robot)
            node.start()
        self.ground_truth.add(given, namespace)
        return given

    def _check_namespace(self, namespace: str) -> None:
        """Refuse a second controller manager of one name: nobody could tell the two apart."""
        taken = {each.node.get_namespace() for each in self._managers.values()}
        if namespace in taken:
            raise SpawnError(
                f"the namespace '{namespace}' has a controller manager already; give the robot "
                'one of its own (entity_namespace; create: --ros-args -r __ns:=/other)',
                SpawnCode.NAMESPACE_INVALID,
            )

    def _insert(
        self,
        name: str,
        robot: Robot,
        pose: Transform,
        node: ControllerManagerNode | None,
    ) -> None:
        """On the owner's thread, in one go: robot, components, all of them active, manager."""
        if node is not None and not self.owner.loop.managers:
            self.world.timestep = physics_stepping(_period_of(node.parameters.update_rate)).step
        view = self.world.spawn(name, robot, pose)
        if node is None:
            return
        try:
            manager = node.bring_up(view, self._period(node.parameters.update_rate))
        except Exception:
            self.world.remove(name)
            raise
        manager.begin(self.owner.loop.time)
        self.owner.loop.managers.append(manager)
        self._managers[name] = node

    def _manager_node(
        self, robot: Robot, hardware: Sequence[HardwareInfo], namespace: str
    ) -> ControllerManagerNode:
        arguments = [*self._ros_args, *self._parameter_files(robot)]
        with argument_errors():
            node = ControllerManagerNode(
                self.owner,
                self._outgoing,
                self.logs,
                namespace=namespace,
                arguments=arguments,
            )
        node.prepare(robot, hardware)
        return node

    def _parameter_files(self, robot: Robot) -> Sequence[str]:
        """``--params-file`` arguments: the parameter, the URDF's own, or the shipped file."""
        paths = [self._parameters.controllers] if self._parameters.controllers else []
        if not paths:
            hosts = (p for p in gazebo_plugins_of(robot) if p.hosts_ros2_control)
            paths = [path for plugin in hosts for path in plugin.parameters]
        if not paths:
            paths = [str(package_share('amr_description') / 'config' / 'controllers.yaml')]
        for path in paths:
            read_parameter_file(Path(path))  # rcl would not say where it is wrong
        return [argument for path in paths for argument in ('--params-file', path)]

    def _period(self, rate: int) -> int:
        """The tick of a manager at ``rate`` Hz in whole physics steps, ns; said if it differs."""
        asked = _period_of(rate)
        period = steps_in(asked, self.world.timestep).period
        if period != asked:
            self.log(
                Severity.WARN,
                f'an update rate of {rate} Hz is {asked} ns, which physics steps of '
                f'{self.world.timestep} ns do not divide; the controllers run every {period} ns',
            )
        return period


def _period_of(rate: int) -> int:
    return round(NANOSECONDS / rate)
