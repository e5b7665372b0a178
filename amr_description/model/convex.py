# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
Whether two convex bodies touch: the algorithm of Gilbert, Johnson and Keerthi (1988).

Two bodies have a point in common when their Minkowski difference holds the origin. A simplex of at
most four of its points is led towards the origin until it encloses it, or cannot get there.
"""

from collections.abc import Callable

from amr_description.model.frames import cross, Vector

# Bodies that merely graze each other may go round for ever; they count as apart.
_MOST_STEPS = 64
_ZERO = 1e-18

type Support = Callable[[Vector], Vector]
"""Direction -> the point of the Minkowski difference that is farthest that way."""


def have_common_point(support: Support) -> bool:
    """Tell whether two bodies touch, given the support function of their difference."""
    simplex = [support((1.0, 0.0, 0.0))]
    direction = _opposite(simplex[0])
    for _ in range(_MOST_STEPS):
        if _dot(direction, direction) < _ZERO:
            return True
        point = support(direction)
        if _dot(point, direction) <= 0.0:
            return False
        simplex.append(point)
        simplex, direction = _towards_origin(simplex)
    return False


def _towards_origin(simplex: list[Vector]) -> tuple[list[Vector], Vector]:
    """
    Return the part of the simplex that is next to the origin, and the way from it to the origin;
    a zero vector when the simplex encloses it. The newest point stands last.
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
    if _dot(ab, ao) > 0.0:
        return [b, a], cross(cross(ab, ao), ab)
    return [a], ao


def _from_triangle(a: Vector, b: Vector, c: Vector) -> tuple[list[Vector], Vector]:
    ab, ac, ao = _minus(b, a), _minus(c, a), _opposite(a)
    normal = cross(ab, ac)
    if _dot(cross(normal, ac), ao) > 0.0:
        return _from_line(a, c) if _dot(ac, ao) > 0.0 else _from_line(a, b)
    if _dot(cross(ab, normal), ao) > 0.0:
        return _from_line(a, b)
    if _dot(normal, ao) > 0.0:
        return [c, b, a], normal
    return [b, c, a], _opposite(normal)


def _from_tetrahedron(a: Vector, b: Vector, c: Vector, d: Vector) -> tuple[list[Vector], Vector]:
    ao = _opposite(a)
    for p, q in ((b, c), (c, d), (d, b)):
        if _dot(cross(_minus(p, a), _minus(q, a)), ao) > 0.0:
            return _from_triangle(a, p, q)
    return [d, c, b, a], (0.0, 0.0, 0.0)


def _dot(a: Vector, b: Vector) -> float:
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]


def _minus(a: Vector, b: Vector) -> Vector:
    return (a[0] - b[0], a[1] - b[1], a[2] - b[2])


def _opposite(a: Vector) -> Vector:
    return (-a[0], -a[1], -a[2])
