# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""The filter: against closed forms, a scalar filter by hand, and differences of its own model."""

from dataclasses import replace
import math

import numpy as np
import pytest

from amr_description.clock import NANOSECONDS
from amr_description.navigation.ekf import (
    ControlInput,
    ControlLimits,
    Ekf,
    Measurement,
    NO_THRESHOLD,
    Outcome,
    PROCESS_NOISE,
    STATE_SIZE,
    StateMember,
    transfer_jacobian,
    transfer_matrix,
    Tuning,
)


def measured(time, values, variances, threshold=NO_THRESHOLD, source='test'):
    """``values``, ``variances``: by member; ``time``: s."""
    full, covariance = np.zeros(STATE_SIZE), np.zeros((STATE_SIZE, STATE_SIZE))
    used = np.zeros(STATE_SIZE, dtype=bool)
    for member, value in values.items():
        full[member], covariance[member, member], used[member] = value, variances[member], True
    return Measurement(source, round(time * NANOSECONDS), full, covariance, used, threshold)


def at_rest(**state):
    """Return an initialised filter at time 0 with a state, by member, and P = 0."""
    each = Ekf()
    each.is_initialized = True
    each.covariance = np.zeros((STATE_SIZE, STATE_SIZE))
    for name, value in state.items():
        each.state[StateMember[name.upper()]] = value
    return each


def seconds(time):
    return round(time * NANOSECONDS)


def moved_by_matrices(state, dt):
    """Return f(x), with rotations by Rodrigues' formula, as an independent model."""

    def turned(axis, angle):
        cross = np.cross(np.eye(3)[axis], np.eye(3)).T
        return np.eye(3) + math.sin(angle) * cross + (1 - math.cos(angle)) * cross @ cross

    roll, pitch, yaw = state[3:6]
    rotation = turned(2, yaw) @ turned(1, pitch) @ turned(0, roll)
    # ω = (ṙ, 0, 0) + Rxᵀ (0, ṗ, 0) + Rxᵀ Ryᵀ (0, 0, ẏ): solved for the rates of the angles.
    columns = [
        np.eye(3)[0],
        turned(0, roll).T @ np.eye(3)[1],
        turned(0, roll).T @ turned(1, pitch).T @ np.eye(3)[2],
    ]
    rates = np.linalg.solve(np.array(columns).T, state[9:12])
    result = state.copy()
    result[:3] += rotation @ (state[6:9] * dt + state[12:15] * dt * dt / 2)
    result[3:6] += rates * dt
    result[6:9] += state[12:15] * dt
    return result


@pytest.fixture(params=range(5))
def state(request):
    return np.random.default_rng(request.param).uniform(-1.2, 1.2, STATE_SIZE)


def test_model_is_that_of_rigid_motion(state):
    assert transfer_matrix(state, 0.1) @ state == pytest.approx(moved_by_matrices(state, 0.1))


def test_jacobian_is_the_derivative_of_the_model(state):
    step = 1e-6
    columns = [
        (moved_by_matrices(state + step * unit, 0.1) - moved_by_matrices(state - step * unit, 0.1))
        / (2 * step)
        for unit in np.eye(STATE_SIZE)
    ]
    assert transfer_jacobian(state, 0.1) == pytest.approx(np.array(columns).T, abs=1e-8)


def test_constant_velocity_goes_straight():
    each = at_rest(vx=0.5, yaw=math.radians(30))
    for step in range(1, 101):
        each.predict(seconds(step * 0.02))
    assert each.state[:2] == pytest.approx((math.cos(math.pi / 6), 0.5))


def test_constant_turn_goes_round_and_the_yaw_stays_within_a_turn():
    each = at_rest(vx=1.0, vyaw=1.0)
    steps = 10_000
    for step in range(1, steps + 1):
        each.predict(seconds(step * 4.0 / steps))
    # Euler's steps: each is along the heading at its begin, by half of 0.4 ms · 1 rad/s too late.
    circle = (math.sin(4.0), 1.0 - math.cos(4.0))
    assert each.state[:2] == pytest.approx(circle, abs=4.0 * 0.5 * 4.0 / steps)
    assert each.state[StateMember.YAW] == pytest.approx(4.0 - 2 * math.pi)


def test_acceleration_is_integrated_twice():
    each = at_rest(ax=2.0)
    each.predict(seconds(3.0))
    assert each.state[[StateMember.X, StateMember.VX]] == pytest.approx((9.0, 6.0))


def test_covariance_grows_by_the_process_noise():
    each = at_rest()
    each.predict(seconds(0.1))
    assert np.diagonal(each.covariance) == pytest.approx(0.1 * np.array(PROCESS_NOISE))
    each.predict(seconds(0.2))
    # Of x: P + 2 dt P_xv + dt² P_vv + dt⁴/4 P_aa + dt Q; after the first step only P_vv, P_aa.
    expected = 0.1 * 0.05 + 0.1**2 * 0.1 * 0.025 + 0.1**4 / 4 * 0.1 * 0.01 + 0.1 * 0.05
    assert each.covariance[0, 0] == pytest.approx(expected)


def test_dynamic_process_noise_follows_the_speed():
    each = Ekf(replace(Tuning.default(), dynamic_process_noise=True))
    each.is_initialized = True
    each.covariance[:] = 0.0
    each.predict(seconds(1.0))
    assert each.covariance[0, 0] == each.covariance[5, 5] == 0.0
    assert each.covariance[6, 6] == pytest.approx(0.025 + 0.01 * 0.0)
    each = Ekf(replace(Tuning.default(), dynamic_process_noise=True))
    each.is_initialized = True
    each.covariance[:] = 0.0
    each.state[[StateMember.VX, StateMember.VYAW]] = (3.0, 4.0)
    each.predict(seconds(1.0))
    # 5² of the velocities; at a yaw of 0 the covariance of y has that of v · dt · 0 only.
    assert each.covariance[0, 0] == pytest.approx(25.0 * 0.05)


def test_one_measurement_is_weighed_as_a_scalar_filter_does():
    each = at_rest(vx=1.0)
    each.covariance[StateMember.VX, StateMember.VX] = 0.3
    each.covariance[StateMember.X, StateMember.X] = 0.2
    each.covariance[StateMember.X, StateMember.VX] = each.covariance[
        StateMember.VX, StateMember.X
    ] = 0.1
    outcome = each.correct(measured(0.0, {StateMember.VX: 2.0}, {StateMember.VX: 0.6}))
    assert outcome is Outcome.FUSED
    gain = 0.3 / (0.3 + 0.6)
    assert each.state[StateMember.VX] == pytest.approx(1.0 + gain)
    assert each.covariance[StateMember.VX, StateMember.VX] == pytest.approx((1 - gain) * 0.3)
    # What is correlated with it is corrected, too.
    assert each.state[StateMember.X] == pytest.approx(0.1 / 0.9)
    assert each.covariance[StateMember.X, StateMember.X] == pytest.approx(0.2 - 0.1**2 / 0.9)


def test_many_measurements_weigh_as_their_inverse_variances():
    each = at_rest()
    each.covariance[StateMember.YAW, StateMember.YAW] = 1e6
    readings = [(0.3, 0.01), (0.5, 0.04), (0.1, 0.02)]
    for value, variance in readings:
        each.correct(measured(0.0, {StateMember.YAW: value}, {StateMember.YAW: variance}))
    weights = [1 / variance for _, variance in readings]
    mean = sum(w * value for w, (value, _) in zip(weights, readings, strict=True)) / sum(weights)
    assert each.state[StateMember.YAW] == pytest.approx(mean, rel=1e-6)
    assert each.covariance[StateMember.YAW, StateMember.YAW] == pytest.approx(
        1 / sum(weights), rel=1e-6
    )


def test_a_yaw_on_the_other_side_of_the_back_is_near():
    each = at_rest(yaw=3.1)
    each.covariance[StateMember.YAW, StateMember.YAW] = 0.1
    each.correct(measured(0.0, {StateMember.YAW: -3.1}, {StateMember.YAW: 0.1}))
    # Half of the way between 3.1 and 2π - 3.1, which is π.
    assert abs(each.state[StateMember.YAW]) == pytest.approx(math.pi)


def test_what_is_too_far_is_rejected():
    for value, outcome in ((2.99, Outcome.FUSED), (3.01, Outcome.REJECTED)):
        each = at_rest()
        each.covariance[StateMember.VX, StateMember.VX] = 0.75
        # The innovation has the variance 0.75 + 0.25, so that the distance is the value.
        reading = measured(0.0, {StateMember.VX: value}, {StateMember.VX: 0.25}, threshold=3.0)
        assert each.correct(reading) is outcome
        assert bool(each.state[StateMember.VX]) is (outcome is Outcome.FUSED)


def test_the_first_measurement_is_taken_as_it_is():
    each = Ekf()
    each.process(
        measured(
            7.0,
            {StateMember.X: 3.0, StateMember.VX: 2.0},
            {StateMember.X: 0.4, StateMember.VX: 0.1},
        )
    )
    assert each.time == seconds(7.0)
    assert (each.state[StateMember.X], each.state[StateMember.VX]) == (3.0, 2.0)
    assert each.covariance[StateMember.X, StateMember.X] == 0.4
    assert each.covariance[StateMember.YAW, StateMember.YAW] == 1e-9


def test_a_late_measurement_corrects_without_a_prediction():
    each = at_rest(vx=1.0)
    each.covariance[StateMember.VX, StateMember.VX] = 1.0
    each.predict(seconds(1.0))
    x, variance = each.state[StateMember.X], each.covariance[StateMember.VX, StateMember.VX]
    each.process(measured(0.5, {StateMember.VX: 1.0}, {StateMember.VX: 1.0}))
    assert each.time == seconds(1.0)
    assert each.state[StateMember.X] == x
    assert each.covariance[StateMember.VX, StateMember.VX] == pytest.approx(
        variance / (variance + 1.0)
    )


@pytest.mark.parametrize('bad', [math.nan, math.inf])
def test_what_is_no_number_is_left_out(bad):
    each = at_rest()
    each.covariance = np.eye(STATE_SIZE)
    values = {StateMember.X: bad, StateMember.Y: 2.0}
    reading = measured(0.0, values, {StateMember.X: 1.0, StateMember.Y: 1.0})
    assert each.correct(reading) is Outcome.FUSED
    assert (each.state[StateMember.X], each.state[StateMember.Y]) == pytest.approx((0.0, 1.0))
    reading = measured(0.0, {StateMember.X: 1.0}, {StateMember.X: bad})
    assert each.correct(reading) is Outcome.UNUSABLE
    assert np.isfinite(each.state).all()


def test_variances_of_zero_and_below_are_mended():
    for variance, expected in ((-0.5, 0.5), (0.0, 1e-9)):
        each = at_rest()
        each.covariance[StateMember.X, StateMember.X] = 1.0
        each.correct(measured(0.0, {StateMember.X: 1.0}, {StateMember.X: variance}))
        assert each.state[StateMember.X] == pytest.approx(1.0 / (1.0 + expected), abs=1e-12)


def limits(**changed):
    six = {
        'acceleration_limits': (1.3,) * 6,
        'acceleration_gains': (0.8,) * 6,
        'deceleration_limits': (1.1,) * 6,
        'deceleration_gains': (0.5,) * 6,
    }
    used = (True, False, False, False, False, True)
    return ControlLimits(used, seconds(0.2), **(six | changed))


@pytest.mark.parametrize(
    ('velocity', 'wanted', 'acceleration'),
    [
        (0.0, 1.0, 0.8),  # gain
        (0.0, 5.0, 1.3),  # limit
        (1.0, 0.4, -0.3),  # deceleration gain
        (4.0, 0.5, -1.1),  # deceleration limit
        (1.0, -1.0, -1.0),  # to the other side: first as a braking
    ],
)
def test_a_command_accelerates_as_its_gains_and_limits_say(velocity, wanted, acceleration):
    each = Ekf(replace(Tuning.default(), control=limits()))
    each.state[StateMember.VX] = velocity
    each.control = ControlInput(np.array([wanted, 0, 0, 0, 0, 0.1]), 0)
    each.predict(seconds(0.1))
    assert each.state[StateMember.AX] == pytest.approx(acceleration)
    assert each.state[StateMember.VX] == pytest.approx(velocity + 0.1 * acceleration)
    assert each.state[StateMember.VYAW] == pytest.approx(0.1 * 0.8 * 0.1)


def test_an_old_command_is_one_to_rest():
    each = Ekf(replace(Tuning.default(), control=limits()))
    each.state[StateMember.VX] = 1.0
    each.control = ControlInput(np.ones(6), 0)
    each.predict(seconds(0.2))
    assert each.state[StateMember.AX] == pytest.approx(-0.5)


def test_reset_begins_as_tuned():
    tuning = replace(
        Tuning.default(),
        initial_state=np.arange(15.0) / 10.0,
        initial_covariance=np.eye(15) * 0.5,
    )
    each = Ekf(tuning)
    each.process(measured(1.0, {StateMember.X: 1.0}, {StateMember.X: 1.0}))
    each.predict(seconds(2.0))
    each.reset()
    assert not each.is_initialized
    assert each.state == pytest.approx(np.arange(15.0) / 10.0)
    assert each.covariance == pytest.approx(np.eye(15) * 0.5)
