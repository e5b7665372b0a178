# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""A robot bolted to the ground: its root joined to a link ``world``, as in Gazebo."""

from amr_description.model.robot import WORLD_LINK
from amr_description.model.urdf import parse

_JOINT = 'fixed_to_world'
_END = '</robot>'


def fixed_to_world(text: str) -> str:
    """
    Return a URDF whose root link is ``world``; one that has it already comes back as it is.

    All lines keep their numbers. Raises DescriptionError: it is no sound tree of links.
    """
    robot = parse(text)
    if robot.root.name == WORLD_LINK:
        return text
    from xml.sax.saxutils import quoteattr  # which imports what ``https:`` needs

    name = _JOINT
    while robot.has_joint(name):
        name += '_'
    added = (
        f'<link name="{WORLD_LINK}"/><joint name="{name}" type="fixed">'
        f'<parent link="{WORLD_LINK}"/><child link={quoteattr(robot.root.name)}/></joint>'
    )
    before, end, behind = text.rpartition(_END)
    return f'{before}{added}{end}{behind}'
