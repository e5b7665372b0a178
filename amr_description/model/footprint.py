# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
The footprint of a robot: the polygon on the ground that costmaps of Nav2 want.

It is the convex hull, seen from above, of the collisions of all links, in the frame of the base.
Round shapes are taken a little too large (:data:`_SIDES` corners around them), and the polygon is
simplified outwards: nothing of the robot is ever outside of it.

The two radii are those of ``nav2_costmap_2d::calculateMinAndMaxDistances``: how near and how far
the polygon is from the origin of its frame.
"""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
import math
from typing import TypeAlias

import numpy as np
from numpy.typing import NDArray

from amr_description.errors import DescriptionError, MeshError
from amr_description.model.frames import matrix_from_quaternion, Transform
from amr_description.model.kinematics import link_poses
from amr_description.model.mesh_uses import FindFile
from amr_description.model.origins import place_in
from amr_description.model.planar_hull import cut_between, planar_hull, PlanarPoints, Points
from amr_description.model.robot import Box, Collision, Cylinder, Mesh, Robot, Sphere
from amr_description.text import quote

Floats: TypeAlias = NDArray[np.float64]

FRAMES = ('base_link', 'base_footprint')
"""Costmaps are told one of these, as a rule; the first that a robot has is taken."""
TOLERANCE = 0.005
"""m: by how much the polygon may be larger than the hull, to have fewer corners."""

_SIDES = 64
_DIGITS = 3
"""Of the corners, m: whole millimetres."""
_SMALLEST = 1e-9
_BOX = np.array([[i, j, k] for i in (-0.5, 0.5) for j in (-0.5, 0.5) for k in (-0.5, 0.5)])
_BOX_EDGES = np.array([[0, 1], [2, 3], [4, 5], [6, 7], [0, 2], [1, 3], [4, 6], [5, 7],
                       [0, 4], [1, 5], [2, 6], [3, 7]])  # fmt: skip


@dataclass(frozen=True, slots=True)
class Footprint:
    """The polygon of a robot on the ground."""

    frame: str
    """The link in whose frame it is."""
    corners: tuple[tuple[float, float], ...]
    """x forward and y left, m; counter-clockwise, the one at the front on the left first."""

    @property
    def text(self) -> str:
        """The value of ``footprint`` in parameter files of Nav2."""
        return f'[{", ".join(f"[{x:g}, {y:g}]" for x, y in self.corners)}]'

    @property
    def inscribed_radius(self) -> float:
        """How far the origin is from the nearest edge, m."""
        points = np.array(self.corners)
        return float(_distances_to_edges(points, np.zeros(2)).min())

    @property
    def circumscribed_radius(self) -> float:
        """How far the origin is from the farthest corner, m."""
        return max(math.hypot(x, y) for x, y in self.corners)

    @property
    def holds_origin(self) -> bool:
        """Whether the robot is around the origin of the frame, which it turns about."""
        return bool(_outside(np.array(self.corners), np.zeros((1, 2)))[0] <= 0.0)


def footprint(
    robot: Robot,
    find_file: FindFile,
    *,
    frame: str | None = None,
    heights: tuple[float, float] = (-math.inf, math.inf),
    positions: Mapping[str, float] | None = None,
    tolerance: float = TOLERANCE,
) -> Footprint:
    """
    Return the footprint of a robot.

    Args:
        robot: its description.
        find_file: finds the files of meshes.
        frame: the link in whose frame it is; None: the first of :data:`FRAMES`, else the root.
        heights: what is lower or higher is left out, m above the lowest collision.
        positions: of joints, rad or m; others are at 0.
        tolerance: by how much it may be larger than the hull, m.

    Raises:
        DescriptionError: there is no such link, no collision, or one that cannot be used.
    """
    named = frame or next((each for each in FRAMES if robot.has_link(each)), robot.root.name)
    robot.link(named)
    poses = link_poses(robot, positions)
    to_frame = poses[named].inverse()
    bodies = [
        _body(robot, link.name, part, to_frame @ poses[link.name] @ part.origin, find_file)
        for link in robot.links
        if link.name in poses
        for part in link.collisions
    ]
    if not bodies:
        raise DescriptionError(
            f'{robot.source}: no link has a <collision>, so there is no footprint; '
            "add one, or give costmaps a 'robot_radius'"
        )
    ground = min(float(points[:, 2].min()) for points, _ in bodies)
    low, high = (ground + each for each in heights)
    seen = np.concatenate([cut_between(points, edges, low, high) for points, edges in bodies])
    if not len(seen):
        top = max(float(points[:, 2].max()) for points, _ in bodies) - ground
        raise DescriptionError(
            f'{robot.source}: no collision is {heights[0]:g} to {heights[1]:g} m above the '
            f'ground; they are 0 to {top:.3g} m'
        )
    hull = planar_hull(seen)
    if len(hull) < 3:
        raise DescriptionError(
            f'{robot.source}: the collisions have no area, seen from above; give them a size'
        )
    return Footprint(named, _in_order(_rounded(hull, simplified(hull, tolerance))))


_Body: TypeAlias = tuple[Points, NDArray[np.intp]]
"""Corners and edges of a polyhedron."""


def _body(robot: Robot, link: str, part: Collision, pose: Transform, find_file: FindFile) -> _Body:
    """Return what is around a collision, in the frame of ``pose``. Raises DescriptionError."""
    shape = part.geometry
    where = f'{place_in(robot.text, robot.source, part.line)}: the collision of {quote(link)}'
    match shape:
        case Box():
            points, edges = _BOX * shape.size, _BOX_EDGES
        case Cylinder():
            points, edges = _prism(shape.radius, shape.length / 2.0)
        case Sphere():
            points, edges = _ball(shape.radius)
        case Mesh():
            points, edges = _mesh(shape, find_file, where)
    turn = np.array(matrix_from_quaternion(pose.rotation))
    found: Points = points @ turn.T + np.array(pose.translation)
    if not np.isfinite(found).all():
        raise DescriptionError(f'{where}: its size or place is no finite number')
    return found, edges


def _rim(radius: float) -> PlanarPoints:
    """Return a polygon around a circle: its edges touch it."""
    angles = (np.arange(_SIDES) + 0.5) * (math.tau / _SIDES)
    outer = radius / math.cos(math.pi / _SIDES)
    return np.column_stack((np.cos(angles), np.sin(angles))) * outer


def _stacked(rings: Sequence[tuple[PlanarPoints, float]]) -> _Body:
    """Return corners and edges of polygons at heights, each joined to the next."""
    points = np.concatenate([np.column_stack((xy, np.full(len(xy), z))) for xy, z in rings])
    count, at = len(rings[0][0]), np.arange(len(rings[0][0]))
    edges = [np.column_stack((at, np.roll(at, -1))) + count * ring for ring in range(len(rings))]
    edges += [np.column_stack((at, at + count)) + count * ring for ring in range(len(rings) - 1)]
    return points, np.concatenate(edges)


def _prism(radius: float, half: float) -> _Body:
    rim = _rim(radius)
    return _stacked([(rim, -half), (rim, half)])


def _ball(radius: float) -> _Body:
    """Return prisms around a sphere, one between each two heights, as wide as it is there."""
    heights = radius * np.sin(np.linspace(-math.pi / 2.0, math.pi / 2.0, _SIDES // 2 + 1))
    rings = []
    for low, high in zip(heights[:-1].tolist(), heights[1:].tolist(), strict=True):
        nearest = 0.0 if low < 0.0 < high else min(abs(low), abs(high))
        rim = _rim(math.sqrt(max(0.0, radius * radius - nearest * nearest)))
        rings += [(rim, low), (rim, high)]
    return _stacked(rings)


def _mesh(shape: Mesh, find_file: FindFile, where: str) -> _Body:
    # Not at the top: what has no mesh need not wait for what reads them.
    from amr_description.model.meshes import load_mesh

    try:
        mesh = load_mesh(find_file(shape.filename), shape.scale)
    except MeshError as error:
        raise DescriptionError(f'{where}: {error}') from error
    used, faces = np.unique(mesh.faces, return_inverse=True)
    faces = faces.reshape(-1, 3)
    pairs = np.concatenate((faces[:, [0, 1]], faces[:, [1, 2]], faces[:, [2, 0]]))
    return mesh.vertices[used], pairs


def simplified(hull: PlanarPoints, tolerance: float) -> PlanarPoints:
    """
    Return a convex polygon around a convex one, with fewer corners.

    An edge is dropped by making its two neighbours longer until they meet, the edge first whose
    new corner is the nearest to the hull; as long as none is farther than ``tolerance``.

    Args:
        hull: corners (n, 2), counter-clockwise, m.
        tolerance: m.
    """
    corners = [*hull]
    names = [*range(len(corners))]
    next_name = len(corners)
    # By the names of the four corners around an edge; most stay from one round to the next.
    known: dict[tuple[int, ...], tuple[float, Floats]] = {}
    while (count := len(corners)) > 4:
        found = []
        for at in range(count):
            around = [(at + step) % count for step in (-1, 0, 1, 2)]
            key = tuple(names[place] for place in around)
            if key not in known:
                known[key] = _without_edge(hull, *(corners[place] for place in around))
            found.append(known[key])
        at = min(range(count), key=lambda place: found[place][0])
        excess, corner = found[at]
        if excess > tolerance:
            break
        corners[at], names[at] = corner, next_name
        next_name += 1
        after = (at + 1) % count
        del corners[after], names[after]
    return np.array(corners)


def _without_edge(
    hull: PlanarPoints, before: Floats, start: Floats, end: Floats, after: Floats
) -> tuple[float, Floats]:
    """Return where the edges beside an edge meet, and how far outside; inf: they do not meet."""
    along, on = start - before, after - end
    turn = along[0] * on[1] - along[1] * on[0]
    if turn <= _SMALLEST * math.hypot(*along) * math.hypot(*on):
        return math.inf, start
    gap = end - start
    share = (gap[0] * on[1] - gap[1] * on[0]) / turn
    found: Floats = start + share * along
    return float(_outside(hull, found[None, :])[0]), found


def _outside(polygon: PlanarPoints, points: PlanarPoints) -> Floats:
    """Return how far points (n, 2) are outside of a convex polygon, m; 0 or less: they are not."""
    along = np.roll(polygon, -1, axis=0) - polygon
    normals = np.column_stack((along[:, 1], -along[:, 0]))
    beyond = (points[:, None, :] - polygon) * normals
    signed = beyond.sum(axis=-1) / np.linalg.norm(normals, axis=1)
    is_out = signed.max(axis=1) > 0.0
    near = np.array([float(_distances_to_edges(polygon, each).min()) for each in points])
    found: Floats = np.where(is_out, near, -near)
    return found


def _distances_to_edges(polygon: PlanarPoints, point: Floats) -> Floats:
    along = np.roll(polygon, -1, axis=0) - polygon
    offset = point - polygon
    share = np.clip((offset * along).sum(axis=1) / (along * along).sum(axis=1), 0.0, 1.0)
    found: Floats = np.linalg.norm(offset - share[:, None] * along, axis=1)
    return found


def _rounded(hull: PlanarPoints, polygon: PlanarPoints) -> PlanarPoints:
    """Return a polygon in whole millimetres that still holds the hull; see :func:`_grown`."""
    step = 10.0**-_DIGITS
    for growth in (0.0, step / 2.0, step, 2.0 * step):
        found = planar_hull(np.round(_grown(polygon, growth), _DIGITS) + 0.0)
        if len(found) > 2 and float(_outside(found, hull).max()) <= 1e-3 * step:
            return found
    return _grown(polygon, 2.0 * step)


def _grown(polygon: PlanarPoints, growth: float) -> PlanarPoints:
    """Return a convex polygon whose edges are farther out, m."""
    if not growth:
        return polygon
    along = np.roll(polygon, -1, axis=0) - polygon
    normals = np.column_stack((along[:, 1], -along[:, 0]))
    normals /= np.linalg.norm(normals, axis=1)[:, None]
    before = np.roll(normals, 1, axis=0)
    # The corner moves so that it is ``growth`` farther along both normals.
    share = growth / (1.0 + (before * normals).sum(axis=1))
    found: PlanarPoints = polygon + (before + normals) * share[:, None]
    return found


def _in_order(polygon: PlanarPoints) -> tuple[tuple[float, float], ...]:
    """Return corners counter-clockwise, the one at the front on the left first."""
    rows = [(float(x), float(y)) for x, y in polygon]
    first = max(range(len(rows)), key=lambda at: (rows[at][0], rows[at][1]))
    return tuple(rows[first:] + rows[:first])
