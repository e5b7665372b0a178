# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""The real-time factor: over a second of time that goes on, and not known before."""

import pytest

from amr_description.clock import NANOSECONDS
from amr_description.viewer.real_time import RealTimeFactor

PERIOD = 0.02  # s of wall-clock time between two messages of /clock


def go_on(factor, begin, seconds, speed, time=0.0):
    """Hear of a clock for some seconds, and return the values that were known meanwhile."""
    values = []
    for step in range(round(seconds / PERIOD) + 1):
        wall = begin + step * PERIOD
        factor.take(wall, round((time + step * PERIOD * speed) * NANOSECONDS))
        values.append(factor.value)
    return [value for value in values if value is not None]


@pytest.mark.parametrize('speed', [0.3, 1.0, 4.0])
def test_it_is_simulated_by_wall_clock_time(speed):
    values = go_on(RealTimeFactor(), 100.0, 3.0, speed)
    assert len(values) > 100
    assert values == pytest.approx([speed] * len(values))


def test_before_a_second_it_is_not_known():
    factor = RealTimeFactor()
    assert factor.value is None
    assert go_on(factor, 100.0, 0.8, 0.1) == []


def test_neither_a_pause_nor_what_follows_is_slow():
    factor = RealTimeFactor()
    go_on(factor, 100.0, 2.0, 1.0)
    go_on(factor, 102.0, 0.3, 0.0, 2.0)  # until it is one
    assert go_on(factor, 102.32, 5.0, 0.0, 2.0) == []
    values = go_on(factor, 107.34, 3.0, 1.0, 2.02)
    assert values == pytest.approx([1.0] * len(values))
    assert len(values) > 100


def test_a_time_that_comes_twice_is_no_pause():
    factor = RealTimeFactor()
    go_on(factor, 100.0, 2.0, 1.0)
    factor.take(102.01, 2 * NANOSECONDS)
    assert factor.value == pytest.approx(1.0)


def test_a_clock_that_was_silent_was_not_slow():
    factor = RealTimeFactor()
    go_on(factor, 100.0, 2.0, 1.0)
    values = go_on(factor, 105.0, 3.0, 1.0, 2.02)
    assert values == pytest.approx([1.0] * len(values))
    assert len(values) > 100


def test_time_that_jumps_back_begins_anew():
    factor = RealTimeFactor()
    go_on(factor, 100.0, 2.0, 1.0)
    factor.clear()
    factor.take(102.0, 0)
    assert factor.value is None
