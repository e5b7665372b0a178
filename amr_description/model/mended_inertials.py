# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
Mass and inertia as a solver needs them, where a description has others.

Gazebo joins links that a fixed joint connects, so that a link without mass counts with its parent;
other programs take a moment of 0 as it is. What cannot be simulated so is replaced here by what
is nearest to it:

- A rigid body (links joined by fixed joints) without any mass gets :data:`LEAST_MASS` at its
  topmost link; a link without mass that is joined to one with mass stays without.
- A link with mass and without moments gets those of a small ball, :func:`least_moment`.
- Moments that no body has (negative, or one above the sum of the two others) become those of the
  nearest body. With the second moments of the mass ``S = tr(I) / 2 - I``, which are never negative
  for a body, ``I = tr(S) - S``: negative ones are raised to a little above 0 (P. Wensing, S. Kim,
  J.-J. Slotine, "Linear Matrix Inequalities for Physically-Consistent Inertial Parameter
  Identification", 2018).
"""

from dataclasses import dataclass, replace
import math

from amr_description.model.frames import Transform
from amr_description.model.robot import Inertia, Inertial, Robot, WORLD_LINK

LEAST_MASS = 0.001
"""kg, of a body without mass."""
LEAST_RADIUS = 0.01
"""m, of the ball whose moments a link without moments has."""
LIGHTEST, SMALLEST_MOMENT = 1e-14, 1e-14
"""kg and kg·m²; ten times the least that MuJoCo accepts."""
ROUNDING = 0.01
"""
The share by which moments may violate the triangle inequality, as files round their numbers: they
are mended, as MuJoCo takes not even the last bit of it, and nothing is said.
"""

_MARGIN = 1e-9
"""The share by which the largest moment stays below the sum of the two others."""
_THINNEST = 1e-3
"""The least second moment of a mended inertia, as a share of the largest."""


@dataclass(frozen=True, slots=True)
class MendedInertial:
    """
    What the simulator takes a link's ``<inertial>`` as.

    ``inertial``: None for a link without mass that is joined to one with mass. ``taken`` says
    it in words.
    """

    inertial: Inertial | None
    taken: str


def least_moment(mass: float) -> float:
    """Return the moment (kg·m²) of a ball of ``mass`` (kg) and LEAST_RADIUS: 2/5 m r²."""
    return max(0.4 * mass * LEAST_RADIUS * LEAST_RADIUS, 10.0 * SMALLEST_MOMENT)


def bodies_of(robot: Robot) -> dict[str, str]:
    """Return the topmost link of each link's rigid body: links joined by fixed joints are one."""
    top = {root.name: root.name for root in robot.roots}
    for _, joint in robot.walk():
        top[joint.child] = joint.child if joint.is_moving else top[joint.parent]
    return top


def mended_inertials(robot: Robot) -> dict[str, MendedInertial]:
    """
    Return what links are given instead of their ``<inertial>``, by link.

    Numbers that no program takes are left: a negative mass, a mass beyond measure.
    """
    bodies = bodies_of(robot)
    with_mass = {
        bodies.get(link.name, '') for link in robot.links if _mass(link.inertial) > LIGHTEST
    }
    mended = {}
    for link in robot.links:
        body = bodies.get(link.name, '')
        mass = _mass(link.inertial)
        if not body or mass < 0.0 or math.isinf(mass):
            continue
        if body == WORLD_LINK:
            if link.inertial is not None and not _is_sound(link.inertial):
                mended[link.name] = MendedInertial(None, 'it is a part of the world')
            continue
        if mass > LIGHTEST:
            assert link.inertial is not None
            inertia = mended_inertia(link.inertial.inertia, mass)
            if inertia is not None:
                moments = ', '.join(f'{each:.3g}' for each in principal_moments(inertia))
                mended[link.name] = MendedInertial(
                    replace(link.inertial, inertia=inertia),
                    f'its principal moments are taken as {moments} kg·m²',
                )
        elif body not in with_mass and body == link.name:
            mended[link.name] = _least(link.inertial, link.line)
        elif link.inertial is not None:
            mended[link.name] = MendedInertial(None, _joined(body, link.name, robot))
    return mended


def mended_inertia(inertia: Inertia, mass: float) -> Inertia | None:
    """
    Return the nearest inertia of a body of ``mass`` (kg); None: it is one, or beyond measure.

    An inertia that is not a number, as one that is not given, or without any positive moment, is
    replaced by that of a small ball.
    """
    if not is_finite(inertia):
        return _ball(mass)
    low, middle, high = principal_moments(inertia)
    if low >= SMALLEST_MOMENT and high <= (low + middle) * (1.0 - _MARGIN):
        return None
    if high < SMALLEST_MOMENT:
        return _ball(mass)
    import numpy as np  # not at import: as in principal_moments

    matrix = np.array(_matrix(inertia))
    seconds, axes = np.linalg.eigh(np.eye(3) * np.trace(matrix) / 2.0 - matrix)
    if seconds[-1] <= 0.0:
        return _ball(mass)
    is_rounded = low > 0.0 and high <= (low + middle) * (1.0 + ROUNDING)
    thinnest = 2.0 * _MARGIN if is_rounded else _THINNEST
    least = max(thinnest * float(seconds[-1]), 10.0 * SMALLEST_MOMENT)
    spread = axes @ np.diag(np.maximum(seconds, least)) @ axes.T
    matrix = np.eye(3) * np.trace(spread) - spread
    (ixx, ixy, ixz), (_, iyy, iyz), (_, _, izz) = matrix.tolist()
    return Inertia(ixx, ixy, ixz, iyy, iyz, izz)


def principal_moments(inertia: Inertia) -> tuple[float, float, float]:
    """Return the eigenvalues of the inertia matrix, ascending (kg·m²)."""
    import numpy as np  # not at import: a description without <inertial> needs no numpy

    low, middle, high = np.linalg.eigvalsh(_matrix(inertia)).tolist()
    return low, middle, high


def _least(given: Inertial | None, line: int) -> MendedInertial:
    """Return the least mass, where the link has its own or at its origin."""
    moment = least_moment(LEAST_MASS)
    origin, line = (Transform(), line) if given is None else (given.origin, given.line)
    inertia = Inertia(moment, 0.0, 0.0, moment, 0.0, moment)
    words = f'it is given {LEAST_MASS:g} kg with moments of {moment:.3g} kg·m²'
    return MendedInertial(Inertial(LEAST_MASS, inertia, origin, line), words)


def _joined(body: str, link: str, robot: Robot) -> str:
    joint = robot.parent_joint(link)
    if body == link or joint is None:
        return 'it is a frame without mass'
    return f'it is joined to "{joint.parent}", without mass of its own'


def _ball(mass: float) -> Inertia:
    moment = least_moment(mass)
    return Inertia(moment, 0.0, 0.0, moment, 0.0, moment)


def _mass(inertial: Inertial | None) -> float:
    """Return the mass, kg; 0 where none is given."""
    return 0.0 if inertial is None or math.isnan(inertial.mass) else inertial.mass


def _is_sound(inertial: Inertial) -> bool:
    mass = _mass(inertial)
    return mass > LIGHTEST and mended_inertia(inertial.inertia, mass) is None


def is_finite(inertia: Inertia) -> bool:
    """Return whether all moments are finite numbers."""
    moments = (inertia.ixx, inertia.ixy, inertia.ixz, inertia.iyy, inertia.iyz, inertia.izz)
    return all(map(math.isfinite, moments))


def _matrix(inertia: Inertia) -> list[list[float]]:
    return [
        [inertia.ixx, inertia.ixy, inertia.ixz],
        [inertia.ixy, inertia.iyy, inertia.iyz],
        [inertia.ixz, inertia.iyz, inertia.izz],
    ]
