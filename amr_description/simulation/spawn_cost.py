# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
How long a robot keeps the simulation waiting when it is put into the world.

MuJoCo compiles its model between two cycles, in which time stands still. Measured on one core of
3 GHz: 1.45 s for 100,000 triangles of collision meshes, whose convex hulls are made, and 0.1 s for
a chain of 100 links, 10 s for one of 1,000.
"""

from collections.abc import Iterable
from dataclasses import dataclass

from amr_description.ament_index import resolve_uri
from amr_description.errors import DescriptionError, ResourceError, SpawnError
from amr_description.log import Log, Severity
from amr_description.model.robot import Collision, Mesh, Robot, Visual
from amr_description.model.urdf import parse
from amr_description.sim.spawning import SpawnCode

_S_PER_TRIANGLE = 1.45e-5
_S_PER_LINK_SQUARED = 1e-5
_BYTES_PER_TRIANGLE = 50
"""Of a binary STL file; of other formats it takes more."""
_WORTH_A_LINE = 0.5
_MOST = 60.0
"""s"""
_BUSY = 30.0
"""How many times as long it may take on a busy machine."""


@dataclass(frozen=True)
class SpawnCost:
    """What makes it long."""

    links: int
    triangles: int
    """Of collision meshes, at most, by the sizes of their files."""

    @property
    def seconds(self) -> float:
        """About how long it takes."""
        return self.triangles * _S_PER_TRIANGLE + self.links**2 * _S_PER_LINK_SQUARED

    def __str__(self) -> str:
        return f'{self.links} links and up to {self.triangles} triangles of collision meshes'


def cost_of(robot: Robot) -> SpawnCost:
    """Look at a robot and at the sizes of its mesh files."""
    return _cost(robot, (part for link in robot.links for part in link.collisions))


def patience_with(text: str, least: float) -> float:
    """
    Return how long to wait for the answer to a spawn, s.

    Args:
        text: The URDF; meshes that are only seen count as well, as they are read, too.
        least: s, for a robot that takes no time.
    """
    try:
        robot = parse(text)
    except DescriptionError:  # the simulator says why
        return least
    parts: list[Collision | Visual] = []
    for link in robot.links:
        parts += [*link.collisions, *link.visuals]
    return least + _BUSY * min(_MOST, _cost(robot, parts).seconds)


def _cost(robot: Robot, parts: Iterable[Collision | Visual]) -> SpawnCost:
    files = {each.geometry.filename for each in parts if isinstance(each.geometry, Mesh)}
    return SpawnCost(len(robot.links), sum(map(_size_of, files)) // _BYTES_PER_TRIANGLE)


def announce(name: str, cost: SpawnCost, log: Log) -> None:
    """Say how long a robot takes, if that is long. Raises SpawnError: it takes too long."""
    if cost.seconds > _MOST:
        raise SpawnError(
            f"'{name}' has {cost}: time would stand still for about {cost.seconds:.0f} s, and "
            f'{_MOST:.0f} s are the most; collisions need no fine meshes: use their convex hulls, '
            'or boxes',
            SpawnCode.UNSUPPORTED_ASSETS,
        )
    if cost.seconds > _WORTH_A_LINE:
        log(
            Severity.WARN,
            f"'{name}' has {cost}: time stands still for about {cost.seconds:.0f} s while it is "
            'spawned',
        )


def _size_of(uri: str) -> int:
    try:
        return resolve_uri(uri).stat().st_size
    except (ResourceError, OSError, ValueError):  # whoever reads it says why
        return 0
