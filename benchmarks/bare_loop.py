# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""The physics alone: the reference for the speed of the stack."""

from collections.abc import Callable
import time

import mujoco

from amr_description.clock import NANOSECONDS
from amr_description.model.frames import Transform
from amr_description.sim.world import MujocoWorld

_SETTLING = 2 * NANOSECONDS
"""ns of simulated time: longer than from the drop to rest."""

_SPACING = 2.0
"""m, between the robots of a fleet."""


def fleet_pose(number: int) -> Transform:
    """Return the spawn pose of a robot of a fleet: in rows of five, 2 m apart, 0.2 m up."""
    row, column = divmod(number, 5)
    return Transform((_SPACING * column, _SPACING * row, 0.2))


def bare_real_time_factor(
    urdf: str,
    seconds: float,
    steps: int = 5,
    clock: Callable[[], float] = time.perf_counter,
    *,
    robots: int = 1,
) -> float:
    """
    Return simulated over wall time of a loop of ``mj_step`` alone, with robots at rest.

    Args:
        urdf: Of each robot.
        seconds: Wall time of the measurement.
        steps: Physics steps in one call into C, as many as a control period has.
        clock: Wall clock, s.
        robots: How many.
    """
    world = MujocoWorld('empty')
    for number in range(robots):
        world.spawn(f'robot_{number}', urdf, fleet_pose(number))
    world.step(_SETTLING // world.timestep)
    model, data = world.engine.model, world.engine.data
    calls = 0
    start = now = clock()
    # Fewer steps between two readings of the clock for more robots.
    batch = max(1, 100 // robots)
    while now - start < seconds:
        for _ in range(batch):
            mujoco.mj_step(model, data, steps)
        calls += batch
        now = clock()
    return calls * steps * world.timestep / NANOSECONDS / (now - start)
