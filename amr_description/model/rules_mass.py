# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
Rules of the checker on mass and inertia: without them a model passes urdfdom and then explodes.

Links joined by fixed joints are one rigid body. What is rigidly joined to a root link called
``world`` never moves and needs no mass.
"""

from collections.abc import Iterator
import math

from amr_description.model.findings import Finding, quote
from amr_description.model.robot import Inertia
from amr_description.model.subject import Subject

# How far rounding of the digits in the file may carry the moments over the triangle inequality.
_ROUNDING = 0.01
# kg and kg·m²; beyond it no solver finds its way.
_HEAVIEST, _LARGEST_MOMENT = 1e9, 1e12
# kg and kg·m²; ten times what MuJoCo takes at least, and nothing that anybody weighs.
_LIGHTEST, _SMALLEST_MOMENT = 1e-14, 1e-14
_FIX = 'add <inertial> with <mass value="…"/> (kg) and <inertia …/> (kg·m²)'


def inertial_is_present(subject: Subject) -> Iterator[Finding]:
    """Whatever touches something, and whatever a moving joint carries, has an ``<inertial>``."""
    robot = subject.robot
    static = subject.standing_links
    massive = _bodies_with_inertial(subject)
    for link in robot.links:
        if link.inertial is not None or link.name in static:
            continue
        joint = robot.parent_joint(link.name)
        if link.collisions:
            # A part that is bolted to one with mass can do without, at the cost of its own.
            is_carried = subject.bodies.get(link.name) in massive
            judge = subject.warning if is_carried else subject.error
            yield judge(
                link.line,
                f'link {quote(link.name)} has a collision shape and no <inertial>',
                fix=_FIX,
            )
        elif joint is not None and joint.is_moving and link.name not in massive:
            yield subject.error(
                link.line,
                f'link {quote(link.name)} moves with {quote(joint.name)} and has no <inertial>',
                fix=_FIX,
            )


def base_has_mass(subject: Subject) -> Iterator[Finding]:
    """The body of the root has mass when something moves on it: it falls and is pushed around."""
    robot = subject.robot
    massive, static = _bodies_with_inertial(subject), subject.standing_links
    if not any(joint.is_moving for joint in robot.joints):
        return
    for root in robot.roots[:1]:
        if root.name not in massive and root.name not in static:
            yield subject.error(
                root.line,
                f'nothing that is rigidly joined to the root {quote(root.name)} has mass',
                fix=f'{_FIX} to a link fixed to it; for a robot bolted down, a root link "world"',
            )


def mass_is_positive(subject: Subject) -> Iterator[Finding]:
    """Mass is above 0, and that of a thing on earth."""
    for link in subject.robot.links:
        if link.inertial is None or _LIGHTEST < link.inertial.mass < _HEAVIEST:
            continue
        if not math.isnan(link.inertial.mass):
            least = _LIGHTEST if 0.0 < link.inertial.mass < _HEAVIEST else 0.0
            yield subject.error(
                link.inertial.line,
                f'link {quote(link.name)}: mass',
                found=f'{link.inertial.mass:g} kg',
                expected=f'more than {least:g} and less than {_HEAVIEST:g}',
            )


def inertia_is_possible(subject: Subject) -> Iterator[Finding]:
    """
    Some distribution of mass has this inertia.

    Its principal moments are positive, and none exceeds the sum of the two others (their sum
    minus the third is twice the second moment of the mass along the third axis).
    """
    for link in subject.robot.links:
        if link.inertial is None or not _is_finite(link.inertial.inertia):
            continue
        low, middle, high = principal_moments(link.inertial.inertia)
        found = f'principal moments {low:.4g}, {middle:.4g}, {high:.4g} kg·m²'
        if low <= 0.0:
            yield subject.error(
                link.inertial.line,
                f'link {quote(link.name)}: the inertia is not positive definite',
                found=found,
                expected='each above 0',
            )
        elif low < _SMALLEST_MOMENT:
            yield subject.error(
                link.inertial.line,
                f'link {quote(link.name)}: the inertia is too small for any solver',
                found=found,
                expected=f'each above {_SMALLEST_MOMENT:g}',
            )
        elif high > (low + middle) * (1.0 + _ROUNDING) or high > _LARGEST_MOMENT:
            yield subject.error(
                link.inertial.line,
                f'link {quote(link.name)}: no body has this inertia',
                found=found,
                expected='none above the sum of the two others (triangle inequality)'
                if high < _LARGEST_MOMENT
                else f'less than {_LARGEST_MOMENT:g}',
            )


def principal_moments(inertia: Inertia) -> tuple[float, float, float]:
    """Return the eigenvalues of the inertia matrix, ascending (kg·m²)."""
    import numpy as np  # not at import: a description without <inertial> needs no numpy

    matrix = [
        [inertia.ixx, inertia.ixy, inertia.ixz],
        [inertia.ixy, inertia.iyy, inertia.iyz],
        [inertia.ixz, inertia.iyz, inertia.izz],
    ]
    low, middle, high = np.linalg.eigvalsh(matrix).tolist()
    return low, middle, high


def _is_finite(inertia: Inertia) -> bool:
    moments = (inertia.ixx, inertia.ixy, inertia.ixz, inertia.iyy, inertia.iyz, inertia.izz)
    return all(map(math.isfinite, moments))


def _bodies_with_inertial(subject: Subject) -> set[str]:
    """Return the topmost links of the rigid bodies in which some link has an ``<inertial>``."""
    links = (link.name for link in subject.robot.links if link.inertial is not None)
    return {subject.bodies.get(link, '') for link in links}
