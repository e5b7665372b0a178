# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
Finds whether a robot is spawned inside something else, the height at which it is free, and how far
it would drop.

Its contacts would throw it out: measured, a robot 2 mm inside the ground comes up by 0.4 mm, one
10 mm inside hops by 13 mm, and one 50 mm inside by 420 mm.
"""

import copy
from dataclasses import dataclass, replace
import math

import mujoco
import numpy as np

from amr_description.errors import SpawnError
from amr_description.sim.engine import Engine
from amr_description.sim.spawning import SpawnCode

TOLERANCE = 0.002
"""m; a smaller overlap is accepted."""

_MAX_LIFTS = 50
_DEEPEST_DROP = 1.0
"""m; a robot that is higher above everything is not meant to stand on it."""
_TOUCHING = 1e-6
"""m."""
_NO_DISTANCE = (mujoco.mjtGeom.mjGEOM_HFIELD, mujoco.mjtGeom.mjGEOM_SDF)
"""Shapes to which MuJoCo measures no distance."""


@dataclass(frozen=True, slots=True)
class Overlap:
    """The overlap of a link with something that is not of its robot."""

    link: str
    other: str
    """What the link is inside of, as text for a message."""
    is_robot: bool
    depth: float
    """m."""
    lift: float | None = None
    """How much higher the robot is free, m; None: it is inside a robot, or there is none."""

    def warning(self, robot: str) -> str:
        """Return what is told of a robot of this name that was put here."""
        return (
            f"'{robot}' was put inside {self.other}: its link '{self.link}' is "
            f'{self.depth:.3f} m deep in it, and will be thrown out'
        )

    def error(self, robot: str) -> SpawnError:
        """Return the refusal to spawn a robot of this name."""
        remedy = 'spawn it elsewhere'
        if self.lift is not None:
            remedy = f'raise z by {self.lift:.3f} m, or spawn it elsewhere'
        return SpawnError(
            f"'{robot}' would be spawned inside {self.other}: its link '{self.link}' is "
            f'{self.depth:.3f} m deep in it; {remedy}',
            SpawnCode.INVALID_POSE,
        )


def find_overlap(engine: Engine, robot: str) -> Overlap | None:
    """Return the deepest overlap of ``robot`` with the world or a robot; nothing is changed."""
    probe = _OverlapProbe(engine, robot)
    found = probe.deepest()
    if found is None or found.is_robot:
        return found
    return replace(found, lift=probe.lift())


def deepest_overlap(engine: Engine, robot: str) -> Overlap | None:
    """Return what :func:`find_overlap` does, without the height at which the robot is free."""
    return _OverlapProbe(engine, robot).deepest()


def find_drop(engine: Engine, robot: str) -> float:
    """
    Return how much lower a robot touches what is below it, m; nothing is changed.

    0: it touches something, stands fixed, or has nothing below it within :data:`_DEEPEST_DROP`.
    """
    return _OverlapProbe(engine, robot).drop()


class _OverlapProbe:
    """A copy of the present state, so that the world itself does not change."""

    def __init__(self, engine: Engine, robot: str) -> None:
        self._model = engine.model
        self._data = mujoco.MjData(engine.model)
        self._prefix = f'{robot}/'
        self._data.qpos[:] = engine.data.qpos
        self._data.mocap_pos[:] = engine.data.mocap_pos
        self._data.mocap_quat[:] = engine.data.mocap_quat

    def deepest(self) -> Overlap | None:
        """Return the deepest overlap, or None where the robot is free."""
        mujoco.mj_kinematics(self._model, self._data)
        mujoco.mj_comPos(self._model, self._data)
        mujoco.mj_collision(self._model, self._data)
        worst: Overlap | None = None
        contacts = self._data.contact
        for distance, geoms in zip(contacts.dist.tolist(), contacts.geom.tolist(), strict=True):
            if distance >= -TOLERANCE or (worst is not None and -distance <= worst.depth):
                continue
            own, other = sorted(geoms, key=lambda geom: not self._is_own(self._body_of(geom)))
            if self._is_own(self._body_of(own)) and not self._is_own(self._body_of(other)):
                link = self._body_of(own).removeprefix(self._prefix)
                worst = Overlap(link, *self._describe(other), depth=-distance)
        return worst

    def lift(self) -> float | None:
        """Return how much higher the robot is free, m; None if no such height is found."""
        # A robot that stands fixed is lifted in the model, so that must be a copy.
        self._model = copy.copy(self._model)
        lifted = 0.0
        for _ in range(_MAX_LIFTS):
            found = self.deepest()
            if found is None:
                # Whole millimetres: the number in the message is then sufficient.
                return lifted
            step = max(0.001, round(found.depth, 3))
            self._raise(step)
            lifted += step
        return None

    def drop(self) -> float:
        """Return how much lower it touches something, m; see :func:`find_drop`."""
        model = self._model
        if not any(self._is_free(body) for body in self._roots()):
            return 0.0
        lowered = 0.0
        for _ in range(_MAX_LIFTS):
            mujoco.mj_kinematics(model, self._data)
            # Straight down it is at least as far as to the nearest point of anything.
            distance = self._distance()
            if distance < _TOUCHING:
                return lowered
            lowered += distance
            if lowered >= _DEEPEST_DROP:
                return 0.0
            self._raise(-distance)
        return lowered

    def _distance(self) -> float:
        """Return how far the robot is from the nearest shape that it may touch, m."""
        model, data = self._model, self._data
        own = np.array([self._is_own(self._body_of(geom)) for geom in range(model.ngeom)], bool)
        if np.isin(model.geom_type[~own], _NO_DISTANCE).any():
            return _DEEPEST_DROP
        may = model.geom_contype[:, None] & model.geom_conaffinity
        mine, others = np.nonzero((may | may.T) & (own[:, None] & ~own))
        apart = np.linalg.norm(data.geom_xpos[mine] - data.geom_xpos[others], axis=1)
        # At least so far; a plane has no bound, and is asked first.
        apart -= model.geom_rbound[mine] + model.geom_rbound[others]
        apart[model.geom_rbound[others] == 0.0] = -math.inf
        nearest = _DEEPEST_DROP
        for pair in np.argsort(apart, kind='stable').tolist():
            if apart[pair] >= nearest:
                break
            geoms = int(mine[pair]), int(others[pair])
            nearest = min(
                nearest, mujoco.mj_geomDistance(model, data, *geoms, _DEEPEST_DROP, None)
            )
        return nearest

    def _raise(self, height: float) -> None:
        model = self._model
        for body in self._roots():
            if self._is_free(body):
                self._data.qpos[model.jnt_qposadr[model.body_jntadr[body]] + 2] += height
            else:
                model.body_pos[body, 2] += height

    def _roots(self) -> list[int]:
        """Return the bodies of the robot that hang on none."""
        model = self._model
        roots = np.flatnonzero(model.body_parentid == 0).tolist()
        return [body for body in roots if body and self._is_own(model.body(body).name)]

    def _is_free(self, body: int) -> bool:
        model = self._model
        return bool(
            model.body_jntnum[body]
            and model.jnt_type[model.body_jntadr[body]] == mujoco.mjtJoint.mjJNT_FREE
        )

    def _body_of(self, geom: int) -> str:
        return self._model.body(int(self._model.geom_bodyid[geom])).name

    def _is_own(self, body: str) -> bool:
        return body.startswith(self._prefix)

    def _describe(self, geom: int) -> tuple[str, bool]:
        """Return what a geom belongs to, and whether that is a robot."""
        robot, _, link = self._body_of(geom).partition('/')
        if link:
            return f"link '{link}' of robot '{robot}'", True
        return f"'{self._model.geom(geom).name or robot}' of the world", False
