# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""Which wheels of a robot have rollers, of what is described and what their controllers say."""

from collections.abc import Iterable, Mapping
from dataclasses import replace
import math

from amr_description.control.contracts import Log, Severity
from amr_description.model.rollers import FREE_PART, Rollers
from amr_description.model.wheels import Wheel
from amr_description.sim.gazebo_physics import wheel_geom_name
from amr_description.text import quote_all

_GRIP = 1.0


def rollers_of(
    wheels: Iterable[Wheel],
    described: Mapping[str, Rollers],
    named: Mapping[str, Rollers],
    frictions: Mapping[str, float],
    log: Log,
) -> dict[str, Rollers]:
    """
    Return the rollers of wheels by geom.

    A wheel that was only to be pushed along is often given hardly any friction. If a controller
    drives it, that is taken as its friction across its rollers.

    Args:
        wheels: of the robot.
        described: the rollers that the description tells of, by link; they count more.
        named: those that a controller has, by joint.
        frictions: sliding frictions of links, by geom.
        log: gets a line on wheels with hardly any friction.
    """
    found: dict[str, Rollers] = {}
    slippery: list[Wheel] = []
    for wheel in wheels:
        geom = wheel_geom_name(wheel.link)
        friction = frictions.get(geom, math.inf)
        if wheel.link in described:
            found[geom] = described[wheel.link]
        elif wheel.joint in named:
            found[geom] = named[wheel.joint]
            if friction <= FREE_PART:
                found[geom] = replace(found[geom], grip=_GRIP, free=friction)
                slippery.append(wheel)
    if slippery:
        friction = frictions[wheel_geom_name(slippery[0].link)]
        log(
            Severity.WARN,
            f'the wheels of joints {quote_all([wheel.joint for wheel in slippery])} have rollers '
            f'for their controller, and a friction of {friction:g} in the description: taken as '
            f'that across the rollers, and {_GRIP:g} along their axes',
        )
    return found
