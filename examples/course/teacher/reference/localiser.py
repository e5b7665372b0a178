"""Localisation: odometry drifts; a map and a lidar tell where the robot really is."""

from typing import Any

import numpy as np

from amr_description.navigation.distance_field import distances

PARTICLES = 300
BEAMS = 30


class Localiser:
    """The pose of the robot in the frame of the map, by a particle filter: m, m, rad."""

    def __init__(self, grid: Any, start: tuple[float, float, float]) -> None:
        self.grid = grid
        self.pose = start
        self.field = distances(grid.cells >= 50, grid.resolution)
        self._random = np.random.default_rng(1)
        self._particles = self._random.normal(start, (0.2, 0.2, 0.1), (PARTICLES, 3))

    def moved(self, dx: float, dy: float, dyaw: float) -> None:
        """Take what odometry says, along the robot's own axes: m, m, rad."""
        own = self._random.normal((dx, dy, dyaw), (0.01, 0.005, 0.01), (PARTICLES, 3))
        yaw = self._particles[:, 2]
        cos, sin = np.cos(yaw), np.sin(yaw)
        self._particles[:, 0] += cos * own[:, 0] - sin * own[:, 1]
        self._particles[:, 1] += sin * own[:, 0] + cos * own[:, 1]
        self._particles[:, 2] += own[:, 2]
        self.pose = tuple(self._particles.mean(axis=0))

    def saw(self, angles: np.ndarray, ranges: np.ndarray) -> None:
        """Take a scan: rad and m."""
        met = np.flatnonzero(np.isfinite(ranges))[:: max(1, len(ranges) // BEAMS)]
        x, y, yaw = (column[:, None] for column in self._particles.T)
        ends_x = x + ranges[met] * np.cos(yaw + angles[met])
        ends_y = y + ranges[met] * np.sin(yaw + angles[met])
        columns = ((ends_x - self.grid.origin.x) / self.grid.resolution).astype(int)
        rows = ((ends_y - self.grid.origin.y) / self.grid.resolution).astype(int)
        height, width = self.field.shape
        off = self.field[rows.clip(0, height - 1), columns.clip(0, width - 1)]
        fits = -0.5 * (np.minimum(off, 0.5) / 0.1) ** 2
        weights = np.exp(fits.sum(axis=1) - fits.sum(axis=1).max())
        weights /= weights.sum()
        self.pose = tuple(weights @ self._particles)
        chosen = self._random.choice(PARTICLES, PARTICLES, p=weights)
        self._particles = self._particles[chosen]
