# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""Maps and paths as they come by DDS, decoded without an object for each of their parts."""

from dataclasses import dataclass

import numpy as np

from amr_description.ros.cdr_sensors import Header, SensorReader

_POSE_DOUBLES = 7


@dataclass(frozen=True, slots=True)
class GridData:
    """``nav_msgs/msg/OccupancyGrid``: ``origin`` is x y z (m) qx qy qz qw; cells row by row."""

    header: Header
    resolution: float
    width: int
    height: int
    origin: tuple[float, ...]
    cells: np.ndarray


@dataclass(frozen=True, slots=True)
class PathData:
    """``nav_msgs/msg/Path``: m, float64 of the shape (poses, 3)."""

    header: Header
    points: np.ndarray


def read_grid(data: bytes) -> GridData:
    """``nav_msgs/msg/OccupancyGrid``. Raises ValueError: it ends too early."""
    reader = SensorReader(data)
    header = reader.header()
    reader.stamp()  # when the map was loaded
    resolution, width, height = reader.number(), reader.count(), reader.count()
    origin = reader.doubles(_POSE_DOUBLES)
    return GridData(header, resolution, width, height, origin, reader.sequence('i1'))


def read_path(data: bytes) -> PathData:
    """
    ``nav_msgs/msg/Path``.

    The header of a path without a frame is that of its first pose. Raises ValueError: it ends too
    early.
    """
    reader = SensorReader(data)
    header, points = reader.header(), []
    for _ in range(reader.count()):
        own = reader.header()
        header = header if header.frame else own
        points.append(reader.doubles(_POSE_DOUBLES)[:3])
    return PathData(header, np.array(points, dtype=float).reshape(-1, 3))
