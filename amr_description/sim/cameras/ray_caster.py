# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
Where the rays of a camera end: each shape is tried only by the rays that may meet it.

``mj_multiRay`` tries all shapes with every ray, 30 ms for 320 x 240 in ``warehouse``; this takes 4
to 8. The rays of a camera are a grid: a shape has a rectangle in the picture, and its depth there
is a formula for arrays (:mod:`amr_description.sim.cameras.ray_caster`); the nearest of all counts.
Meshes and height fields are left to MuJoCo, within their rectangles, as far as nothing is nearer.

Surfaces are met from outside only, see :mod:`amr_description.sim.cameras.ray_renderer`.
"""

from abc import ABC, abstractmethod
from collections.abc import Iterator
from dataclasses import dataclass, field

import mujoco
import numpy as np

from amr_description.sim.cameras.screen import Area, Screen
from amr_description.sim.rays import RayScene

# --- The surfaces of simple shapes ---------------------------------------------------------------
#
# A box shows at most three of its sides, a cylinder its side and one end. Each surface returns the
# depth of every ray of an area that meets it, NaN or less than 0 of the others; formulas of
# analytic geometry, with the ray ``origin + depth · direction`` in the axes of the shape.

_Type = mujoco.mjtGeom
SIMPLE = frozenset(
    int(each)
    for each in (
        _Type.mjGEOM_PLANE, _Type.mjGEOM_SPHERE, _Type.mjGEOM_CAPSULE, _Type.mjGEOM_ELLIPSOID,
        _Type.mjGEOM_CYLINDER, _Type.mjGEOM_BOX,
    )
)  # fmt: skip
"""The types of geoms that have surfaces here."""


@dataclass(frozen=True, slots=True)
class Sight:
    """
    How a camera sees the axes of a shape.

    Attributes:
        origin: (3,): the camera, in these axes, m.
        turn: (3, 3): from the sensor's axes to these.
    """

    origin: np.ndarray
    turn: np.ndarray


class Surface(ABC):
    """One surface of a shape."""

    @abstractmethod
    def depths(self, screen: Screen, area: Area, sight: Sight) -> np.ndarray:
        """Return where the rays of an area meet it, (rows, columns)."""

    @abstractmethod
    def normals(self, points: np.ndarray) -> np.ndarray:
        """Return the normals at points (n, 3) of it, outward, of any length: (n, 3) or (3,)."""

    def corners(self) -> np.ndarray | None:
        """Return corners (n, 3) between which it lies; None: those of the whole shape."""
        return None


@dataclass(frozen=True, slots=True)
class Flat(Surface):
    """
    A rectangle or a disc across an axis of the shape, or all of a plane.

    ``size``: half the sides along the two other axes, in their order, or inf; of a disc twice its
    radius.
    """

    axis: int
    place: float
    sign: float
    size: tuple[float, float]
    is_disc: bool = False

    def depths(self, screen: Screen, area: Area, sight: Sight) -> np.ndarray:
        """Return where the rays of an area meet it, (rows, columns)."""
        away = self.place - float(sight.origin[self.axis])
        depth = away / screen.linear(sight.turn[self.axis], area)
        outside = np.zeros(depth.shape, bool)
        radius2 = np.zeros(1)
        for axis, size in zip(_OTHERS[self.axis], self.size, strict=True):
            if np.isinf(size):
                continue
            along = screen.linear(sight.turn[axis], area)
            along *= depth
            along += float(sight.origin[axis])
            if self.is_disc:
                radius2 = radius2 + along * along
            else:
                outside |= np.abs(along, out=along) > size
        if self.is_disc:
            outside = radius2 > self.size[0] ** 2
        depth[outside] = -1.0
        return np.asarray(depth)

    def normals(self, points: np.ndarray) -> np.ndarray:
        """Return the normal, (3,)."""
        del points
        normal = np.zeros(3)
        normal[self.axis] = self.sign
        return normal

    def corners(self) -> np.ndarray | None:
        """Return its corners; None: it has none."""
        if np.isinf(self.size).any():
            return None
        corners = np.empty((4, 3))
        corners[:, self.axis] = self.place
        first, second = _OTHERS[self.axis]
        corners[:, first] = np.multiply((-1, -1, 1, 1), self.size[0])
        corners[:, second] = np.multiply((-1, 1, -1, 1), self.size[1])
        return corners


@dataclass(frozen=True, slots=True)
class Round(Surface):
    """
    An ellipsoid, or the part of one from a height on: x²/a² + y²/b² + (z - middle)²/c² = 1.

    ``end``: its sign says on which side of ``middle`` it is; 0: it is whole.
    """

    size: tuple[float, float, float]
    middle: float = 0.0
    end: float = 0.0

    def depths(self, screen: Screen, area: Area, sight: Sight) -> np.ndarray:
        """Return where the rays of an area meet it, (rows, columns)."""
        place = (sight.origin - (0.0, 0.0, self.middle)) / self.size
        c = float(place @ place) - 1.0
        rows = sight.turn / np.array(self.size)[:, np.newaxis]
        x, y, z = (screen.linear(row, area) for row in rows)
        depth = _nearer_root(x * x + y * y + z * z, screen.linear(place @ rows, area), c)
        if self.end:
            height = screen.linear(sight.turn[2], area) * depth + sight.origin[2]
            depth[(height - self.middle) * self.end < 0.0] = -1.0
        return depth

    def normals(self, points: np.ndarray) -> np.ndarray:
        """Return the normals at points, (n, 3)."""
        return np.asarray((points - (0.0, 0.0, self.middle)) / np.square(self.size))


@dataclass(frozen=True, slots=True)
class Tube(Surface):
    """The side of a cylinder along z."""

    radius: float
    half_length: float

    def depths(self, screen: Screen, area: Area, sight: Sight) -> np.ndarray:
        """Return where the rays of an area meet it, (rows, columns)."""
        place, rows = sight.origin[:2], sight.turn[:2]
        c = float(place @ place) - self.radius**2
        x, y = (screen.linear(row, area) for row in rows)
        depth = _nearer_root(x * x + y * y, screen.linear(place @ rows, area), c)
        height = screen.linear(sight.turn[2], area) * depth + sight.origin[2]
        depth[np.abs(height) > self.half_length] = -1.0
        return depth

    def normals(self, points: np.ndarray) -> np.ndarray:
        """Return the normals at points, (n, 3)."""
        return np.asarray(points * (1.0, 1.0, 0.0))


def visible_surfaces(kind: int, size: np.ndarray, origin: np.ndarray) -> Iterator[Surface]:
    """
    Yield the surfaces of a shape that are seen from a point, from outside only.

    Args:
        kind: A type of geoms, one of :data:`SIMPLE`.
        size: (3,), as of ``mjModel.geom_size``.
        origin: (3,), in the shape's axes.
    """
    a, b, c = size.tolist()
    x, y, z = origin.tolist()
    match _Type(kind):
        case _Type.mjGEOM_PLANE if z > 0.0:
            yield Flat(2, 0.0, 1.0, (a or np.inf, b or np.inf))
        case _Type.mjGEOM_BOX:
            for axis, (place, half) in enumerate(zip((x, y, z), (a, b, c), strict=True)):
                if abs(place) > half:
                    sign = 1.0 if place > 0.0 else -1.0
                    first, second = _OTHERS[axis]
                    yield Flat(axis, sign * half, sign, (float(size[first]), float(size[second])))
        case _Type.mjGEOM_SPHERE if x * x + y * y + z * z > a * a:
            yield Round((a, a, a))
        case _Type.mjGEOM_ELLIPSOID if (x / a) ** 2 + (y / b) ** 2 + (z / c) ** 2 > 1.0:
            yield Round((a, b, c))
        case _Type.mjGEOM_CYLINDER:
            if x * x + y * y > a * a:
                yield Tube(a, b)
            if abs(z) > b:
                sign = 1.0 if z > 0.0 else -1.0
                yield Flat(2, sign * b, sign, (a, a), is_disc=True)
        case _Type.mjGEOM_CAPSULE:
            if x * x + y * y > a * a:
                yield Tube(a, b)
            for sign in (-1.0, 1.0):
                if x * x + y * y + (z - sign * b) ** 2 > a * a:
                    yield Round((a, a, a), sign * b, sign)
        case _:
            return


_OTHERS = ((1, 2), (0, 2), (0, 1))


def _nearer_root(a: np.ndarray, b: np.ndarray, c: float) -> np.ndarray:
    """Return the smaller solution t of a t² + 2 b t + c = 0; NaN: there is none."""
    root = b * b
    root -= a * c
    np.sqrt(root, out=root)
    root += b
    # c / (-b + root) would be more exact far away, but costs as much again.
    np.divide(root, a, out=root)
    return np.negative(root, out=root)


_SIGNS = np.array([(x, y, z) for x in (-1, 1) for y in (-1, 1) for z in (-1, 1)], float)
_PLANE = int(mujoco.mjtGeom.mjGEOM_PLANE)


@dataclass(frozen=True, slots=True)
class Eye:
    """
    Where a camera is, and what it does not see.

    Attributes:
        origin: (3,), in the world, m.
        turn: (3, 3), from the sensor's axes to the world.
        far: m; what is farther may be missed.
        carrier: The body that carries the camera; -1: none.
        near: How near that is not seen, m.
    """

    origin: np.ndarray
    turn: np.ndarray
    far: float
    carrier: int
    near: float


@dataclass(slots=True)
class _SeenShape:
    """A surface that is seen in an area."""

    geom: int
    surface: Surface | None
    area: Area
    normals: np.ndarray | None = None
    """(rows, columns, 3), in the world: of a mesh."""


@dataclass(slots=True)
class Ends:
    """
    Where rays end.

    Attributes:
        depth: (height, width), m; inf: nowhere.
        number: (height, width): which one of ``seen``; -1: none.
    """

    depth: np.ndarray
    number: np.ndarray
    seen: list[_SeenShape] = field(default_factory=list)

    def geoms(self) -> np.ndarray:
        """Return the ids of geoms, (height, width); -1: none."""
        table = np.array([each.geom for each in self.seen] + [-1], np.int32)
        return np.asarray(table[self.number])

    def normals(self, scene: RayScene, points: np.ndarray) -> np.ndarray:
        """
        Return normals of length 1, (height, width, 3), float32, in the world.

        Args:
            scene: In which they ended.
            points: (height, width, 3), in the world, of those that do end.
        """
        flat = np.zeros((len(self.seen) + 1, 3), np.float32)
        others = []
        for number, each in enumerate(self.seen):
            turn = scene.data.geom_xmat[each.geom].reshape(3, 3)
            normal = None if each.surface is None else each.surface.normals(_NO_POINTS)
            if normal is not None and normal.ndim == 1:
                flat[number] = turn @ normal
            else:
                others.append((number, each, turn))
        found = flat[self.number]
        for number, each, turn in others:
            rows, columns = np.nonzero(self.number[each.area] == number)
            if not len(rows):
                continue
            if each.normals is not None:
                normals = each.normals[rows, columns]
            else:
                assert each.surface is not None
                local = points[each.area][rows, columns] - scene.data.geom_xpos[each.geom]
                normals = each.surface.normals(local @ turn) @ turn.T
            lengths = np.sqrt(np.einsum('ij,ij->i', normals, normals))
            found[each.area][rows, columns] = normals / np.maximum(lengths, 1e-12)[:, None]
        return found


_NO_POINTS = np.zeros((0, 3))


class RayCaster:
    """Casts the rays of cameras into one scene."""

    def __init__(self, scene: RayScene) -> None:
        """``scene``: its poses are those of the instant of each cast."""
        self._scene = scene
        model = scene.model
        seen = np.flatnonzero(scene.all_seen == 0)
        is_simple = np.isin(model.geom_type, [*SIMPLE])
        # Planes first, and last what MuJoCo has to do.
        order = np.lexsort((seen, ~is_simple[seen], model.geom_type[seen] != _PLANE))
        self._geoms = seen[order]
        self._is_simple = is_simple

    def cast(self, screen: Screen, eye: Eye) -> Ends:
        """Return where the rays of a camera end; numpy warns of those that end nowhere."""
        ends = Ends(np.full(screen.shape, np.inf), np.full(screen.shape, -1, np.int32))
        for geom, corners in self._in_view(eye):
            if self._is_simple[geom]:
                self._add_simple(ends, screen, eye, geom, corners)
            else:
                self._add_other(ends, screen, eye, geom, corners)
        return ends

    def _in_view(self, eye: Eye) -> list[tuple[int, np.ndarray | None]]:
        """Return geoms that are not wholly behind or too far, with corners, sensor's axes."""
        model, data, geoms = self._scene.model, self._scene.data, self._geoms
        turns = data.geom_xmat[geoms].reshape(-1, 3, 3)
        boxes = model.geom_aabb[geoms]
        local = boxes[:, np.newaxis, :3] + _SIGNS * boxes[:, np.newaxis, 3:]
        corners = np.einsum('nij,nkj->nki', turns, local)
        corners += (data.geom_xpos[geoms] - eye.origin)[:, np.newaxis]
        corners = corners @ eye.turn
        is_plane = model.geom_type[geoms] == _PLANE
        ahead = corners[..., 0]
        is_near = (ahead.max(axis=1) > 0.0) & (ahead.min(axis=1) < eye.far)
        return [
            (int(geoms[at]), None if is_plane[at] else corners[at])
            for at in np.flatnonzero(is_near | is_plane).tolist()
        ]

    def _add_simple(
        self, ends: Ends, screen: Screen, eye: Eye, geom: int, corners: np.ndarray | None
    ) -> None:
        model, data = self._scene.model, self._scene.data
        area = screen.everywhere if corners is None else screen.area_of(corners)
        if area is None:
            return
        turn = data.geom_xmat[geom].reshape(3, 3)
        sight = Sight((eye.origin - data.geom_xpos[geom]) @ turn, turn.T @ eye.turn)
        for surface in visible_surfaces(
            int(model.geom_type[geom]), model.geom_size[geom], sight.origin
        ):
            part: Area | None = area
            own = surface.corners()
            if own is not None:
                part = screen.area_of((own - sight.origin) @ sight.turn)
            if part is not None:
                depth = surface.depths(screen, part, sight)
                self._merge(ends, eye, depth, _SeenShape(geom, surface, part))

    def _add_other(
        self, ends: Ends, screen: Screen, eye: Eye, geom: int, corners: np.ndarray | None
    ) -> None:
        assert corners is not None
        area = screen.area_of(corners)
        if area is None:
            return
        # Rays that end before it begins are not cast.
        rows, columns = np.nonzero(ends.depth[area] > corners[:, 0].min())
        if not len(rows):
            return
        rays = screen.rays(area)
        directions = rays[rows, columns] @ eye.turn.T
        is_blind = np.isnan(directions[:, 0])
        directions[is_blind] = eye.turn[:, 0]
        hits = self._scene.cast(
            eye.origin,
            directions,
            mask=self._scene.mask(only=[geom]),
            cutoff=eye.far * screen.longest,
            normals=True,
        )
        assert hits.normals is not None
        is_behind = np.einsum('ij,ij->i', hits.normals, directions) > 0.0
        depth = np.full(rays.shape[:2], -1.0)
        depth[rows, columns] = np.where(is_behind | is_blind, -1.0, hits.distances)
        normals = np.zeros(rays.shape, np.float32)
        normals[rows, columns] = hits.normals
        self._merge(ends, eye, depth, _SeenShape(geom, None, area, normals))

    def _merge(self, ends: Ends, eye: Eye, depth: np.ndarray, seen: _SeenShape) -> None:
        """Let rays end at a surface that is nearer."""
        nearest = ends.depth[seen.area]
        is_nearer = depth < nearest
        carried = self._scene.model.geom_bodyid[seen.geom] == eye.carrier
        is_nearer &= depth >= (eye.near if carried else 0.0)
        if not is_nearer.any():
            return
        np.copyto(nearest, depth, where=is_nearer)
        np.copyto(ends.number[seen.area], len(ends.seen), where=is_nearer)
        ends.seen.append(seen)
