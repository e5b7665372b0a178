# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""The greatest cost that the edges of a footprint lie on, as nav2_costmap_2d finds it in C++."""

# ruff: noqa: N802

import math

from geometry_msgs.msg import Point32, Polygon

from amr_description.nav2_simple_commander.costmap_2d import PyCostmap2D
from amr_description.nav2_simple_commander.line_iterator import LineIterator

NO_INFORMATION = 255
LETHAL_OBSTACLE = 254
INSCRIBED_INFLATED_OBSTACLE = 253
MAX_NON_OBSTACLE = 252
FREE_SPACE = 0


class FootprintCollisionChecker:
    """Looks at footprints on a costmap."""

    def __init__(self) -> None:
        """Begin without a costmap."""
        self.costmap_: PyCostmap2D | None = None

    def footprintCost(self, footprint: Polygon) -> float:
        """Return the greatest cost of the edges, their corners in the frame of the costmap."""
        corners = [self.worldToMapValidated(each.x, each.y) for each in footprint.points]
        cost = 0.0
        for (x0, y0), (x1, y1) in zip(corners, [*corners[1:], *corners[:1]], strict=True):
            if x0 is None or y0 is None or x1 is None or y1 is None:
                return float(LETHAL_OBSTACLE)
            cost = max(cost, float(self.lineCost(x0, x1, y0, y1)))
            if cost == LETHAL_OBSTACLE:
                break
        return cost

    def lineCost(
        self, x0: float, x1: float, y0: float, y1: float, step_size: float = 0.5
    ) -> float:
        """Return the greatest cost of a line between two cells."""
        if (x0, y0) == (x1, y1):
            return self.pointCost(int(x0), int(y0))
        line, cost = LineIterator(x0, y0, x1, y1, step_size), 0.0
        while line.isValid():
            cost = max(cost, self.pointCost(int(line.getX()), int(line.getY())))
            if cost == LETHAL_OBSTACLE:
                break
            line.advance()
        return cost

    def worldToMapValidated(self, wx: float, wy: float) -> tuple[int | None, int | None]:
        """Return the cell of a point, m. Raises ValueError: there is no costmap."""
        return self._costmap().worldToMapValidated(wx, wy)

    def pointCost(self, x: int, y: int) -> float:
        """Return the cost of a cell. Raises ValueError: there is no costmap; IndexError."""
        return float(self._costmap().getCostXY(x, y))

    def setCostmap(self, costmap: PyCostmap2D) -> None:
        """Look at this costmap from now on."""
        self.costmap_ = costmap

    def footprintCostAtPose(self, x: float, y: float, theta: float, footprint: Polygon) -> float:
        """Return the cost of a footprint around the origin that is moved to a pose, m and rad."""
        cosine, sine = math.cos(theta), math.sin(theta)
        moved = [
            Point32(x=x + each.x * cosine - each.y * sine, y=y + each.x * sine + each.y * cosine)
            for each in footprint.points
        ]
        return self.footprintCost(Polygon(points=moved))

    def _costmap(self) -> PyCostmap2D:
        if self.costmap_ is None:
            raise ValueError('there is no costmap: call setCostmap first')
        return self.costmap_
