# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
Robots come into a world with their controller managers, and leave it, between two cycles.

Everything here is for the control thread.
"""

from collections.abc import Callable, Mapping
from dataclasses import dataclass

from amr_description.clock import NANOSECONDS
from amr_description.control.contracts import Log, Severity
from amr_description.control.controller_manager import ControllerManager
from amr_description.control.loop import Loop
from amr_description.control.plugin_errors import describe
from amr_description.errors import SpawnError
from amr_description.model.frames import Transform
from amr_description.model.robot import Robot
from amr_description.model.rollers import Rollers
from amr_description.sim.engine import physics_stepping, steps_in
from amr_description.sim.robot_view import RobotView
from amr_description.sim.spawning import SpawnCode
from amr_description.sim.world import MujocoWorld

_NO_ROLLERS: Mapping[str, Rollers] = {}


@dataclass(frozen=True, slots=True)
class ManagerStart:
    """A controller manager that is to come with a robot."""

    namespace: str
    """Absolute."""
    update_rate: int
    """Hz."""
    bring_up: Callable[[RobotView, int], ControllerManager]
    """``(robot in the world, period in ns) ->`` the manager, with its hardware started."""


class ManagedRobots:
    """The robots of a world, and the managers of those that have hardware."""

    def __init__(self, world: MujocoWorld, loop: Loop, log: Log, *, lift: bool) -> None:
        """
        Begin without robots.

        Args:
            world: The simulated world.
            loop: Ticks the managers.
            log: Of the simulator.
            lift: Whether a robot that would be inside the world is lifted until it is free.
        """
        self._world, self._loop, self._log, self._lift = world, loop, log, lift
        self._managers: dict[str, tuple[str, ControllerManager]] = {}
        """Namespace and manager, by the name of the robot."""

    def insert(
        self,
        name: str,
        robot: Robot,
        pose: Transform,
        start: ManagerStart | None = None,
        rollers: Mapping[str, Rollers] = _NO_ROLLERS,
    ) -> ControllerManager | None:
        """
        Add a robot, components (all of them active) and manager.

        Args:
            name: Of the entity.
            robot: Its description.
            pose: Transform from its root link to the world.
            start: Of its manager; None: it has no hardware.
            rollers: Of wheels of which the description does not tell, by joint.

        Raises:
            SpawnError, HardwareError: Nothing is left of the robot then; nor is it where the
                constructor of a third party's component raises.
        """
        loop, world = self._loop, self._world
        if start is None:
            world.spawn(name, robot, pose, lift=self._lift)
            return None
        self._check_namespace(start.namespace)
        if not loop.managers:
            step = physics_stepping(_period_of(start.update_rate), world.longest_step).step
            world.timestep = step
        view = world.spawn(name, robot, pose, lift=self._lift, rollers=rollers)
        try:
            manager = start.bring_up(view, self._period(start.update_rate))
        except Exception:
            world.remove(name)
            raise
        manager.begin(loop.time)
        loop.managers.append(manager)
        self._managers[name] = (start.namespace, manager)
        return manager

    def remove(self, name: str) -> None:
        """Shut a robot's manager down, motors first, and remove the robot from the world."""
        _, manager = self._managers.pop(name, ('', None))
        if manager is not None:
            self._loop.managers.remove(manager)
            try:
                manager.shut_down(self._loop.time)
            except (
                Exception
            ) as error:  # of a third-party plugin; the robot is removed all the same
                self._log(
                    Severity.ERROR, f"'{name}' is removed, though it raised: {describe(error)}"
                )
        self._world.remove(name)

    def reset(self, *, time: bool = True, state: bool = True) -> None:
        """
        Reset; active controllers stay active.

        Args:
            time: Set the time to 0.
            state: Put every robot where it was spawned, at rest, with odometry at zero.
        """
        world, loop = self._world, self._loop
        now = world.time
        if state:
            world.reset()
        world.time = 0 if time else now
        if state:
            loop.reset()
        else:
            loop.set_clock()

    def _check_namespace(self, namespace: str) -> None:
        """Raise SpawnError: a second controller manager would have the same name."""
        if any(namespace == each for each, _ in self._managers.values()):
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


def _period_of(rate: int) -> int:
    return round(NANOSECONDS / rate)
