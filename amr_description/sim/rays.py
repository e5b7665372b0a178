# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
Rays into the world, for whatever looks at it: lidars, range finders, cameras without OpenGL.

What a ray meets is what is visible, as in Gazebo's rendered sensors:

- of the world what MuJoCo's viewer shows, the geoms in groups 0 to 2, moving or not: also meshes,
  by their true triangles, and height fields, as in :mod:`amr_description.sim.terrain`;
- of a robot its visuals, true meshes as well; its collisions are not seen, so that a hull around
  a fork does not close the gap. A robot that has no visual at all is seen by its collisions.

What is wholly transparent is not seen.

:class:`RayScene` is bound to one model, so to one :attr:`Engine.generation`;
:meth:`MujocoWorld.ray_scene` has the present one. MuJoCo lets go of the GIL while it casts, and
cost is linear in rays: 360 take 0.12 ms in the world ``warehouse``, 16 × 1024 take 4.8 ms.
"""

from collections.abc import Callable, Collection, Sequence
import copy
from dataclasses import dataclass
import math
from typing import Self, TypeAlias

import mujoco
import numpy as np
from numpy.typing import NDArray

from amr_description.sim.terrain import Terrain, terrains

Floats: TypeAlias = NDArray[np.float64]
Mask: TypeAlias = NDArray[np.int32]
"""Which geoms are met: a geom group for each, ``_SEEN`` or ``_UNSEEN``."""

_SEEN, _UNSEEN = 0, 1
_GROUPS = np.array([1, 0, 0, 0, 0, 0], np.uint8)
_VISUAL_GROUP = 1
"""MuJoCo's URDF reader puts visuals into this geom group, collisions into group 0."""
_FIRST_HIDDEN_GROUP = 3
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
            model: Is left as it is, except while rays are cast: then its geom groups say what
                they meet, and the bounds of its bodies what they may meet.
            data: Its kinematics have to be up to date now, and whenever rays are cast.
            robots: Their names, which prefix those of their bodies.
        """
        self.model, self.data = model, data
        self._robots = tuple(robots)
        self.colors = _colors(model)
        """(geoms, 4): red, green, blue, alpha of each geom in 0..1; textures do not count."""
        self._owners = _owners(model, self._robots)
        self._own_groups = model.geom_group.copy()
        seen = (self.colors[:, 3] > 0.0) & (self._own_groups < _FIRST_HIDDEN_GROUP)
        for index in range(len(self._robots)):
            own = self._owners == index
            visuals = own & (self._own_groups == _VISUAL_GROUP)
            if visuals.any():
                seen &= ~own | visuals
        self.all_seen: Mask = np.where(seen, _SEEN, _UNSEEN).astype(np.int32)
        self._bounds, self._own_bounds, self._true_bounds = _bounds(model, data)
        self._terrains: tuple[Terrain, ...] | None = None

    def copy(self) -> Self:
        """Return a scene with a model and poses of its own, for another thread; see `take`."""
        twin = copy.copy(self)
        twin.model = copy.copy(self.model)
        twin.data = mujoco.MjData(twin.model)
        twin._terrains = None  # noqa: SLF001
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

    def cast_each_at_start(self, mask: Mask) -> Callable[[Floats, Floats], Hits]:
        """
        Return what casts each ray from a point of its own, of a scene that is :meth:`at_start`.

        It takes origins (n, 3) and directions (n, 3), and gives the normals, too.

        Args:
            mask: Which geoms are met.
        """
        from mujoco.batch import Batch  # a fiftieth of a start; few sensors have a use for it

        self.model.geom_group[:] = mask
        try:
            batch = Batch(self.model, nsim=1, nthread=1)  # it copies the model
        finally:
            self.model.geom_group[:] = self._own_groups

        def cast(origins: Floats, directions: Floats) -> Hits:
            each = batch.ray(origins, directions, geomgroup=_GROUPS, normal=True)
            distances, geoms, normals = (part[0] for part in each)
            return Hits(distances, geoms, normals)

        return cast

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

    def is_seen(self) -> NDArray[np.bool_]:
        """Return which geoms are visible."""
        return self.all_seen == _SEEN

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
        groups = self.all_seen if mask is None else mask
        if self._terrains is None:
            self._terrains = terrains(self.model)
        fields = [each for each in self._terrains if groups[each.geom] == _SEEN]
        if fields:
            groups = groups.copy()
            groups[[each.geom for each in fields]] = _UNSEEN
        model, bounds = self.model, self._bounds
        model.geom_group[:] = groups
        model.bvh_aabb[bounds] = self._true_bounds
        try:
            hits = _cast(model, self.data, origin, directions, cutoff, normals=normals)
        finally:
            model.geom_group[:] = self._own_groups
            model.bvh_aabb[bounds] = self._own_bounds
        for field in fields:
            self._cast_at(field, hits, origin, directions, cutoff)
        return hits

    def _cast_at(
        self, field: Terrain, hits: Hits, origin: Floats, directions: Floats, cutoff: float
    ) -> None:
        """Cast the same rays at a height field, and write what they meet first into ``hits``."""
        turn = self.data.geom_xmat[field.geom].reshape(3, 3)
        start = (origin - self.data.geom_xpos[field.geom]) @ turn
        rays, normals = directions @ turn, hits.normals is not None
        there = _cast(field.model, field.data, start, rays, cutoff, normals=normals)
        is_first = (there.geoms >= 0) & ((hits.geoms < 0) | (there.distances < hits.distances))
        hits.geoms[is_first] = field.geom
        hits.distances[is_first] = there.distances[is_first]
        if hits.normals is not None and there.normals is not None:
            hits.normals[is_first] = there.normals[is_first] @ turn.T


def _cast(
    model: mujoco.MjModel,
    data: mujoco.MjData,
    origin: Floats,
    directions: Floats,
    cutoff: float,
    *,
    normals: bool,
) -> Hits:
    """Cast rays at the geoms that are in the group ``_SEEN``."""
    count = len(directions)
    distances, geoms = np.empty(count), np.empty(count, np.int32)
    found = np.empty(3 * count) if normals else None
    rays = np.ascontiguousarray(directions, np.float64).reshape(-1)
    mujoco.mj_multiRay(
        model, data, origin, rays, _GROUPS, True, -1,
        geoms, distances, found, count, min(cutoff, _FARTHEST),
    )  # fmt: skip
    return Hits(distances, geoms, None if found is None else found.reshape(-1, 3))


def _colors(model: mujoco.MjModel) -> Floats:
    """Return the color of each geom's material, or else of the geom."""
    colors = model.geom_rgba.astype(np.float64)
    material = model.geom_matid
    has_one = material >= 0
    colors[has_one] = model.mat_rgba[material[has_one]]
    return colors


def _bounds(model: mujoco.MjModel, data: mujoco.MjData) -> tuple[NDArray[np.intp], Floats, Floats]:
    """
    Return the bounds with which bodies are culled: indices, as they are, as they should be.

    ``mj_multiRay`` (4.0.0) takes no ray for a body that passes by the box around those geoms of it
    that collide, even if it has others, such as visuals.
    """
    collides = (model.geom_contype != 0) | (model.geom_conaffinity != 0)
    bodies = [
        int(body)
        for body in np.unique(model.geom_bodyid[~collides])
        if model.body_bvhadr[body] >= 0
    ]
    rows = model.body_bvhadr[bodies].astype(np.intp)
    true_bounds = [_bounds_of(model, data, body) for body in bodies]
    return rows, model.bvh_aabb[rows].copy(), np.array(true_bounds).reshape(-1, 6)


_CORNERS = np.array([[i, j, k] for i in (-1, 1) for j in (-1, 1) for k in (-1, 1)])
_UNBOUNDED = np.array([0.0, 0.0, 0.0, 1e8, 1e8, 1e8])


def _bounds_of(model: mujoco.MjModel, data: mujoco.MjData, body: int) -> Floats:
    """Return centre and half extents of the box around all geoms, in the inertial frame."""
    first = model.body_geomadr[body]
    geoms = np.arange(first, first + model.body_geomnum[body])
    if (model.geom_type[geoms] == mujoco.mjtGeom.mjGEOM_PLANE).any():
        return _UNBOUNDED
    boxes = model.geom_aabb[geoms]
    corners = boxes[:, None, :3] + boxes[:, None, 3:] * _CORNERS
    turns = data.geom_xmat[geoms].reshape(-1, 3, 3)
    points = np.einsum('gij,gcj->gci', turns, corners) + data.geom_xpos[geoms][:, None]
    local = (points.reshape(-1, 3) - data.xipos[body]) @ data.ximat[body].reshape(3, 3)
    lowest, highest = local.min(axis=0), local.max(axis=0)
    # A hair more: of flat visuals the box is flat.
    return np.concatenate(((lowest + highest) / 2.0, (highest - lowest) / 2.0 + 1e-6))


def _owners(model: mujoco.MjModel, robots: Sequence[str]) -> NDArray[np.int32]:
    """Return for each geom the index of the robot that it belongs to; -1: the world."""
    index = {name: at for at, name in enumerate(robots)}
    owners = [
        index.get(name.partition('/')[0], -1) if '/' in name else -1
        for name in (model.body(body).name for body in range(model.nbody))
    ]
    return np.array(owners, np.int32)[model.geom_bodyid]
