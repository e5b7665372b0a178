# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""Maps and paths as samples for pages: bytes in, a head and what follows it out. Pure."""

from dataclasses import replace
import math
import zlib

import numpy as np

from amr_description.clock import NANOSECONDS
from amr_description.errors import ViewerError
from amr_description.ros.readers import GRID, PATH
from amr_description.viewer.protocol import OccupancyGrid, Origin, Route

MOST_CELLS = 4096
"""Cells of a side of a map: as many as the pictures of every graphics card have."""
MOST_POSES = 5_000
"""Poses of a path that are sent."""
_LONGEST_NAME = 200
"""Characters of the name of a frame."""
_FAST = 1
"""Level of deflate: a map of one colour is small at any."""


def frame_name(frame: str) -> str:
    """Return the name of a frame as the states have it."""
    return frame.removeprefix('/')[:_LONGEST_NAME]


def grid_sample(data: bytes, origin: Origin) -> tuple[OccupancyGrid, tuple[bytes]]:
    """
    Convert a map. Two of the same content are equal: neither stamp nor rate is told.

    Raises:
        ViewerError: a page cannot draw it.
        ValueError: it ends too early.
    """
    grid = GRID.read(data)
    size = f'a map of {grid.width} × {grid.height} cells'
    if not 0 < grid.width <= MOST_CELLS or not 0 < grid.height <= MOST_CELLS:
        raise ViewerError(f'{size}: the page draws 1 to {MOST_CELLS} a side')
    if len(grid.cells) != grid.width * grid.height:
        raise ViewerError(f'{size} has {len(grid.cells)}')
    if not (math.isfinite(grid.resolution) and grid.resolution > 0.0):
        raise ViewerError(f'{size} of {grid.resolution:g} m: a cell has a side of more than 0 m')
    if not all(map(math.isfinite, grid.origin)):
        raise ViewerError(f'{size} begins at {grid.origin[:3]}: NaN and infinity are no place')
    x, y, z, *turn = grid.origin
    qx, qy, qz, qw = turn if any(turn) else (0.0, 0.0, 0.0, 1.0)
    head = OccupancyGrid(
        replace(origin, frame=frame_name(grid.header.frame), stamp=0.0, rate=None),
        grid.width,
        grid.height,
        grid.resolution,
        (x, y, z),
        (qx, qy, qz, qw),
    )
    return head, (zlib.compress(grid.cells.tobytes(), _FAST),)


def path_sample(data: bytes, origin: Origin) -> tuple[Route, tuple[np.ndarray]]:
    """
    Convert a path. Poses with NaN or infinity are left out.

    Raises:
        ValueError: it ends too early.
    """
    path = PATH.read(data)
    points = path.points[np.isfinite(path.points).all(axis=1)]
    length = float(np.linalg.norm(np.diff(points, axis=0), axis=1).sum())
    step = max(1, -(-len(points) // MOST_POSES))
    # The last pose is the goal: it stays.
    thinned = points if step == 1 else np.concatenate([points[:-1:step], points[-1:]])
    header = path.header
    origin = replace(origin, frame=frame_name(header.frame), stamp=header.stamp / NANOSECONDS)
    return Route(origin, len(path.points), length), (thinned.astype('<f4'),)
