# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
The friction of what a world leaves without: not MuJoCo's 1, with which driven wheels climb walls.

A robot on four driven wheels of radius r, the axles at ±a from its middle, rears up at a wall when
the moments about its rear contacts lift its front. With friction µ on the ground and µ_w on the
wall that is ``µ (r + µ_w (a + r)) > a``; where both are equal, ``µ > a / (a + r)``: 0.67 for the
shipped robot, whose momentum lifts it at 1 m/s from 0.6 on. A rigid rubber wheel would truly do
so; walls are smoother than that, and so is what a world does not speak of.
"""

from pathlib import Path

from lxml import etree
import mujoco

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
