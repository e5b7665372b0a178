# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""The physics alone: what everything around it is measured against."""

from collections.abc import Callable
import time

import mujoco

from amr_description.clock import NANOSECONDS
from amr_description.model.frames import Transform
from amr_description.sim.world import MujocoWorld

_SETTLING = 2 * NANOSECONDS
"""ns of simulated time from the drop to rest, and more."""

_SPACING = 2.0
"""m, between the robots of a fleet."""


def fleet_pose(number: int) -> Transform:
    """A place for each of many robots, in rows of five, 2 m apart, a little above the ground."""
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
    Simulated over wall time of a loop of nothing but ``mj_step``.

    Robots at rest in the empty world, as after their drop. ``seconds``: how long to measure, s of
    wall time. ``steps``: physics steps in one call into C, as many as a control period has.
    """
    world = MujocoWorld('empty')
    for number in range(robots):
        world.spawn(f'robot_{number}', urdf, fleet_pose(number))
    world.step(_SETTLING // world.timestep)
    model, data = world.engine.model, world.engine.data
    calls = 0
    start = now = clock()
    # A clock is looked at after about the same work, however many robots there are.
    batch = max(1, 100 // robots)
    while now - start < seconds:
        for _ in range(batch):
            mujoco.mj_step(model, data, steps)
        calls += batch
        now = clock()
    return calls * steps * world.timestep / NANOSECONDS / (now - start)
