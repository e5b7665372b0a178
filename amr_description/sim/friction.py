# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
The friction of what a world leaves without: not MuJoCo's 1, with which driven wheels climb walls.

A robot on four driven wheels of radius r, the axles at ±a from its middle, rears up at a wall when
the moments about its rear contacts lift its front. With friction µ on the ground and µ_w on the
wall that is ``µ (r + µ_w (a + r)) > a``; where both are equal, ``µ > a / (a + r)``: 0.67 for the
shipped robot, whose momentum lifts it at 1 m/s from 0.6 on. A rigid rubber wheel would truly do
so; walls are smoother than that, and so is what a world does not speak of.

The friction that a URDF made for Gazebo gives its links: ``<gazebo reference="caster"><mu1>``.

As in Gazebo, the smaller friction of the two that touch counts. So a link's own is of use where it
is small, above all for a caster that Gazebo's users make slippery because it cannot roll.

A wheel is slippery on whatever moves, which is above all the side of another robot: with MuJoCo's
1 robots that run into each other climb. What it drives on has its own friction; see
:mod:`amr_description.sim.wheel_contact`.
"""

from collections.abc import Mapping
import math
from pathlib import Path

from lxml import etree
import mujoco

from amr_description.control.contracts import Log, Severity
from amr_description.model.findings import raise_error
from amr_description.model.robot import Robot
from amr_description.model.xml_reader import parse_xml

SILENT_FRICTION = 0.5
"""Rubber on a smooth dry floor; holds on 26 degrees, climbs kerbs of 20 mm, and no wall."""

_MARK = 0.987654321
"""A friction that nobody writes."""


def fill_in_friction(spec: mujoco.MjSpec, path: Path) -> None:
    """
    Give the geoms whose friction the file at ``path`` leaves open SILENT_FRICTION.

    In ``spec`` a friction that is left open cannot be told from a 1 that is written: the file is
    read once more, with another default.
    """
    root = etree.parse(path).getroot()
    _include(root, path.parent)
    _mark(root)
    try:
        marked = mujoco.MjSpec.from_string(etree.tostring(root, encoding='unicode'))
    except ValueError:
        return  # it attaches models by relative paths: they speak for themselves
    for geom, other in zip(spec.geoms, marked.geoms, strict=True):
        if other.friction[0] == _MARK:
            geom.friction[0] = SILENT_FRICTION


def _include(root: etree._Element, folder: Path) -> None:
    """Put what is included in its place; MuJoCo looks for it beside the file of the world."""
    for element in tuple(root.iter('include')):
        included = etree.parse(folder / element.get('file', '')).getroot()
        _include(included, folder)
        parent = element.getparent()
        place = parent.index(element)
        parent[place : place + 1] = list(included)


def _mark(root: etree._Element) -> None:
    """Let the default of the whole file be _MARK, unless it has one."""
    defaults = root.findall('default')
    if any(geom.get('friction') for each in defaults for geom in each.findall('geom')):
        return
    first = defaults[0] if defaults else etree.Element('default')
    if not defaults:
        root.insert(0, first)
    geom = etree.Element('geom', friction=str(_MARK))
    first.insert(0, geom)


SIDE_FRICTION = 0.2
"""
Of a wheel on what moves: smooth paint. From ``(a - r) / (a + r)`` on, 0.33 for the shipped robot,
it would rear up there, the friction of the ground being 1; see
:mod:`amr_description.sim.friction`.
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
