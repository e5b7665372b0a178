# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
Some joints of one robot, read and commanded in the control tick.

A read is one slice and one ``tolist()``, well below 1 µs; access by name would cost 10 µs.
"""

from collections.abc import Callable, Sequence
import math
from operator import itemgetter
from typing import Any

import mujoco
import numpy as np

from amr_description.control.contracts import Log, Severity
from amr_description.control.interfaces import VELOCITY
from amr_description.errors import SimulationError
from amr_description.sim.actuators import actuator_name, rotor_name
from amr_description.sim.engine import Engine

_JOINT = mujoco.mjtObj.mjOBJ_JOINT
_ACTUATOR = mujoco.mjtObj.mjOBJ_ACTUATOR

type Reader = Callable[[], list[float]]
type Writer = Callable[[Sequence[float]], None]


class MujocoJointGroup:
    """The :class:`~amr_description.control.contracts.JointGroup` of a simulated robot."""

    def __init__(self, engine: Engine, robot: str, names: Sequence[str], log: Log) -> None:
        """Bind these joints of ``robot``. Raises SimulationError if one is not there."""
        self._engine = engine
        self._robot = robot
        self._names = tuple(names)
        self._log = log
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
        """The actuators' generalised force during the last physics step, N·m or N."""
        if self._generation != self._engine.generation:
            self._bind()
        return self._read_efforts()

    def command_velocities(self, values: Sequence[float]) -> None:
        """
        Target velocities, rad/s or m/s, kept until the next call.

        A value beyond the joint's velocity limit is clamped, which is told once. Raises
        SimulationError if one is not finite, or if a joint takes no velocity command.
        """
        if self._generation != self._engine.generation:
            self._bind()
        for value in values:
            # False for NaN too.
            if not -self._lowest_limit <= value <= self._lowest_limit:
                self._judge(values)
                break
        self._write_velocities(values)

    def _judge(self, values: Sequence[float]) -> None:
        """Refuse what is not finite, and tell of what will be clamped."""
        for name, value, limit in zip(self._names, values, self._limits, strict=True):
            joint = f"robot '{self._robot}': joint '{name}'"
            if not math.isfinite(value):
                raise SimulationError(
                    f'{joint}: the velocity command is {value}; a finite number is needed'
                )
            if abs(value) > limit:
                self._log(
                    Severity.WARN,
                    f'{joint}: the velocity command {value:.6g} is beyond its limit of '
                    f'{limit:.6g} and is clamped; <limit velocity="…"> in the URDF sets the limit',
                    throttle=math.inf,
                )

    def _bind(self) -> None:
        """Make the views into the present model and data; again after every recompile."""
        model, data = self._engine.model, self._engine.data
        joints = self._find(_JOINT, self._names)
        self._require(joints, 'is not in the simulated world')
        dofs = [int(model.jnt_dofadr[joint]) for joint in joints]
        # Behind a slip clutch the actuator works on the rotor.
        rotors = self._find(_JOINT, [rotor_name(name) for name in self._names])
        driven = [
            dof if rotor < 0 else int(model.jnt_dofadr[rotor])
            for dof, rotor in zip(dofs, rotors, strict=True)
        ]
        self._read_positions = _reader(data.qpos, [int(model.jnt_qposadr[j]) for j in joints])
        self._read_velocities = _reader(data.qvel, dofs)
        self._read_efforts = _reader(data.qfrc_actuator, driven)
        self._bind_velocity_commands()
        self._generation = self._engine.generation

    def _bind_velocity_commands(self) -> None:
        names = [actuator_name(joint, VELOCITY) for joint in self._names]
        actuators = self._find(_ACTUATOR, names)
        if -1 not in actuators:
            limits = self._engine.model.actuator_ctrlrange[actuators, 1]
            self._limits: list[float] = limits.tolist()
            self._write_velocities = _writer(self._engine.data.ctrl, actuators)
        else:
            self._limits = [math.inf] * len(actuators)
            self._write_velocities = lambda _: self._require(
                actuators, 'takes no velocity command: its <ros2_control> block declares none'
            )
        self._lowest_limit = min(self._limits, default=math.inf)

    def _find(self, kind: mujoco.mjtObj, names: Sequence[str]) -> list[int]:
        """The indices of the robot's elements, -1 where there is none of that name."""
        model = self._engine.model
        return [mujoco.mj_name2id(model, kind, f'{self._robot}/{name}') for name in names]

    def _require(self, indices: Sequence[int], fault: str) -> None:
        for name, index in zip(self._names, indices, strict=True):
            if index < 0:
                raise SimulationError(f"robot '{self._robot}': joint '{name}' {fault}")


def _reader(array: np.ndarray, indices: Sequence[int]) -> Reader:
    """A function that reads these elements as Python floats."""
    if not indices:
        return list
    first, end = min(indices), max(indices) + 1
    view = array[first:end]
    if list(indices) == list(range(first, end)):
        return view.tolist
    pick = itemgetter(*(index - first for index in indices))
    return lambda: list(pick(view.tolist()))


def _writer(array: np.ndarray, indices: Sequence[int]) -> Writer:
    """A function that writes these elements."""
    first, end = min(indices, default=0), max(indices, default=-1) + 1
    if sorted(indices) != list(range(first, end)) or len(indices) < 2:
        where: Any = list(indices)

        def scatter(values: Sequence[float]) -> None:
            array[where] = values

        return scatter
    # A permuted run is written as a slice, which is three times faster than by index.
    view = array[first:end]
    pick = itemgetter(*(indices.index(index) for index in range(first, end)))

    def write(values: Sequence[float]) -> None:
        view[:] = pick(values)

    return write
