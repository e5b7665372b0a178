# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
The kinematics of steered vehicles: a twist ↔ wheel speeds and steering angles.

The middle of the fixed axle moves along x of the base at v, and the vehicle turns at ω about a
point on that axle's line, at R = v / ω to the left. A wheel midway on the steered axle, wheelbase
L ahead, has the angle φ = atan(L / R); two wheels, w apart, have atan(L / (R ± w / 2)), so that
all axles meet in that point. Of two wheels on the fixed axle, w apart, each rolls at
v (R ± w / 2) / R. The upper sign is that of the right wheel, which comes first everywhere.

Formulas as in steering_controllers_library 4.x, with two differences: the wheels of a double
steered axle get their own angles also while the measured angle is zero, where the original turns
both alike for one update; and a wheel that is itself the point to turn about says nothing about
the speed, where the original divides by zero.
"""

from abc import ABC, abstractmethod
from collections.abc import Sequence
from dataclasses import dataclass
import math

_SMALL = 1e-6
"""rad or m: below it a value counts as zero."""

_FREE_ERROR = math.pi / 6.0
"""rad: up to this error of the steering angle the wheels have their full speed."""
_GREATEST_ERROR = 1.5608
"""rad: from this error on, the speed is not reduced any further."""


@dataclass(frozen=True, slots=True)
class SteeringCommands:
    """Speeds of the traction wheels, rad/s, and angles of the steered ones, rad; right first."""

    traction: tuple[float, ...]
    steering: tuple[float, ...]


@dataclass(frozen=True, slots=True)
class SteeringKinematics(ABC):
    """
    What bicycle, tricycle and Ackermann steering have in common.

    ``wheelbase`` and ``radius``, that of the traction wheels, are in m.
    """

    wheelbase: float
    radius: float

    def commands(
        self, linear: float, angular: float, steered: float | None, *, reduces_speed: bool = False
    ) -> SteeringCommands:
        """
        Return the commands for a twist of the base, m/s and rad/s.

        Args:
            linear: along x.
            angular: about z.
            steered: the measured angle of the virtual middle wheel, by which the speeds of two
                traction wheels differ, rad; None: the wanted one (open loop).
            reduces_speed: drive slowly while the measured angle is off by more than 30 degrees.
        """
        wanted = self.steering_angle(linear, angular)
        speed = linear / self.radius
        if reduces_speed and steered is not None:
            speed *= _speed_scale(abs(steered - wanted))
        actual = wanted if steered is None else steered
        return SteeringCommands(self._traction(speed, actual), self._steering(wanted))

    def steering_angle(self, linear: float, angular: float) -> float:
        """
        Return the angle of the virtual middle wheel, rad: atan(L ω / v), at most a right angle.

        At rest it is 0.
        """
        if linear == 0.0:
            return math.copysign(math.pi / 2.0, angular) if angular else 0.0
        return math.atan(angular * self.wheelbase / linear)

    def twist(self, traction: Sequence[float], steering: Sequence[float]) -> tuple[float, float]:
        """Return v (m/s) and ω (rad/s) for measured speeds (rad/s) and angles (rad)."""
        angle = self.middle_angle(steering)
        linear = self._linear(traction, angle)
        return linear, math.tan(angle) * linear / self.wheelbase

    @abstractmethod
    def middle_angle(self, steering: Sequence[float]) -> float:
        """Return the angle of the virtual middle wheel for measured angles, rad."""

    @abstractmethod
    def _traction(self, speed: float, angle: float) -> tuple[float, ...]:
        """Return the speeds of the wheels for that of a wheel in the middle."""

    @abstractmethod
    def _steering(self, angle: float) -> tuple[float, ...]:
        """Return the angles of the steered wheels for that of a wheel in the middle."""

    @abstractmethod
    def _linear(self, traction: Sequence[float], angle: float) -> float:
        """Return the speed of the middle of the fixed axle, m/s."""


@dataclass(frozen=True, slots=True)
class BicycleKinematics(SteeringKinematics):
    """One traction wheel, one steered wheel."""

    def middle_angle(self, steering: Sequence[float]) -> float:
        """Return the angle of the steered wheel."""
        return steering[0]

    def _traction(self, speed: float, angle: float) -> tuple[float, ...]:
        return (speed,)

    def _steering(self, angle: float) -> tuple[float, ...]:
        return (angle,)

    def _linear(self, traction: Sequence[float], angle: float) -> float:
        return traction[0] * self.radius


@dataclass(frozen=True, slots=True)
class TricycleKinematics(BicycleKinematics):
    """Two traction wheels, ``traction_track`` (m) apart, and one steered wheel."""

    traction_track: float

    def _traction(self, speed: float, angle: float) -> tuple[float, ...]:
        if abs(angle) < _SMALL:
            return speed, speed
        difference = 0.5 * self.traction_track * math.tan(angle) / self.wheelbase
        return speed * (1.0 + difference), speed * (1.0 - difference)

    def _linear(self, traction: Sequence[float], angle: float) -> float:
        difference = 0.5 * self.traction_track * math.tan(angle) / self.wheelbase
        scales = (1.0 + difference, 1.0 - difference)
        speeds = [
            speed * self.radius / scale
            for speed, scale in zip(traction, scales, strict=True)
            if abs(scale) > _SMALL
        ]
        return sum(speeds) / len(speeds)


@dataclass(frozen=True, slots=True)
class AckermannKinematics(TricycleKinematics):
    """Two traction wheels, and two steered wheels, ``steering_track`` (m) apart."""

    steering_track: float

    def middle_angle(self, steering: Sequence[float]) -> float:
        """Return the mean of the two angles that the steered wheels would have in the middle."""
        right, left = (
            math.atan2(
                self.wheelbase * math.sin(angle),
                self.wheelbase * math.cos(angle)
                - side * 0.5 * self.steering_track * math.sin(angle),
            )
            for angle, side in zip(steering, (1.0, -1.0), strict=True)
        )
        return 0.5 * (right + left)

    def _steering(self, angle: float) -> tuple[float, ...]:
        ahead = 2.0 * self.wheelbase * math.sin(angle)
        aside = 2.0 * self.wheelbase * math.cos(angle)
        half = self.steering_track * math.sin(angle)
        return math.atan2(ahead, aside + half), math.atan2(ahead, aside - half)


def _speed_scale(error: float) -> float:
    """Return the factor on the speed while the steering angle is off by ``error`` (rad)."""
    if error < _FREE_ERROR:
        return 1.0
    return math.cos(min(error, _GREATEST_ERROR)) / math.cos(_FREE_ERROR)
