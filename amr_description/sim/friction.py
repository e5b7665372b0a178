# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
The sliding friction of geoms that MuJoCo would give its default of 1, and of links.

**Geoms of a world without a friction of their own** get :data:`DEFAULT_FRICTION`: with MuJoCo's 1
driven wheels climb walls. A robot on four driven wheels of radius r, the axles at ±a from its
middle, rears up at a wall when the moments about its rear contacts lift its front. With friction µ
on the ground and µ_w on the wall that is ``µ (r + µ_w (a + r)) > a``; where both are equal,
``µ > a / (a + r)``: 0.67 for the shipped robot, whose momentum lifts it at 1 m/s from 0.6 on. A
rigid rubber wheel would really do so; walls are smoother.

**Links** have the friction that a URDF made for Gazebo gives them:
``<gazebo reference="caster"><mu1>``. As in Gazebo, the smaller friction of two touching geoms
counts, so that of a link matters where it is small, as for a ball caster that cannot roll.

**Wheels** have :data:`WHEEL_FRICTION` on everything that moves, which is above all the side of
another robot: with MuJoCo's 1 robots that run into each other climb. Static surfaces have their
own friction, see :mod:`amr_description.sim.wheel_contact`.
"""

from collections.abc import Mapping
import math
from pathlib import Path

from lxml import etree
import mujoco

from amr_description.control.contracts import Log, Severity
from amr_description.model.findings import raise_error
from amr_description.model.origins import place_in
from amr_description.model.robot import Robot
from amr_description.model.xml_reader import line_of, parse_xml

DEFAULT_FRICTION = 0.5
"""Rubber on a smooth dry floor; holds on 26 degrees, climbs kerbs of 20 mm, and no wall."""

WHEEL_FRICTION = 0.2
"""
Of a wheel on everything that moves: smooth paint. From ``(a - r) / (a + r)`` on, 0.33 for the
shipped robot, it would rear up there, the friction of the ground being 1.
"""

WHEEL_PRIORITY, LINK_PRIORITY = 1, 2
"""MuJoCo takes the friction of the geom with the higher priority: a link's own prevails."""

_MUJOCO_DEFAULT = 1.0
_TAGS = ('mu1', 'mu', 'collision/surface/friction/ode/mu')

_SENTINEL = 0.987654321
"""A friction that no file has."""


def apply_default_friction(spec: mujoco.MjSpec, path: Path) -> None:
    """
    Give the geoms for which a file sets no friction DEFAULT_FRICTION.

    In the spec, a friction of 1 may be MuJoCo's default or written in the file: the file is read
    once more, with another default, to distinguish them.

    Args:
        spec: Read from the file; edited.
        path: The MJCF file.
    """
    root = etree.parse(path).getroot()
    _include(root, path.parent)
    _set_default(root)
    try:
        probed = mujoco.MjSpec.from_string(etree.tostring(root, encoding='unicode'))
    except ValueError:
        return  # it attaches models by relative paths: their frictions stay as they are
    for geom, other in zip(spec.geoms, probed.geoms, strict=True):
        if other.friction[0] == _SENTINEL:
            geom.friction[0] = DEFAULT_FRICTION


def _include(root: etree._Element, folder: Path) -> None:
    """Expand ``<include>``; MuJoCo looks for the files in the folder of the world."""
    for element in tuple(root.iter('include')):
        included = etree.parse(folder / element.get('file', '')).getroot()
        _include(included, folder)
        parent = element.getparent()
        index = parent.index(element)
        parent[index : index + 1] = list(included)


def _set_default(root: etree._Element) -> None:
    """Set the default friction of the whole file to _SENTINEL, unless it has one."""
    defaults = root.findall('default')
    if any(geom.get('friction') for each in defaults for geom in each.findall('geom')):
        return
    first = defaults[0] if defaults else etree.Element('default')
    if not defaults:
        root.insert(0, first)
    geom = etree.Element('geom', friction=str(_SENTINEL))
    first.insert(0, geom)


def link_frictions(robot: Robot, log: Log) -> Mapping[str, float]:
    """
    Return the sliding friction of the links that have one of their own.

    Args:
        robot: Its ``<gazebo reference="…">`` blocks are read.
        log: Gets a warning for each value that is no number or negative.
    """
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
                f'{place_in(robot.text, robot.source, line_of(found))}: <{found.tag}> of link '
                f'"{link}" is "{found.text}"; a number from 0 on is needed, and it is left out',
            )
    return frictions


def apply_link_frictions(spec: mujoco.MjSpec, frictions: Mapping[str, float]) -> None:
    """Let the friction of a link prevail where it is smaller than that of its geoms."""
    for link, friction in frictions.items():
        for geom in spec.body(link).geoms:
            is_wheel = geom.priority == WHEEL_PRIORITY
            if friction < (_MUJOCO_DEFAULT if is_wheel else geom.friction[0]):
                geom.friction[0] = friction
                geom.priority = LINK_PRIORITY


def _number(text: str | None) -> float:
    try:
        return float(text or '')
    except ValueError:
        return math.nan
