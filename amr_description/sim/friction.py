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
``<gazebo reference="caster"><mu1>``, else 1, which is Gazebo's default too. As in Gazebo, the
smaller friction of two touching geoms counts, so that of a link matters where it is small, as for
a ball caster that cannot roll.

**Wheels** have :data:`WHEEL_FRICTION` on everything that moves, which is above all the side of
another robot: with MuJoCo's 1 robots that run into each other climb. Static surfaces have their
own friction, see :mod:`amr_description.sim.wheel_contact`.
"""

from collections.abc import Collection, Iterable, Mapping
import math
from pathlib import Path

from lxml import etree
import mujoco

from amr_description.model.gazebo.physics import GazeboLink

DEFAULT_FRICTION = 0.5
"""Rubber on a smooth dry floor; holds on 26 degrees, climbs kerbs of 20 mm, and no wall."""

WHEEL_FRICTION = 0.2
"""
Of a wheel on everything that moves: smooth paint. From ``(a - r) / (a + r)`` on, 0.33 for the
shipped robot, it would rear up there, the friction of the ground being 1.
"""

_ROUGHEST = 10.0
"""Frictions from here on count as one."""
_STEPS = 1000.0
_FILES_PRIORITY = 100_000

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
    try:
        root = _parsed(path)
        _include(root, path.parent)
        _set_default(root)
        probed = mujoco.MjSpec.from_string(etree.tostring(root, encoding='unicode'))
    except (ValueError, OSError, etree.XMLSyntaxError):
        return  # it attaches models by relative paths: their frictions stay as they are
    if len(probed.geoms) != len(spec.geoms):
        return  # no XML, though MuJoCo reads it: likewise
    for geom, other in zip(spec.geoms, probed.geoms, strict=True):
        if other.friction[0] == _SENTINEL:
            geom.friction[0] = DEFAULT_FRICTION


def _parsed(path: Path) -> etree._Element:
    """Read a file as MuJoCo does, which takes what is not quite XML: ``<!-- a -- b -->``."""
    root = etree.parse(path, etree.XMLParser(recover=True, resolve_entities=False)).getroot()
    if root is None:
        raise ValueError(f'{path}: no XML')
    return root


def _include(root: etree._Element, folder: Path) -> None:
    """Expand ``<include>``; MuJoCo looks for the files in the folder of the world."""
    for element in tuple(root.iter('include')):
        included = _parsed(folder / element.get('file', ''))
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


def count_the_smaller(geoms: Iterable[mujoco.MjsGeom]) -> None:
    """
    Have the smaller friction of two touching geoms count, as in Gazebo.

    MuJoCo takes the larger one, or that of the geom with the higher priority: so priorities follow
    from frictions. One that a file gives goes before.
    """
    for geom in geoms:
        slippery = round(_STEPS * (_ROUGHEST - min(float(geom.friction[0]), _ROUGHEST)))
        geom.priority = geom.priority * _FILES_PRIORITY + slippery


def apply_link_frictions(
    spec: mujoco.MjSpec, links: Mapping[str, GazeboLink], wheels: Collection[str]
) -> Mapping[str, float]:
    """
    Give the geoms of links the friction that ``<mu1>`` has, and those of ``wheels`` theirs.

    Args:
        spec: Of a robot; edited.
        links: What Gazebo is told, by link.
        wheels: The names of the geoms that are wheels.

    Returns:
        The friction of its own of each geom that has a name and one.
    """
    own: dict[str, float] = {}
    for geom in spec.geoms:
        link = links.get(geom.parent.name)
        friction = math.inf if link is None or link.mu1 is None else link.mu1
        if geom.name in wheels:
            geom.friction[0] = min(WHEEL_FRICTION, friction)
        elif friction < math.inf:
            geom.friction[0] = friction
        if geom.name and friction < math.inf:
            own[geom.name] = friction
    count_the_smaller(spec.geoms)
    return own
