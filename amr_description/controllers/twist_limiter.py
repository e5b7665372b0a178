# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
The limits of a planar twist: each component by itself, or both by one factor.

By itself, as diff_drive_controller does it, a robot told to drive an arc starts on another one
when one component reaches its speed later than the other. With one factor it keeps to the arc, as
far as the limits allow: they are never exceeded for its sake.
"""

from amr_description.controllers.rate_limiter import RateLimiter

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
