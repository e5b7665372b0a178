# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""Instants of a rate, and which messages are stale after time jumped back."""

import pytest

from amr_description.clock import instants_until, TimeJumpFilter

MILLISECOND = 1_000_000


@pytest.mark.parametrize(
    'stamps',
    [
        [220, 0, 10, 20],  # one of before is still on its way
        [210, 220, 0, 10],
        [0, 10, 20],
        [30, 40],  # the clock is a little behind
    ],
)
def test_only_what_was_sent_before_time_went_back_is_left_out(stamps):
    clock = TimeJumpFilter()
    assert not clock.observe(220 * MILLISECOND)
    assert not clock.is_stale(220 * MILLISECOND)
    assert clock.observe(0)
    kept = [stamp for stamp in stamps if not clock.is_stale(stamp * MILLISECOND)]
    assert kept == [stamp for stamp in stamps if stamp < 200]


def test_the_time_that_begins_anew_may_reach_that_of_before():
    clock = TimeJumpFilter()
    clock.observe(220 * MILLISECOND)
    clock.observe(0)
    for now in range(0, 400, 10):
        assert not clock.observe(now * MILLISECOND)
        assert not clock.is_stale((now + 10) * MILLISECOND)


def test_a_publisher_that_stays_ahead_is_accepted_again():
    """Its clock is another one: what is on its way is not as old as that, nor as new."""
    for stamp in (2000, 7000):
        clock = TimeJumpFilter()
        clock.observe(5000 * MILLISECOND)
        clock.observe(0)
        assert not clock.is_stale(stamp * MILLISECOND)


def test_one_that_was_sent_since_does_not_hide_another_of_before():
    clock = TimeJumpFilter()
    clock.observe(5000 * MILLISECOND)
    clock.observe(0)
    for stamp, is_of_before in ((4990, True), (10, False), (5000, True), (5200, False)):
        assert clock.is_stale(stamp * MILLISECOND) is is_of_before


def test_after_a_second_nothing_is_on_its_way_any_more():
    clock = TimeJumpFilter()
    clock.observe(5000 * MILLISECOND)
    clock.observe(0)
    assert clock.is_recent
    clock.observe(1001 * MILLISECOND)
    assert not clock.is_recent
    assert not clock.is_stale(5000 * MILLISECOND)


@pytest.mark.parametrize(
    ('rate', 'expected'), [(10.0, [100, 200, 300]), (15.0, [67, 134, 200, 267]), (0.0, [])]
)
def test_an_instant_counts_from_itself_on(rate, expected):
    counts = [instants_until(time * MILLISECOND, rate) for time in range(310)]
    steps = [time for time in range(1, 310) if counts[time] != counts[time - 1]]
    assert (steps, counts[0], counts[-1]) == (expected, 0, len(expected))
