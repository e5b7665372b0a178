# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
Limits of a velocity and of its first and second derivative (``RateLimiter`` of control_toolbox).

Speeding up and slowing down have separate limits, and so have driving forward and in reverse::

            max_acceleration_reverse        max_acceleration
      reverse  ◄──────────────────── 0 ────────────────────►  forward
               ────────────────────►   ◄────────────────────
            max_deceleration_reverse        max_deceleration

:class:`TwistLimiter` limits the two components of a planar twist separately, or by one factor. If
separately, as in diff_drive_controller, a robot that is commanded an arc starts on a different one
while one component lags behind the other. With one factor it keeps the arc, as far as the limits
allow.
"""

from dataclasses import dataclass, field
import math
from typing import TypeAlias

from amr_description.errors import ParameterError

_NAN = math.nan

_AT_REST = (0.0, 0.0)

_ROUNDING = 1e-9


Twist: TypeAlias = tuple[float, float]
"""m/s along x, rad/s about z."""


@dataclass(frozen=True)
class RateLimiter:
    """
    Limits a command, given the two previous ones.

    Units are those of the command, per s (acceleration) and per s² (jerk). A limit whose maximum
    is NaN is off; a minimum that is NaN is the negative of its maximum. Raises ParameterError: a
    minimum is above its maximum.
    """

    min_value: float = _NAN
    max_value: float = _NAN
    max_acceleration_reverse: float = _NAN
    """≤ 0: away from zero, in reverse; NaN: −max_acceleration."""
    max_acceleration: float = _NAN
    """≥ 0: away from zero, forward."""
    max_deceleration: float = _NAN
    """≤ 0: towards zero, forward; NaN: max_acceleration_reverse."""
    max_deceleration_reverse: float = _NAN
    """≥ 0: towards zero, in reverse; NaN: max_acceleration."""
    min_jerk: float = _NAN
    max_jerk: float = _NAN
    _is_off: bool = field(init=False, repr=False, compare=False)

    def __post_init__(self) -> None:
        """Replace NaN by the defaults, and check the order."""
        self._default('min_value', -self.max_value)
        self._default('max_acceleration_reverse', -self.max_acceleration)
        self._default('max_deceleration', self.max_acceleration_reverse)
        self._default('max_deceleration_reverse', self.max_acceleration)
        self._default('min_jerk', -self.max_jerk)
        if self.min_value > self.max_value:
            raise ParameterError(_invalid('value', self.min_value, self.max_value))
        for low, high in (
            (self.max_acceleration_reverse, self.max_acceleration),
            (self.max_deceleration, self.max_deceleration_reverse),
        ):
            if low > high:
                raise ParameterError(_invalid('first derivative', low, high))
        if self.min_jerk > self.max_jerk:
            raise ParameterError(_invalid('second derivative', self.min_jerk, self.max_jerk))
        maxima = self.max_value, self.max_acceleration, self.max_jerk
        object.__setattr__(self, '_is_off', all(map(math.isnan, maxima)))

    def limit(self, value: float, previous: float, before_previous: float, dt: float) -> float:
        """
        Return the command closest to ``value`` within the limits.

        Jerk is limited first, then acceleration, then the value.

        Args:
            value: the command.
            previous: the previous command, as limited.
            before_previous: the command before that, as limited.
            dt: time between two commands, s.
        """
        if self._is_off:
            return value
        value = self.limit_jerk(value, previous, before_previous, dt)
        value = self.limit_acceleration(value, previous, dt)
        return self.limit_value(value)

    def limit_value(self, value: float) -> float:
        """Limit the value itself."""
        if math.isnan(self.max_value):
            return value
        return _clamp(value, self.min_value, self.max_value)

    def limit_acceleration(self, value: float, previous: float, dt: float) -> float:
        """Limit the change since ``previous``, whose sign decides which limits apply."""
        if math.isnan(self.max_acceleration):
            return value
        low = self.max_acceleration_reverse if previous <= 0.0 else self.max_deceleration
        high = self.max_acceleration if previous >= 0.0 else self.max_deceleration_reverse
        return previous + _clamp(value - previous, low * dt, high * dt)

    def limit_jerk(
        self, value: float, previous: float, before_previous: float, dt: float
    ) -> float:
        """Limit the change of the change, but only while the change grows."""
        if math.isnan(self.max_jerk):
            return value
        change = value - previous
        previous_change = previous - before_previous
        if (change - previous_change) * change <= 0.0:
            return value
        square = dt * dt
        gain = _clamp(change - previous_change, self.min_jerk * square, self.max_jerk * square)
        return previous + previous_change + gain

    def _default(self, name: str, value: float) -> None:
        if math.isnan(getattr(self, name)):
            object.__setattr__(self, name, value)


class AxisLimiter:
    """Limits the commands of one axis, one after the other."""

    def __init__(self, limiter: RateLimiter) -> None:
        """Start at rest."""
        self._limiter = limiter
        self.forget()

    def forget(self) -> None:
        """Start at rest, without previous commands."""
        self._last = self._before_last = 0.0

    def limit(self, value: float, dt: float) -> float:
        """Return the limited command; ``dt``: since the previous one, s."""
        limited = self._limiter.limit(value, self._last, self._before_last, dt)
        self._last, self._before_last = limited, self._last
        return limited


class TwistLimiter:
    """Limits one twist after the other."""

    def __init__(
        self, linear: RateLimiter, angular: RateLimiter, *, keeps_curvature: bool = False
    ) -> None:
        """
        Start at rest.

        Args:
            linear: limits along x.
            angular: limits about z.
            keeps_curvature: limit both components by one factor.
        """
        self._linear = linear
        self._angular = angular
        self._keeps_curvature = keeps_curvature
        self.forget()

    def forget(self) -> None:
        """Start at rest, without previous twists."""
        self._last = self._before_last = _AT_REST

    def limit(self, twist: Twist, dt: float) -> Twist:
        """Return the limited twist; ``dt``: since the previous one, s."""
        limited = self._limit_each(twist, dt)
        if self._keeps_curvature and limited != twist:
            limited = self._limit_each(self._scaled(twist, limited), dt)
        self._last, self._before_last = limited, self._last
        return limited

    def _limit_each(self, twist: Twist, dt: float) -> Twist:
        (last_v, last_w), (before_v, before_w) = self._last, self._before_last
        return (
            self._linear.limit(twist[0], last_v, before_v, dt),
            self._angular.limit(twist[1], last_w, before_w, dt),
        )

    def _scaled(self, twist: Twist, limited: Twist) -> Twist:
        """
        Scale the command by the remaining fraction of its more limited component, 0 to 1.

        If neither component falls short of the command and one is still faster, that one decides
        instead, as far as the other does not exceed the previous twist. Zero has no curvature: on
        the way there, that of the previous twist is kept.
        """
        if twist == _AT_REST:
            kept = [a / b for a, b in zip(limited, self._last, strict=True) if b]
            return _times(self._last, max(kept, default=0.0))
        left = [a / b for a, b in zip(limited, twist, strict=True) if b]
        if min(left) > 1.0 - _ROUNDING:
            before = [a / b for a, b in zip(self._last, twist, strict=True) if b]
            return _times(twist, max(1.0, min(max(left), *before)))
        return _times(twist, max(min(left), 0.0))


def _times(twist: Twist, factor: float) -> Twist:
    return factor * twist[0], factor * twist[1]


def _clamp(value: float, low: float, high: float) -> float:
    return min(max(value, low), high)


def _invalid(kind: str, low: float, high: float) -> str:
    return f'Invalid {kind} limits: the lower is {low:g}, above the upper, {high:g}'
