# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""What is free, occupied and unknown, in square cells: ``nav_msgs/msg/OccupancyGrid``."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from amr_description.maps.pose import Pose

UNKNOWN = -1
FREE = 0
OCCUPIED = 100


@dataclass(frozen=True)
class OccupancyGrid:
    """A map in square cells."""

    cells: NDArray[np.int8]
    """
    (height, width): -1 is unknown, else how surely there is something, 0 to 100 percent.

    Row 0 is at the lowest y, column 0 at the lowest x (of the origin's frame): as in the message,
    and upside down in an image file.
    """
    resolution: float
    """Edge of a cell, m."""
    origin: Pose
    """Of the outer corner of cell [0, 0] in the frame of the map."""

    @property
    def height(self) -> int:
        """Number of rows."""
        return self.cells.shape[0]

    @property
    def width(self) -> int:
        """Number of columns."""
        return self.cells.shape[1]

    def cell_of(self, x: float, y: float) -> tuple[int, int]:
        """Return (row, column) of the cell that a point of the map frame is in; maybe outside."""
        inside = self.origin.inverse().compose(Pose(x, y, 0.0))
        return int(inside.y // self.resolution), int(inside.x // self.resolution)

    def center_of(self, row: int, column: int) -> tuple[float, float]:
        """Return x and y of the middle of a cell in the frame of the map, m."""
        half = 0.5 * self.resolution
        point = Pose(column * self.resolution + half, row * self.resolution + half, 0.0)
        middle = self.origin.compose(point)
        return middle.x, middle.y

    def holds(self, row: int, column: int) -> bool:
        """Return whether the grid has this cell."""
        return 0 <= row < self.height and 0 <= column < self.width
