# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""The physics alone: what everything around it is measured against."""

from collections.abc import Callable
import time

import mujoco

from amr_description.model.frames import Transform
from amr_description.sim.engine import NANOSECONDS
from amr_description.sim.world import MujocoWorld

_SETTLING = 2 * NANOSECONDS
"""ns of simulated time from the drop to rest, and more."""


def bare_real_time_factor(
    urdf: str, seconds: float, steps: int = 5, clock: Callable[[], float] = time.perf_counter
) -> float:
    """
    Simulated over wall time of a loop of nothing but ``mj_step``.

    One robot at rest in the empty world, as after its drop. ``seconds``: how long to measure, s of
    wall time. ``steps``: physics steps in one call into C, as many as a control period has.
    """
    world = MujocoWorld('empty')
    world.spawn('robot', urdf, Transform((0.0, 0.0, 0.2)))
    world.step(_SETTLING // world.timestep)
    model, data = world.engine.model, world.engine.data
    calls = 0
    start = now = clock()
    while now - start < seconds:
        for _ in range(100):
            mujoco.mj_step(model, data, steps)
        calls += 100
        now = clock()
    return calls * steps * world.timestep / NANOSECONDS / (now - start)
