# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
What it costs to be in a cell, as Nav2's costmaps have it: static map, obstacles, inflation.

Of nav2_costmap_2d 1.3 these layers: ``StaticLayer`` with its thresholds, ``ObstacleLayer`` with
one scan (rays clear what they pass, and mark where they end), ``InflationLayer``. The costs of the
last are exact here, as :mod:`~amr_description.navigation.distance_field` is: Nav2 approximates
distances by those that its wave front finds.
"""

from dataclasses import dataclass
import math

import numpy as np
from numpy.typing import NDArray

from amr_description.maps.grid import OccupancyGrid, UNKNOWN
from amr_description.maps.pose import Pose
from amr_description.navigation.distance_field import distances
from amr_description.navigation.footprint import Points
from amr_description.parameters import parameter

FREE_SPACE = 0
INSCRIBED = 253
"""The robot touches an obstacle, however it is turned."""
LETHAL = 254
NO_INFORMATION = 255

Costs = NDArray[np.uint8]


@dataclass(frozen=True)
class CostmapSettings:
    """Parameters of the layers, by the names of Nav2."""

    inflation_radius: float = parameter(0.55, 'Costs reach this far', unit='m', minimum=0.0)
    cost_scaling_factor: float = parameter(
        10.0, 'How fast costs fall with the distance', unit='1/m', minimum=0.0
    )
    lethal_cost_threshold: int = parameter(
        100,
        'A cell of the map that is at least this occupied is lethal',
        unit='%',
        minimum=0,
        read_only=True,
    )
    obstacle_max_range: float = parameter(
        2.5, 'Obstacles of the scan are marked as far as this', unit='m', minimum=0.0
    )
    raytrace_max_range: float = parameter(
        3.0, 'Rays of the scan clear as far as this', unit='m', minimum=0.0
    )
    inf_is_valid: bool = parameter(
        False, 'A ray that meets nothing clears; else it says nothing, as of a broken sensor'
    )


class Costmap:
    """
    The costs of a map in its own cells, with what a scan has seen besides.

    The frame is that of the map, which may not be turned: ``origin.yaw`` is 0.
    """

    def __init__(
        self, grid: OccupancyGrid, inscribed_radius: float, settings: CostmapSettings
    ) -> None:
        """
        Take a map; cells that nobody knows are not crossed.

        Args:
            grid: the map.
            inscribed_radius: of the footprint, m.
            settings: of the layers.

        Raises:
            ValueError: the map is turned.
        """
        if grid.origin.yaw != 0.0:
            raise ValueError(
                f'the origin of the map is turned by {grid.origin.yaw} rad; costmaps need 0'
            )
        self.grid = grid
        self.settings = settings
        self.inscribed_radius = inscribed_radius
        self._unknown = grid.cells == UNKNOWN
        self._static = grid.cells >= settings.lethal_cost_threshold
        self._obstacles = np.zeros_like(self._static)
        self._costs: Costs | None = None
        self._static_distances = distances(self._static, grid.resolution)
        self._distances = self._static_distances

    @property
    def resolution(self) -> float:
        """Edge of a cell, m."""
        return self.grid.resolution

    @property
    def costs(self) -> Costs:
        """(height, width): 0 to 252, INSCRIBED, LETHAL or NO_INFORMATION."""
        if self._costs is None:
            self._costs = self._inflated()
        return self._costs

    @property
    def seen(self) -> NDArray[np.bool_]:
        """(height, width): obstacles of the scan that the map has not."""
        return self._obstacles & ~self._static

    def configure(self, settings: CostmapSettings) -> None:
        """Take other settings from now on, but for ``lethal_cost_threshold``."""
        self.settings = settings
        self._costs = None

    def clear(self) -> None:
        """Forget what scans have seen."""
        self._change(np.zeros_like(self._obstacles))

    def clear_square(self, center: Pose, side: float, *, inside: bool = True) -> None:
        """Forget what scans have seen within a square of this side, m, or outside of it."""
        half = 0.5 * abs(side)
        corners = np.array(
            [[center.x - half, center.y - half], [center.x + half, center.y + half]]
        )
        (first, last) = np.clip(self.cells_of(corners), 0, np.array(self._static.shape))
        is_square = np.zeros_like(self._obstacles)
        is_square[first[0] : last[0] + 1, first[1] : last[1] + 1] = True
        self._change(self._obstacles & (~is_square if inside else is_square))

    def window(self, center: Pose, side: float) -> tuple[Costs, Pose]:
        """Return the costs within a square of this side, m, and the pose of its first corner."""
        row, column = self.grid.cell_of(center.x, center.y)
        half = max(1, round(0.5 * side / self.resolution))
        height, width = self._static.shape
        rows = slice(min(max(row - half, 0), height), min(max(row + half, 0), height))
        columns = slice(min(max(column - half, 0), width), min(max(column + half, 0), width))
        origin = self.grid.origin
        corner = Pose(
            origin.x + columns.start * self.resolution,
            origin.y + rows.start * self.resolution,
            0.0,
        )
        return self.costs[rows, columns], corner

    def cells_of(self, points: Points) -> NDArray[np.intp]:
        """Return (n, 2) row and column of points (n, 2) of the map frame; maybe outside."""
        corner = (self.grid.origin.x, self.grid.origin.y)
        return self._indices(points - corner)[:, ::-1]

    def cost_at(self, x: float, y: float) -> int:
        """Return the cost of a point of the map frame; NO_INFORMATION outside."""
        row, column = self.grid.cell_of(x, y)
        if not self.grid.holds(row, column):
            return NO_INFORMATION
        return int(self.costs[row, column])

    def costs_at(self, points: Points) -> Costs:
        """Return the costs (n,) of points (n, 2) of the map frame; NO_INFORMATION outside."""
        cells = self.cells_of(points)
        is_inside = ((cells >= 0) & (cells < self._static.shape)).all(axis=1)
        found = np.full(len(cells), NO_INFORMATION, dtype=np.uint8)
        found[is_inside] = self.costs[tuple(cells[is_inside].T)]
        return found

    def is_blocked(self, points: Points) -> bool:
        """Return whether one of the points (n, 2) is on an obstacle, or outside of the map."""
        cells = self.cells_of(points)
        shape = np.array(self._static.shape)
        if ((cells < 0) | (cells >= shape)).any():
            return True
        rows, columns = cells.T
        return bool((self._static | self._obstacles)[rows, columns].any())

    def see(self, sensor: Pose, angles: NDArray[np.float64], ranges: NDArray[np.float64]) -> None:
        """
        Take a scan: its rays clear what they pass, and mark where they end.

        Args:
            sensor: where the lidar is in the frame of the map.
            angles: (n,) of the rays from its x axis, rad.
            ranges: (n,) m; ``inf``: nothing was met; NaN or ``-inf``: the ray says nothing.
        """
        limit = self.settings.raytrace_max_range
        is_free = np.isposinf(ranges) & self.settings.inf_is_valid
        is_hit = np.isfinite(ranges) & (ranges > 0.0)
        obstacles = self._obstacles.copy()
        passed = np.where(is_free, limit, np.where(is_hit, ranges, 0.0))
        directions = np.stack((np.cos(angles + sensor.yaw), np.sin(angles + sensor.yaw)), axis=1)
        self._clear_rays(obstacles, sensor, directions, np.minimum(passed, limit))
        marked = is_hit & (ranges <= self.settings.obstacle_max_range)
        ends = (sensor.x, sensor.y) + directions[marked] * ranges[marked][:, None]
        obstacles[self._inside(*self.cells_of(ends).T)] = True
        self._change(obstacles)

    def _clear_rays(
        self,
        obstacles: NDArray[np.bool_],
        sensor: Pose,
        directions: Points,
        lengths: NDArray[np.float64],
    ) -> None:
        """Clear what lies along rays, looked at twice a cell."""
        longest = float(lengths.max(initial=0.0))
        steps = np.arange(math.ceil(longest / (0.5 * self.resolution))) * 0.5 * self.resolution
        reach = steps[None, :] < lengths[:, None]
        # x and y apart: pairs of them take numpy three times as long, ten times a second.
        x = (sensor.x + directions[:, :1] * steps)[reach]
        y = (sensor.y + directions[:, 1:] * steps)[reach]
        origin = self.grid.origin
        inside = self._inside(self._indices(y - origin.y), self._indices(x - origin.x))
        obstacles[inside] = False

    def _indices(self, lengths: NDArray[np.float64]) -> NDArray[np.intp]:
        indices: NDArray[np.intp] = np.floor(lengths / self.resolution).astype(np.intp)
        return indices

    def _inside(
        self, rows: NDArray[np.intp], columns: NDArray[np.intp]
    ) -> tuple[NDArray[np.intp], NDArray[np.intp]]:
        """Return rows and columns of those cells that the map has."""
        height, width = self._static.shape
        held = (rows >= 0) & (rows < height) & (columns >= 0) & (columns < width)
        return rows[held], columns[held]

    def _change(self, obstacles: NDArray[np.bool_]) -> None:
        if np.array_equal(obstacles, self._obstacles):
            return
        self._obstacles = obstacles
        self._costs = None

    def _inflated(self) -> Costs:
        """
        Return the costs of the present obstacles.

        InflationLayer::computeCost: LETHAL at an obstacle, INSCRIBED up to the inscribed radius,
        then ``252 exp(-cost_scaling_factor (d - inscribed_radius))`` up to ``inflation_radius``.
        """
        self._distances = self._static_distances.copy()
        self._add_distances(self._obstacles & ~self._static)
        d = self._distances
        reach = self.settings.inflation_radius
        beyond = np.clip(d - self.inscribed_radius, 0.0, reach)  # finite, also without obstacles
        factor = np.exp(-self.settings.cost_scaling_factor * beyond)
        costs = np.where(d <= reach, (INSCRIBED - 1) * factor, 0.0).astype(np.uint8)
        costs[self._unknown] = NO_INFORMATION
        costs[d <= self.inscribed_radius] = INSCRIBED
        costs[d == 0.0] = LETHAL
        return costs

    def _add_distances(self, extra: NDArray[np.bool_]) -> None:
        """Lower the distances near obstacles that the map has not, in their surroundings only."""
        if not extra.any():
            return
        reach = math.ceil(
            max(self.settings.inflation_radius, self.inscribed_radius) / self.resolution
        )
        rows, columns = np.flatnonzero(extra.any(axis=1)), np.flatnonzero(extra.any(axis=0))
        part = np.s_[
            max(0, rows[0] - reach) : rows[-1] + reach + 1,
            max(0, columns[0] - reach) : columns[-1] + reach + 1,
        ]
        near = distances(extra[part], self.resolution)
        np.minimum(self._distances[part], near, out=self._distances[part])
