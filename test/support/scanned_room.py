# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""A room whose map is in cells, and whose scans are exact."""

from math import pi

import numpy as np
from numpy.typing import NDArray

from amr_description.maps.grid import FREE, OccupancyGrid, OCCUPIED
from amr_description.maps.pose import Pose

RESOLUTION = 0.05
ANGLES = np.linspace(-pi, pi, 360, endpoint=False)
# x from, x to, y from, y to, m: a room of 7 by 5 m that looks different from everywhere.
WALLS = (
    (-3.2, 4.2, -2.2, -2.0),
    (-3.2, 4.2, 3.0, 3.2),
    (-3.2, -3.0, -2.2, 3.2),
    (4.0, 4.2, -2.2, 3.2),
    (1.0, 1.5, 0.8, 1.2),
    (-1.7, -1.3, -2.0, -0.9),
    (2.95, 3.35, -1.43, -0.98),  # not on the edges of cells
)


def room(origin: Pose = Pose(-3.5, -2.5, 0.0), boxes=WALLS) -> OccupancyGrid:  # noqa: B008
    """The map: a cell is occupied if a wall reaches into it."""
    edges_x = -3.5 + RESOLUTION * np.arange(160)
    edges_y = -2.5 + RESOLUTION * np.arange(120)
    cells = np.full((120, 160), FREE, dtype=np.int8)
    for x0, x1, y0, y1 in boxes:
        inside_x = (edges_x + RESOLUTION > x0 + 1e-6) & (edges_x < x1 - 1e-6)
        inside_y = (edges_y + RESOLUTION > y0 + 1e-6) & (edges_y < y1 - 1e-6)
        cells[np.ix_(inside_y, inside_x)] = OCCUPIED
    return OccupancyGrid(cells, RESOLUTION, origin)


def scan(pose: Pose, boxes=WALLS) -> NDArray[np.float64]:
    """The exact length of every ray from a pose in the room, m; inf: it meets nothing."""
    directions = np.column_stack([np.cos(ANGLES + pose.yaw), np.sin(ANGLES + pose.yaw)])
    lengths = np.full(len(ANGLES), np.inf)
    for x0, x1, y0, y1 in boxes:
        with np.errstate(divide='ignore'):
            ends = (np.array([[x0, y0], [x1, y1]])[:, None] - (pose.x, pose.y)) / directions
        enters, leaves = ends.min(axis=0).max(axis=1), ends.max(axis=0).min(axis=1)
        meets = (enters <= leaves) & (enters > 0.0)
        lengths[meets] = np.minimum(lengths[meets], enters[meets])
    return lengths
