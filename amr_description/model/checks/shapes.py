# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""Rules on visual and collision shapes: their sizes and colours, and whether they overlap."""

from collections.abc import Iterator
from typing import TypeAlias

from amr_description.model.checks.context import CheckContext
from amr_description.model.findings import Finding, NO_SHAPE
from amr_description.model.robot import Collision, Geometry, Link, Mesh, Visual
from amr_description.model.shapes import overlap, reach, sizes, Solid, solids_of
from amr_description.model.xml_reader import line_of
from amr_description.text import quote

# m; shapes that overlap by less only touch, as mounted parts do.
_DEPTH = 0.002
# Limits the time for files with thousands of shapes at one point.
_MOST_PAIRS = 20_000


def sizes_are_positive(context: CheckContext) -> Iterator[Finding]:
    """
    Every side, radius, length and scale of a shape is above 0; a mesh may be mirrored.

    One of size 0 is left out by the simulator; a negative one means nothing.
    """
    for link in context.robot.links:
        parts: tuple[Visual | Collision, ...] = (*link.visuals, *link.collisions)
        for part in parts:
            wrong = [size for size in _sizes(part.geometry) if size <= 0.0]
            if wrong:
                kind = 'visual' if isinstance(part, Visual) else 'collision'
                shape = type(part.geometry).__name__.lower()
                is_negative = any(size < 0.0 for size in wrong)
                report = context.error if is_negative else context.warning
                yield report(
                    part.line,
                    f'link {quote(link.name)}: the {shape} of its {kind} has no volume',
                    found=' '.join(f'{size:g}' for size in _sizes(part.geometry)),
                    expected='sizes above 0, in m',
                    taken='' if is_negative else NO_SHAPE,
                )


def _sizes(geometry: Geometry) -> tuple[float, ...]:
    if isinstance(geometry, Mesh):
        return tuple(abs(scale) for scale in geometry.scale)
    return sizes(geometry)


def collision_is_present(context: CheckContext) -> Iterator[Finding]:
    """
    A link with mass and a visual shape has a collision shape.

    It needs none where its rigid body has one, as trim, or carries one, as a caster's fork.
    """
    touching = _with_what_carries_them(context)
    for link in context.robot.links:
        if link.inertial is None or not link.visuals or link.collisions:
            continue
        if context.bodies.get(link.name, link.name) not in touching:
            yield context.warning(
                link.line,
                f'link {quote(link.name)} has mass and is seen, but has no <collision>',
                expected='a shape that touches; without one it passes through everything',
                fix='add <collision> with the <geometry> of its <visual>',
            )


def _with_what_carries_them(context: CheckContext) -> set[str]:
    """Return the topmost links of the bodies that touch, or carry one that does."""
    robot = context.robot
    found: set[str] = set()
    for link in robot.links:
        body = context.bodies.get(link.name) if link.collisions else None
        while body is not None and body not in found:
            found.add(body)
            joint = robot.parent_joint(body)
            body = None if joint is None else context.bodies.get(joint.parent)
    return found


def colors_are_visible(context: CheckContext) -> Iterator[Finding]:
    """Colours are within 0..1, and a material of the robot's own list has one."""
    for element in context.xml.iter('material'):
        parent = element.getparent()
        if parent is None or parent.tag not in ('robot', 'visual'):
            continue
        name = f'material {quote(element.get("name", ""))}'
        line = line_of(element)
        color, texture = element.find('color'), element.find('texture')
        if parent.tag == 'robot' and color is None and texture is None:
            yield context.warning(
                line, f'{name} has neither color nor texture', fix='add <color rgba="r g b a"/>'
            )
        text = '' if color is None else color.get('rgba', '')
        if any(not 0.0 <= part <= 1.0 for part in _numbers(text)):
            yield context.warning(
                line_of(color),
                f'{name}: color',
                found=quote(text),
                expected='red, green, blue and opacity, each from 0 to 1',
            )


def _numbers(text: str) -> list[float]:
    """Return the numbers of a text; none when one of its words is none, which was reported."""
    try:
        return [float(word) for word in text.split()]
    except ValueError:
        return []


def shapes_do_not_overlap(context: CheckContext) -> Iterator[Finding]:
    """
    Collision shapes of links that are not neighbours are apart, all joints at 0.

    Links of one rigid body may overlap, and so may neighbours: two bodies with a joint between
    them, or with a chain of joints whose links have no shapes. A wheel reaches into the chassis,
    on a suspension too. Meshes are left out.
    """
    reported: set[tuple[str, str]] = set()
    neighbours = _neighbours(context)
    for one, other in _near_pairs(_placed_solids(context)):
        (link, solid), (other_link, other_solid) = one, other
        pair = (context.bodies[link.name], context.bodies[other_link.name])
        if pair[0] == pair[1] or pair in neighbours or (link.name, other_link.name) in reported:
            continue
        if overlap(solid, other_solid, _DEPTH):
            reported.add((link.name, other_link.name))
            yield context.warning(
                max(link.line, other_link.line),
                f'the collision shapes of links {quote(link.name)} and {quote(other_link.name)} '
                'overlap, all joints at 0',
                expected=f'shapes apart, or in each other by less than {_DEPTH * 1000.0:g} mm',
                fix='make one smaller, or move it',
            )


_Placed: TypeAlias = tuple[Link, Solid]


def _placed_solids(context: CheckContext) -> list[_Placed]:
    """Return the primitive collision shapes of all links, placed in the root's frame."""
    return [
        (link, solid)
        for link in context.robot.links
        if link.name in context.poses
        for solid in solids_of(link.collisions, context.poses[link.name])
    ]


def _neighbours(context: CheckContext) -> set[tuple[str, str]]:
    """Return the pairs of rigid bodies with no other that touches between, either way round."""
    touching = {context.bodies.get(link.name) for link in context.robot.links if link.collisions}
    pairs = set()
    for joint in context.robot.joints:
        child = context.bodies.get(joint.child, '')
        parent = context.bodies.get(joint.parent, '')
        pairs.add((parent, child))
        for _ in context.robot.links:  # at most so many, in a tree that is none too
            above = context.robot.parent_joint(parent)
            if parent in touching or above is None:
                break
            parent = context.bodies.get(above.parent, '')
            pairs.add((parent, child))
    return pairs | {(child, parent) for parent, child in pairs}


def _near_pairs(placed: list[_Placed]) -> Iterator[tuple[_Placed, _Placed]]:
    """Yield pairs whose extents along x meet, the leftmost first, as many as are looked at."""
    spans = []
    for item in placed:
        x, radius = item[1].pose.translation[0], reach(item[1].shape)
        spans.append((x - radius, x + radius, item))
    spans.sort(key=lambda span: span[0])
    left = _MOST_PAIRS
    for index, (_, end, item) in enumerate(spans):
        for other in range(index + 1, len(spans)):
            if spans[other][0] > end:
                break
            if left == 0:
                return
            left -= 1
            yield item, spans[other][2]
