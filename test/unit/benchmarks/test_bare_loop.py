# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""The measure of the physics alone."""

from itertools import count
import time

from fixtures.sim.driving import AMR
import pytest

from amr_description.sim.world import MujocoWorld
from benchmarks.bare_loop import bare_real_time_factor, fleet_pose


def test_counts_simulated_against_wall_time():
    # The clock says that 0.1 s went by at each look, that is after 100 calls of 5 steps of 2 ms.
    ticks = (0.1 * i for i in count())
    factor = bare_real_time_factor(AMR, seconds=1.0, steps=5, clock=lambda: next(ticks))
    assert factor == pytest.approx(100 * 5 * 0.002 / 0.1)


def test_with_many_robots_the_clock_is_looked_at_more_often():
    ticks = (0.1 * i for i in count())
    factor = bare_real_time_factor(AMR, 0.5, steps=5, clock=lambda: next(ticks), robots=10)
    assert factor == pytest.approx(10 * 5 * 0.002 / 0.1)


def test_a_fleet_has_room():
    world = MujocoWorld('empty')
    for number in range(20):
        world.spawn(f'robot_{number}', AMR, fleet_pose(number))
    assert len(world.names) == 20


def test_physics_is_far_from_being_the_bottleneck():
    # By the processor time, which others on the machine do not take.
    assert bare_real_time_factor(AMR, seconds=0.05, clock=time.thread_time) > 10
