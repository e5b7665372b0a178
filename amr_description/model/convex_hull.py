# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
The volume of the convex hull of points, with NumPy alone.

trimesh asks SciPy for hulls, which is not installed: 35 MB of download, 100 MB on disk, for one
figure of one rule of ``check_urdf``. MuJoCo has a hull, but this room does not know the simulator.
So the hull is that of the points farthest in :data:`DIRECTIONS` directions, in time linear in the
number of points: exact for up to a few dozen corners; of a ball of very many it misses 1 %.
"""

import math
from typing import TypeAlias

import numpy as np
from numpy.typing import NDArray

Points: TypeAlias = NDArray[np.float64]

DIRECTIONS = 512
"""How many extreme points are looked for."""
_AT_A_TIME = 32
# In the unit cube: a point that is above a face by less is on it.
_THICKNESS = 1e-9


def hull_volume(points: Points) -> float:
    """
    Return the volume of the convex hull.

    Args:
        points: (n, 3), m, finite, n > 0.

    Returns:
        m³; at most the true volume, and 0 for points in one plane.
    """
    low = points.min(axis=0)
    size = points.max(axis=0) - low
    if not size.all():
        return 0.0
    # In the unit cube a thin plate has as many extreme points as a ball; volumes scale.
    corners = _extreme_points((points - low) / size)
    return _volume(corners) * math.prod(size.tolist())


def _extreme_points(points: Points) -> Points:
    """Return the points that are farthest in evenly spread directions (a Fibonacci lattice)."""
    number = np.arange(DIRECTIONS)
    z = 1.0 - (2.0 * number + 1.0) / DIRECTIONS
    angle = number * math.pi * (3.0 - math.sqrt(5.0))
    radius = np.sqrt(1.0 - z * z)
    directions = np.column_stack((radius * np.cos(angle), radius * np.sin(angle), z))
    columns = np.ascontiguousarray(points.T)
    found = [
        (directions[start : start + _AT_A_TIME] @ columns).argmax(axis=1)
        for start in range(0, DIRECTIONS, _AT_A_TIME)
    ]
    return np.unique(points[np.concatenate(found)], axis=0)


def _volume(points: Points) -> float:
    """Return the volume of a hull that grows from a tetrahedron, point by point."""
    first = _tetrahedron(points)
    if first is None:
        return 0.0
    faces = np.array(first)
    normals, offsets = _planes(points, faces)
    for index, point in enumerate(points):
        is_seen = normals @ point > offsets + _THICKNESS
        if not is_seen.any():
            continue
        edges = {edge for a, b, c in faces[is_seen].tolist() for edge in ((a, b), (b, c), (c, a))}
        rim = [(a, b) for a, b in sorted(edges) if (b, a) not in edges]
        new = np.array([(a, b, index) for a, b in rim])
        new_normals, new_offsets = _planes(points, new)
        faces = np.vstack((faces[~is_seen], new))
        normals = np.vstack((normals[~is_seen], new_normals))
        offsets = np.concatenate((offsets[~is_seen], new_offsets))
    return float(np.linalg.det(points[faces] - points[0]).sum()) / 6.0


def _planes(points: Points, faces: NDArray[np.int64]) -> tuple[Points, Points]:
    """Return the unit normals of triangles, and how far their planes are from the origin."""
    a, b, c = points[faces[:, 0]], points[faces[:, 1]], points[faces[:, 2]]
    normals = np.cross(b - a, c - a)
    normals /= np.maximum(np.linalg.norm(normals, axis=1, keepdims=True), 1e-300)
    return normals, np.einsum('ij,ij->i', normals, a)


def _tetrahedron(points: Points) -> list[tuple[int, int, int]] | None:
    """Return the faces of four points that are far from one plane, outside out; None if flat."""
    a = 0
    b = int(np.linalg.norm(points - points[a], axis=1).argmax())
    along = points[b] - points[a]
    c = int(np.linalg.norm(np.cross(points - points[a], along), axis=1).argmax())
    normal = np.cross(along, points[c] - points[a])
    height = (points - points[a]) @ normal
    d = int(np.abs(height).argmax())
    if abs(height[d]) <= _THICKNESS * max(float(np.linalg.norm(normal)), 1e-300):
        return None
    if height[d] > 0.0:
        b, c = c, b
    return [(a, b, c), (a, d, b), (a, c, d), (b, d, c)]
