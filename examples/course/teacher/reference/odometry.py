"""Odometry: where a robot of two driven sides is, told by its wheels."""

import math


class Odometry:
    """The pose of the robot in the frame in which it has begun: m, m, rad."""

    def __init__(self, wheel_radius: float, wheel_separation: float) -> None:
        self.x = self.y = self.yaw = 0.0
        self._radius, self._separation = wheel_radius, wheel_separation
        self._left = self._right = 0.0

    def update(self, left: float, right: float) -> None:
        """Take how far the wheels of each side have turned since the beginning, rad."""
        rolled_left = self._radius * (left - self._left)
        rolled_right = self._radius * (right - self._right)
        self._left, self._right = left, right
        forward = 0.5 * (rolled_left + rolled_right)
        turn = (rolled_right - rolled_left) / self._separation
        # It has moved along the direction that it had halfway.
        self.x += forward * math.cos(self.yaw + 0.5 * turn)
        self.y += forward * math.sin(self.yaw + 0.5 * turn)
        self.yaw = math.remainder(self.yaw + turn, math.tau)
