# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""What was when, in a recording."""

import math

import numpy as np
import pytest

from amr_description.viewer.tracks import Changes, NOTHING, thinned, Times, Track

S = 10**9


@pytest.fixture
def track():
    track = Track(2)
    track.add(10, (1.0, 2.0))
    track.add(20, (3.0, 4.0))
    return track


@pytest.mark.parametrize(
    ('time', 'row'),
    [(9, None), (10, [1.0, 2.0]), (19, [1.0, 2.0]), (20, [3.0, 4.0]), (99, [3, 4])],
)
def test_a_track_has_the_last_row_at_a_time_or_before(track, time, row):
    found = track.at(time)
    assert (None if found is None else [*found]) == row


def test_what_was_latched_was_so_before_it_came(track):
    assert [*track.at(0, or_first=True)] == [1.0, 2.0]
    assert Track(2).at(0, or_first=True) is None


def test_a_row_counts_for_so_long(track):
    assert track.at(25, within=5) is not None
    assert track.at(26, within=5) is None


def test_what_is_too_large_for_a_float_is_infinite_and_moves_no_other_row(track):
    track.add(30, (1.0, 1e300))
    track.add(40, (5.0, 6.0))
    assert [*track.at(30)] == [1.0, math.inf]
    assert [*track.at(40)] == [5.0, 6.0]


def test_changes_leave_out_what_is_the_same():
    changes = Changes()
    for time, value in [(10, 'a'), (20, 'a'), (30, 'b')]:
        changes.add(time, value)
    assert len(changes) == 2
    assert [changes.at(time) for time in (0, 29, 30)] == ['a', 'a', 'b']
    assert Changes().at(0) is None


def test_a_rate_is_that_of_the_last_seconds():
    times = Times()
    for tenth in range(100):
        times.add(tenth * S // 10)
    assert times.index(-1) == NOTHING
    assert times.rate(NOTHING, S) is None
    assert times.rate(0, S) is None
    assert times.rate(99, 3 * S) == pytest.approx(10.0)


def test_thinned_values_keep_each_peak():
    stamps, values = np.arange(10_000.0), np.zeros(10_000)
    values[[1234, 8765]] = 5.0, -7.0
    values[2000:3000] = math.nan
    times, numbers = thinned(stamps, values, 1000)
    assert len(numbers) <= 1000
    assert np.all(np.diff(times) > 0)
    assert {(1234.0, 5.0), (8765.0, -7.0)} <= set(zip(times, numbers, strict=True))
    assert np.isnan(numbers[(times > 2010) & (times < 2990)]).all()


def test_few_values_stay_as_they_are():
    stamps, values = np.arange(5.0), np.array([1.0, math.nan, 3.0, 4.0, 5.0])
    times, numbers = thinned(stamps, values, 5)
    assert times is stamps
    assert numbers is values
