# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
What of a geom is at a height, or between two, seen from above: its section with a level plane.

Boxes and the triangles of meshes and height fields are cut exactly. Round geoms are polygons that
lie less than :data:`ROUNDNESS` inside of their true section.
"""

from dataclasses import dataclass
import math
from typing import TypeAlias

import mujoco
import numpy as np
from numpy.typing import NDArray

from amr_description.model.planar_hull import crossings, cut_between, planar_hull
from amr_description.sim.terrain import field_mesh

Floats: TypeAlias = NDArray[np.float64]
Triangles: TypeAlias = NDArray[np.intp]

ROUNDNESS = 1e-4
"""m."""

_Type = mujoco.mjtGeom
_FAR = 1e4
"""m: half the size of an infinite plane."""
_CORNERS = np.array([[i, j, k] for i in (-1.0, 1.0) for j in (-1.0, 1.0) for k in (-1.0, 1.0)])
_BOX_EDGES = np.array([[0, 1], [2, 3], [4, 5], [6, 7], [0, 2], [1, 3], [4, 6], [5, 7],
                       [0, 4], [1, 5], [2, 6], [3, 7]])  # fmt: skip
_RECTANGLE = np.array([[-1.0, -1.0, 0.0], [1.0, -1.0, 0.0], [1.0, 1.0, 0.0], [-1.0, 1.0, 0.0]])
_RECTANGLE_EDGES = np.array([[0, 1], [1, 2], [2, 3], [3, 0]])
_TRIANGLE_EDGES = np.array([[0, 1], [1, 2], [2, 0]])
_MOST_SIDES = 2048
_LEVELS = 33
"""In a band, in which the outline of a round geom is looked for."""
_SPHERES = 65
"""By which a capsule is swept."""


@dataclass(frozen=True, slots=True)
class GeomSection:
    """What of one geom is there, in the plane of the world, m."""

    parts: tuple[Floats, ...]
    """Convex shapes, each (n, 2), corners in their order: polygons, segments, points."""
    outline: Floats | None = None
    """Closed curves around what is solid, (n, 2, 2) segments; None: ``parts`` are all of it."""


def section(
    model: mujoco.MjModel, data: mujoco.MjData, geom: int, low: float, high: float
) -> GeomSection:
    """
    Return what of a geom is between two heights, or at one.

    A solid is there from its bottom on, and at its top no more: a floor is not at its own height.

    Args:
        model: Of the world.
        data: Its kinematics are up to date.
        geom: The id.
        low: m, in the world.
        high: Likewise, not below ``low``.
    """
    low = math.nextafter(low + 1e-9, math.inf)
    high = max(low, high)
    position, turn = data.geom_xpos[geom], data.geom_xmat[geom].reshape(3, 3)
    size = model.geom_size[geom]
    match _Type(model.geom_type[geom]):
        case _Type.mjGEOM_BOX:
            return _of_edges((_CORNERS * size) @ turn.T + position, _BOX_EDGES, low, high)
        case _Type.mjGEOM_PLANE:
            half = np.array([size[0] or _FAR, size[1] or _FAR, 1.0])
            corners = (_RECTANGLE * half) @ turn.T + position
            return _of_edges(corners, _RECTANGLE_EDGES, low, high)
        case _Type.mjGEOM_CYLINDER:
            points, edges = _prism(float(size[0]), float(size[1]))
            return _of_edges(points @ turn.T + position, edges, low, high)
        case _Type.mjGEOM_SPHERE:
            return _of_ellipsoid(position, turn * size[0], low, high)
        case _Type.mjGEOM_ELLIPSOID:
            return _of_ellipsoid(position, turn * size, low, high)
        case _Type.mjGEOM_CAPSULE:
            return _of_capsule(position, turn[:, 2] * size[1], float(size[0]), low, high)
        case _Type.mjGEOM_MESH | _Type.mjGEOM_SDF | _Type.mjGEOM_HFIELD as kind:
            vertices, faces = triangles(model, geom)
            # A field is, though its bottom has fewer corners than its sides.
            closed = kind == _Type.mjGEOM_HFIELD or is_closed(faces)
            return _of_triangles(vertices @ turn.T + position, faces, low, high, closed=closed)
    return GeomSection(())


def triangles(model: mujoco.MjModel, geom: int) -> tuple[Floats, Triangles]:
    """Return vertices (n, 3), m, and faces (m, 3) of a mesh or height field in its own frame."""
    index = int(model.geom_dataid[geom])
    if model.geom_type[geom] == _Type.mjGEOM_HFIELD:
        rows, columns = int(model.hfield_nrow[index]), int(model.hfield_ncol[index])
        first = model.hfield_adr[index]
        heights = model.hfield_data[first : first + rows * columns]
        return field_mesh(rows, columns, model.hfield_size[index].tolist(), heights)
    first, count = model.mesh_vertadr[index], model.mesh_vertnum[index]
    start, end = model.mesh_faceadr[index], model.mesh_facenum[index]
    vertices = model.mesh_vert[first : first + count].astype(np.float64)
    return vertices, model.mesh_face[start : start + end].astype(np.intp)


def _of_edges(points: Floats, edges: NDArray[np.intp], low: float, high: float) -> GeomSection:
    """Cut a convex polyhedron (n, 3), or a flat polygon, given by its edges."""
    return _around(cut_between(points, edges, low, high))


def _around(points: Floats) -> GeomSection:
    return GeomSection((planar_hull(points),)) if len(points) else GeomSection(())


def _circle(radius: float) -> Floats:
    """Return cosines and sines (n, 2) of enough corners for a circle of this radius."""
    # A polygon of n sides lies within r (1 - cos(pi / n)) of its circle.
    share = min(1.0, ROUNDNESS / max(radius, ROUNDNESS))
    sides = min(_MOST_SIDES, max(16, math.ceil(math.pi / math.acos(1.0 - share))))
    angles = np.arange(sides) * (math.tau / sides)
    return np.column_stack((np.cos(angles), np.sin(angles)))


def _prism(radius: float, half: float) -> tuple[Floats, NDArray[np.intp]]:
    """Return corners and edges of a prism inside of a cylinder."""
    rim = _circle(radius) * radius
    count = len(rim)
    ends = [np.column_stack((rim, np.full(count, z))) for z in (-half, half)]
    at = np.arange(count)
    after = np.roll(at, -1)
    pairs = [(at, after), (at + count, after + count), (at, at + count)]
    edges = np.concatenate([np.column_stack(pair) for pair in pairs])
    return np.concatenate(ends), edges


def _levels(low: float, high: float, bottom: float, top: float) -> Floats:
    """Return heights of the band that a round geom has, at which its outline is looked for."""
    first, last = max(low, bottom), min(high, top)
    if first > last:
        return np.empty(0)
    middle = min(max((bottom + top) / 2.0, first), last)  # where it is widest
    return np.unique([*np.linspace(first, last, _LEVELS), middle])


def _of_ellipsoid(center: Floats, axes: Floats, low: float, high: float) -> GeomSection:
    """
    Cut an ellipsoid: the image of the unit sphere by ``axes`` (3, 3), moved to ``center``.

    The points of the sphere that end up at one height lie on a circle about the direction that
    the third row of ``axes`` has.
    """
    upward = axes[2]
    reach = float(np.linalg.norm(upward))
    normal = upward / reach
    across = np.linalg.svd(normal[None, :])[2][1:]
    circle = _circle(float(np.linalg.norm(axes, axis=0).max()))
    found = []
    for level in _levels(low, high, center[2] - reach, center[2] + reach):
        offset = (level - center[2]) / reach
        ring = offset * normal + math.sqrt(max(0.0, 1.0 - offset * offset)) * (circle @ across)
        found.append((ring @ axes.T + center)[:, :2])
    return _around(np.concatenate(found)) if found else GeomSection(())


def _of_capsule(
    center: Floats, half_axis: Floats, radius: float, low: float, high: float
) -> GeomSection:
    """Cut a capsule: a sphere swept along a segment from -half_axis to half_axis."""
    rise = float(half_axis[2])
    reach = abs(rise) + radius
    circle = _circle(radius)
    found = []
    for level in _levels(low, high, center[2] - reach, center[2] + reach):
        # The part of the segment whose spheres reach this height.
        offset = level - center[2]
        first, last = -1.0, 1.0
        if abs(rise) > 1e-12:
            ends = sorted(((offset - radius) / rise, (offset + radius) / rise))
            first, last = max(first, ends[0]), min(last, ends[1])
        nearest = offset / rise if abs(rise) > 1e-12 else 0.0
        along = np.unique([*np.linspace(first, last, _SPHERES), min(max(nearest, first), last)])
        radii = np.sqrt(np.maximum(0.0, radius**2 - (offset - along * rise) ** 2))
        middles = center[:2] + along[:, None] * half_axis[:2]
        found.append((middles[:, None] + radii[:, None, None] * circle).reshape(-1, 2))
    return _around(np.concatenate(found)) if found else GeomSection(())


def _of_triangles(
    vertices: Floats, faces: Triangles, low: float, high: float, *, closed: bool
) -> GeomSection:
    """Cut a mesh: of one that is closed, what is inside is solid."""
    heights = vertices[faces][:, :, 2]
    if low == high:
        cuts = _cuts(vertices, faces, low)
        return GeomSection(tuple(cuts), cuts if closed else None)
    touched = faces[(heights.min(axis=1) <= high) & (heights.max(axis=1) >= low)]
    parts = [
        part
        for corners in vertices[touched]
        for part in _of_edges(corners, _TRIANGLE_EDGES, low, high).parts
    ]
    return GeomSection(tuple(parts), _cuts(vertices, faces, low) if closed else None)


def _cuts(vertices: Floats, faces: Triangles, level: float) -> Floats:
    """Return where triangles cross a height, (n, 2, 2) segments."""
    is_below = vertices[:, 2] < level
    below = is_below[faces]
    crossing = faces[below.any(axis=1) & ~below.all(axis=1)]
    if not len(crossing):
        return np.empty((0, 2, 2))
    edges = crossing[:, _TRIANGLE_EDGES]
    crosses = is_below[edges[:, :, 0]] != is_below[edges[:, :, 1]]
    # Sorted, so that two triangles find the same point on the edge that they share.
    ends = np.sort(edges[crosses], axis=1)
    return crossings(vertices, ends, level)[:, :2].reshape(-1, 2, 2)


def is_closed(faces: Triangles) -> bool:
    """Return whether each edge of a mesh is one of two triangles."""
    edges = np.sort(np.concatenate([faces[:, pair] for pair in _TRIANGLE_EDGES]), axis=1)
    counts = np.unique(edges[:, 0] * (int(faces.max()) + 1) + edges[:, 1], return_counts=True)[1]
    return bool((counts == 2).all())
