# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""The measure of the physics alone."""

from itertools import count

from fixtures.sim.driving import AMR
import pytest

from amr_description.sim.bare_loop import bare_real_time_factor


def test_counts_simulated_against_wall_time():
    # The clock says that 0.1 s went by at each look, that is after 100 calls of 5 steps of 2 ms.
    ticks = (0.1 * i for i in count())
    factor = bare_real_time_factor(AMR, seconds=1.0, steps=5, clock=lambda: next(ticks))
    assert factor == pytest.approx(100 * 5 * 0.002 / 0.1)


def test_a_fleet_is_slower_than_one_and_still_fast():
    one, ten = (bare_real_time_factor(AMR, seconds=0.1, robots=count) for count in (1, 10))
    assert one > ten > 2


def test_physics_is_far_from_being_the_bottleneck():
    assert bare_real_time_factor(AMR, seconds=0.05) > 10
