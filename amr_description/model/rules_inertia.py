# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""Rules of the checker on inertia that is possible, and still not that of the link."""

from collections.abc import Iterator
from itertools import permutations
import math

from amr_description.model.findings import Finding, quote
from amr_description.model.frames import Transform, Vector
from amr_description.model.robot import Inertial, Link
from amr_description.model.shapes import moments_along_axes, moments_of_solids, solids_of
from amr_description.model.subject import Subject

# A hollow sphere has 5/3 of the moment of a solid one, a thin ring twice that of a disc, a heavy
# core a fraction; slips of the pen (g or mm, a diameter for a radius) are beyond this factor.
_FACTOR = 3.0
# Moments that are this close when two axes change places, and not before, were swapped.
_SWAPPED, _NOT_SWAPPED = 1.1, 1.5
_HEAVIEST = 1e9


def inertia_fits_the_shape(subject: Subject) -> Iterator[Finding]:
    """
    The inertia is about that of a solid of the link's mass and collision shape.

    Formulas: :func:`~amr_description.model.shapes.solid_moments`, several shapes together by the
    parallel axis theorem. A link that collides as a mesh is left alone.
    """
    for link in subject.robot.links:
        solid = _solid_moments(link)
        if link.inertial is None or solid is None:
            continue
        given = moments_along_axes(link.inertial.inertia, link.inertial.origin)
        if not all(0.0 < moment < math.inf for moment in given):
            continue
        name = quote(link.name)
        if _factor(given, solid) > _FACTOR:
            what = f'link {name}: the inertia is not that of its collision shape'
        elif _is_swapped(given, solid):
            what = f'link {name}: the moments of inertia stand on the wrong axes'
        else:
            continue
        yield subject.warning(
            link.inertial.line,
            what,
            found=f'{_list(given)} kg·m² about x, y, z',
            expected=f'about {_list(solid)}, as a solid of {link.inertial.mass:g} kg has',
            fix='correct <inertia>, or the mass or the shape',
        )


def root_has_no_inertial(subject: Subject) -> Iterator[Finding]:
    """The root of a robot that moves is a mere frame: KDL takes no inertia of it."""
    root = subject.robot.roots[0] if subject.robot.roots else None
    if root is not None and root.inertial is not None and subject.robot.child_joints(root.name):
        yield subject.warning(
            root.inertial.line,
            f'the root link {quote(root.name)} has an inertia, which KDL does not support',
            fix='add a root link without mass, such as <link name="base_footprint"/>, and a fixed '
            'joint from it to this one',
        )


def _solid_moments(link: Link) -> Vector | None:
    """Return the moments of the link as a solid, or None when they cannot be told."""
    solids = solids_of(link.collisions, Transform())
    mass = _mass(link.inertial)
    if not solids or len(solids) != len(link.collisions) or not 0.0 < mass < _HEAVIEST:
        return None
    moments = moments_of_solids(solids, mass)
    return moments if min(moments) > 0.0 else None


def _mass(inertial: Inertial | None) -> float:
    return math.nan if inertial is None else inertial.mass


def _factor(one: Vector, other: Vector) -> float:
    """Return by how much two triples of moments differ at most, 1 or above."""
    return max(max(a / b, b / a) for a, b in zip(one, other, strict=True))


def _is_swapped(given: Vector, solid: Vector) -> bool:
    return _factor(given, solid) > _NOT_SWAPPED and any(
        _factor(given, (a, b, c)) < _SWAPPED for a, b, c in permutations(solid)
    )


def _list(moments: Vector) -> str:
    return ', '.join(f'{moment:.3g}' for moment in moments)
