# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""Measurements in the order of their stamps, late ones, timeouts."""

import numpy as np
import pytest

from amr_description.clock import NANOSECONDS
from amr_description.navigation.ekf import Measurement, Outcome, STATE_SIZE, StateMember, Tuning
from amr_description.navigation.ekf_estimator import Estimator, Timing

TIMEOUT = 100_000_000
DRIVE = [
    (0.00, StateMember.VX, 0.5), (0.02, StateMember.VYAW, 0.3), (0.04, StateMember.VX, 0.6),
    (0.05, StateMember.YAW, 0.01), (0.06, StateMember.VYAW, 0.2), (0.08, StateMember.VX, 0.5),
]  # fmt: skip


def ns(seconds):
    return round(seconds * NANOSECONDS)


def measurement(seconds, member, value, variance=0.01):
    values, used = np.zeros(STATE_SIZE), np.zeros(STATE_SIZE, dtype=bool)
    values[member], used[member] = value, True
    covariance = np.diag(np.where(used, variance, 0.0))
    return Measurement(member.name, ns(seconds), values, covariance, used)


def estimator(history=None, always=False, report=lambda *_: None):
    timing = Timing(TIMEOUT, always, None if history is None else ns(history))
    return Estimator(Tuning.default(), timing, report)


def in_order():
    each = estimator()
    for row in DRIVE:
        each.add(measurement(*row))
    each.integrate(ns(0.08))
    return each


def test_the_order_of_arrival_does_not_count():
    shuffled = estimator()
    for row in reversed(DRIVE):
        shuffled.add(measurement(*row))
    shuffled.integrate(ns(0.08))
    assert np.array_equal(shuffled.filter.state, in_order().filter.state)
    assert np.array_equal(shuffled.filter.covariance, in_order().filter.covariance)


def test_what_is_of_the_future_waits():
    outcomes = []
    each = estimator(report=lambda reading, outcome: outcomes.append((reading.time, outcome)))
    for row in DRIVE:
        each.add(measurement(*row))
    each.integrate(ns(0.045))
    assert [time for time, _ in outcomes] == [0, ns(0.02), ns(0.04)]
    assert each.filter.time == ns(0.04)
    each.integrate(ns(0.08))
    assert np.array_equal(each.filter.state, in_order().filter.state)
    assert {outcome for _, outcome in outcomes} == {Outcome.FUSED}


def late(history):
    """Return an estimator that gets the third of the measurements after all others."""
    each = estimator(history)
    for row in DRIVE[:2] + DRIVE[3:]:
        each.add(measurement(*row))
        each.integrate(ns(row[0]))
    each.add(measurement(*DRIVE[2]))
    each.integrate(ns(0.08))
    return each


def test_with_a_history_a_late_measurement_is_as_if_it_had_come_in_time():
    smoothed = late(history=1.0)
    assert smoothed.filter.state == pytest.approx(in_order().filter.state, abs=1e-15)
    assert smoothed.filter.covariance == pytest.approx(in_order().filter.covariance, abs=1e-15)
    # The test would see it if it were not: without a history the state differs.
    assert abs(late(None).filter.state - in_order().filter.state).max() > 1e-6


def test_beyond_its_history_it_goes_back_to_the_oldest_state():
    short = late(history=0.025)
    # States of 0.06 and 0.08 are kept: the late one is taken first from there on.
    expected = estimator()
    for row in DRIVE[:2] + DRIVE[3:5]:
        expected.add(measurement(*row))
        expected.integrate(ns(row[0]))
    expected.filter.process(measurement(*DRIVE[2]))
    expected.filter.process(measurement(*DRIVE[4]))
    expected.filter.process(measurement(*DRIVE[5]))
    assert short.filter.state == pytest.approx(expected.filter.state, abs=1e-12)


def test_without_measurements_it_predicts_after_the_timeout():
    each = in_order()
    x = each.filter.state[StateMember.X]
    each.integrate(ns(0.08) + TIMEOUT - 1)
    assert each.filter.time == ns(0.08)
    each.integrate(ns(0.08) + TIMEOUT)
    assert each.filter.time == ns(0.08) + TIMEOUT
    speed = each.filter.state[StateMember.VX]
    assert each.filter.state[StateMember.X] == pytest.approx(x + 0.1 * speed, rel=1e-3)


def test_it_predicts_to_the_present_if_that_is_asked():
    each = estimator(always=True)
    each.add(measurement(0.0, StateMember.VX, 1.0))
    each.integrate(ns(0.05))
    assert each.filter.time == ns(0.05)
    assert each.filter.state[StateMember.X] == pytest.approx(0.05)


def test_nothing_is_predicted_before_the_first_measurement_or_back_in_time():
    each = estimator(always=True)
    each.integrate(ns(1.0))
    assert (each.filter.time, each.filter.is_initialized) == (0, False)
    each.add(measurement(1.0, StateMember.VX, 1.0))
    each.integrate(ns(1.0))
    each.integrate(ns(0.5))
    assert each.filter.time == ns(1.0)


def test_the_angular_acceleration_is_the_change_of_the_rate():
    each = estimator()
    for time, rate in ((0.0, 0.0), (0.1, 0.2)):
        each.add(measurement(time, StateMember.VYAW, rate, variance=1e-9))
        each.integrate(ns(time))
    assert each.angular_acceleration[2] == pytest.approx(2.0, rel=1e-3)
    variance = each.filter.covariance[StateMember.VYAW, StateMember.VYAW]
    assert each.angular_covariance[2, 2] == pytest.approx(2 * variance / 0.1**2)


def test_a_set_state_forgets_what_was_before():
    each = late(history=1.0)
    each.add(measurement(0.07, StateMember.VX, 9.0))
    state = np.zeros(STATE_SIZE)
    state[StateMember.X] = 4.0
    each.set_state(state, np.eye(STATE_SIZE) * 1e-6, ns(0.09))
    each.integrate(ns(0.09))
    assert np.array_equal(each.filter.state, state)


def test_reset_is_as_new():
    each = in_order()
    each.reset()
    for row in DRIVE:
        each.add(measurement(*row))
    each.integrate(ns(0.08))
    assert np.array_equal(each.filter.state, in_order().filter.state)
