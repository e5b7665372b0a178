# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
Which entity of a simulator's world a robot of the ROS graph is.

Nobody can guess it by names: robots of a kind have the same name in their URDF, and an entity may
have any, in any namespace. So a simulator of this package says with what it has spawned each; of
another one an entity is the robot whose namespace has its name.
"""

from collections.abc import Collection, Iterable, Mapping
from dataclasses import dataclass, field

from amr_description.errors import DescriptionError
from amr_description.model.urdf import parse
from amr_description.viewer.protocol import EntityInfo

_MOVED = ('<ros2_control', '<plugin')
"""What in a description says that the entity is a robot, and no box that lies about."""


@dataclass(frozen=True, slots=True)
class SpawnedEntity:
    """With what a simulator has spawned an entity."""

    name: str
    namespace: str
    """Absolute; that of the root is ``/``."""
    urdf: str = field(repr=False)

    @property
    def is_robot(self) -> bool:
        """Whether it can be told that it is a robot: others may share a namespace with one."""
        return self.namespace != '/' or any(each in self.urdf for each in _MOVED)


def entity_of(robot: str, urdf: str | None, spawned: Iterable[SpawnedEntity]) -> str | None:
    """
    Return the name of the entity that a robot is; None: none, or it cannot be told which.

    Args:
        robot: The robot's namespace.
        urdf: Its description in the graph; None: not known yet.
        spawned: All entities of the simulator.
    """
    here = [each for each in spawned if each.namespace == robot]
    if urdf is None or not here:
        return None
    same = [each for each in here if each.urdf == urdf]
    if not same:  # one of them may have other paths of meshes
        links = _links(urdf)
        same = [each for each in here if links and _links(each.urdf) == links]
    return same[0].name if len(same) == 1 else None


def entity_among(
    worlds: Mapping[str, Iterable[SpawnedEntity]],
    silent: Mapping[str, Collection[str]],
    robot: str,
    urdf: str | None,
) -> EntityInfo | None:
    """
    Return what a robot is in the world of a simulator; None: nothing, or it cannot be told.

    Args:
        worlds: With what simulators say that they have spawned their entities, by the simulator.
        silent: Those that say nothing of it, with the names of their entities.
        robot: The robot's namespace.
        urdf: Its description in the graph; None: not known yet.
    """
    for simulator, spawned in worlds.items():
        if (name := entity_of(robot, urdf, spawned)) is not None:
            return EntityInfo(simulator, name)
    for simulator, names in silent.items():
        if simulator not in worlds and robot.removeprefix('/') in names:
            return EntityInfo(simulator, robot.removeprefix('/'))
    return None


def undescribed(
    spawned: Collection[SpawnedEntity], described: Collection[str]
) -> dict[str, SpawnedEntity]:
    """
    Return the robots of a world that nobody describes, by their namespaces.

    Args:
        spawned: All entities of the simulator.
        described: The namespaces with a description.
    """
    robots = [each for each in spawned if each.is_robot and each.namespace not in described]
    places = [each.namespace for each in robots]
    return {each.namespace: each for each in robots if places.count(each.namespace) == 1}


def _links(urdf: str) -> frozenset[str]:
    """Return the names of the links; none of what is no description."""
    try:
        return frozenset(link.name for link in parse(urdf).links)
    except DescriptionError:
        return frozenset()
