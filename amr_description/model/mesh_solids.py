# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
Triangle meshes as solids: whether they are closed, volume, mass and inertia.

A mesh encloses a volume when each edge is gone along as often one way as the other: then its
surface has no boundary, and the signed volumes of the tetrahedra between its triangles and any
point add up to what it encloses (Gauss). Parts that overlap count twice. Mass properties are the
same sum over the tetrahedra's second moments: B. Mirtich, "Fast and Accurate Computation of
Polyhedral Mass Properties", Journal of Graphics Tools 1(2), 1996, in the closed form for one
tetrahedron of J. Blow and A. Binstock, "How to find the inertia tensor (or other mass properties)
of a 3D solid body represented by a triangle mesh", 2004.
"""

from collections.abc import Sequence
from dataclasses import dataclass
import math
from typing import TypeAlias

import numpy as np
from numpy.typing import NDArray

from amr_description.errors import MeshError
from amr_description.model.frames import matrix_from_quaternion, Transform, Vector
from amr_description.model.meshes import TriangleMesh
from amr_description.model.robot import Inertia
from amr_description.model.shapes import Solid, solid_moments, volume as primitive_volume

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


Matrix: TypeAlias = NDArray[np.float64]

# Corners closer than the longest edge of the box around the mesh over this are one.
_CELLS = 2**21 - 1
# A volume below that of the box around the mesh times this is rounding.
_FLAT = 1e-9


@dataclass(frozen=True, slots=True)
class Edges:
    """The edges of a mesh; ``open``: those that are not gone along as often either way."""

    open: int
    total: int


@dataclass(frozen=True, slots=True, eq=False)
class SolidBody:
    """
    A homogeneous body of density 1 in the frame of a link.

    ``volume``: m³. ``center``: its centre of mass, (3,), m. ``inertia``: (3, 3), about that centre
    along the axes of the link, m⁵.
    """

    volume: float
    center: Matrix
    inertia: Matrix


@dataclass(frozen=True, slots=True)
class MassProperties:
    """Mass (kg), centre of mass (m) and inertia about it (kg·m²), along the axes of the link."""

    mass: float
    center: Vector
    inertia: Inertia


def count_edges(mesh: TriangleMesh) -> Edges:
    """Count the edges of a mesh. Corners at one place are one: STL gives each triangle its own."""
    faces = _welded_faces(mesh)
    faces = faces[
        (faces[:, 0] != faces[:, 1]) & (faces[:, 1] != faces[:, 2]) & (faces[:, 2] != faces[:, 0])
    ]
    if not len(faces):
        return Edges(0, 0)
    ends = np.vstack((faces[:, [0, 1]], faces[:, [1, 2]], faces[:, [2, 0]]))
    way = np.where(ends[:, 0] < ends[:, 1], 1, -1)
    key = ends.min(axis=1) * (int(faces.max()) + 1) + ends.max(axis=1)
    _, edge = np.unique(key, return_inverse=True)
    balance = np.bincount(edge, weights=way)
    return Edges(int(np.count_nonzero(balance)), len(balance))


def hull_ratio(mesh: TriangleMesh) -> float:
    """Return how often the volume of a closed mesh goes into its convex hull's, at least."""
    own = abs(_signed_volume(mesh))
    hull = hull_volume(mesh.vertices[np.unique(mesh.faces)])
    return hull / own if own > _FLAT * hull else math.inf


def solid_mesh(mesh: TriangleMesh, pose: Transform, name: str) -> SolidBody:
    """
    Return what a closed mesh encloses.

    Args:
        mesh: The mesh.
        pose: ``transform_mesh_to_link``.
        name: What the error calls it.

    Raises:
        MeshError: It is not closed, or encloses nothing; with the figure.
    """
    edges = count_edges(mesh)
    if edges.open:
        raise MeshError(
            f'{name}: it is not closed, so it has no volume: {edges.open} of its {edges.total} '
            'edges are not between two triangles that face the same way; close it, or use a '
            'primitive shape'
        )
    rotation = np.array(matrix_from_quaternion(pose.rotation))
    vertices = mesh.vertices @ rotation.T
    origin = vertices[mesh.faces[0, 0]]  # near the mesh: nothing cancels
    corners = (vertices - origin)[mesh.faces]
    volumes = np.linalg.det(corners) / 6.0
    volume = float(volumes.sum())
    if abs(volume) <= _FLAT * math.prod(mesh.size) or volume == 0.0:
        raise MeshError(f'{name}: it encloses no volume; use a primitive shape')
    sums = corners.sum(axis=1)
    center = volumes @ sums / (4.0 * volume)
    moments = np.einsum('t,tci,tcj->ij', volumes, corners, corners)
    moments = (moments + np.einsum('t,ti,tj->ij', volumes, sums, sums)) / 20.0
    if volume < 0.0:  # all of it turned inside out
        volume, moments = -volume, -moments
    moments -= volume * np.outer(center, center)
    inertia = np.trace(moments) * np.eye(3) - moments
    return SolidBody(volume, center + origin + np.array(pose.translation), inertia)


def solid_primitive(solid: Solid) -> SolidBody:
    """Return a box, cylinder or sphere as a body."""
    volume = primitive_volume(solid.shape)
    rotation = np.array(matrix_from_quaternion(solid.pose.rotation))
    inertia = rotation @ np.diag(solid_moments(solid.shape, volume)) @ rotation.T
    return SolidBody(volume, np.array(solid.pose.translation), inertia)


def joined(bodies: Sequence[SolidBody], density: float) -> MassProperties:
    """
    Return the mass properties of bodies of one density that are rigidly joined.

    Args:
        bodies: At least one, in the frame of one link. Where they overlap both count.
        density: kg/m³.

    Returns:
        Those of all together (parallel axis theorem).
    """
    volume = math.fsum(body.volume for body in bodies)
    center = sum((body.volume * body.center for body in bodies), np.zeros(3)) / volume
    inertia = np.zeros((3, 3))
    for body in bodies:
        arm = body.center - center
        inertia += body.inertia + body.volume * (arm @ arm * np.eye(3) - np.outer(arm, arm))
    inertia *= density
    x, y, z = center.tolist()
    return MassProperties(
        density * volume,
        (x, y, z),
        Inertia(
            ixx=float(inertia[0, 0]),
            ixy=float(inertia[0, 1]),
            ixz=float(inertia[0, 2]),
            iyy=float(inertia[1, 1]),
            iyz=float(inertia[1, 2]),
            izz=float(inertia[2, 2]),
        ),
    )


def _signed_volume(mesh: TriangleMesh) -> float:
    corners = (mesh.vertices - mesh.vertices[mesh.faces[0, 0]])[mesh.faces]
    return float(np.linalg.det(corners).sum()) / 6.0


def _welded_faces(mesh: TriangleMesh) -> NDArray[np.int64]:
    """Return the faces by numbers that corners at one place share."""
    low = mesh.vertices.min(axis=0)
    longest = float(np.max(mesh.vertices.max(axis=0) - low)) or 1.0
    cell = np.rint((mesh.vertices - low) * (_CELLS / longest)).astype(np.int64)
    key = (cell[:, 0] << 42) | (cell[:, 1] << 21) | cell[:, 2]
    _, corner = np.unique(key, return_inverse=True)
    return corner[mesh.faces]
