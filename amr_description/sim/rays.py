# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
Rays into the world, for whatever looks at it: lidars, range finders, cameras without OpenGL.

What a ray meets is what is visible, as in Gazebo's rendered sensors:

- of the world each geom that is not wholly transparent, moving or not: also meshes, by their true
  triangles, and height fields;
- of a robot its visuals, true meshes as well; its collisions are not seen, so that a hull around
  a fork does not close the gap. A robot that has no visual at all is seen by its collisions.

:class:`RayScene` is bound to one model, so to one :attr:`Engine.generation`;
:meth:`MujocoWorld.ray_scene` has the present one. MuJoCo lets go of the GIL while it casts, and
cost is linear in rays: 360 take 0.12 ms in the world ``warehouse``, 16 × 1024 take 4.8 ms.
"""

from collections.abc import Collection, Sequence
import copy
from dataclasses import dataclass
import math
from typing import Self

import mujoco
import numpy as np
from numpy.typing import NDArray

type Floats = NDArray[np.float64]
type Mask = NDArray[np.int32]
"""Which geoms are met: a geom group for each, ``_SEEN`` or ``_UNSEEN``."""

_SEEN, _UNSEEN = 0, 1
_GROUPS = np.array([1, 0, 0, 0, 0, 0], np.uint8)
_VISUAL_GROUP = 1
"""MuJoCo's URDF reader puts visuals into this geom group, collisions into group 0."""
_FARTHEST = float(mujoco.mjMAXVAL)
_POSES = (
    'xpos', 'xquat', 'xmat', 'xipos', 'ximat', 'geom_xpos', 'geom_xmat',
    'flexvert_xpos', 'bvh_aabb_dyn',
)  # fmt: skip
"""All of ``mjData`` that rays depend on."""


@dataclass(frozen=True, slots=True)
class Hits:
    """
    Where rays have met something first.

    Attributes:
        distances: (n,) m, in units of the length of the direction; -1 where nothing is met.
        geoms: (n,) ids; -1 where nothing is met.
        normals: (n, 3) of the surface in world axes, outwards, also where the ray comes from
            inside; zero where nothing is met; None unless asked for.
    """

    distances: Floats
    geoms: NDArray[np.int32]
    normals: Floats | None = None


class RayScene:
    """
    What there is to be seen in a world, and where it is at one instant.

    One thread casts into a scene at a time; another thread needs a :meth:`copy`.
    """

    def __init__(
        self, model: mujoco.MjModel, data: mujoco.MjData, robots: Sequence[str] = ()
    ) -> None:
        """
        Find out what is visible.

        Args:
            model: Is left as it is, except while rays are cast: then its geom groups, which no
                physics depends on, say what they meet.
            data: Its kinematics have to be those of the instant when rays are cast.
            robots: Their names, which prefix those of their bodies.
        """
        self.model, self.data = model, data
        self._robots = tuple(robots)
        self.colors = _colors(model)
        """(geoms, 4): red, green, blue, alpha of each geom in 0..1; textures do not count."""
        self._owners = _owners(model, self._robots)
        self._group = model.geom_group
        self._own_groups = self._group.copy()
        seen = self.colors[:, 3] > 0.0
        for index in range(len(self._robots)):
            own = self._owners == index
            visuals = own & (self._own_groups == _VISUAL_GROUP)
            if visuals.any():
                seen &= ~own | visuals
        self.all_seen: Mask = np.where(seen, _SEEN, _UNSEEN).astype(np.int32)

    def copy(self) -> Self:
        """Return a scene with a model and poses of its own, for another thread; see `take`."""
        twin = copy.copy(self)
        twin.model = copy.copy(self.model)
        twin.data = mujoco.MjData(twin.model)
        twin._group = twin.model.geom_group  # noqa: SLF001
        twin.take(self)
        return twin

    def take(self, other: 'RayScene') -> None:
        """Take over where everything is, from the scene that this is a copy of."""
        for name in _POSES:
            getattr(self.data, name)[...] = getattr(other.data, name)

    def at_start(self) -> Self:
        """Return a scene in which all joints are where the model has them, of the same model."""
        twin = copy.copy(self)
        twin.data = mujoco.MjData(self.model)
        mujoco.mj_kinematics(self.model, twin.data)
        return twin

    def pose(self, body: int) -> tuple[Floats, Floats]:
        """Return position (3,) and rotation matrix (3, 3), from a body to the world."""
        return self.data.xpos[body].copy(), self.data.xmat[body].reshape(3, 3).copy()

    def geoms_of(self, robot: str) -> NDArray[np.intp]:
        """Return the ids of all geoms of a robot."""
        return np.flatnonzero(self._owners == self._robots.index(robot))

    def geoms_fixed_to(self, robot: str, body: int) -> NDArray[np.intp]:
        """Return those of them that cannot move against one of its bodies."""
        own = self.geoms_of(robot)
        weld = self.model.body_weldid
        return own[weld[self.model.geom_bodyid[own]] == weld[body]]

    def mask(self, *, without: Collection[int] = (), only: Collection[int] | None = None) -> Mask:
        """
        Return which geoms rays shall meet: of those that are visible some.

        Args:
            without: Ids of geoms that are not met.
            only: Ids of the geoms that may be met; None: all.
        """
        mask = self.all_seen.copy()
        if only is not None:
            mask[:] = _UNSEEN
            chosen = np.asarray(only, np.intp)
            mask[chosen] = self.all_seen[chosen]
        mask[np.asarray(without, np.intp)] = _UNSEEN
        return mask

    def cast(
        self,
        origin: Floats,
        directions: Floats,
        *,
        mask: Mask | None = None,
        cutoff: float = math.inf,
        normals: bool = False,
    ) -> Hits:
        """
        Cast rays from one point.

        Args:
            origin: (3,) in the world, m.
            directions: (n, 3) in the world; distances are in units of their length.
            mask: Which geoms are met; None: all that are visible.
            cutoff: Geoms that are wholly farther away than this are not met, m.
            normals: Whether the surfaces' normals are asked for.
        """
        count = len(directions)
        distances, geoms = np.empty(count), np.empty(count, np.int32)
        found = np.empty(3 * count) if normals else None
        rays = np.ascontiguousarray(directions, np.float64).reshape(-1)
        self._group[:] = self.all_seen if mask is None else mask
        try:
            mujoco.mj_multiRay(
                self.model, self.data, origin, rays, _GROUPS, True, -1,
                geoms, distances, found, count, min(cutoff, _FARTHEST),
            )  # fmt: skip
        finally:
            self._group[:] = self._own_groups
        return Hits(distances, geoms, None if found is None else found.reshape(-1, 3))


def _colors(model: mujoco.MjModel) -> Floats:
    """Return the color of each geom's material, or else of the geom."""
    colors = model.geom_rgba.astype(np.float64)
    material = model.geom_matid
    has_one = material >= 0
    colors[has_one] = model.mat_rgba[material[has_one]]
    return colors


def _owners(model: mujoco.MjModel, robots: Sequence[str]) -> NDArray[np.int32]:
    """Return for each geom the index of the robot that it belongs to; -1: the world."""
    index = {name: at for at, name in enumerate(robots)}
    owners = [
        index.get(name.partition('/')[0], -1) if '/' in name else -1
        for name in (model.body(body).name for body in range(model.nbody))
    ]
    return np.array(owners, np.int32)[model.geom_bodyid]
