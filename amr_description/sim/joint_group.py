# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
A group of joints of one robot, read and commanded in every control cycle.

The joints are bound once to views into MuJoCo's arrays. A read is then one slice and one
``tolist()``, well below 1 µs; access by name costs 10 µs.
"""

from collections.abc import Callable, Mapping, Sequence
import math
from operator import itemgetter
from typing import Any, TypeAlias

import mujoco
import numpy as np

from amr_description.control.interfaces import EFFORT, POSITION, VELOCITY
from amr_description.errors import SimulationError
from amr_description.log import Log, Severity
from amr_description.model.robot import Joint
from amr_description.sim.actuator_modes import (
    ActuatorMode,
    EffortReader,
    NO_TARGETS,
    RobotActuators,
)
from amr_description.sim.actuators import actuator_name, command_bounds, COMMANDS, rotor_name
from amr_description.sim.engine import Engine

Reader: TypeAlias = Callable[[], list[float]]
Writer: TypeAlias = Callable[[Sequence[float]], None]

_JOINT = mujoco.mjtObj.mjOBJ_JOINT
_ROUNDING = 1e-9
"""In any unit: how far beyond a limit a command may be by the rounding of who has computed it."""
_ACTUATOR = mujoco.mjtObj.mjOBJ_ACTUATOR
_LIMITS = {
    POSITION: 'lower="…" upper="…"',
    VELOCITY: 'velocity="…"',
    EFFORT: 'effort="…"',
}


class MujocoJointGroup:
    """The :class:`~amr_description.control.world.JointGroup` of a simulated robot."""

    def __init__(
        self,
        engine: Engine,
        robot: str,
        joints: Sequence[Joint],
        actuators: RobotActuators,
        log: Log,
    ) -> None:
        """Bind joints of ``robot``. Raises SimulationError: one is not in the world."""
        self._engine = engine
        self._robot = robot
        self._joints = tuple(joints)
        self._names = tuple(joint.name for joint in joints)
        self._actuators = actuators
        self._log = log
        self._known_changes = -1
        self._written: Sequence[float] | None = None
        """The values in force, as long as nobody switches or commands the joints."""
        self._bind()

    def positions(self) -> list[float]:
        """rad or m."""
        if self._generation != self._engine.generation:
            self._bind()
        return self._read_positions()

    def velocities(self) -> list[float]:
        """rad/s or m/s."""
        if self._generation != self._engine.generation:
            self._bind()
        return self._read_velocities()

    def efforts(self) -> list[float]:
        """Generalised force of the actuators during the last physics step, N·m or N."""
        if self._generation != self._engine.generation:
            self._bind()
        return self._read_efforts()

    def accelerations(self) -> list[float]:
        """During the last physics step, rad/s² or m/s²."""
        if self._generation != self._engine.generation:
            self._bind()
        return self._read_accelerations()

    def command(self, interface: str, values: Sequence[float]) -> None:
        """
        Let the joints follow one command interface, until the next call.

        A value beyond the joint's limit is clamped, which is logged once.

        Args:
            interface: ``position`` (rad or m), ``velocity`` (rad/s or m/s) or ``effort`` (N·m
                or N).
            values: One for each joint.

        Raises:
            SimulationError: A value is not finite, or a joint has no such command interface.
        """
        if self._generation != self._engine.generation:
            self._bind()
        if interface != self._interface:
            self._select(interface)
        elif values == self._written and self._actuators.changes == self._known_changes:
            return
        given = values
        for value, (lower, upper) in zip(values, self._bounds, strict=True):
            # False for NaN too.
            if not lower <= value <= upper:
                values = self._clamped(values)
                break
        if self._actuators.changes != self._known_changes:
            self._actuators.command(self._names, ActuatorMode(interface), self)
            self._known_changes = self._actuators.changes
        if interface == POSITION and self._has_rotors:
            values = [
                value + rotor - joint
                for value, rotor, joint in zip(
                    values, self._read_rotors(), self._read_positions(), strict=True
                )
            ]
        self._write(values)
        # What is in force need not be written again. The command of a rotor depends on where it
        # is now; and 0.0 equals -0.0, of which the state of the world keeps the sign.
        lasts = values is given and all(values)
        self._written = list(values) if lasts else None

    def hold(self) -> None:
        """Stop the joints and hold them where they stop."""
        self.hold_at(NO_TARGETS)

    def hold_at(self, targets: Mapping[str, float]) -> Mapping[str, float]:
        """
        Hold the joints at targets, rad or m; those without, where they stop; return all targets.

        Who holds them again and again, against others, gives what the first call has returned.
        """
        if self._generation != self._engine.generation:
            self._bind()
        return self._actuators.hold(self._names, targets)

    def release(self) -> None:
        """Let the joints move freely: no actuator exerts a force."""
        if self._generation != self._engine.generation:
            self._bind()
        self._actuators.switch(self._names, ActuatorMode.FREE)

    def _select(self, interface: str) -> None:
        """Bind the commands of an interface. Raises SimulationError: a joint has no such one."""
        for name in self._names:
            if (
                interface not in self._actuators.commands.get(name, ())
                or interface not in COMMANDS
            ):
                raise SimulationError(
                    f"robot '{self._robot}': joint '{name}' takes no {interface} command: its "
                    '<ros2_control> block declares none'
                )
        actuators = self._find(_ACTUATOR, [actuator_name(name, interface) for name in self._names])
        addresses = [int(self._engine.model.actuator_ctrladr[actuator]) for actuator in actuators]
        self._write = writer(self._engine.data.ctrl, addresses)
        bounds = (command_bounds(joint, interface) for joint in self._joints)
        self._bounds = [(each.lower, each.upper) for each in bounds]
        self._interface = interface
        self._known_changes = -1
        self._written = None

    def _clamped(self, values: Sequence[float]) -> list[float]:
        """Clamp values to the limits, and log it. Raises SimulationError: one is not finite."""
        clamped = []
        for joint, value in zip(self._joints, values, strict=True):
            where = f"robot '{self._robot}': joint '{joint.name}': the {self._interface} command"
            if not math.isfinite(value):
                raise SimulationError(f'{where} is {value}; a finite number is needed')
            bounds = command_bounds(joint, self._interface)
            clamped.append(min(max(value, bounds.lower), bounds.upper))
            if abs(clamped[-1] - value) > _ROUNDING:
                self._log(
                    Severity.WARN,
                    f'{where} {value:.6g} is beyond {bounds} and is clamped; '
                    f'<limit {_LIMITS[self._interface]}> in the URDF sets the limit',
                    throttle=math.inf,
                )
        return clamped

    def _bind(self) -> None:
        """Make the views into the present model and data; repeated after every recompile."""
        model, data = self._engine.model, self._engine.data
        joints = self._find(_JOINT, self._names)
        for name, index in zip(self._names, joints, strict=True):
            if index < 0:
                raise SimulationError(
                    f"robot '{self._robot}': joint '{name}' is not in the simulated world"
                )
        # The servo of a joint with a slip clutch drives the rotor.
        rotors = self._find(_JOINT, [rotor_name(name) for name in self._names])
        self._has_rotors = max(rotors, default=-1) >= 0
        rotors = [j if rotor < 0 else rotor for j, rotor in zip(joints, rotors, strict=True)]
        self._read_positions = reader(data.qpos, [int(model.jnt_qposadr[j]) for j in joints])
        self._read_rotors = reader(data.qpos, [int(model.jnt_qposadr[j]) for j in rotors])
        degrees = [int(model.jnt_dofadr[j]) for j in joints]
        self._read_velocities = reader(data.qvel, degrees)
        self._read_accelerations = reader(data.qacc, degrees)
        self._read_efforts = EffortReader(self._engine, self._robot, self._names)
        self._interface = ''
        self._generation = self._engine.generation

    def _find(self, kind: mujoco.mjtObj, names: Sequence[str]) -> list[int]:
        """Return the indices of elements of the robot; -1: there is none of that name."""
        model = self._engine.model
        return [mujoco.mj_name2id(model, kind, f'{self._robot}/{name}') for name in names]


def reader(array: np.ndarray, indices: Sequence[int]) -> Reader:
    """Return a function that reads elements of an array as Python floats."""
    if not indices:
        return list
    first, end = min(indices), max(indices) + 1
    view = array[first:end]
    if list(indices) == list(range(first, end)):
        return view.tolist
    pick = itemgetter(*(index - first for index in indices))
    return lambda: list(pick(view.tolist()))


def writer(array: np.ndarray, indices: Sequence[int]) -> Writer:
    """Return a function that writes elements of an array."""
    first, end = min(indices, default=0), max(indices, default=-1) + 1
    if sorted(indices) != list(range(first, end)) or len(indices) < 2:
        where: Any = list(indices)

        def scatter(values: Sequence[float]) -> None:
            array[where] = values

        return scatter
    # A permuted range is written as a slice, three times faster than by index.
    view = array[first:end]
    pick = itemgetter(*(indices.index(index) for index in range(first, end)))

    def write(values: Sequence[float]) -> None:
        view[:] = pick(values)

    return write
