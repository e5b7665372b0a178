# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
The names that Gazebo gives the ``<collision>`` elements of a URDF.

Its converter to SDF calls a collision by its name, or else by its link, with ``_collision`` behind
it, and from the second of a link on its number: ``base_link_collision``,
``base_link_collision_1``. Links on fixed joints are merged there into the one above, and their
collisions called ``base_link_fixed_joint_lump__bumper_collision_2``, with a number in the merged
link. Here nothing is merged: such a name is that of the collision of its own link.
"""

from collections.abc import Iterator, Sequence
import re
from typing import TypeAlias

from amr_description.model.robot import Link, Robot

CollisionKey: TypeAlias = tuple[str, int]
"""A link, and the number of one of its collisions."""

_MERGED = '_fixed_joint_lump__'
_SUFFIX = re.compile(r'_collision(?:_\d+)?$')


def gazebo_name(link: Link, number: int) -> str:
    """Return what Gazebo calls a collision of a link, in which nothing is merged."""
    name = f'{link.collisions[number].name or link.name}_collision'
    return f'{name}_{number}' if number else name


def find_collisions(
    robot: Robot, link: str, names: Sequence[str]
) -> tuple[tuple[CollisionKey, ...], tuple[str, ...]]:
    """
    Return the collisions that a sensor names, and which of the names are of none.

    Args:
        robot: The description.
        link: On which the sensor is mounted; its collisions count before those of other links.
        names: As in the URDF, or as Gazebo has them; none at all: all collisions of the link.
    """
    own = robot.link(link)
    if not names:
        return tuple((link, number) for number in range(len(own.collisions))), ()
    links = (own, *(each for each in robot.links if each is not own))
    found: dict[CollisionKey, None] = {}
    unknown = []
    for name in names:
        keys = tuple(_called(name.strip(), links))
        found |= dict.fromkeys(keys)
        if not keys:
            unknown.append(name)
    return tuple(found), tuple(unknown)


def _called(name: str, links: Sequence[Link]) -> Iterator[CollisionKey]:
    """Yield the collisions of a name, of the first link that has any."""
    stem = _SUFFIX.sub('', name.rpartition(_MERGED)[2])
    for link in links:
        numbers = range(len(link.collisions))
        exact = [
            number
            for number in numbers
            if name in (link.collisions[number].name, gazebo_name(link, number))
        ]
        alike = [n for n in numbers if (link.collisions[n].name or link.name) == stem]
        if keys := exact or alike:
            yield from ((link.name, number) for number in keys)
            return
