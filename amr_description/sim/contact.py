# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
How a wheel touches the ground.

Four fixed wheels scrub when the robot turns. With MuJoCo's default contacts the slip lifts them
and the robot hops; the settings here let it slide as Coulomb's law has it. The slip couples into
the normal force as ``R f = a_ref + mu b v_slip - a`` with ``b = 2 / (d tc_friction)``; a wheel
leaves the ground once ``mu b v_slip / (1 + h b)`` exceeds ``R f``. Hence a small impedance ``d``,
a small step ``h``, a long time constant with a damping ratio below 1, and a ``margin`` that
cancels the sink.
"""

from dataclasses import dataclass

import mujoco


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
    """m; contacts begin this far above the surface, which cancels the sink under the weight."""
    torsional_friction: float = 0.005
    """m; without effect at ``condim`` 3."""
    rolling_friction: float = 0.0001
    """m; without effect at ``condim`` 3."""


WHEEL_CONTACT = ContactSettings(
    solref=(0.038, 0.3),
    solimp=(0.032, 0.032, 0.001, 0.5, 2.0),
    solreffriction=(1.786, 1.0),
    margin=0.0008,
)
"""Tuned at a physics step of 2 ms; measured to do as well down to 1 ms."""


def add_wheel_contact(
    spec: mujoco.MjSpec, wheel: str, surface: mujoco.MjsGeom, settings: ContactSettings
) -> None:
    """
    Let the geom named ``wheel`` touch ``surface`` with these settings and the surface's own
    sliding friction.
    """
    mu = float(surface.friction[0])
    pair = spec.add_pair(geomname1=wheel, geomname2=surface.name)
    pair.condim = 3
    pair.friction = [
        mu,
        mu,
        settings.torsional_friction,
        settings.rolling_friction,
        settings.rolling_friction,
    ]
    pair.solref = settings.solref
    pair.solimp = settings.solimp
    pair.solreffriction = settings.solreffriction
    pair.margin = settings.margin
    pair.gap = 0.0
