# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
Where a robot is in a map, from scan to scan: odometry predicts, the scan corrects.

How far odometry errs is what amcl's motion model of a differential drive says of a motion by
``d`` m and ``a`` rad: the variance of the heading is ``alpha1 a² + alpha2 d²``, of the place
``alpha3 d² + alpha4 a²``.
"""

from collections.abc import Sequence
from dataclasses import dataclass, replace
import enum
import math

import numpy as np
from numpy.typing import NDArray

from amr_description.maps.pose import Pose
from amr_description.navigation.scan_matching import Array, Match, ScanMatcher

INITIAL_VARIANCES = (0.25, 0.25, (math.pi / 12.0) ** 2)
"""m², m², rad²: amcl's, of an initial pose without a covariance."""

_LEAST_NOISE = (0.02, 0.02, 0.01)
"""m, m, rad: a pose is never believed to be better than this before the next scan."""
_LOST, _POOR = 0.25, 0.5
"""Below these shares of rays that meet something of the map, a scan says nothing, or little."""


class Agreement(enum.IntEnum):
    """How well a scan fits the map at the pose that was found."""

    LOST = 0
    """So badly that the pose is that of odometry."""
    POOR = 1
    """So that another pose may be meant."""
    GOOD = 2

    @classmethod
    def of(cls, match: Match) -> 'Agreement':
        """Return that of a match."""
        return cls((match.fit >= _LOST) + (match.fit >= _POOR))


@dataclass(frozen=True)
class MotionNoise:
    """How far odometry errs, by the names of amcl."""

    alpha1: float = 0.2
    """Of the heading, by turning."""
    alpha2: float = 0.2
    """Of the heading, by driving, rad²/m²."""
    alpha3: float = 0.2
    """Of the place, by driving."""
    alpha4: float = 0.2
    """Of the place, by turning, m²/rad²."""

    def covariance(self, motion: Pose) -> Array:
        """Return the covariance of x, y and yaw after a motion: (3, 3), m² and rad²."""
        driven, turned = math.hypot(motion.x, motion.y) ** 2, motion.yaw**2
        place = self.alpha3 * driven + self.alpha4 * turned
        heading = self.alpha1 * turned + self.alpha2 * driven
        return np.diag([place, place, heading])


@dataclass(frozen=True)
class Estimate:
    """Where the robot is when a scan was taken."""

    pose: Pose
    """In the frame of the map."""
    covariance: Array
    """(3, 3), of x, y and yaw, m² and rad²."""
    odometry: Pose
    """Where odometry says it is, in its own frame."""

    @property
    def map_to_odom(self) -> Pose:
        """Where the frame of odometry is in that of the map."""
        return self.pose.compose(self.odometry.inverse())


class ScanTracker:
    """Follows a robot through one map."""

    def __init__(
        self,
        matcher: ScanMatcher,
        noise: MotionNoise,
        *,
        update_min_d: float = 0.0,
        update_min_a: float = 0.0,
    ) -> None:
        """
        Begin without a pose.

        Args:
            matcher: Of the map.
            noise: Of odometry.
            update_min_d: A scan is matched after a way of so many m …
            update_min_a: … or a turn by so many rad.
        """
        self.matcher = matcher
        self._noise = noise
        self._min_d, self._min_a = update_min_d, update_min_a
        self.estimate: Estimate | None = None
        """The last one."""
        self._is_due = False

    def place(self, pose: Pose, covariance: Array, odometry: Pose) -> None:
        """
        Take a pose as the prediction for the next scan, however short the way until then.

        Args:
            pose: In the frame of the map.
            covariance: (3, 3), of x, y and yaw; of one that is singular or none, only the
                variances are taken, and amcl's for those that are not above 0.
            odometry: Where odometry says that the robot was then.
        """
        variances = np.diag(covariance)
        if (np.linalg.eigvalsh(covariance) <= 0.0).any():
            covariance = np.diag(np.where(variances > 0.0, variances, INITIAL_VARIANCES))
        self.estimate = Estimate(pose, covariance, odometry)
        self.match_next()

    def match_next(self) -> None:
        """Have the next scan matched, even if the robot stands."""
        self._is_due = True

    def update(self, points: NDArray[np.float64], odometry: Pose) -> Match | None:
        """
        Correct the pose by a scan.

        Args:
            points: (n, 2), where its rays end, in the frame of the robot, m.
            odometry: Where odometry says that the robot was when it was taken.

        Returns:
            What was found; None if the robot has not moved far enough, or has no pose at all. If
            it does not fit the map, the pose stays that of odometry.
        """
        last = self.estimate
        if last is None:
            return None
        motion = last.odometry.inverse().compose(odometry)
        if not (self._is_due or self._has_moved(motion)):
            return None
        self._is_due = False
        predicted = last.pose.compose(motion)
        covariance = last.covariance + self._noise.covariance(motion)
        covariance = covariance + np.diag(np.square(_LEAST_NOISE))
        match = self.matcher.match(points, predicted, covariance)
        if match.fit < _LOST:
            match = Match(predicted, covariance, match.fit)
        elif match.fit < _POOR:  # it is less sure than what does fit alone would have it
            match = replace(match, covariance=match.covariance / match.fit**2)
        self.estimate = Estimate(match.pose, match.covariance, odometry)
        return match

    def _has_moved(self, motion: Pose) -> bool:
        return math.hypot(motion.x, motion.y) >= self._min_d or abs(motion.yaw) >= self._min_a


def ray_ends(
    ranges: Sequence[float] | NDArray[np.float32],
    angles: Array,
    *,
    nearest: float,
    farthest: float,
    most: int,
) -> NDArray[np.float64]:
    """
    Return where the rays of a scan that met something end, (n, 2), m, in the lidar's frame.

    Args:
        ranges: m.
        angles: rad, of each.
        nearest: Shorter ones are left out, m.
        farthest: Those that are not shorter are left out, m.
        most: Of more, every second, third … one is taken.
    """
    lengths = np.asarray(ranges, dtype=np.float64)
    met = np.flatnonzero(np.isfinite(lengths) & (lengths >= nearest) & (lengths < farthest))
    met = met[:: max(1, math.ceil(len(met) / most))]
    return lengths[met, None] * np.column_stack([np.cos(angles[met]), np.sin(angles[met])])
