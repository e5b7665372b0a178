# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
Planar odometry of a drive that cannot go sideways, from its wheels or from commands.

:class:`PlanarOdometry` integrates distance and turn; :class:`Odometry` takes them from the travel
of the two sides of a differential drive.

:class:`DeadReckoning` has three sources of motion: wheel positions (the difference to the previous
update), wheel velocities (times the period) and, in open loop, the limited command. It feeds
:class:`Odometry`, with the maths of diff_drive_controller 4.x: exact arcs, and their second-order
(midpoint) approximation if the turn is too small to divide by.
"""

from collections import deque
from collections.abc import Sequence
import math
import sys

from amr_description.clock import NANOSECONDS
from amr_description.control.interfaces import CommandInterface, StateInterface
from amr_description.control.samples import Frames, OdometrySample
from amr_description.errors import ControllerError

_SMALL_TURN = 1e-6
"""rad: below it the radius of the arc is ill-conditioned."""

LEAST_PERIOD = 100_000
"""ns: a shorter time since the previous update is no basis of odometry, and skipped."""

_GREATEST = sys.float_info.max


class PlanarOdometry:
    """Integrates the pose (x, y in m, heading in rad, not wrapped), and estimates the twist."""

    def __init__(self, window: int) -> None:
        """Start at the origin; ``window``: number of samples in the rolling mean of the twist."""
        self._linears: deque[float] = deque(maxlen=window)
        self._angulars: deque[float] = deque(maxlen=window)
        self.reset()

    def reset(self) -> None:
        """Go to the origin, at rest, with an empty rolling mean."""
        self.x = self.y = self.heading = 0.0
        self.linear = self.angular = 0.0
        self._linears.clear()
        self._angulars.clear()

    def update(self, distance: float, turn: float, dt: float) -> None:
        """
        Integrate a motion (m, rad) in ``dt`` (s, positive).

        The twist is the rolling mean of both divided by ``dt``.
        """
        self._integrate(distance, turn)
        self._linears.append(distance / dt)
        self._angulars.append(turn / dt)
        self.linear = sum(self._linears) / len(self._linears)
        self.angular = sum(self._angulars) / len(self._angulars)

    def update_open_loop(self, linear: float, angular: float, dt: float) -> None:
        """Integrate a commanded twist (m/s, rad/s) over ``dt`` (s)."""
        self._integrate(linear * dt, angular * dt)
        self.linear = linear
        self.angular = angular

    def sample(self, time: int, frames: Frames) -> OdometrySample:
        """Return what to publish at ``time``, ns."""
        return OdometrySample(
            stamp=time,
            x=self.x,
            y=self.y,
            heading=self.heading,
            linear=self.linear,
            angular=self.angular,
            frames=frames,
        )

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


class Odometry(PlanarOdometry):
    """
    That of a differential drive.

    The pose is that of the point midway between the wheels, in the frame where it started.
    """

    def __init__(self, wheel_separation: float, window: int) -> None:
        """
        Start at the origin.

        Args:
            wheel_separation: effective, m.
            window: number of samples in the rolling mean of the twist.
        """
        self._separation = wheel_separation
        super().__init__(window)

    def update_from_travel(self, left: float, right: float, dt: float) -> None:
        """
        Integrate the travel of both sides (m) in ``dt`` (s, positive).

        distance = (left + right) / 2, turn = (right − left) / separation.
        """
        self.update((left + right) * 0.5, (right - left) / self._separation, dt)


class WheelSide:
    """The wheels of one side: any number, of one radius (m); no ``states`` in open loop."""

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
        Command the speed of the side over the ground, m/s: speed / radius for every wheel.

        A quotient that overflows becomes the greatest number: no wheel is commanded infinity.
        """
        velocity = min(max(speed / self._radius, -_GREATEST), _GREATEST)
        for wheel in self._commands:
            wheel.value = velocity

    def travel(self) -> float:
        """
        Return mean state · radius: m since the wheels' zero for positions, m/s for velocities.

        Raises ControllerError: a state is not finite.
        """
        total = 0.0
        for state in self._states:
            total += state.value
        if not math.isfinite(total):
            self._check_states()
        return total / len(self._states) * self._radius

    def _check_states(self) -> None:
        for index, state in enumerate(self._states):
            if not math.isfinite(state.value):
                raise ControllerError(
                    f'Either the left or right wheel {state.interface} is invalid for index '
                    f'[{index}]: {state.name} is {state.value}'
                )


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
        Let time go on to ``time`` without motion.

        With wheel positions to compare with, the next update covers this time and its motion.
        """
        if self._last_travel is None:
            self._last_time = time

    def reset(self, time: int) -> None:
        """Go to the origin; wheels and time start from where they are."""
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

        Args:
            left: the wheels on the left.
            right: the wheels on the right.
            twist: the limited command, m/s and rad/s.
            time: of this update, ns.
            period: since the previous update, ns.

        Raises:
            ControllerError: a wheel state is not finite.
        """
        travel = (0.0, 0.0) if self._is_open_loop else (left.travel(), right.travel())
        if self._has_positions and self._last_travel is None:
            self._last_travel = travel
        elapsed = time - self._last_time
        if elapsed < LEAST_PERIOD:
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


class HolonomicOdometry:
    """
    Integrates the pose: x, y in m, heading in rad, not wrapped.

    ``linear``, ``lateral`` (m/s) and ``angular`` (rad/s) are the latest twist, in the frame of the
    base; it is not filtered, as in the originals.
    """

    def __init__(self) -> None:
        """Start at the origin."""
        self.reset()

    def reset(self) -> None:
        """Go to the origin, at rest."""
        self.x = self.y = self.heading = 0.0
        self.linear = self.lateral = self.angular = 0.0

    def update(self, twist: tuple[float, float, float], dt: float) -> None:
        """
        Integrate a twist (m/s, m/s, rad/s) over ``dt`` (s) exactly: along an arc.

        As in omni_wheel_drive_controller 4.x.
        """
        self.linear, self.lateral, self.angular = twist
        along, across, turn = self.linear * dt, self.lateral * dt, self.angular * dt
        before = self.heading
        self.heading = before + turn
        if abs(turn) < _SMALL_TURN:
            cosine, sine = math.cos(before), math.sin(before)
        else:
            cosine = (math.sin(self.heading) - math.sin(before)) / turn
            sine = (math.cos(before) - math.cos(self.heading)) / turn
        self.x += along * cosine - across * sine
        self.y += along * sine + across * cosine

    def update_after_turn(self, twist: tuple[float, float, float], dt: float) -> None:
        """
        Integrate a twist over ``dt`` along the heading that it ends with.

        As in mecanum_drive_controller 4.x; on a turn it is off by half of the turn of one period.
        """
        self.linear, self.lateral, self.angular = twist
        self.heading += self.angular * dt
        cosine, sine = math.cos(self.heading), math.sin(self.heading)
        self.x += (self.linear * cosine - self.lateral * sine) * dt
        self.y += (self.linear * sine + self.lateral * cosine) * dt

    def sample(self, time: int, frames: Frames) -> OdometrySample:
        """Return what to publish at ``time``, ns."""
        return OdometrySample(
            stamp=time,
            x=self.x,
            y=self.y,
            heading=self.heading,
            linear=self.linear,
            angular=self.angular,
            frames=frames,
            lateral=self.lateral,
        )
