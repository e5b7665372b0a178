# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""How late commands and cycles are."""

import math

import pytest

from benchmarks.punctuality import latencies, percentile, punctuality, speed_of, Tick

MS = 1_000_000
RADIUS = 0.1


def ticks_of(count, period=MS, delay=lambda _: 0):
    return [Tick(7 * MS + i * period + delay(i), i * period, 0.0) for i in range(count)]


def test_percentile():
    values = [float(i) for i in range(1, 101)]
    assert percentile(values, 0.5) == 50.0
    assert percentile(values, 0.99) == 99.0
    assert percentile([3.0], 0.99) == 3.0


def test_a_command_is_found_in_the_first_cycle_that_has_it():
    sent = {0: 10 * MS, 1: 20 * MS}
    reached = [
        Tick(9 * MS, 0, math.nan),
        Tick(11 * MS, 1, 0.0),
        Tick(12 * MS, 2, speed_of(0) / RADIUS),
        Tick(22 * MS, 3, speed_of(0) / RADIUS),
        Tick(23 * MS, 4, speed_of(1) / RADIUS),
        Tick(24 * MS, 5, speed_of(1) / RADIUS),
    ]
    assert latencies(sent, reached) == [2.0, 3.0]


def test_a_command_that_a_later_one_has_overtaken_counts_with_that():
    sent = {0: 10 * MS, 1: 20 * MS, 2: 30 * MS}
    assert latencies(sent, [Tick(25 * MS, 0, speed_of(1) / RADIUS)]) == [15.0, 5.0]


def test_a_loop_that_keeps_time():
    assert punctuality(ticks_of(1000), MS) == (0, 0.0)


def test_a_late_cycle_is_not_a_missed_one():
    kept = punctuality(ticks_of(1000, delay=lambda i: 5 * MS if 500 <= i < 520 else 0), MS)
    assert kept == (0, 5.0)
    kept = punctuality(ticks_of(1000, delay=lambda i: 5 * MS if i == 500 else 0), MS)
    assert kept == (0, 0.0)


def test_time_that_is_given_up_is_missed():
    kept = punctuality(ticks_of(1000, delay=lambda i: 120 * MS if i >= 500 else 0), MS)
    assert kept.missed == 120


def test_cycles_that_are_left_out_are_missed():
    ticks = ticks_of(1000)
    assert punctuality(ticks[:500] + ticks[503:], MS).missed == 3


def test_a_start_that_was_late_does_not_hide_anything():
    kept = punctuality(ticks_of(1000, delay=lambda i: 0 if i == 100 else 2 * MS), MS)
    assert kept.late == pytest.approx(2.0)
