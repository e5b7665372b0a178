# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
Collision shapes as solids: volume, inertia, extent, and whether two of them overlap.

Lengths in m, masses in kg, moments in kg·m². Meshes are left out: they are files, which
:mod:`amr_description.model.mesh_solids` reads.

Overlap is found by the algorithm of Gilbert, Johnson and Keerthi (1988): two convex bodies have a
point in common when their Minkowski difference contains the origin. A simplex of at most four of
its points is moved towards the origin until it encloses it, or cannot get there.
"""

from collections.abc import Callable, Sequence
from dataclasses import dataclass
import math
from operator import mul
from typing import TypeAlias

from amr_description.model.frames import (
    conjugate,
    cross,
    dot,
    matrix_from_quaternion,
    rotate,
    Transform,
    Vector,
)
from amr_description.model.kinematics import link_poses
from amr_description.model.robot import Box, Collision, Cylinder, Inertia, Mesh, Robot, Sphere

# Bodies that only graze each other may never end the search; they count as separate.
_MOST_STEPS = 64
_ZERO = 1e-18
Support: TypeAlias = Callable[[Vector], Vector]
"""Direction -> the farthest point of the Minkowski difference in that direction."""
# m; within them no product of sizes leaves the range of floats.
_SMALLEST, _LARGEST = 1e-6, 1e6
REACH_OF_A_MESH = 0.5
"""m: the assumed radius of a collision mesh, which is not read here."""
Primitive: TypeAlias = Box | Cylinder | Sphere


@dataclass(frozen=True, slots=True)
class Solid:
    """A primitive shape and its ``pose``, ``transform_shape_to_frame``."""

    shape: Primitive
    pose: Transform


def solids_of(collisions: Sequence[Collision], pose: Transform) -> list[Solid]:
    """
    Return the primitive shapes of a link in the frame in which ``pose`` is that of the link.

    Meshes and shapes without a sensible size or position are left out.
    """
    solids = []
    for collision in collisions:
        shape, shape_pose = collision.geometry, pose @ collision.origin
        if isinstance(shape, Box | Cylinder | Sphere) and (
            all(_SMALLEST < size < _LARGEST for size in sizes(shape))
            and all(abs(part) < _LARGEST for part in shape_pose.translation)
        ):
            solids.append(Solid(shape, shape_pose))
    return solids


def sizes(shape: Primitive) -> tuple[float, ...]:
    """Return the lengths by which URDF describes a shape (m)."""
    match shape:
        case Box():
            return shape.size
        case Cylinder():
            return (shape.radius, shape.length)
        case Sphere():
            return (shape.radius,)


def volume(shape: Primitive) -> float:
    """Return the volume in m³."""
    match shape:
        case Box(size):
            return math.prod(size)
        case Cylinder(radius, length):
            return math.pi * radius * radius * length
        case Sphere(radius):
            return 4.0 / 3.0 * math.pi * radius * radius * radius


def half_sizes(shape: Primitive) -> Vector:
    """Return half the edges of the box around a shape, in its own axes (m)."""
    match shape:
        case Box((x, y, z)):
            return (x / 2.0, y / 2.0, z / 2.0)
        case Cylinder(radius, length):
            return (radius, radius, length / 2.0)
        case Sphere(radius):
            return (radius, radius, radius)


def reach(shape: Primitive) -> float:
    """Return the radius of the sphere around a shape (m)."""
    return shape.radius if isinstance(shape, Sphere) else math.hypot(*half_sizes(shape))


def horizontal_reach(robot: Robot) -> float:
    """
    Return the radius (m) of a circle about the root's origin that holds all collision shapes.

    Seen from above, with all joints at 0 and each shape as the sphere around it; a mesh counts
    with :data:`REACH_OF_A_MESH`.
    """
    poses = link_poses(robot)
    farthest = 0.0
    for link in robot.links:
        pose = poses[link.name]
        for solid in solids_of(link.collisions, pose):
            x, y, _ = solid.pose.translation
            farthest = max(farthest, math.hypot(x, y) + reach(solid.shape))
        for part in link.collisions:
            if isinstance(part.geometry, Mesh):
                x, y, _ = (pose @ part.origin).translation
                farthest = max(farthest, math.hypot(x, y) + REACH_OF_A_MESH)
    return farthest


def solid_moments(shape: Primitive, mass: float) -> Vector:
    """
    Return the principal moments of a homogeneous solid about its centre, along its own axes.

    Box: m (b² + c²) / 12. Cylinder: m (3 r² + h²) / 12 across, m r² / 2 along. Sphere: 2/5 m r².
    """
    match shape:
        case Box((x, y, z)):
            sides = (y * y + z * z, x * x + z * z, x * x + y * y)
            a, b, c = (mass * each / 12.0 for each in sides)
            return (a, b, c)
        case Cylinder(radius, length):
            across = mass * (3.0 * radius * radius + length * length) / 12.0
            return (across, across, mass * radius * radius / 2.0)
        case Sphere(radius):
            moment = 0.4 * mass * radius * radius
            return (moment, moment, moment)


def moments_of_solids(solids: Sequence[Solid], mass: float) -> Vector:
    """
    Return the moments of inertia of several solids together, by the parallel axis theorem.

    Args:
        solids: bodies of one density.
        mass: of all of them together, kg.

    Returns:
        The moments about the axes of the frame, through the common centre of mass, kg·m².
    """
    volumes = [volume(solid.shape) for solid in solids]
    density = mass / math.fsum(volumes)
    parts = [density * each for each in volumes]
    centres = [solid.pose.translation for solid in solids]
    middle = [math.fsum(map(mul, parts, [c[axis] for c in centres])) / mass for axis in range(3)]
    total = [0.0, 0.0, 0.0]
    for solid, part in zip(solids, parts, strict=True):
        a, b, c = solid_moments(solid.shape, part)
        turned = moments_along_axes(Inertia(a, 0.0, 0.0, b, 0.0, c), solid.pose)
        squares = [(p - q) ** 2 for p, q in zip(solid.pose.translation, middle, strict=True)]
        for axis in range(3):
            total[axis] += turned[axis] + part * (sum(squares) - squares[axis])
    return (total[0], total[1], total[2])


def moments_along_axes(inertia: Inertia, pose: Transform) -> Vector:
    """Return the moments about the axes of the frame of ``pose``: the diagonal of R I Rᵀ."""
    a = (inertia.ixx, inertia.ixy, inertia.ixz)
    b = (inertia.ixy, inertia.iyy, inertia.iyz)
    c = (inertia.ixz, inertia.iyz, inertia.izz)
    rows = matrix_from_quaternion(pose.rotation)
    x, y, z = (dot(row, (dot(a, row), dot(b, row), dot(c, row))) for row in rows)
    return (x, y, z)


def farthest(solid: Solid, direction: Vector, less: float = 0.0) -> Vector:
    """
    Return the farthest point of a solid in a direction, the support function of GJK.

    Args:
        solid: in some frame.
        direction: in the same frame, of any length.
        less: by how much the solid is made thinner on each side, m.
    """
    local = rotate(conjugate(solid.pose.rotation), direction)
    half = tuple(max(0.0, each - less) for each in half_sizes(solid.shape))
    match solid.shape:
        case Box():
            point = tuple(math.copysign(h, d) for h, d in zip(half, local, strict=True))
        case Cylinder():
            across = math.hypot(local[0], local[1])
            scale = half[0] / across if across else 0.0
            point = (local[0] * scale, local[1] * scale, math.copysign(half[2], local[2]))
        case Sphere():
            length = math.hypot(*local)
            point = tuple(half[0] * d / length for d in local) if length else (0.0, 0.0, 0.0)
    x, y, z = point
    return solid.pose.apply((x, y, z))


def overlap(one: Solid, other: Solid, depth: float) -> bool:
    """Return whether two solids penetrate each other by more than about ``depth`` (m)."""
    gap = math.dist(one.pose.translation, other.pose.translation)
    if gap > reach(one.shape) + reach(other.shape) - depth:
        return False

    def difference(direction: Vector) -> Vector:
        x, y, z = direction
        a = farthest(one, direction, depth / 2.0)
        b = farthest(other, (-x, -y, -z), depth / 2.0)
        return (a[0] - b[0], a[1] - b[1], a[2] - b[2])

    return have_common_point(difference)


def have_common_point(support: Support) -> bool:
    """Return whether two bodies touch, given the support function of their difference."""
    simplex = [support((1.0, 0.0, 0.0))]
    direction = _opposite(simplex[0])
    for _ in range(_MOST_STEPS):
        if dot(direction, direction) < _ZERO:
            return True
        point = support(direction)
        if dot(point, direction) <= 0.0:
            return False
        simplex.append(point)
        simplex, direction = _towards_origin(simplex)
    return False


def _towards_origin(simplex: list[Vector]) -> tuple[list[Vector], Vector]:
    """
    Return the part of the simplex nearest to the origin, and the direction from it to the origin.

    The direction is zero when the simplex encloses the origin. The newest point is the last one.
    """
    match simplex:
        case [b, a]:
            return _from_line(a, b)
        case [c, b, a]:
            return _from_triangle(a, b, c)
        case [d, c, b, a]:
            return _from_tetrahedron(a, b, c, d)
    raise AssertionError(f'a simplex of {len(simplex)} points')


def _from_line(a: Vector, b: Vector) -> tuple[list[Vector], Vector]:
    ab, ao = _minus(b, a), _opposite(a)
    if dot(ab, ao) > 0.0:
        return [b, a], cross(cross(ab, ao), ab)
    return [a], ao


def _from_triangle(a: Vector, b: Vector, c: Vector) -> tuple[list[Vector], Vector]:
    ab, ac, ao = _minus(b, a), _minus(c, a), _opposite(a)
    normal = cross(ab, ac)
    if dot(cross(normal, ac), ao) > 0.0:
        return _from_line(a, c) if dot(ac, ao) > 0.0 else _from_line(a, b)
    if dot(cross(ab, normal), ao) > 0.0:
        return _from_line(a, b)
    if dot(normal, ao) > 0.0:
        return [c, b, a], normal
    return [b, c, a], _opposite(normal)


def _from_tetrahedron(a: Vector, b: Vector, c: Vector, d: Vector) -> tuple[list[Vector], Vector]:
    ao = _opposite(a)
    for p, q in ((b, c), (c, d), (d, b)):
        if dot(cross(_minus(p, a), _minus(q, a)), ao) > 0.0:
            return _from_triangle(a, p, q)
    return [d, c, b, a], (0.0, 0.0, 0.0)


def _minus(a: Vector, b: Vector) -> Vector:
    return (a[0] - b[0], a[1] - b[1], a[2] - b[2])


def _opposite(a: Vector) -> Vector:
    return (-a[0], -a[1], -a[2])
