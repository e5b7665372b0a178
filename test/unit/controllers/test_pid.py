# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""The PID controller against its closed forms, and its anti-windup strategies at the clamp."""

import math

from hypothesis import given, strategies as st
import pytest

from amr_description.controllers.pid import Pid, PidGains, STRATEGIES
from amr_description.errors import ControllerError

PERIOD = 0.01
NUMBERS = st.floats(-100.0, 100.0)


def run(pid, errors, rate=0.0):
    return [pid.compute(error, PERIOD, rate) for error in errors]


@given(NUMBERS, NUMBERS, NUMBERS, NUMBERS)
def test_proportional_and_derivative_parts_add_up(p, d, error, rate):
    assert Pid(PidGains(p=p, d=d)).compute(error, PERIOD, rate) == pytest.approx(
        p * error + d * rate
    )


def test_the_integral_of_a_constant_error_is_a_ramp_of_one_period_behind():
    commands = run(Pid(PidGains(i=2.0)), [3.0] * 5)
    assert commands == pytest.approx([2.0 * 3.0 * PERIOD * k for k in range(5)])


def test_legacy_integrates_before_the_output():
    commands = run(Pid(PidGains(i=2.0, strategy='legacy')), [3.0] * 5)
    assert commands == pytest.approx([2.0 * 3.0 * PERIOD * k for k in range(1, 6)])


def test_the_derivative_is_the_difference_where_none_is_measured():
    pid = Pid(PidGains(d=1.0))
    assert pid.compute(1.0, PERIOD) == pytest.approx(1.0 / PERIOD)
    assert pid.compute(1.5, PERIOD) == pytest.approx(0.5 / PERIOD)
    assert pid.error_rate == pytest.approx(0.5 / PERIOD)


@pytest.mark.parametrize('strategy', STRATEGIES)
@given(st.lists(NUMBERS, max_size=20))
def test_the_output_stays_within_its_clamp(strategy, errors):
    pid = Pid(PidGains(p=2.0, i=30.0, d=0.1, u_max=5.0, u_min=-1.0, strategy=strategy))
    assert all(-1.0 <= command <= 5.0 for command in run(pid, errors))


@pytest.mark.parametrize('strategy', STRATEGIES)
@given(st.lists(NUMBERS, max_size=20))
def test_the_integral_part_stays_within_its_clamp(strategy, errors):
    pid = Pid(PidGains(i=30.0, i_max=2.0, i_min=-1.0, strategy=strategy))
    assert all(-1.0 <= command <= 2.0 for command in run(pid, errors))


def test_legacy_winds_up_beyond_its_clamp_unless_it_is_told_not_to():
    limits = {'i': 1.0, 'i_max': 1.0, 'i_min': -1.0, 'strategy': 'legacy'}
    winding, clamped = Pid(PidGains(**limits)), Pid(PidGains(**limits, antiwindup=True))
    for pid in (winding, clamped):
        assert run(pid, [100.0] * 100)[-1] == 1.0
    assert winding.integral == pytest.approx(100.0)
    assert clamped.integral == pytest.approx(1.0)


def test_conditional_integration_stands_while_clamped_and_goes_on_when_the_error_turns():
    pid = Pid(PidGains(p=1.0, i=1.0, u_max=1.0, u_min=-1.0, strategy='conditional_integration'))
    run(pid, [10.0] * 100)
    assert pid.integral == 0.0
    run(pid, [-0.5] * 10)
    assert pid.integral == pytest.approx(-0.5 * 10 * PERIOD)


def test_back_calculation_settles_where_the_error_balances_the_excess():
    pid = Pid(PidGains(p=1.0, i=4.0, u_max=1.0, u_min=-1.0, strategy='back_calculation'))
    run(pid, [2.0] * 5000)
    # dI/dt = i·e + (u_clamped − (p·e + I)) / T = 0, T = p / i
    assert pid.integral == pytest.approx(4.0 * 2.0 * 0.25 + 1.0 - 2.0)


@pytest.mark.parametrize(
    ('gains', 'time'),
    [
        (PidGains(p=3.0, i=2.0), 1.5),
        (PidGains(p=3.0, i=2.0, d=8.0), 2.0),
        (PidGains(p=3.0, i=2.0, d=8.0, tracking_time_constant=0.3), 0.3),
        (PidGains(p=3.0), math.inf),
    ],
)
def test_the_tracking_time_constant_has_a_default(gains, time):
    assert gains.tracking_time() == pytest.approx(time)


def test_errors_within_the_deadband_are_not_integrated():
    pid = Pid(PidGains(p=1.0, i=100.0, error_deadband=0.1))
    assert run(pid, [0.1] * 10) == [0.1] * 10
    assert pid.integral == 0.0


def test_an_error_that_is_no_number_gives_no_command_and_leaves_no_trace():
    pid = Pid(PidGains(p=1.0, i=1.0))
    pid.compute(1.0, PERIOD, 0.0)
    before = pid.integral
    assert math.isnan(pid.compute(math.nan, PERIOD, 0.0))
    assert pid.integral == before
    assert math.isfinite(pid.compute(1.0, PERIOD, 0.0))


def test_no_time_changes_nothing():
    pid = Pid(PidGains(p=1.0, i=1.0))
    command = pid.compute(1.0, PERIOD, 0.0)
    assert pid.compute(7.0, 0.0, 0.0) == command


def test_new_gains_keep_the_integral_and_a_reset_forgets_it():
    pid = Pid(PidGains(i=1.0))
    run(pid, [1.0] * 10)
    pid.gains = PidGains(i=2.0)
    assert pid.integral == pytest.approx(0.1)
    pid.reset(keep_integral=True)
    assert pid.integral == pytest.approx(0.1)
    pid.reset()
    assert pid.integral == 0.0


@pytest.mark.parametrize(
    ('wrong', 'text'),
    [
        ({'strategy': 'hope'}, "Unknown antiwindup strategy : 'hope'"),
        ({'u_min': 1.0, 'u_max': 1.0}, r'u_min \(1\) must be less than u_max \(1\)'),
        ({'u_min': math.nan}, 'must be less than u_max'),
        ({'i_min': 1.0, 'i_max': 0.0}, r'i_min \(1\) must be less than i_max \(0\)'),
        ({'strategy': 'back_calculation', 'tracking_time_constant': -1.0}, 'not -1'),
    ],
)
def test_gains_that_contradict_each_other_are_refused(wrong, text):
    with pytest.raises(ControllerError, match=text):
        Pid(PidGains(**wrong))
