"""Localisation: odometry drifts; a map and a lidar tell where the robot really is."""

from typing import Any

import numpy as np

from amr_description.navigation.distance_field import distances


class Localiser:
    """
    The pose of the robot in the frame of the map.

    Args:
        grid: The map. ``cells[row, column]`` is 100 where something is; ``resolution``, m;
            ``origin``: x and y of the outer corner of cell [0, 0], m.
        start: x, y, yaw at the beginning: m, m, rad. About right, by 0.2 m and 0.1 rad.
    """

    def __init__(self, grid: Any, start: tuple[float, float, float]) -> None:
        self.grid = grid
        self.pose = start
        """x, y, yaw: m, m, rad."""
        # How far each cell is from the nearest that is occupied, m:
        self.field = distances(grid.cells >= 50, grid.resolution)

    def moved(self, dx: float, dy: float, dyaw: float) -> None:
        """
        Take what odometry says of the last tenth of a second; it says a tenth too much.

        Args:
            dx: Forward, m, along the robot's own axis.
            dy: To the left, m.
            dyaw: Counter-clockwise, rad.
        """
        # Your turn.

    def saw(self, angles: np.ndarray, ranges: np.ndarray) -> None:
        """
        Take a scan. The lidar stands in the middle of the robot.

        Args:
            angles: Of the rays, rad, from the robot's own x axis.
            ranges: How far each went, m; ``inf`` where it met nothing.
        """
        # Your turn: at a right pose the rays end where the map has something.
