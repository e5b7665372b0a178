# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""Control period → physics step."""

import pytest

from amr_description.errors import SimulationError
from amr_description.sim.engine import physics_stepping, Stepping, steps_in

MS = 1_000_000


@pytest.mark.parametrize(
    'period, step, count',
    [
        (10 * MS, 2 * MS, 5),  # 100 Hz
        (20 * MS, 2 * MS, 10),  # 50 Hz
        (2 * MS, 2 * MS, 1),  # 500 Hz
        (1 * MS, 1 * MS, 1),  # 1 kHz
        (4 * MS, 2 * MS, 2),  # 250 Hz
        (5 * MS, 1_250_000, 4),  # 200 Hz: a third of it would be no integer
        (12_500_000, 1_562_500, 8),  # 80 Hz
        (6_666_667, 952_381, 7),  # 150 Hz
        (7_142_857, 1_785_714, 4),  # 140 Hz: no divisor, the period becomes 7142856 ns
        (1000 * MS, 2 * MS, 500),
    ],
)
def test_table(period, step, count):
    assert physics_stepping(period) == Stepping(step, count)


@pytest.mark.parametrize('rate', [1, 3, 7, 30, 60, 99, 100, 150, 333, 400, 512, 600, 1000, 1024])
def test_laws(rate):
    period = round(1e9 / rate)
    stepping = physics_stepping(period)
    assert 0 < stepping.step <= 2 * MS
    assert stepping.period == stepping.step * stepping.count
    assert abs(stepping.period - period) < stepping.count
    # As few steps as the longest allows, or twice that where it gives a true divisor.
    assert stepping.count * MS <= max(period, MS) + 2 * MS


@pytest.mark.parametrize('period', [10 * MS, 5 * MS, 12_500_000, 7_812_500, 6_666_667])
def test_no_larger_divisor_is_passed_over(period):
    step = physics_stepping(period).step
    larger = [d for d in range(step + 1, 2 * MS + 1) if period % d == 0]
    assert not larger


@pytest.mark.parametrize('period', [0, -5])
def test_period_must_be_positive(period):
    with pytest.raises(SimulationError, match=f'control period of {period} ns.*positive'):
        physics_stepping(period)


@pytest.mark.parametrize(
    'period, count', [(10 * MS, 5), (9 * MS, 4), (1, 1), (6_666_667, 3), (33_333_333, 17)]
)
def test_second_manager_is_fitted_to_the_step_there_is(period, count):
    assert steps_in(period, 2 * MS) == Stepping(2 * MS, count)
