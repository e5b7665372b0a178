# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
Where the rays of a camera end: each shape is tried only by the rays that may meet it.

``mj_multiRay`` tries all shapes with every ray, 30 ms for 320 x 240 in ``warehouse``; this takes 4
to 8. The rays of a camera are a grid: a shape has a rectangle in the picture, and its depth there
is a formula for arrays (:mod:`amr_description.sim.cameras.surfaces`); the nearest of all counts.
Meshes and height fields are left to MuJoCo, within their rectangles, as far as nothing is nearer.

Surfaces are met from outside only, see :mod:`amr_description.sim.cameras.ray_renderer`.
"""

from dataclasses import dataclass, field

import mujoco
import numpy as np

from amr_description.sim.cameras.screen import Area, Screen
from amr_description.sim.cameras.surfaces import Sight, SIMPLE, Surface, visible_surfaces
from amr_description.sim.rays import RayScene

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
