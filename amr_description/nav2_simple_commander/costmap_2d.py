# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""The cells of an occupancy grid by their coordinates, as nav2_costmap_2d has them in C++."""

# ruff: noqa: N802

import math

from builtin_interfaces.msg import Time
from nav_msgs.msg import OccupancyGrid
import numpy as np


class PyCostmap2D:
    """The costs of a grid: x to the right, y upwards, cell (0, 0) at its origin."""

    def __init__(self, occupancy_map: OccupancyGrid) -> None:
        """Take a grid; -1, unknown, becomes 255."""
        info = occupancy_map.info
        self.size_x, self.size_y = info.width, info.height
        self.resolution = info.resolution
        self.origin_x, self.origin_y = info.origin.position.x, info.origin.position.y
        self.global_frame_id = occupancy_map.header.frame_id
        self.costmap_timestamp = occupancy_map.header.stamp
        self.costmap = np.asarray(occupancy_map.data, dtype=np.int16).astype(np.uint8)

    def getSizeInCellsX(self) -> int:
        """Return the number of columns."""
        return int(self.size_x)

    def getSizeInCellsY(self) -> int:
        """Return the number of rows."""
        return int(self.size_y)

    def getSizeInMetersX(self) -> float:
        """Return the width from the origin to the middle of the last cell, m."""
        return float((self.size_x - 0.5) * self.resolution)

    def getSizeInMetersY(self) -> float:
        """Return the height from the origin to the middle of the last cell, m."""
        return float((self.size_y - 0.5) * self.resolution)

    def getOriginX(self) -> float:
        """Return where cell (0, 0) begins, m."""
        return float(self.origin_x)

    def getOriginY(self) -> float:
        """Return where cell (0, 0) begins, m."""
        return float(self.origin_y)

    def getResolution(self) -> float:
        """Return the edge of a cell, m."""
        return float(self.resolution)

    def getGlobalFrameID(self) -> str:
        """Return the frame of the grid."""
        return str(self.global_frame_id)

    def getCostmapTimestamp(self) -> Time:
        """Return the stamp of the grid."""
        return self.costmap_timestamp

    def getCostXY(self, mx: int, my: int) -> np.uint8:
        """Return the cost of a cell. Raises IndexError: there is none."""
        cost: np.uint8 = self.costmap[self.getIndex(mx, my)]
        return cost

    def getCostIdx(self, index: int) -> np.uint8:
        """Return the cost of a cell by its index. Raises IndexError: there is none."""
        cost: np.uint8 = self.costmap[index]
        return cost

    def setCost(self, mx: int, my: int, cost: int) -> None:
        """Write the cost of a cell. Raises IndexError: there is none."""
        self.costmap[self.getIndex(mx, my)] = cost

    def mapToWorld(self, mx: int, my: int) -> tuple[float, float]:
        """Return the middle of a cell, m."""
        return (
            self.origin_x + (mx + 0.5) * self.resolution,
            self.origin_y + (my + 0.5) * self.resolution,
        )

    def worldToMapValidated(self, wx: float, wy: float) -> tuple[int | None, int | None]:
        """Return the cell of a point, m; (None, None): it is outside of the grid."""
        mx = math.floor((wx - self.origin_x) / self.resolution)
        my = math.floor((wy - self.origin_y) / self.resolution)
        if 0 <= mx < self.size_x and 0 <= my < self.size_y:
            return mx, my
        return None, None

    def getIndex(self, mx: int, my: int) -> int:
        """Return the index of a cell among all, row by row."""
        return int(my * self.size_x + mx)
