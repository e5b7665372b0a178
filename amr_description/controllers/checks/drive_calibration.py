# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
The multipliers of a differential drive, from runs whose true motion is known.

Odometry computes, from the wheels' angles times ``wheel_radius`` (l and r, m)::

    distance = (m_l l + m_r r) / 2        turn = (m_r r - m_l l) / (m_s separation)

with the multipliers m_l, m_r (radii) and m_s (separation). Wheels roll on straight runs and scrub
in turns, so each kind of run determines only some of them. With the true distance d and turn t of
a run, and the effective separation s = m_s separation:

- straight runs: m_l l = d - s t / 2 and m_r r = d + s t / 2, least squares in m of travel;
- turns: (m_r r - m_l l) / s = t, least squares in rad.

The three are solved together: the turn t of a straight run depends on the radii and on s.
"""

from collections.abc import Iterable, Sequence
from dataclasses import dataclass
import math
from operator import mul

from amr_description.errors import CalibrationError

_SMALL_TURN = 1e-6
"""rad: below it an arc is a line."""


@dataclass(frozen=True, slots=True)
class Geometry:
    """A differential drive, by the parameters of diff_drive_controller."""

    separation: float
    """m, wheel_separation."""
    separation_multiplier: float = 1.0
    left_multiplier: float = 1.0
    """left_wheel_radius_multiplier."""
    right_multiplier: float = 1.0
    """right_wheel_radius_multiplier."""

    @property
    def effective_separation(self) -> float:
        """m."""
        return self.separation * self.separation_multiplier


@dataclass(frozen=True, slots=True)
class Travel:
    """The motion of the point midway between the wheels along its path."""

    distance: float
    """m, negative backwards."""
    turn: float
    """rad, counter-clockwise, not wrapped."""


@dataclass(frozen=True, slots=True)
class CalibrationRun:
    """One drive from rest to rest."""

    name: str
    left: float
    """m: angle of the left wheels (rad) times wheel_radius."""
    right: float
    """m, likewise."""
    truth: Travel

    @classmethod
    def from_odometry(
        cls, name: str, odometry: Travel, truth: Travel, used: Geometry
    ) -> 'CalibrationRun':
        """
        Compute the wheels' angles from odometry.

        Args:
            name: of the run.
            odometry: what the controller has computed.
            truth: the true motion.
            used: the parameters of the controller.
        """
        half = odometry.turn * used.effective_separation / 2.0
        return cls(
            name,
            left=(odometry.distance - half) / used.left_multiplier,
            right=(odometry.distance + half) / used.right_multiplier,
            truth=truth,
        )

    def odometry(self, geometry: Geometry) -> Travel:
        """Return what odometry computes with other parameters."""
        left = geometry.left_multiplier * self.left
        right = geometry.right_multiplier * self.right
        return Travel((left + right) / 2.0, (right - left) / geometry.effective_separation)


class Path:
    """Adds up poses (x, y in m, heading in rad) to the :class:`Travel` between them."""

    def __init__(self, x: float, y: float, heading: float) -> None:
        self._pose = x, y, heading
        self.distance = self.turn = 0.0

    def add(self, x: float, y: float, heading: float) -> None:
        """
        Add a pose, reached along an arc of less than half a turn.

        The length of the arc is chord * (turn / 2) / sin(turn / 2), exact for any arc.
        """
        x0, y0, heading0 = self._pose
        turn = math.remainder(heading - heading0, 2.0 * math.pi)
        middle = heading0 + turn / 2.0
        chord = (x - x0) * math.cos(middle) + (y - y0) * math.sin(middle)
        half = turn / 2.0
        self.distance += chord if abs(turn) < _SMALL_TURN else chord * half / math.sin(half)
        self.turn += turn
        self._pose = x, y, heading

    @property
    def travel(self) -> Travel:
        """The motion from the first pose to the last."""
        return Travel(self.distance, self.turn)


def fit(
    straight: Sequence[CalibrationRun], turning: Sequence[CalibrationRun], separation: float
) -> Geometry:
    """
    Fit the three multipliers.

    Args:
        straight: straight runs.
        turning: turns in place.
        separation: ``wheel_separation``, m.

    Raises:
        CalibrationError: the runs do not determine them.
    """
    # m_l = left - s left_drift and m_r = right + s right_drift.
    left, left_drift = _side('left', [run.left for run in straight], straight)
    right, right_drift = _side('right', [run.right for run in straight], straight)
    rolled = [right * run.right - left * run.left for run in turning]
    turned = [run.truth.turn - right_drift * run.right - left_drift * run.left for run in turning]
    if not _sum_of_products(rolled, turned):
        raise CalibrationError(f'the robot did not turn in any of {len(turning)} turns')
    effective = _sum_of_products(rolled, rolled) / _sum_of_products(rolled, turned)
    geometry = Geometry(
        separation,
        separation_multiplier=effective / separation,
        left_multiplier=left - effective * left_drift,
        right_multiplier=right + effective * right_drift,
    )
    _check(geometry)
    return geometry


def yaw_error(run: CalibrationRun, geometry: Geometry) -> float:
    """Return |turn by odometry / true turn - 1|; NaN for a run that does not turn."""
    if abs(run.truth.turn) < math.radians(30.0):
        return math.nan
    return abs(run.odometry(geometry).turn / run.truth.turn - 1.0)


def _side(
    name: str, travel: Sequence[float], runs: Sequence[CalibrationRun]
) -> tuple[float, float]:
    """Fit the true distance, and half the true turn, to the travel of a side (least squares)."""
    square = _sum_of_products(travel, travel)
    if not square:
        raise CalibrationError(f'the wheels on the {name} did not turn in any straight run')
    distance = _sum_of_products(travel, [run.truth.distance for run in runs])
    half_turn = _sum_of_products(travel, [run.truth.turn / 2.0 for run in runs])
    return distance / square, half_turn / square


def _sum_of_products(one: Iterable[float], other: Iterable[float]) -> float:
    return math.fsum(map(mul, one, other))


def _check(geometry: Geometry) -> None:
    found = {
        'wheel_separation_multiplier': geometry.separation_multiplier,
        'left_wheel_radius_multiplier': geometry.left_multiplier,
        'right_wheel_radius_multiplier': geometry.right_multiplier,
    }
    for name, value in found.items():
        if not value > 0.0:
            raise CalibrationError(
                f'the fit gives {name} = {value:.4g}: the robot goes against its wheels; are the '
                'axes of their joints, and left and right, as they should be (check_urdf)?'
            )
