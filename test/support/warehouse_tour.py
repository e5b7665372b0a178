# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""A drive through the world `warehouse`, around shelves and through its door, in lock-step."""

from collections.abc import Iterator
from math import atan2, hypot, remainder, tau

from amr_description.simulation.readings import Motion
from amr_description.testing.simulation import Simulation

PIECE = 0.1
"""s between two commands."""
WAYPOINTS = ((2.6, 0.9), (2.9, -0.9), (-0.3, -1.0), (-3.2, 0.0), (-4.9, 0.0), (-5.0, 1.2),
             (-5.0, 0.0), (-3.4, 0.0), (-1.0, 1.0), (0.0, 0.0))  # fmt: skip
"""m, in the world."""
_REACHED = 0.15
_MOST_PIECES = 200
_SPEED, _TURN = 0.5, 1.0
"""m/s and rad/s."""
_SPEEDING_UP, _TURNING_UP = 0.08, 0.2
"""m/s and rad/s, from piece to piece."""


def tour(sim: Simulation, seconds: float = PIECE) -> Iterator[Motion]:
    """
    Drive from waypoint to waypoint; yield the truth after each of the pieces of the drive.

    Commands change no faster than a velocity smoother lets them: wheels that are commanded to
    another speed at once slip.
    """
    linear = angular = 0.0
    for x, y in WAYPOINTS:
        for _ in range(_MOST_PIECES):
            truth = sim.truth
            if hypot(x - truth.x, y - truth.y) < _REACHED:
                break
            yield truth
            off = remainder(atan2(y - truth.y, x - truth.x) - truth.yaw, tau)
            linear = _toward(linear, _SPEED if abs(off) < 0.5 else 0.0, _SPEEDING_UP)
            wanted = max(-_TURN, min(1.5 * off, _TURN))
            angular = _toward(angular, wanted, _TURNING_UP)
            sim.drive(linear, angular, seconds=seconds, stop=False)
        else:
            raise AssertionError(f'stuck at {truth.x:.2f} {truth.y:.2f}, on the way to {x} {y}')


def _toward(present: float, wanted: float, step: float) -> float:
    return present + max(-step, min(wanted - present, step))
