# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
The friction that a URDF made for Gazebo gives its links: ``<gazebo reference="caster"><mu1>``.

As in Gazebo, the smaller friction of the two that touch counts. So a link's own is of use where it
is small, above all for a caster that Gazebo's users make slippery because it cannot roll.
"""

from collections.abc import Mapping
import math

import mujoco

from amr_description.control.contracts import Log, Severity
from amr_description.model.findings import raise_error
from amr_description.model.robot import Robot
from amr_description.model.xml_source import parse_xml

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
            if friction < geom.friction[0]:
                geom.friction[0] = friction
                geom.priority = 1


def _number(text: str | None) -> float:
    try:
        return float(text or '')
    except ValueError:
        return math.nan
