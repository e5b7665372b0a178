# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
Planar odometry of a differential drive, from wheel travel or from commands.

Maths as in diff_drive_controller 4.x: exact arcs, and their second-order (midpoint)
approximation where the turn is too small to divide by.

From which motion, and over which time, a differential drive's odometry is integrated.

Three sources: wheel positions (the difference to the update before), wheel velocities (times the
period), and in open loop the limited command.

The wheels of one side of a differential drive, which turn as one.
"""

from collections import deque
from collections.abc import Sequence
import math
import sys

from amr_description.clock import NANOSECONDS
from amr_description.control.interfaces import CommandInterface, StateInterface
from amr_description.errors import ControllerError

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


_GREATEST = sys.float_info.max


class WheelSide:
    """Any number of wheels with one radius, m; without ``states`` they are driven blindly."""

    def __init__(
        self,
        radius: float,
        commands: Sequence[CommandInterface] = (),
        states: Sequence[StateInterface] = (),
    ) -> None:
        self._radius = radius
        self._commands = commands
        self._states = states

    def drive(self, speed: float) -> None:
        """
        Command the speed of the side over the ground, m/s: speed / radius on every wheel.

        A quotient beyond all numbers becomes the greatest one: no wheel is told infinity.
        """
        turning = min(max(speed / self._radius, -_GREATEST), _GREATEST)
        for wheel in self._commands:
            wheel.value = turning

    def travel(self) -> float:
        """
        Return mean reading · radius: m since the wheels' zero from positions, m/s from velocities.

        Raises ControllerError when a reading is not a finite number.
        """
        total = 0.0
        for index, state in enumerate(self._states):
            if not math.isfinite(state.value):
                raise ControllerError(
                    f'Either the left or right wheel {state.interface} is invalid for index '
                    f'[{index}]: {state.name} is {state.value}'
                )
            total += state.value
        return total / len(self._states) * self._radius


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
