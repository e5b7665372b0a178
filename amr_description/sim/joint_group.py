# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
Some joints of one robot, read and commanded in the control tick.

A read is one slice and one ``tolist()`` (about 0.3 µs); access by name would cost 10 µs.
"""

from collections.abc import Callable, Sequence
import math
from operator import itemgetter
from typing import Any

import mujoco
import numpy as np

from amr_description.errors import SimulationError
from amr_description.sim.actuators import actuator_name
from amr_description.sim.engine import Engine

type Reader = Callable[[], list[float]]
type Writer = Callable[[Sequence[float]], None]


class MujocoJointGroup:
    """The :class:`~amr_description.control.contracts.JointGroup` of a simulated robot."""

    def __init__(self, engine: Engine, prefix: str, names: Sequence[str]) -> None:
        """Bind the joints ``names`` of the robot whose elements begin with ``prefix``."""
        self._engine = engine
        self._prefix = prefix
        self._names = tuple(names)
        self._generation = -1
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
        Target velocities, rad/s or m/s, kept until the next call; the joint's limit bounds them.
        Raises SimulationError if one is not finite or a joint takes no velocity command.
        """
        if self._generation != self._engine.generation:
            self._bind()
        if not math.isfinite(sum(values)):
            self._refuse(values)
        self._write_velocities(values)

    def _refuse(self, values: Sequence[float]) -> None:
        commands = zip(self._names, values, strict=True)
        joint, value = next(
            ((n, v) for n, v in commands if not math.isfinite(v)), (self._names[0], values[0])
        )
        raise SimulationError(
            f"joint '{joint}': the velocity command is {value}; a finite number is needed"
        )

    def _bind(self) -> None:
        """Make the views into the present model and data; again after every recompile."""
        model, data = self._engine.model, self._engine.data
        joints = [_find(model, mujoco.mjtObj.mjOBJ_JOINT, self._prefix + n) for n in self._names]
        self._require(joints, 'is not in the simulated robot')
        dofs = [int(model.jnt_dofadr[joint]) for joint in joints]
        self._read_positions = _reader(data.qpos, [int(model.jnt_qposadr[j]) for j in joints])
        self._read_velocities = _reader(data.qvel, dofs)
        self._read_efforts = _reader(data.qfrc_actuator, dofs)
        self._write_velocities = self._bind_command('velocity')
        self._generation = self._engine.generation

    def _bind_command(self, interface: str) -> Writer:
        names = [self._prefix + actuator_name(joint, interface) for joint in self._names]
        model = self._engine.model
        actuators = [_find(model, mujoco.mjtObj.mjOBJ_ACTUATOR, name) for name in names]
        if -1 not in actuators:
            return _writer(self._engine.data.ctrl, actuators)

        def refuse(_: Sequence[float]) -> None:
            self._require(actuators, f'takes no {interface} command')

        return refuse

    def _require(self, found: Sequence[int], fault: str) -> None:
        missing = [n for n, index in zip(self._names, found, strict=True) if index < 0]
        if missing:
            raise SimulationError(f"robot '{self._prefix[:-1]}': joint '{missing[0]}' {fault}")


def _find(model: mujoco.MjModel, kind: mujoco.mjtObj, name: str) -> int:
    """The index of an element, -1 when there is none of that name."""
    return mujoco.mj_name2id(model, kind, name)


def _is_run(indices: Sequence[int]) -> bool:
    """Whether the indices are consecutive, so that a slice holds exactly them, in order."""
    return list(indices) == list(range(indices[0], indices[0] + len(indices)))


def _reader(array: np.ndarray, indices: Sequence[int]) -> Reader:
    """A function that reads these elements as Python floats."""
    if not indices:
        return list
    first, end = min(indices), max(indices) + 1
    view = array[first:end]
    if _is_run(indices):
        return view.tolist
    pick = itemgetter(*(index - first for index in indices))
    return lambda: list(pick(view.tolist()))


def _writer(array: np.ndarray, indices: Sequence[int]) -> Writer:
    """A function that writes these elements."""
    where: Any = list(indices)
    if indices and _is_run(indices):
        where = slice(indices[0], indices[-1] + 1)

    def write(values: Sequence[float]) -> None:
        array[where] = values

    return write
