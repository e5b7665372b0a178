# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""The rate at which messages arrive."""

import pytest

from amr_description.cli.meters import RateMeter

MS = 1_000_000  # ns


def fed(meter, times):
    for time in times:
        meter.add(time * MS)
    return meter


def test_a_steady_rate_is_found():
    meter = fed(RateMeter(100), range(0, 500, 100))
    assert meter.report() is None
    rate = fed(meter, range(500, 1501, 100)).report()
    assert (rate.window, rate.rate) == (15, pytest.approx(10.0))
    assert str(rate) == (
        'average rate: 10.000\n\tmin: 0.100s max: 0.100s std dev: 0.00000s window: 15'
    )


def test_the_deviation_is_that_of_the_population():
    meter = RateMeter(100)
    fed(meter, [0, 100]).report()
    rate = fed(meter, [400, 500, 800, 1200]).report()
    assert rate.shortest == pytest.approx(0.1)
    assert rate.longest == pytest.approx(0.4)
    mean = 1.2 / 5
    squares = [(x - mean) ** 2 for x in (0.1, 0.3, 0.1, 0.3, 0.4)]
    assert rate.deviation == pytest.approx((sum(squares) / 5) ** 0.5)


def test_silence_is_not_reported_again():
    meter = RateMeter(100)
    fed(meter, [0, 100]).report()
    assert fed(meter, [1200]).report() is not None
    assert meter.report() is None


def test_the_window_forgets_what_is_old():
    meter = RateMeter(2)
    fed(meter, [0, 1000]).report()
    rate = fed(meter, [1100, 2200, 2300]).report()
    assert rate.window == 2
    assert rate.shortest == pytest.approx(0.1)


def test_time_that_goes_back_starts_all_over():
    meter = fed(RateMeter(10), [5000, 5100])
    assert meter.add(0) is False
    assert meter.report() is None
    assert meter.add(100 * MS) is True
