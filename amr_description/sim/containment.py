# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
What is done when the physics of a robot is lost: it stands still, and the others go on.

A number that is not finite spreads over the whole world within a step, as MuJoCo's solver uses one
warm start for all. So positions and velocities of the world are kept after every step that was
sound, 0.3 µs; after one that was not they are put back, and the robot in which it began is frozen:
at rest where it was, so heavy that neither gravity nor motors nor who bumps into it move it, until
a reset or its removal. The others lose the motion of that one step.
"""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import mujoco
import numpy as np

from amr_description.sim.engine import Engine

_ARMATURE = 1e12
"""kg·m² or kg, added to each degree of freedom of what is frozen: 1 kN gives it 1e-9 m/s²."""
_OF_WORLD = '/'
"""How a key begins that is no robot's name."""


@dataclass(frozen=True)
class _Frozen:
    """A robot that is frozen: indices into ``qpos`` and ``qvel``, its positions, its joints."""

    positions: np.ndarray
    values: np.ndarray
    dofs: np.ndarray
    joints: Sequence[int]


class Containment:
    """The last sound state of an engine, and what is frozen in it."""

    def __init__(self, engine: Engine) -> None:
        """Keep the present state."""
        self._engine = engine
        self._kept_at = 0
        self.holds = False
        """Whether something is frozen."""
        self._frozen: dict[str, _Frozen] = {}
        self._generation = -1
        self._inertias: list[tuple[np.ndarray, np.ndarray, np.ndarray]] = []
        self.bind()

    @property
    def frozen(self) -> tuple[str, ...]:
        """The names of the robots that are frozen."""
        return tuple(self._frozen)

    def bind(self) -> None:
        """Take the present model and state; what is frozen and still there stays so."""
        model, data = self._engine.model, self._engine.data
        before, self._frozen = self._frozen, {}
        self.holds = False
        self._restore_inertias()
        self._generation = self._engine.generation
        self._positions, self._speeds = memoryview(data.qpos), memoryview(data.qvel)
        self._activations = data.act if model.na else None
        self._kept_positions = memoryview(np.array(model.qpos0))
        self._kept_speeds = memoryview(np.zeros(model.nv))
        self._kept_activations = np.zeros(model.na)
        if np.isfinite(data.qpos).all() and np.isfinite(data.qvel).all():
            self.keep(self._engine.time)
        for robot, frozen in before.items():
            # What belongs to the file of the world comes before all robots, and may have no name.
            joints = frozen.joints if robot.startswith(_OF_WORLD) else _joints_of(model, robot)
            if len(joints):
                self._fix(robot, joints, frozen.values)

    def keep(self, time: int) -> None:
        """Keep the present state, which is sound; ``time``: now, ns."""
        self._kept_positions[:] = self._positions
        self._kept_speeds[:] = self._speeds
        if self._activations is not None:
            self._kept_activations[:] = self._activations
        self._kept_at = time

    def freeze(self, robot: str, dof: int) -> int:
        """
        Put the world back to its last sound state, and a robot at rest there.

        Args:
            robot: Its name; empty: what belongs to the file of the world, of which the bodies
                that hang together are frozen.
            dof: Index into ``qvel`` of a degree of freedom of it.

        Returns:
            The time of that state, ns.
        """
        model, data = self._engine.model, self._engine.data
        self._positions[:] = self._kept_positions
        self._speeds[:] = self._kept_speeds
        data.act[:] = self._kept_activations
        data.qacc[:] = data.qacc_warmstart[:] = data.qfrc_applied[:] = 0.0
        joints = _joints_of(model, robot) if robot else _joints_of_tree(model, dof)
        key = robot or f'{_OF_WORLD}{joints[0]}'
        if key not in self._frozen:
            self._fix(key, joints, None)
        self.hold()
        # All that follows from the state, for who reads it before the next step.
        mujoco.mj_forward(model, data)
        self._engine.invalidate_kinematics()
        return self._kept_at

    def hold(self) -> None:
        """Have what is frozen be where it was, at rest; after every step."""
        data = self._engine.data
        for each in self._frozen.values():
            data.qpos[each.positions] = each.values
            data.qvel[each.dofs] = 0.0

    def end(self, robot: str = '') -> None:
        """Let a robot, or all, move again, from the present state on."""
        self._frozen = {} if not robot else _without(self._frozen, robot)
        self.bind()

    def _restore_inertias(self) -> None:
        model = self._engine.model
        if self._generation == self._engine.generation:  # else it was compiled anew
            for dofs, armature, inertia in self._inertias:
                model.dof_armature[dofs], model.dof_M0[dofs] = armature, inertia
        self._inertias = []

    def _fix(self, robot: str, joints: Sequence[int], values: np.ndarray | None) -> None:
        """``values``: the positions; None: the present ones."""
        model, data = self._engine.model, self._engine.data
        positions = np.array(_indices(model.jnt_qposadr, joints, model.nq), dtype=int)
        dofs = np.array(_indices(model.jnt_dofadr, joints, model.nv), dtype=int)
        self.holds = True
        self._inertias.append((dofs, model.dof_armature[dofs], model.dof_M0[dofs]))
        model.dof_armature[dofs] += _ARMATURE
        model.dof_M0[dofs] += _ARMATURE  # what the mass of simple bodies is taken from
        self._frozen[robot] = _Frozen(
            positions, data.qpos[positions] if values is None else values, dofs, joints
        )


def _without(frozen: Mapping[str, _Frozen], robot: str) -> dict[str, _Frozen]:
    return {name: each for name, each in frozen.items() if name != robot}


def _joints_of(model: mujoco.MjModel, robot: str) -> list[int]:
    """Return the joints of a robot, in order."""
    prefix = f'{robot}/'
    return [each for each in range(model.njnt) if model.joint(each).name.startswith(prefix)]


def _joints_of_tree(model: mujoco.MjModel, dof: int) -> list[int]:
    """Return the joints of the bodies that hang together with a degree of freedom, in order."""
    trees = model.dof_treeid[model.jnt_dofadr]
    return [int(each) for each in np.flatnonzero(trees == model.dof_treeid[dof])]


def _indices(starts: np.ndarray, joints: Sequence[int], end: int) -> list[int]:
    """Return the indices that joints have, by where each begins; ``end``: of the last."""
    ends = [*starts[1:].tolist(), end]
    return [index for joint in joints for index in range(int(starts[joint]), ends[joint])]
