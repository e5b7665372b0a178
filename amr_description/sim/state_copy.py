# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
Copies of the state of a world at an instant, from which another thread measures.

The control thread copies only what poses follow from, which takes microseconds; the other thread
computes the poses, in a ``mjData`` of its own. The model is copied once for each generation of it,
as rays change its geom groups while they are cast.
"""

import copy
from dataclasses import dataclass

import mujoco
import numpy as np

from amr_description.sim.rays import RayScene
from amr_description.sim.world import MujocoWorld

_POSITIONS = ('qpos', 'mocap_pos', 'mocap_quat')
"""What poses follow from."""


@dataclass(frozen=True, slots=True, eq=False)
class StateCopy:
    """The state of a world at one instant, as far as poses follow from it."""

    model: mujoco.MjModel
    """For the thread that measures; the same object until a robot comes or goes."""
    time: int
    """ns."""
    qpos: np.ndarray
    mocap_pos: np.ndarray
    mocap_quat: np.ndarray
    robots: frozenset[str]
    """Their names, with which and a slash the names of their bodies begin."""


class StateCopier:
    """Makes one copy of each instant that somebody asks for; on the control thread."""

    def __init__(self, world: MujocoWorld) -> None:
        """``world``: whose state is copied."""
        self._world = world
        self._generation = -1
        self._latest: StateCopy | None = None

    def copy(self) -> StateCopy:
        """Return the present state; the same object to all who ask at the same instant."""
        engine, latest = self._world.engine, self._latest
        data = engine.data
        if latest is None or self._generation != engine.generation:
            self._generation = engine.generation
            model = copy.copy(engine.model)
        elif latest.time == engine.time and all(
            np.array_equal(getattr(latest, name), getattr(data, name)) for name in _POSITIONS
        ):
            return latest
        else:
            model = latest.model
        self._latest = StateCopy(
            model,
            engine.time,
            data.qpos.copy(),
            data.mocap_pos.copy(),
            data.mocap_quat.copy(),
            frozenset(self._world.names),
        )
        return self._latest


class CopiedPoses:
    """The poses that follow from copies; on the thread that measures."""

    def __init__(self) -> None:
        """Nothing is there yet."""
        self._state: StateCopy | None = None
        self._data: mujoco.MjData | None = None

    def data(self, state: StateCopy) -> mujoco.MjData:
        """Return data with the poses of bodies, geoms, sites, cameras and lights of a copy."""
        if self._data is None or self._state is None or self._state.model is not state.model:
            self._data = mujoco.MjData(state.model)
        if state is not self._state:
            data = self._data
            data.qpos[:] = state.qpos
            data.mocap_pos[:], data.mocap_quat[:] = state.mocap_pos, state.mocap_quat
            mujoco.mj_kinematics(state.model, data)
            mujoco.mj_comPos(state.model, data)
            mujoco.mj_camlight(state.model, data)
            self._state = state
        return self._data


class CopiedScenes:
    """What can be seen in copies; on the thread that measures."""

    def __init__(self) -> None:
        """Nothing is there yet."""
        self._poses = CopiedPoses()
        self._scene: RayScene | None = None

    def scene(self, state: StateCopy) -> RayScene:
        """Return the scene at the instant of a copy; the same object, for the same model."""
        data = self._poses.data(state)
        if self._scene is None or self._scene.model is not state.model:
            self._scene = RayScene(state.model, data, sorted(state.robots))
        return self._scene
