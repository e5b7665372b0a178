# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""When sensors measure, and that their noise follows from time."""

import numpy as np
import pytest

from amr_description.sim.sensor_schedule import CycleBudget, noise_generator, SensorSchedule

MS = 1_000_000


def due(schedule, times):
    return [time for time in times if schedule.is_due(time)]


@pytest.mark.parametrize(
    ('rate', 'expected'),
    [(10.0, [100, 200, 300]), (15.0, [70, 140, 200, 270]), (0.0, [*range(10, 310, 10)])],
)
def test_the_first_tick_at_or_after(rate, expected):
    ticks = range(0, 310 * MS, 10 * MS)
    assert due(SensorSchedule(rate, 0), ticks) == [each * MS for each in expected]


def test_not_while_time_stands_still():
    schedule = SensorSchedule(10.0, 0)
    assert due(schedule, [100 * MS] * 3) == [100 * MS]


def test_at_once_after_a_reset():
    schedule = SensorSchedule(10.0, 0)
    assert due(schedule, [50 * MS, 0, 10 * MS]) == [0]


def test_at_time_0_although_time_was_0_before():
    schedule = SensorSchedule(10.0, 0)
    schedule.restart()
    assert due(schedule, [0, 10 * MS]) == [0]
    schedule.restart()
    assert due(schedule, [0, 50 * MS, 100 * MS]) == [0, 100 * MS]


def test_one_that_is_spawned_later_keeps_to_the_grid():
    schedule = SensorSchedule(10.0, 3217 * MS)
    assert due(schedule, [3220 * MS, 3290 * MS, 3300 * MS]) == [3300 * MS]


def test_noise_follows_from_seed_sensor_and_time():
    def drawn(*key):
        return noise_generator(*key).normal(size=3).tolist()

    assert drawn((0, 97), 'lidar', 5) == drawn((0, 97), 'lidar', 5)
    others = [((1, 97), 'lidar', 5), ((0, 97), 'lidar_2', 5), ((0, 97), 'lidar', 6)]
    assert all(drawn(*key) != drawn((0, 97), 'lidar', 5) for key in others)
    assert noise_generator((0,), 'a', -1).normal() != noise_generator((0,), 'a', 1).normal()


def test_noise_is_normal():
    values = [noise_generator((0, 97), 'lidar', time).normal() for time in range(2000)]
    assert abs(np.mean(values)) < 0.1
    assert np.std(values) == pytest.approx(1.0, abs=0.1)


def test_a_budget_is_that_of_each_cycle():
    budget = CycleBudget(1000)
    assert [budget.take(0, 400) for _ in range(3)] == [True, True, False]
    assert budget.take(0, 200)
    assert [budget.take(10 * MS, amount) for amount in (1001, 1000, 1)] == [False, True, False]
