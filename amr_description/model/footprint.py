# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""How much of the floor a robot takes, and places for several that do not touch."""

from collections.abc import Iterator
import math

from amr_description.model.frames import link_poses
from amr_description.model.robot import Mesh, Robot
from amr_description.model.shapes import reach, solids_of

REACH_OF_A_MESH = 0.5
"""m; what is assumed of a collision mesh, which is a file that is not read here."""


def horizontal_reach(robot: Robot) -> float:
    """
    Return the radius (m) of a circle about the root's origin that holds all collision shapes, as
    seen from above, all joints at 0; the shapes as the spheres around them. A mesh counts with
    :data:`REACH_OF_A_MESH`.
    """
    poses = link_poses(robot)
    farthest = 0.0
    for link in robot.links:
        pose = poses[link.name]
        for solid in solids_of(link.collisions, pose):
            x, y, _ = solid.place.translation
            farthest = max(farthest, math.hypot(x, y) + reach(solid.shape))
        for part in link.collisions:
            if isinstance(part.geometry, Mesh):
                x, y, _ = (pose @ part.origin).translation
                farthest = max(farthest, math.hypot(x, y) + REACH_OF_A_MESH)
    return farthest


def grid(count: int, spacing: float) -> Iterator[tuple[float, float]]:
    """Yield x and y (m) of ``count`` places in rows, as square as can be, about the origin."""
    columns = math.ceil(math.sqrt(count))
    rows = math.ceil(count / columns)
    for number in range(count):
        row, column = divmod(number, columns)
        yield spacing * (column - (columns - 1) / 2.0), spacing * (row - (rows - 1) / 2.0)
