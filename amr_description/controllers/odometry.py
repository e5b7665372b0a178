# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
Planar odometry of a differential drive, from wheel travel or from commands.

Maths as in diff_drive_controller 4.x: exact arcs, and their second-order (midpoint)
approximation where the turn is too small to divide by.
"""

from collections import deque
import math

_SMALL_TURN = 1e-6
"""rad: below it the arc's radius is ill-conditioned."""


class Odometry:
    """
    Integrates the pose (x, y in m, heading in rad, not wrapped), and estimates the twist.

    The pose is that of the point midway between the wheels in the frame where it began.
    """

    def __init__(self, wheel_separation: float, window: int) -> None:
        """
        Begin at the origin.

        ``wheel_separation``: effective, m. ``window``: samples in the rolling mean of the twist.
        """
        self._separation = wheel_separation
        self._linears: deque[float] = deque(maxlen=window)
        self._angulars: deque[float] = deque(maxlen=window)
        self.reset()

    def reset(self) -> None:
        """Go to the origin, at rest, with an empty rolling mean."""
        self.x = self.y = self.heading = 0.0
        self.linear = self.angular = 0.0
        self._linears.clear()
        self._angulars.clear()

    def update_from_travel(self, left: float, right: float, dt: float) -> None:
        """
        Take the travel of both sides (m) in ``dt`` (s, positive).

        distance = (left + right) / 2, turn = (right − left) / separation; the twist is the
        rolling mean of both over ``dt``.
        """
        distance = (left + right) * 0.5
        turn = (right - left) / self._separation
        self._integrate(distance, turn)
        self._linears.append(distance / dt)
        self._angulars.append(turn / dt)
        self.linear = sum(self._linears) / len(self._linears)
        self.angular = sum(self._angulars) / len(self._angulars)

    def update_open_loop(self, linear: float, angular: float, dt: float) -> None:
        """Take a commanded twist (m/s, rad/s) that held for ``dt`` (s)."""
        self._integrate(linear * dt, angular * dt)
        self.linear = linear
        self.angular = angular

    def _integrate(self, distance: float, turn: float) -> None:
        before = self.heading
        self.heading = before + turn
        if abs(turn) < _SMALL_TURN:
            direction = before + turn * 0.5
            self.x += distance * math.cos(direction)
            self.y += distance * math.sin(direction)
        else:
            radius = distance / turn
            self.x += radius * (math.sin(self.heading) - math.sin(before))
            self.y -= radius * (math.cos(self.heading) - math.cos(before))
