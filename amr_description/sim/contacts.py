# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
What touches some collisions of a robot: points, normals, forces and depths, as contact sensors
report them.
"""

from collections.abc import Sequence
from dataclasses import dataclass

import mujoco
import numpy as np

from amr_description.model.collision_names import CollisionKey, gazebo_name
from amr_description.model.frames import Vector
from amr_description.sim.robot_view import RobotView
from amr_description.sim.world import MujocoWorld


@dataclass(frozen=True, slots=True)
class ContactPoint:
    """One point of a contact, in the frame of the world."""

    position: Vector
    """m."""
    normal: Vector
    """A unit vector towards the sensor's own collision: the way in which it is pushed."""
    force: Vector
    """N, on the sensor's own collision; the opposite acts on the other one."""
    depth: float
    """m, of the penetration; ≥ 0."""


@dataclass(frozen=True, slots=True)
class Contact:
    """Two collisions that touch; names as Gazebo has them: ``model::link::collision``."""

    own: str
    own_id: int
    """Unique in the world, > 0, as long as no robot comes or goes."""
    other: str
    other_id: int
    points: tuple[ContactPoint, ...]


class ContactReader:
    """Reads what touches some collisions of one robot; valid as long as its view is."""

    def __init__(
        self, world: MujocoWorld, robot: RobotView, collisions: Sequence[CollisionKey]
    ) -> None:
        """
        Take a sensor.

        Args:
            world: The simulated world.
            robot: That has the sensor.
            collisions: Links and numbers, see :mod:`amr_description.model.collision_names`.
        """
        self._world = world
        self._robot = robot
        self._collisions = frozenset(collisions)
        self._generation = -1
        self._own: frozenset[int] = frozenset()
        self._names: dict[int, str] = {}
        self._force = np.empty(6)

    def read(self) -> tuple[Contact, ...]:
        """
        Return what pushes, or rubs against, the collisions: those of the last physics step.

        A contact without a force, of shapes that are near each other only, is none.
        """
        engine = self._world.engine
        if self._generation != engine.generation:
            self._bind()
        touching = engine.data.contact
        # Each list is read once as a whole: one element of a MuJoCo array costs 0.3 µs.
        geoms = touching.geom.tolist() if engine.data.ncon else []
        own = self._own
        mine = [index for index, pair in enumerate(geoms) if not own.isdisjoint(pair)]
        if not mine:
            return ()
        positions, frames = touching.pos.tolist(), touching.frame.tolist()
        depths = touching.dist.tolist()
        found: dict[tuple[int, int], list[ContactPoint]] = {}
        for index in mine:
            first, second = geoms[index]
            # The normal points to the second geom, and that is the one that the force acts on.
            pair, sign = ((first, second), -1.0) if first in own else ((second, first), 1.0)
            force = self._force_at(index, frames[index], sign)
            if force is not None:
                x, y, z = positions[index]
                nx, ny, nz = (sign * value for value in frames[index][:3])
                point = ContactPoint((x, y, z), (nx, ny, nz), force, max(0.0, -depths[index]))
                found.setdefault(pair, []).append(point)
        return tuple(
            Contact(self._name(its), its + 1, self._name(other), other + 1, tuple(points))
            for (its, other), points in found.items()
        )

    def _force_at(self, index: int, axes: Sequence[float], sign: float) -> Vector | None:
        """
        Return the force of a contact of MuJoCo in the world, N; None: it has none.

        Args:
            index: Its number.
            axes: Normal and tangents by rows.
            sign: 1: on the second geom; -1: on the first one.
        """
        mujoco.mj_contactForce(
            self._world.engine.model, self._world.engine.data, index, self._force
        )
        normal, along, across, *_ = self._force.tolist()
        if normal <= 0.0:
            return None
        nx, ny, nz, ax, ay, az, bx, by, bz = axes
        return (
            sign * (normal * nx + along * ax + across * bx),
            sign * (normal * ny + along * ay + across * by),
            sign * (normal * nz + along * az + across * bz),
        )

    def _bind(self) -> None:
        """Look up the geoms of the collisions; repeated after every recompile."""
        geoms = geoms_of(self._world, self._robot)
        self._own = frozenset(geom for geom, key in geoms.items() if key in self._collisions)
        self._names.clear()
        self._generation = self._world.engine.generation

    def _name(self, geom: int) -> str:
        """Return the name of a geom, looked up once."""
        name = self._names.get(geom)
        if name is None:
            name = self._names[geom] = _scoped_name(self._world, geom)
        return name


def geoms_of(world: MujocoWorld, robot: RobotView) -> dict[int, CollisionKey]:
    """Return the collisions of a robot by the numbers of their geoms in the present model."""
    model = world.engine.model
    found: dict[int, CollisionKey] = {}
    for link, numbers in robot.collisions.items():
        body = mujoco.mj_name2id(model, mujoco.mjtObj.mjOBJ_BODY, f'{robot.name}/{link}')
        if body <= 0:
            continue  # of a root called world: it is the world itself
        first = int(model.body_geomadr[body])
        found |= {
            first + index: (link, number) for index, number in enumerate(numbers) if number >= 0
        }
    return found


def _scoped_name(world: MujocoWorld, geom: int) -> str:
    """Return ``model::link::collision`` of a geom, of a robot or of the world."""
    model = world.engine.model
    body = int(model.geom_bodyid[geom])
    robot, is_inside, link = model.body(body).name.partition('/')
    if is_inside and robot in world.names:
        view = world.robot(robot)
        key = geoms_of(world, view).get(geom)
        if key is not None:
            return f'{robot}::{link}::{gazebo_name(view.description.link(link), key[1])}'
    name = model.geom(geom).name or f'collision_{geom - int(model.body_geomadr[body])}'
    if body == 0:  # as Gazebo's ground_plane::link::collision
        return f'{name}::link::collision'
    root = model.body(int(model.body_rootid[body])).name
    return f'{root}::{model.body(body).name}::{name}'
