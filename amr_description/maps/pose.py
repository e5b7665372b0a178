# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""A pose in the plane."""

import math
from typing import NamedTuple


class Pose(NamedTuple):
    """Where a frame is in another one, in the plane. Also a rigid motion, see ``compose``."""

    x: float
    """m"""
    y: float
    """m"""
    yaw: float
    """rad, counter-clockwise"""

    def compose(self, other: 'Pose') -> 'Pose':
        """Return the pose of ``other``, given in the frame at this pose, in this one's frame."""
        cos, sin = math.cos(self.yaw), math.sin(self.yaw)
        return Pose(
            self.x + cos * other.x - sin * other.y,
            self.y + sin * other.x + cos * other.y,
            wrapped(self.yaw + other.yaw),
        )

    def inverse(self) -> 'Pose':
        """Return the pose of the outer frame in the frame at this pose."""
        cos, sin = math.cos(self.yaw), math.sin(self.yaw)
        return Pose(-cos * self.x - sin * self.y, sin * self.x - cos * self.y, wrapped(-self.yaw))

    def distance(self, other: 'Pose') -> float:
        """Return how far apart the two are, m."""
        return math.hypot(other.x - self.x, other.y - self.y)


def wrapped(angle: float) -> float:
    """Return the same angle, rad, from -π to π."""
    return math.remainder(angle, math.tau)
