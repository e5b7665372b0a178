# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
Where a robot is, by a scan matched against a map.

The map is a field of distances: how far a point is from the nearest face of something, negative
inside. At the right pose the ends of all rays are at 0. The pose that is found is the most likely
one of the scan and of a prediction, such as odometry gives::

    sum over rays of rho(d(end of the ray) / sigma) + (x - x0)' P^-1 (x - x0)  is least

with the robust loss of Geman and McClure, rho(r) = r² / (1 + r² / k²), so that what is not in the
map does not matter. It is found by Gauss-Newton steps with k falling (graduated non-convexity),
and if the prediction is vague, from the best of many poses around it (correlative search: Olson,
Real-time correlative scan matching, ICRA 2009).
"""

from dataclasses import dataclass
import math
from typing import TypeAlias

import numpy as np
from numpy.typing import NDArray

from amr_description.maps.grid import OccupancyGrid
from amr_description.maps.pose import Pose, wrapped
from amr_description.navigation.distance_field import distances

Array: TypeAlias = NDArray[np.float64]

_WIDTHS = (0.5, 0.2, 0.1)
"""m: at these distances a ray's weight has fallen to a quarter, from step to step."""
_STEPS = 12
"""The most steps for each of them."""
_SMALL_STEP = 1e-4
"""m and rad: below it the search has ended."""
_VAGUE = (0.3, 0.3, 0.2)
"""m, m, rad: a prediction with a larger standard deviation is searched around."""
_SEARCH_STEP = (0.12, 0.12, math.radians(5.0))
_SEARCH_REACH = 2.0
"""Standard deviations, to both sides."""
_FARTHEST = (2.0, 2.0, math.pi / 2.0)
"""m, m, rad: no search goes farther, however vague the prediction of a lost robot has become."""
_SEARCH_RAYS = 60
_SEARCH_WIDTH = 0.2
"""m: how far from a face the end of a ray may be in the search."""
_REFINED = 8
"""How many of the poses of a search are refined."""
_NEAR = 0.15
"""m: the end of a ray that is nearer to a face has met what the map shows."""
_POSES_AT_ONCE = 2000


@dataclass(frozen=True)
class Match:
    """A pose that was found."""

    pose: Pose
    """Of the robot in the frame of the map."""
    covariance: Array
    """(3, 3), of x, y and yaw, m² and rad²."""
    fit: float
    """The share of the rays that end within 0.15 m of a face of the map, 0 to 1."""


class ScanMatcher:
    """Matches scans against one map."""

    def __init__(
        self,
        grid: OccupancyGrid,
        *,
        sigma: float = 0.05,
        max_distance: float = 2.0,
        occupied_at: int = 50,
    ) -> None:
        """
        Make the field.

        Args:
            grid: The map.
            sigma: How far the end of a ray is from what it met, m: one standard deviation, of the
                map's cells more than of the sensor.
            max_distance: Farther from everything, a point tells nothing, m.
            occupied_at: Cells of at least so many percent are occupied.
        """
        self._resolution = grid.resolution
        self._origin = grid.origin
        self._sigma = sigma
        self._max_distance = max_distance
        self._field = _face_distances(grid, occupied_at, max_distance)

    def match(self, points: Array, predicted: Pose, covariance: Array) -> Match:
        """
        Return the most likely pose.

        Args:
            points: (n, 2), where rays end, in the frame of the robot, m.
            predicted: The pose before the scan is known, in the frame of the map.
            covariance: (3, 3), of the prediction: x, y, yaw.

        Returns:
            The prediction itself, if there are no points.
        """
        turn = _rotation(-self._origin.yaw)
        start = _vector(self._origin.inverse().compose(predicted))
        information = np.linalg.inv(turn @ covariance @ turn.T)
        starts = [start]
        if any(np.sqrt(np.diag(covariance)) > _VAGUE):
            starts = self._search(points, start, turn @ covariance @ turn.T)
        best = min(
            (self._refined(points, each, start, information) for each in starts),
            key=lambda found: found.cost,
        )
        pose = self._origin.compose(Pose(*best.pose.tolist()))
        distance, _ = self._look_up(_moved(points, best.pose))
        fit = float(np.mean(np.abs(distance) < _NEAR)) if len(points) else 0.0
        return Match(pose, turn.T @ np.linalg.inv(best.information) @ turn, fit)

    def _search(self, points: Array, start: Array, covariance: Array) -> list[Array]:
        """Return the poses around ``start`` at which most rays end at a face."""
        reach = np.minimum(_SEARCH_REACH * np.sqrt(np.diag(covariance)), _FARTHEST)
        axes = [
            np.arange(-math.ceil(most / step), math.ceil(most / step) + 1) * step
            for most, step in zip(reach, _SEARCH_STEP, strict=True)
        ]
        poses = start + np.stack(np.meshgrid(*axes, indexing='ij'), axis=-1).reshape(-1, 3)
        some = points[:: max(1, math.ceil(len(points) / _SEARCH_RAYS))]
        scores = np.concatenate(
            [
                self._scores(some, poses[first : first + _POSES_AT_ONCE])
                for first in range(0, len(poses), _POSES_AT_ONCE)
            ]
        )
        best = np.argsort(-scores, kind='stable')[:_REFINED]
        return [start, *poses[best]]

    def _scores(self, points: Array, poses: Array) -> Array:
        """Return how many rays end near a face, for (m, 3) poses: (m,)."""
        cos, sin = np.cos(poses[:, 2, None]), np.sin(poses[:, 2, None])
        x = poses[:, 0, None] + cos * points[:, 0] - sin * points[:, 1]
        y = poses[:, 1, None] + sin * points[:, 0] + cos * points[:, 1]
        height, width = self._field.shape
        row = np.clip(y / self._resolution, 0, height - 1).astype(np.int64)
        column = np.clip(x / self._resolution, 0, width - 1).astype(np.int64)
        near: Array = np.exp(-0.5 * (self._field[row, column] / _SEARCH_WIDTH) ** 2)
        return near.sum(axis=1)

    def _refined(
        self, points: Array, begin: Array, predicted: Array, information: Array
    ) -> '_Estimate':
        """Return the local optimum that Gauss-Newton steps from ``begin`` lead to."""
        pose = begin
        for width in _WIDTHS:
            for _ in range(_STEPS):
                estimate = self._linearised(points, pose, predicted, information, width)
                pose = pose + np.linalg.solve(estimate.information, -estimate.gradient)
                if np.abs(pose - estimate.pose).max() < _SMALL_STEP:
                    break
        return self._linearised(points, pose, predicted, information, _WIDTHS[-1])

    def _linearised(
        self, points: Array, pose: Array, predicted: Array, information: Array, width: float
    ) -> '_Estimate':
        """Return cost, gradient and Gauss-Newton matrix at a pose; ``width``: of the loss, m."""
        ends = _moved(points, pose)
        distance, slope = self._look_up(ends)
        lever = ends - pose[:2]
        turning = slope[:, 1] * lever[:, 0] - slope[:, 0] * lever[:, 1]
        jacobian = np.column_stack([slope, turning])
        bounded = 1.0 / (1.0 + (distance / width) ** 2)
        weight = (bounded / self._sigma) ** 2
        away = pose - predicted
        away[2] = wrapped(float(away[2]))
        return _Estimate(
            pose,
            cost=float(np.sum(distance**2 * bounded) / self._sigma**2 + away @ information @ away),
            gradient=jacobian.T @ (weight * distance) + information @ away,
            information=(jacobian.T * weight) @ jacobian + information,
        )

    def _look_up(self, points: Array) -> tuple[Array, Array]:
        """
        Return the distances at points, m, (n,), and their slopes, (n, 2), bilinear between cells.

        Args:
            points: (n, 2), in the frame of the grid's corner.
        """
        height, width = self._field.shape
        place = points / self._resolution - 0.5
        known = np.all((place >= 0.0) & (place < (width - 1, height - 1)), axis=1)
        place = np.where(known[:, None], place, 0.0)
        column, row = np.floor(place).astype(np.int64).T
        right, up = (place - np.floor(place)).T
        low_left, low_right = self._field[row, column], self._field[row, column + known]
        row = row + known
        high_left, high_right = self._field[row, column], self._field[row, column + known]
        low = low_left + right * (low_right - low_left)
        high = high_left + right * (high_right - high_left)
        along_x = (low_right - low_left) * (1.0 - up) + (high_right - high_left) * up
        slope = np.column_stack([along_x, high - low]) / self._resolution
        distance = np.where(known, low + up * (high - low), self._max_distance)
        return distance, np.where(known[:, None], slope, 0.0)


@dataclass(frozen=True)
class _Estimate:
    """The cost of a pose, and how it changes; all in the frame of the grid's corner."""

    pose: Array
    cost: float
    gradient: Array
    information: Array


def _face_distances(grid: OccupancyGrid, occupied_at: int, max_distance: float) -> Array:
    """
    Return how far the middle of each cell is from the nearest face between occupied and other.

    The middles of the two cells at a face are half a cell away from it, so that the field is 0 at
    the face itself; negative inside.
    """
    occupied = grid.cells >= occupied_at
    half = 0.5 * grid.resolution
    outside = distances(occupied, grid.resolution) - half
    inside = distances(~occupied, grid.resolution) - half
    return np.clip(np.where(occupied, -inside, outside), -max_distance, max_distance)


def _moved(points: Array, pose: Array) -> Array:
    """Return points of the robot's frame, (n, 2), in the frame in which it is at ``pose``."""
    cos, sin = math.cos(pose[2]), math.sin(pose[2])
    return points @ np.array([[cos, sin], [-sin, cos]]) + pose[:2]


def _rotation(angle: float) -> Array:
    """Return the matrix that turns (x, y, yaw) about z."""
    cos, sin = math.cos(angle), math.sin(angle)
    return np.array([[cos, -sin, 0.0], [sin, cos, 0.0], [0.0, 0.0, 1.0]])


def _vector(pose: Pose) -> Array:
    return np.array(pose, dtype=np.float64)
