# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
Limits of a driven and steered wheel, with the formulas of tricycle_controller 4.x.

All limits hold in both directions, and none is negative. Where only one of a pair is set, the
other is 0 or 1000. With a lowest rate a command is approached no more slowly, and overshot: that
is the original's.
"""

from dataclasses import dataclass
import math
from typing import Any

from amr_description.errors import ControllerError
from amr_description.parameters import parameter

_BIG = 1000.0
_NO_LIMIT: dict[str, Any] = {'nan': True}


def _limit(doc: str, unit: str) -> Any:
    return parameter(math.nan, doc, unit=unit, **_NO_LIMIT)


@dataclass(frozen=True)
class TractionLimits:
    """Limits of the speed of the wheel; .nan: none."""

    max_velocity: float = _limit('Highest speed', 'rad/s')
    min_velocity: float = _limit('Lowest speed', 'rad/s')
    max_acceleration: float = _limit('Highest rate away from zero', 'rad/s²')
    min_acceleration: float = _limit('Lowest rate away from zero', 'rad/s²')
    max_deceleration: float = _limit('Highest rate towards zero', 'rad/s²')
    min_deceleration: float = _limit('Lowest rate towards zero', 'rad/s²')
    max_jerk: float = _limit('Highest jerk', 'rad/s³')
    min_jerk: float = _limit('Lowest jerk', 'rad/s³')

    def check(self) -> None:
        """Raise ControllerError if a limit is negative, or a lower one above its upper one."""
        _check(self, 'traction', ('velocity', 'acceleration', 'deceleration', 'jerk'))

    def limit(self, value: float, previous: float, before_previous: float, dt: float) -> float:
        """
        Return the limited speed, rad/s.

        Args:
            value: the command.
            previous: the previous command, as limited.
            before_previous: the command before that.
            dt: since the previous command, s.
        """
        low, high = _pair(self.min_jerk, self.max_jerk)
        if not math.isnan(low):
            slope = previous - before_previous
            value = previous + slope + _sized(value - previous - slope, low, high, 2.0 * dt * dt)
        low, high = _pair(self.min_acceleration, self.max_acceleration)
        if not math.isnan(low):
            if abs(value) < abs(previous):
                low, high = _pair(self.min_deceleration, self.max_deceleration)
            value = previous + _sized(value - previous, low, high, dt)
        low, high = _pair(self.min_velocity, self.max_velocity)
        return value if math.isnan(low) else _sized(value, low, high, 1.0)


@dataclass(frozen=True)
class SteeringLimits:
    """Limits of the steering angle; .nan: none."""

    max_position: float = _limit('Greatest angle', 'rad')
    min_position: float = _limit('Least angle', 'rad')
    max_velocity: float = _limit('Highest speed', 'rad/s')
    min_velocity: float = _limit('Lowest speed', 'rad/s')
    max_acceleration: float = _limit('Highest acceleration', 'rad/s²')
    min_acceleration: float = _limit('Lowest acceleration', 'rad/s²')

    def check(self) -> None:
        """Raise ControllerError if a rate is negative, or a lower limit above its upper one."""
        _check(self, 'steering', ('velocity', 'acceleration'))
        low, high = self._positions()
        if low > high:
            raise ControllerError(
                f'Error configuring steering limiter: min_position {low:g} is above max_position '
                f'{high:g}'
            )

    def limit(self, value: float, previous: float, before_previous: float, dt: float) -> float:
        """Return the limited angle, rad; arguments as of :meth:`TractionLimits.limit`."""
        low, high = _pair(self.min_acceleration, self.max_acceleration)
        if not math.isnan(low):
            slope = previous - before_previous
            value = previous + slope + _sized(value - previous - slope, low, high, 2.0 * dt * dt)
        low, high = _pair(self.min_velocity, self.max_velocity)
        if not math.isnan(low):
            value = previous + _sized(value - previous, low, high, dt)
        low, high = self._positions()
        return value if math.isnan(low) else min(max(value, low), high)

    def _positions(self) -> tuple[float, float]:
        low, high = self.min_position, self.max_position
        return (-high if math.isnan(low) else low), (-low if math.isnan(high) else high)


def _pair(low: float, high: float) -> tuple[float, float]:
    """Return both limits, NaN if none is set."""
    if math.isnan(low) and math.isnan(high):
        return low, high
    return (0.0 if math.isnan(low) else low), (_BIG if math.isnan(high) else high)


def _sized(change: float, low: float, high: float, scale: float) -> float:
    """Return a change with its size within the limits, times ``scale``; NaN: no limit."""
    size = abs(change)
    if not math.isnan(low):
        size = min(max(size, low * scale), high * scale)
    return math.copysign(size, change) if change else size


def _check(limits: TractionLimits | SteeringLimits, name: str, kinds: tuple[str, ...]) -> None:
    for kind in kinds:
        low, high = _pair(getattr(limits, f'min_{kind}'), getattr(limits, f'max_{kind}'))
        if low < 0.0 or high < 0.0:
            raise ControllerError(
                f'Error configuring {name} limiter: {kind} cannot be negative, found '
                f'{min(low, high):g}: the positive limit is applied to both directions'
            )
        if low > high:
            raise ControllerError(
                f'Error configuring {name} limiter: min_{kind} {low:g} is above max_{kind} '
                f'{high:g}'
            )
