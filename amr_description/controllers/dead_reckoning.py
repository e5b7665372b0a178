# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
From which motion, and over which time, a differential drive's odometry is integrated.

Three sources: wheel positions (the difference to the update before), wheel velocities (times the
period), and in open loop the limited command.
"""

from amr_description.control.interfaces import NANOSECONDS
from amr_description.controllers.odometry import Odometry
from amr_description.controllers.wheel_side import WheelSide

_LEAST_STEP = 100_000
"""ns: an update that comes sooner after the one before is left out."""


class DeadReckoning:
    """Feeds an :class:`Odometry`; all times in ns."""

    def __init__(self, odometry: Odometry, *, is_open_loop: bool, has_positions: bool) -> None:
        self.odometry = odometry
        self._is_open_loop = is_open_loop
        self._has_positions = has_positions and not is_open_loop
        self._last_travel: tuple[float, float] | None = None
        self._last_time = 0

    def hold(self, time: int) -> None:
        """
        Let time run on to ``time`` without motion.

        Only wheel positions, once there are some to compare with, will tell what moved meanwhile,
        and over which time.
        """
        if self._last_travel is None:
            self._last_time = time

    def reset(self, time: int) -> None:
        """Go to the origin; wheels and time begin from where they are."""
        self.odometry.reset()
        self._last_travel = None
        self._last_time = time

    def set_clock(self, time: int) -> None:
        """Let time go on from ``time``; pose and wheels stay."""
        self._last_time = time

    def update(
        self, left: WheelSide, right: WheelSide, twist: tuple[float, float], time: int, period: int
    ) -> None:
        """
        Integrate up to ``time``.

        ``twist``: the limited command, m/s and rad/s. ``period``: since the previous update.
        Raises ControllerError when a wheel's reading is not finite.
        """
        travel = (0.0, 0.0) if self._is_open_loop else (left.travel(), right.travel())
        if self._has_positions and self._last_travel is None:
            self._last_travel = travel
        elapsed = time - self._last_time
        if elapsed < _LEAST_STEP:
            return
        self._last_time = time
        dt = elapsed / NANOSECONDS
        if self._is_open_loop:
            self.odometry.update_open_loop(*twist, dt)
        elif self._last_travel is None:
            self.odometry.update_from_travel(
                travel[0] * period / NANOSECONDS, travel[1] * period / NANOSECONDS, dt
            )
        else:
            last, self._last_travel = self._last_travel, travel
            self.odometry.update_from_travel(travel[0] - last[0], travel[1] - last[1], dt)
