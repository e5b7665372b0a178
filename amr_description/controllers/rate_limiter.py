# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
Limits of a velocity and of its first and second derivative (``RateLimiter`` of control_toolbox).

Speeding up and slowing down have limits of their own, and so have driving forward and in reverse::

            max_acceleration_reverse        max_acceleration
      reverse  ◄──────────────────── 0 ────────────────────►  forward
               ────────────────────►   ◄────────────────────
            max_deceleration_reverse        max_deceleration

The limits of a planar twist: each component by itself, or both by one factor.

By itself, as diff_drive_controller does it, a robot told to drive an arc starts on another one
when one component reaches its speed later than the other. With one factor it keeps to the arc, as
far as the limits allow: they are never exceeded for its sake.
"""

from dataclasses import dataclass
import math

from amr_description.errors import ParameterError

_NAN = math.nan


@dataclass(frozen=True)
class RateLimiter:
    """
    Limits a command, given the two commands before it.

    Units are those of the command per s (acceleration) and per s² (jerk). A kind of limit whose
    maximum is NaN is off; a minimum that is NaN is the negative of its maximum. Raises
    ParameterError when a minimum is above its maximum.
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

    def __post_init__(self) -> None:
        """Fill in what is NaN, and check the order."""
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

    def limit(self, value: float, previous: float, before_previous: float, dt: float) -> float:
        """
        Return the command nearest to ``value`` that keeps the limits.

        ``previous`` and ``before_previous``: the last two commands, as limited. ``dt``: time
        between them, s. Jerk is limited first, then acceleration, then the value.
        """
        value = self.limit_jerk(value, previous, before_previous, dt)
        value = self.limit_acceleration(value, previous, dt)
        return self.limit_value(value)

    def limit_value(self, value: float) -> float:
        """Clamp the value itself."""
        if math.isnan(self.max_value):
            return value
        return _clamp(value, self.min_value, self.max_value)

    def limit_acceleration(self, value: float, previous: float, dt: float) -> float:
        """Clamp the change since ``previous``; its sign decides which limits hold."""
        if math.isnan(self.max_acceleration):
            return value
        low = self.max_acceleration_reverse if previous <= 0.0 else self.max_deceleration
        high = self.max_acceleration if previous >= 0.0 else self.max_deceleration_reverse
        return previous + _clamp(value - previous, low * dt, high * dt)

    def limit_jerk(
        self, value: float, previous: float, before_previous: float, dt: float
    ) -> float:
        """Clamp the change of the change, but only while the command gains on ``previous``."""
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


def _clamp(value: float, low: float, high: float) -> float:
    return min(max(value, low), high)


def _invalid(kind: str, low: float, high: float) -> str:
    return f'Invalid {kind} limits: the lower is {low:g}, above the upper, {high:g}'


type Twist = tuple[float, float]
"""m/s along x, rad/s about z."""

_AT_REST = (0.0, 0.0)
_ROUNDING = 1e-9


class TwistLimiter:
    """Limits one twist after the other."""

    def __init__(
        self, linear: RateLimiter, angular: RateLimiter, *, keeps_curvature: bool = False
    ) -> None:
        """Begin at rest."""
        self._linear = linear
        self._angular = angular
        self._keeps_curvature = keeps_curvature
        self.forget()

    def forget(self) -> None:
        """Begin at rest: the twists before count no more."""
        self._last = self._before_last = _AT_REST

    def limit(self, twist: Twist, dt: float) -> Twist:
        """Return the twist to drive; ``dt``: since the one before, s."""
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
        Scale the command by what is left of its more limited component, between 0 and 1.

        Where none falls short of the command, and one is still faster, that one decides instead,
        as far as the other does not gain on the twist before. Rest has no curvature: on the way
        there it is that of the motion.
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
