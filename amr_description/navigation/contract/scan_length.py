# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""How many ranges slam_toolbox expects of a scan."""

import math

import numpy as np

from amr_description.navigation.contract.observations import ScanGeometry

_NEARLY_A_TURN = 6.10865
"""rad, 350°: from here on a scan may have its first ray twice."""


def is_full_circle(geometry: ScanGeometry) -> bool:
    """
    Return whether slam_toolbox takes a scan for one of 360° whose last ray is not the first one.

    ``LaserAssistant::makeLaser`` in slam_toolbox's ``laser_utils.cpp``, with its float32.
    """
    span = np.abs(np.float32(geometry.angle_max) - np.float32(geometry.angle_min))
    increment = float(np.float32(geometry.angle_increment))
    rounding = float(np.finfo(np.float32).eps) * math.tau
    if not abs(float(span) - math.tau) < increment - rounding:
        return False
    is_double = _rounded(float(span / np.float32(increment))) + 1 == geometry.count
    return not (float(span) > _NEARLY_A_TURN and is_double)


def expected_length(geometry: ScanGeometry) -> int | None:
    """
    Return the number of ranges that Karto expects; it refuses every scan of another length.

    ``LaserRangeFinder::Update`` in Karto's ``Karto.h``. None: the increment is 0 or not finite.
    """
    angles = (geometry.angle_min, geometry.angle_max, geometry.angle_increment)
    lower, upper, increment = (float(np.float32(angle)) for angle in angles)
    if not (all(map(math.isfinite, (lower, upper, increment))) and increment):
        return None
    return _rounded((upper - lower) / increment) + (0 if is_full_circle(geometry) else 1)


def _rounded(value: float) -> int:
    """Round half away from zero, as C does."""
    return int(math.copysign(math.floor(abs(value) + 0.5), value))
