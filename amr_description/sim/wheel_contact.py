# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
The contact of a wheel with a static surface, and its measured settings.

Four fixed wheels scrub when the robot turns. With MuJoCo's default contacts the slip lifts them
and the robot hops; with these settings it slides by Coulomb's law. The slip couples into
the normal force as ``R f = a_ref + mu b v_slip - a`` with ``b = 2 / (d tc_friction)``; a wheel
leaves the ground once ``mu b v_slip / (1 + h b)`` exceeds ``R f``. Hence a small impedance ``d``,
a small step ``h``, a long time constant with a damping ratio below 1, and a ``margin`` that
cancels the sink.
"""

from dataclasses import dataclass, replace
import math

import mujoco

from amr_description.model.wheels import Rollers

_LEAST = 1e-5
"""The least friction that MuJoCo takes."""


@dataclass(frozen=True, slots=True)
class ContactSettings:
    """The contact of a wheel with a static surface, in MuJoCo's terms (``<pair>``)."""

    solref: tuple[float, float]
    """Time constant in s and damping ratio of the normal direction."""
    solimp: tuple[float, float, float, float, float]
    """Impedance at and beyond the surface, width in m, midpoint, power."""
    solreffriction: tuple[float, float]
    """Time constant in s and damping ratio of the tangential directions."""
    margin: float
    """
    m; contacts begin this far above the surface, which cancels the sink under the weight. It is
    adjusted for each robot by :mod:`amr_description.sim.wheel_trim`.
    """
    sliding_friction: float = math.inf
    """Of the wheel's own link; infinite: it has none, and that of the surface counts."""
    torsional_friction: float = 0.005
    """m; no effect at ``condim`` 3."""
    rolling_friction: float = 0.0001
    """m; no effect at ``condim`` 3."""
    free: float = math.inf
    """Of a wheel with rollers across their axes; infinite: it has none."""

    def with_rollers(self, rollers: Rollers) -> 'ContactSettings':
        """
        Return the settings for a wheel with rollers.

        Such a wheel need not scrub, and keeps to its rollers best with friction that is as stiff
        as the normal direction: on an arc of 0.2 m/s ahead, 0.1 m/s to the left and 0.5 rad/s the
        true speeds are 0.1998 and 0.0993 m/s, and with the soft friction of a rubber tyre 0.2011
        and 0.0964 m/s.
        """
        grip = self.sliding_friction if math.isinf(rollers.grip) else rollers.grip
        free = max(rollers.free, _LEAST)
        return replace(self, solreffriction=(0.0, 0.0), sliding_friction=grip, free=free)


WHEEL_CONTACT = ContactSettings(
    solref=(0.038, 0.3),
    solimp=(0.032, 0.032, 0.001, 0.5, 2.0),
    solreffriction=(1.786, 1.0),
    margin=0.0008,
)
"""
Tuned for :data:`~amr_description.sim.engine.LONGEST_STEP`.

Measured with the shipped robot and ``wheel_separation_multiplier`` 2.82, at two physics steps, and
beside them a set tuned for 1 ms (solref .023 .5, solimp .008 .008, solreffriction 6.25 1,
margin .00084). One set does for all steps:

====================================  ===========  ===========  ================
what                                  this, 2 ms   this, 1 ms   tuned for 1 ms
====================================  ===========  ===========  ================
true turn ÷ odometry, 0.3 rad/s       1.015        1.015        1.015
... 1 rad/s                           1.013        1.013        1.013
... 2 rad/s                           1.005        1.004        1.004
arc 0.5 m/s, 1 rad/s                  1.003        1.002        1.002
arc 1 m/s, 1 rad/s                    0.990        0.989        0.989
straight 1 m, true ÷ odometry         1.0000       1.0000       1.0000
stop from 0.5 m/s                     0.108 s      0.106 s      0.100 s
rest after a drop of 0.2 m            0.49 s       0.50 s       0.38 s
drift in 60 s at rest                 5e-10 mm     1e-11 mm     4e-12 mm
====================================  ===========  ===========  ================
"""


def add_wheel_contact(
    spec: mujoco.MjSpec, wheel: str, surface: mujoco.MjsGeom, settings: ContactSettings
) -> None:
    """
    Add a contact pair of a wheel and a static surface.

    The sliding friction is that of the surface, or that of the wheel's link where it has a smaller
    one of its own (:mod:`amr_description.sim.friction`).

    Args:
        spec: The spec of the world, with the robot.
        wheel: The name of the wheel's geom.
        surface: A geom of the world.
        settings: Of the contact.
    """
    mu = min(float(surface.friction[0]), settings.sliding_friction)
    pair = spec.add_pair(geomname1=wheel, geomname2=surface.name)
    pair.condim = 3
    pair.friction = [
        mu,
        min(mu, settings.free),
        settings.torsional_friction,
        settings.rolling_friction,
        settings.rolling_friction,
    ]
    pair.solref = settings.solref
    pair.solimp = settings.solimp
    pair.solreffriction = settings.solreffriction
    pair.margin = settings.margin
    pair.gap = 0.0
