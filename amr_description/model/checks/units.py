# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
Rules on units: lengths in millimetres and masses in grams, as CAD programs write them.

Where one is found, other rules would only tell its consequences, and leave the part out.
"""

from collections.abc import Iterator

from amr_description.model.checks.context import CheckContext
from amr_description.model.findings import Finding
from amr_description.model.robot import Box, Collision, Cylinder, Geometry, Link, Sphere, Visual
from amr_description.model.shapes import sizes, volume
from amr_description.text import quote

# m; links of vehicles and arms are shorter, and few lengths in mm are below 10.
_LONGEST = 10.0
# In a shape that is in mm, what is above this is, too.
_ONE = 1.0
# kg/m³; twice what the heaviest metal has. A shape may be smaller than what it stands for.
_DENSEST = 50_000.0
# kg; below it a shape may be a token only, as that of a sensor of 1 g.
_HEAVY = 10.0


def lengths_are_in_metres(context: CheckContext) -> Iterator[Finding]:
    """
    No shape, and no origin of a joint, is longer than 10 m, unless it is fixed to the world.

    The finding asks: ``160 m: millimetres?``
    """
    for link in context.robot.links:
        if link.name in context.fixed_links:
            continue
        for part in _parts(link):
            attributes = _attributes(part.geometry)
            long = {name: text for name, text in attributes.items() if _is_long(text)}
            if long:
                name, text = next(iter(long.items()))
                kind = type(part.geometry).__name__.lower()
                yield context.warning(
                    part.line,
                    f'link {quote(link.name)}: the {name} of its {kind} is {text} m: millimetres?',
                    fix=f'write {_in_metres(attributes)}',
                )
                break
    for joint in context.robot.joints:
        xyz = ' '.join(f'{part:g}' for part in joint.origin.translation)
        if joint.parent not in context.fixed_links and _is_long(xyz):
            yield context.warning(
                joint.line,
                f'joint {quote(joint.name)}: the xyz of its <origin> is {xyz} m: millimetres?',
                fix=f'write {_in_metres({"xyz": xyz})}',
            )


def masses_are_in_kilograms(context: CheckContext) -> Iterator[Finding]:
    """
    No link has a mass that its collision shapes cannot hold, were they solid osmium.

    That is, no link of more than 10 kg is denser than 50,000 kg/m³: ``grams?``
    """
    for link in context.robot.links:
        if is_in_grams(link):
            assert link.inertial is not None
            mass = link.inertial.mass
            yield context.warning(
                link.inertial.line,
                f'link {quote(link.name)}: a mass of {mass:g} kg in a shape of '
                f'{_volume(link):.3g} m³: grams?',
                fix=f'write <mass value="{mass * 0.001:g}"/>',
            )


def is_in_millimetres(link: Link) -> bool:
    """Return whether a shape of a link is too long for one in metres."""
    return any(
        _is_long(text) for part in _parts(link) for text in _attributes(part.geometry).values()
    )


def is_in_grams(link: Link) -> bool:
    """Return whether a link is too heavy for its collision shapes."""
    mass = 0.0 if link.inertial is None else link.inertial.mass
    room = _volume(link)
    return mass > _HEAVY and room > 0.0 and mass / room > _DENSEST


def are_doubtful(context: CheckContext) -> bool:
    """Return whether units are mixed up, so that nothing can be said of the whole robot."""
    rules = (lengths_are_in_metres, masses_are_in_kilograms)
    return any(True for rule in rules for _ in rule(context))


def _parts(link: Link) -> tuple[Collision | Visual, ...]:
    return (*link.collisions, *link.visuals)


def _attributes(geometry: Geometry) -> dict[str, str]:
    """Return the lengths of a primitive shape as they are written."""
    match geometry:
        case Box():
            return {'size': ' '.join(f'{each:g}' for each in sizes(geometry))}
        case Cylinder():
            return {'radius': f'{geometry.radius:g}', 'length': f'{geometry.length:g}'}
        case Sphere():
            return {'radius': f'{geometry.radius:g}'}
    return {}


def _is_long(text: str) -> bool:
    return any(_LONGEST < abs(float(word)) < float('inf') for word in text.split())


def _in_metres(attributes: dict[str, str]) -> str:
    """Return attributes with what is in mm in m."""
    return ' '.join(
        f'{name}="{" ".join(map(_word_in_metres, text.split()))}"'
        for name, text in attributes.items()
    )


def _word_in_metres(word: str) -> str:
    value = float(word)
    return f'{value * 0.001:g}' if abs(value) > _ONE else word


def _volume(link: Link) -> float:
    """Return the volume of the collision shapes (m³); 0 where one is a mesh."""
    shapes = [part.geometry for part in link.collisions]
    if not all(isinstance(shape, Box | Cylinder | Sphere) for shape in shapes):
        return 0.0
    return sum(volume(shape) for shape in shapes if isinstance(shape, Box | Cylinder | Sphere))
