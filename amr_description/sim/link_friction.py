# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
The friction that a URDF made for Gazebo gives its links: ``<gazebo reference="caster"><mu1>``.

As in Gazebo, the smaller friction of the two that touch counts. So a link's own is of use where it
is small, above all for a caster that Gazebo's users make slippery because it cannot roll.

A wheel is slippery on whatever moves, which is above all the side of another robot: with MuJoCo's
1 robots that run into each other climb. What it drives on has its own friction; see
:mod:`amr_description.sim.contact`.
"""

from collections.abc import Mapping
import math

import mujoco

from amr_description.control.contracts import Log, Severity
from amr_description.model.findings import raise_error
from amr_description.model.robot import Robot
from amr_description.model.xml_source import parse_xml

SIDE_FRICTION = 0.2
"""
Of a wheel on what moves: smooth paint. From ``(a - r) / (a + r)`` on, 0.33 for the shipped robot,
it would rear up there, the friction of the ground being 1; see
:mod:`amr_description.sim.silent_friction`.
"""

SIDE_PRIORITY, LINK_PRIORITY = 1, 2
"""Whose friction counts between two that touch, in MuJoCo's terms; a URDF's own prevails."""

_MUJOCOS = 1.0
_TAGS = ('mu1', 'mu', 'collision/surface/friction/ode/mu')


def link_frictions(robot: Robot, log: Log) -> Mapping[str, float]:
    """The sliding friction of the links that have their own; the log is told what is no number."""
    root = parse_xml(robot.text, robot.source, raise_error)
    assert root is not None, 'raise_error does not return from an error'
    names = {link.name for link in robot.links}
    frictions: dict[str, float] = {}
    for block in root.iterchildren('gazebo'):
        link = block.get('reference', '')
        found = next((f for f in map(block.find, _TAGS) if f is not None), None)
        if link not in names or found is None:
            continue
        friction = _number(found.text)
        if friction >= 0.0:
            frictions[link] = friction
        else:
            log(
                Severity.WARN,
                f'{robot.source}:{found.sourceline}: <{found.tag}> of link "{link}" is '
                f'"{found.text}"; a number from 0 on is needed, and it is left out',
            )
    return frictions


def make_slippery(spec: mujoco.MjSpec, frictions: Mapping[str, float]) -> None:
    """Let a link that is more slippery than MuJoCo's default have its own friction prevail."""
    for link, friction in frictions.items():
        for geom in spec.body(link).geoms:
            is_tread = geom.priority == SIDE_PRIORITY
            if friction < (_MUJOCOS if is_tread else geom.friction[0]):
                geom.friction[0] = friction
                geom.priority = LINK_PRIORITY


def _number(text: str | None) -> float:
    try:
        return float(text or '')
    except ValueError:
        return math.nan
