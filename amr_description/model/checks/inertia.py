# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
Rules on mass and inertia, and on whether a robot on wheels stands.

Without sound mass properties a model passes urdfdom and then explodes in a simulation. Links
joined by fixed joints are one rigid body. What is rigidly joined to a root link called ``world``
never moves and needs no mass.
"""

from collections.abc import Iterator, Sequence
from itertools import permutations, product
import math
from typing import TypeAlias

from amr_description.model.checks.axles import lying_flat
from amr_description.model.checks.context import CheckContext
from amr_description.model.checks.units import is_in_grams, is_in_millimetres
from amr_description.model.findings import Finding
from amr_description.model.frames import Transform, Vector
from amr_description.model.mended_inertials import (
    is_finite,
    LIGHTEST,
    principal_moments,
    ROUNDING,
    SMALLEST_MOMENT,
)
from amr_description.model.robot import Box, Cylinder, Inertial, Link, Mesh, Sphere
from amr_description.model.shapes import (
    farthest,
    half_sizes,
    moments_along_axes,
    moments_of_solids,
    Solid,
    solids_of,
)
from amr_description.text import quote

# m; shapes whose lowest points are this close to the ground stand on it.
_STANDS = 0.005
# m; the centre of mass may be this far outside: an axle has no width in the model.
_TOLERANCE = 0.002
_DOWN: Vector = (0.0, 0.0, -1.0)
_TILTS = (-1e-3, 1e-3)
_SIGNS = (-1.0, 1.0)
# Limits the time for files with absurdly many shapes.
_MOST_POINTS = 10_000
_Point: TypeAlias = tuple[float, float]
# A hollow sphere has 5/3 of the moment of a solid one, a thin ring twice that of a disc, a heavy
# core a fraction; typing errors (g or mm, a diameter for a radius) exceed this factor.
_FACTOR = 3.0
# The collision of a link that is drawn by a mesh is a sketch of it, often much slimmer.
_FACTOR_OF_A_SKETCH = 10.0
# Moments that agree this closely after two axes are exchanged, and not before, were swapped.
_SWAPPED, _NOT_SWAPPED = 1.1, 1.5
# kg and kg·m²; solvers fail beyond.
_HEAVIEST, _LARGEST_MOMENT = 1e9, 1e12
_FIX = 'add <inertial> with <mass value="…"/> (kg) and <inertia …/> (kg·m²)'


def inertial_is_present(context: CheckContext) -> Iterator[Finding]:
    """
    A link with a collision shape, or that a moving joint carries, has an ``<inertial>``.

    Or a bare link fixed to it has the mass of both.
    """
    robot = context.robot
    static = context.fixed_links
    massive = _bodies_with_inertial(context)
    weighed = {
        context.bodies.get(link.name)
        for link in robot.links
        if link.inertial is not None
        and not (link.visuals or link.collisions or robot.child_joints(link.name))
    }
    for link in robot.links:
        if link.inertial is not None or link.name in static:
            continue
        if context.bodies.get(link.name) in weighed & massive:
            continue  # a link of its own stands for the mass of all of it
        joint = robot.parent_joint(link.name)
        if link.collisions:
            # A part fixed to one with mass moves with it, but its own mass is missing.
            yield context.warning(
                link.line,
                f'link {quote(link.name)} has a collision shape and no <inertial>',
                taken=''
                if context.bodies.get(link.name) in massive
                else _taken(context, link.name) or 'it is a part without mass',
                fix=_FIX,
            )
        elif joint is not None and joint.is_moving and link.name not in massive:
            yield context.warning(
                link.line,
                f'link {quote(link.name)} moves with {quote(joint.name)} and has no <inertial>',
                taken=_taken(context, link.name),
                fix=_FIX,
            )


def base_has_mass(context: CheckContext) -> Iterator[Finding]:
    """The rigid body of the root has mass if the robot has moving joints."""
    robot = context.robot
    massive, static = _bodies_with_inertial(context), context.fixed_links
    if not any(joint.is_moving for joint in robot.joints):
        return
    for root in robot.roots[:1]:
        if root.name not in massive and root.name not in static and not root.collisions:
            yield context.warning(
                root.line,
                f'nothing that is rigidly joined to the root {quote(root.name)} has mass',
                taken=_taken(context, root.name),
                fix=f'{_FIX} to a link fixed to it; for a robot bolted down, a root link "world"',
            )


def mass_is_positive(context: CheckContext) -> Iterator[Finding]:
    """
    Mass is above 0 and within what a solver can handle.

    That is from 10⁻¹⁴ to 10⁹ kg.
    """
    for link in context.robot.links:
        if link.inertial is None or LIGHTEST < link.inertial.mass < _HEAVIEST:
            continue
        if not math.isnan(link.inertial.mass):
            least = LIGHTEST if 0.0 < link.inertial.mass < _HEAVIEST else 0.0
            taken = _taken(context, link.name)
            report = context.warning if taken else context.error
            yield report(
                link.inertial.line,
                f'link {quote(link.name)}: mass',
                found=f'{link.inertial.mass:g} kg',
                expected=f'more than {least:g} and less than {_HEAVIEST:g}',
                taken=taken,
            )


def inertia_is_possible(context: CheckContext) -> Iterator[Finding]:
    """
    The inertia is that of some distribution of mass.

    Its principal moments are positive, and none exceeds the sum of the two others (their sum minus
    the third is twice the second moment of the mass along the third axis). Each is between 10⁻¹⁴
    and 10¹² kg·m². Of a link that never moves, or whose mass is wrong, it is not looked at.
    """
    for link in context.robot.links:
        taken = _taken(context, link.name)
        if link.inertial is None or not is_finite(link.inertial.inertia):
            continue
        if not link.inertial.mass > LIGHTEST or link.name in context.fixed_links:
            continue
        low, middle, high = principal_moments(link.inertial.inertia)
        found = f'principal moments {low:.4g}, {middle:.4g}, {high:.4g} kg·m²'
        what, expected = '', ''
        if high > _LARGEST_MOMENT:
            what, expected = 'no body has this inertia', f'less than {_LARGEST_MOMENT:g}'
            taken = ''
        elif low <= 0.0:
            what, expected = 'the inertia is not positive definite', 'each above 0'
        elif low < SMALLEST_MOMENT:
            what = 'the inertia is too small for any solver'
            expected = f'each above {SMALLEST_MOMENT:g}'
        elif high > (low + middle) * (1.0 + ROUNDING):
            what = 'no body has this inertia'
            expected = 'none above the sum of the two others (triangle inequality)'
        if what:
            report = context.warning if taken else context.error
            yield report(
                link.inertial.line,
                f'link {quote(link.name)}: {what}',
                found=found,
                expected=expected,
                taken=taken,
            )


def inertia_fits_the_shape(context: CheckContext) -> Iterator[Finding]:
    """
    The inertia is close to that of a homogeneous solid of the link's mass and collision shape.

    Formulas: :func:`~amr_description.model.shapes.solid_moments`, several shapes together by the
    parallel axis theorem. Links with collision meshes are not checked. Close is within a factor of
    3, and on its axes.
    """
    for link in context.robot.links:
        solid = _solid_moments(link)
        if link.inertial is None or solid is None:
            continue
        if is_in_millimetres(link) or is_in_grams(link) or _taken(context, link.name):
            continue  # which is reported, and explains it
        given = moments_along_axes(link.inertial.inertia, link.inertial.origin)
        if not all(0.0 < moment < math.inf for moment in given):
            continue
        name = quote(link.name)
        is_sketch = any(isinstance(visual.geometry, Mesh) for visual in link.visuals)
        if _factor(given, solid) > (_FACTOR_OF_A_SKETCH if is_sketch else _FACTOR):
            what = f'link {name}: the inertia is not that of its collision shape'
        elif _is_swapped(given, solid):
            what = f'link {name}: the moments of inertia stand on the wrong axes'
        else:
            continue
        yield context.warning(
            link.inertial.line,
            what,
            found=f'{_list(given)} kg·m² about x, y, z',
            expected=f'about {_list(solid)}, as a solid of {link.inertial.mass:g} kg has',
            fix='correct <inertia>, or the mass or the shape',
        )


def root_has_no_inertial(context: CheckContext) -> Iterator[Finding]:
    """The root of a robot that moves has no inertia, which KDL would ignore."""
    root = context.robot.roots[0] if context.robot.roots else None
    if root is not None and root.inertial is not None and context.robot.child_joints(root.name):
        yield context.warning(
            root.inertial.line,
            f'the root link {quote(root.name)} has an inertia, which KDL does not support',
            fix='add a root link without mass, such as <link name="base_footprint"/>, and a fixed '
            'joint from it to this one',
        )


def mass_is_supported(context: CheckContext) -> Iterator[Finding]:
    """
    The centre of mass is above the support polygon, so that the robot does not tip over.

    All joints are at 0. The polygon is the convex hull of the points where the lowest shapes touch
    the ground. Robots with fewer than two wheels, with a fixed base or with collision meshes are
    not checked. Where the wheels lie flat, or a caster reaches below them or not down to the
    ground, that is the cause.
    """
    robot = context.robot
    meshes = any(
        isinstance(part.geometry, Mesh) for link in robot.links for part in link.collisions
    )
    centre = _centre_of_mass(context)
    if len(context.wheels) < 2 or meshes or context.fixed_links or centre is None:
        return
    points = _ground_points(context)
    outside = _distance_outside(centre, convex_hull(points)) if points else 0.0
    flat = lying_flat(context)
    cause = _deeper_than_the_wheels(context)
    if outside > _TOLERANCE:
        cause = flat or cause or _above_the_ground(context, centre, points)
    if cause is not None and (outside > _TOLERANCE or flat is None):
        yield cause
    elif outside > _TOLERANCE:
        wheel = robot.joint(context.wheels[0].joint)
        xs, ys = [point[0] for point in points], [point[1] for point in points]
        yield context.warning(
            wheel.line,
            'the robot tips over: its centre of mass is outside the polygon on which it stands',
            found=f'x {centre[0]:.3g}, y {centre[1]:.3g} m, {outside * 1000.0:.0f} mm outside',
            expected=f'within x {min(xs):.3g}..{max(xs):.3g}, y {min(ys):.3g}..{max(ys):.3g} m '
            'of the root frame',
            fix='add a caster, or move the mass or the wheels',
        )


def _deeper_than_the_wheels(context: CheckContext) -> Finding | None:
    """Return the finding on a link that reaches below the driven wheels, so that these hang."""
    wheels = {wheel.link for wheel in context.wheels}
    lows = _lowest_points(context)
    ground = min(low for low, link, _ in lows if link.name in wheels)
    low, link, _ = min(lows, key=lambda item: item[0])
    joint = context.robot.parent_joint(link.name)
    if ground - low < _STANDS or joint is None:
        return None
    return context.warning(
        joint.line,
        f'link {quote(link.name)} reaches below the driven wheels, which hang in the air',
        found=f'{(ground - low) * 1000.0:.0f} mm below them',
        expected='the same height',
        fix=f'raise it by {ground - low:.3g} m in the <origin> of joint {quote(joint.name)}, or '
        'make it smaller',
    )


def _above_the_ground(
    context: CheckContext, centre: _Point, points: Sequence[_Point]
) -> Finding | None:
    """Return the finding on a ball that would hold the robot up if it reached the ground."""
    lows = _lowest_points(context)
    ground = min(low for low, _, _ in lows)
    for low, link, solid in sorted(lows, key=lambda item: item[0]):
        joint = context.robot.parent_joint(link.name)
        x, y, _ = farthest(solid, _DOWN)
        if not isinstance(solid.shape, Sphere) or low - ground < _STANDS or joint is None:
            continue
        if _distance_outside(centre, convex_hull([*points, (x, y)])) <= _TOLERANCE:
            return context.warning(
                joint.line,
                f'link {quote(link.name)} does not reach the ground, and the robot tips over',
                found=f'{(low - ground) * 1000.0:.0f} mm above it',
                expected='the height of the wheels',
                fix=f'lower it by {low - ground:.3g} m in the <origin> of joint '
                f'{quote(joint.name)}, or make it larger',
            )
    return None


def _lowest_points(context: CheckContext) -> list[tuple[float, Link, Solid]]:
    """Return the height of the lowest point of each collision shape, in the frame of the root."""
    return [
        (farthest(solid, _DOWN)[2], link, solid)
        for link in context.robot.links
        if link.name in context.poses
        for solid in solids_of(link.collisions, context.poses[link.name])[:_MOST_POINTS]
    ]


def convex_hull(points: Sequence[_Point]) -> list[_Point]:
    """Return the corners of the convex hull, counter-clockwise (Andrew's monotone chain)."""
    ordered = sorted(set(points))
    if len(ordered) < 3:
        return ordered
    return _half_hull(ordered)[:-1] + _half_hull(ordered[::-1])[:-1]


def _taken(context: CheckContext, link: str) -> str:
    """Return what the simulator takes the ``<inertial>`` of a link as; '' for what stands."""
    mended = context.mended_inertials.get(link)
    return '' if mended is None else mended.taken


def _bodies_with_inertial(context: CheckContext) -> set[str]:
    """Return the topmost links of the rigid bodies in which some link has a mass, or no number."""
    links = (
        link.name
        for link in context.robot.links
        if link.inertial is not None and not link.inertial.mass <= LIGHTEST
    )
    return {context.bodies.get(link, '') for link in links}


def _solid_moments(link: Link) -> Vector | None:
    """Return the moments of the link as a solid, or None if they are not known."""
    solids = solids_of(link.collisions, Transform())
    mass = _mass(link.inertial)
    if not solids or len(solids) != len(link.collisions) or not 0.0 < mass < _HEAVIEST:
        return None
    moments = moments_of_solids(solids, mass)
    return moments if min(moments) > 0.0 else None


def _mass(inertial: Inertial | None) -> float:
    return math.nan if inertial is None else inertial.mass


def _factor(one: Vector, other: Vector) -> float:
    """Return the largest ratio between two triples of moments, 1 or above."""
    return max(max(a / b, b / a) for a, b in zip(one, other, strict=True))


def _is_swapped(given: Vector, solid: Vector) -> bool:
    return _factor(given, solid) > _NOT_SWAPPED and any(
        _factor(given, (a, b, c)) < _SWAPPED for a, b, c in permutations(solid)
    )


def _list(moments: Vector) -> str:
    return ', '.join(f'{moment:.3g}' for moment in moments)


def _centre_of_mass(context: CheckContext) -> _Point | None:
    """Return x and y of the centre of mass in the frame of the root; None without mass."""
    total, moment_x, moment_y = 0.0, 0.0, 0.0
    for link in context.robot.links:
        if link.inertial is None or link.name not in context.poses:
            continue
        point = context.poses[link.name].apply(link.inertial.origin.translation)
        total += link.inertial.mass
        moment_x += link.inertial.mass * point[0]
        moment_y += link.inertial.mass * point[1]
    if not 0.0 < total < math.inf:
        return None
    centre = (moment_x / total, moment_y / total)
    return centre if all(map(math.isfinite, centre)) else None


def _ground_points(context: CheckContext) -> list[_Point]:
    """Return where the lowest collision shapes touch the ground, x and y in the root's frame."""
    solids = [
        solid
        for link in context.robot.links
        if link.name in context.poses
        for solid in solids_of(link.collisions, context.poses[link.name])
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
    """Return the corners of a shape that are on the ground; for a round one its lowest line."""
    match solid.shape:
        case Sphere():
            corners = [farthest(solid, _DOWN)]
        case Cylinder():
            # The ends of the line on which it lies, or the rim of the base on which it stands.
            corners = [farthest(solid, (x, y, -1.0)) for x in _TILTS for y in _TILTS]
        case Box():
            x, y, z = half_sizes(solid.shape)
            corners = [
                solid.pose.apply((i * x, j * y, k * z)) for i, j, k in product(_SIGNS, repeat=3)
            ]
    return [(a, b) for a, b, height in corners if height < ground + _STANDS]


def _half_hull(points: list[_Point]) -> list[_Point]:
    hull: list[_Point] = []
    for point in points:
        while len(hull) > 1 and _turn(hull[-2], hull[-1], point) <= 0.0:
            hull.pop()
        hull.append(point)
    return hull


def _turn(a: _Point, b: _Point, c: _Point) -> float:
    """Return twice the area of a triangle; positive if it is counter-clockwise."""
    return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])


def _distance_outside(point: _Point, hull: list[_Point]) -> float:
    """Return how far a point is from a convex polygon; 0 inside."""
    edges = list(zip(hull, hull[1:] + hull[:1], strict=True))
    if len(hull) > 2 and all(_turn(a, b, point) >= 0.0 for a, b in edges):
        return 0.0
    return min(_distance_to_edge(point, a, b) for a, b in edges)


def _distance_to_edge(point: _Point, a: _Point, b: _Point) -> float:
    along = (b[0] - a[0], b[1] - a[1])
    square = along[0] ** 2 + along[1] ** 2
    reached = (point[0] - a[0]) * along[0] + (point[1] - a[1]) * along[1]
    share = min(1.0, max(0.0, reached / square)) if square else 0.0
    return math.dist(point, (a[0] + share * along[0], a[1] + share * along[1]))
