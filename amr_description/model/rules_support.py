# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""Rules of the checker on how a robot on wheels stands."""

from collections.abc import Iterator, Sequence
from itertools import product
import math

from amr_description.model.findings import Finding
from amr_description.model.frames import Vector
from amr_description.model.robot import Box, Cylinder, Mesh, Sphere
from amr_description.model.shapes import farthest, half_sizes, Solid, solids_of
from amr_description.model.subject import Subject

# m; shapes whose lowest points are this near to the ground stand on it.
_STANDS = 0.005
# m; the centre of mass may be so far outside: an axle has no breadth in the model.
_TOLERANCE = 0.002
_DOWN: Vector = (0.0, 0.0, -1.0)
_TILTS = (-1e-3, 1e-3)
_SIGNS = (-1.0, 1.0)
# A made-up file may hold more shapes than anything stands on.
_MOST_POINTS = 10_000

type _Point = tuple[float, float]


def mass_is_supported(subject: Subject) -> Iterator[Finding]:
    """
    The centre of mass is above the support polygon: the robot does not tip over.

    All joints at 0. The polygon is the convex hull of where wheels, casters and whatever else is
    lowest touch the ground. A robot without two wheels, one that stands fixed and one that
    collides as a mesh are left alone.
    """
    robot = subject.robot
    meshes = any(
        isinstance(part.geometry, Mesh) for link in robot.links for part in link.collisions
    )
    centre = _centre_of_mass(subject)
    if len(subject.wheels) < 2 or meshes or subject.standing_links or centre is None:
        return
    points = _ground_points(subject)
    outside = _distance_outside(centre, convex_hull(points)) if points else 0.0
    if outside > _TOLERANCE:
        wheel = robot.joint(subject.wheels[0].joint)
        xs, ys = [point[0] for point in points], [point[1] for point in points]
        yield subject.warning(
            wheel.line,
            'the robot tips over: its centre of mass is outside the polygon on which it stands',
            found=f'x {centre[0]:.3g}, y {centre[1]:.3g} m, {outside * 1000.0:.0f} mm outside',
            expected=f'within x {min(xs):.3g}..{max(xs):.3g}, y {min(ys):.3g}..{max(ys):.3g} m '
            'of the root frame',
            fix='add a caster, or move the mass or the wheels',
        )


def _centre_of_mass(subject: Subject) -> _Point | None:
    """Return x and y of the centre of mass in the root's frame; None when there is none."""
    total, moment_x, moment_y = 0.0, 0.0, 0.0
    for link in subject.robot.links:
        if link.inertial is None or link.name not in subject.poses:
            continue
        place = subject.poses[link.name].apply(link.inertial.origin.translation)
        total += link.inertial.mass
        moment_x += link.inertial.mass * place[0]
        moment_y += link.inertial.mass * place[1]
    if not 0.0 < total < math.inf:
        return None
    centre = (moment_x / total, moment_y / total)
    return centre if all(map(math.isfinite, centre)) else None


def _ground_points(subject: Subject) -> list[_Point]:
    """Return where the lowest collision shapes touch the ground, x and y in the root's frame."""
    solids = [
        solid
        for link in subject.robot.links
        if link.name in subject.poses
        for solid in solids_of(link.collisions, subject.poses[link.name])
    ]
    lowest = [farthest(solid, _DOWN) for solid in solids[:_MOST_POINTS]]
    ground = min((point[2] for point in lowest), default=0.0)
    return [
        point
        for solid, low in zip(solids, lowest, strict=False)
        if low[2] < ground + _STANDS
        for point in _footprint(solid, ground)
    ]


def _footprint(solid: Solid, ground: float) -> list[_Point]:
    """Return the corners of a shape that are on the ground, of a round one its lowest line."""
    match solid.shape:
        case Sphere():
            corners = [farthest(solid, _DOWN)]
        case Cylinder():
            # The ends of the line on which it lies, or the rim of the base on which it stands.
            corners = [farthest(solid, (x, y, -1.0)) for x in _TILTS for y in _TILTS]
        case Box():
            x, y, z = half_sizes(solid.shape)
            corners = [
                solid.place.apply((i * x, j * y, k * z)) for i, j, k in product(_SIGNS, repeat=3)
            ]
    return [(a, b) for a, b, height in corners if height < ground + _STANDS]


def convex_hull(points: Sequence[_Point]) -> list[_Point]:
    """Return the corners of the convex hull, counter-clockwise (Andrew's monotone chain)."""
    ordered = sorted(set(points))
    if len(ordered) < 3:
        return ordered
    return _half_hull(ordered)[:-1] + _half_hull(ordered[::-1])[:-1]


def _half_hull(points: list[_Point]) -> list[_Point]:
    hull: list[_Point] = []
    for point in points:
        while len(hull) > 1 and _turn(hull[-2], hull[-1], point) <= 0.0:
            hull.pop()
        hull.append(point)
    return hull


def _turn(a: _Point, b: _Point, c: _Point) -> float:
    """Return twice the area of a triangle: positive when it goes round to the left."""
    return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])


def _distance_outside(point: _Point, hull: list[_Point]) -> float:
    """Return how far a point is from a convex polygon; 0 inside."""
    edges = list(zip(hull, hull[1:] + hull[:1], strict=True))
    if len(hull) > 2 and all(_turn(a, b, point) >= 0.0 for a, b in edges):
        return 0.0
    return min(_distance_to_edge(point, a, b) for a, b in edges)


def _distance_to_edge(point: _Point, a: _Point, b: _Point) -> float:
    along = (b[0] - a[0], b[1] - a[1])
    square = math.sumprod(along, along)
    to_point = (point[0] - a[0], point[1] - a[1])
    share = min(1.0, max(0.0, math.sumprod(to_point, along) / square)) if square else 0.0
    return math.dist(point, (a[0] + share * along[0], a[1] + share * along[1]))
