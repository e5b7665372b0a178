# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""The rate limiter: its laws, and the rows of control_toolbox's own tests."""

import math
import random

from hypothesis import given, strategies as st
import pytest
from support.control_fakes import nan_for_none, VECTORS
from support.examples import examples

from amr_description.controllers.drives.rate_limiter import RateLimiter
from amr_description.errors import ParameterError

ROWS = VECTORS['rate_limiter']['rows']
CONSTRUCTED = VECTORS['rate_limiter_construct']
RAMP = VECTORS['speed_limiter_ramp']
ROUNDING = 1e-12


def random_limiter(dice):
    return RateLimiter(
        min_value=-dice.uniform(0.1, 2.0),
        max_value=dice.uniform(0.1, 2.0),
        max_acceleration_reverse=-dice.uniform(0.1, 5.0),
        max_acceleration=dice.uniform(0.1, 5.0),
        max_deceleration=-dice.uniform(0.1, 5.0),
        max_deceleration_reverse=dice.uniform(0.1, 5.0),
        min_jerk=-dice.uniform(1.0, 50.0),
        max_jerk=dice.uniform(1.0, 50.0),
    )


def commands(dice, count):
    """Steps, ramps and noise, beyond every limit."""
    value = 0.0
    for _ in range(count):
        value = dice.choice((value, dice.uniform(-5.0, 5.0), value + dice.gauss(0.0, 0.2), 0.0))
        yield value


# --- laws ----------------------------------------------------------------------------------------

nothing = st.just(math.nan)
limits = {
    'min_value': nothing | st.floats(-3.0, -0.05),
    'max_value': nothing | st.floats(0.05, 3.0),
    'max_acceleration_reverse': nothing | st.floats(-9.0, -0.05),
    'max_acceleration': nothing | st.floats(0.05, 9.0),
    'max_deceleration': nothing | st.floats(-9.0, -0.05),
    'max_deceleration_reverse': nothing | st.floats(0.05, 9.0),
    'min_jerk': nothing | st.floats(-90.0, -0.05),
    'max_jerk': nothing | st.floats(0.05, 90.0),
}
any_speed = st.floats(-1e6, 1e6) | st.floats(-4.0, 4.0)


def bounds_of_change(limiter, last):
    """m/s²: the least and the greatest that may follow a speed."""
    if math.isnan(limiter.max_acceleration):
        return -math.inf, math.inf
    low = limiter.max_deceleration if last > 0.0 else limiter.max_acceleration_reverse
    high = limiter.max_deceleration_reverse if last < 0.0 else limiter.max_acceleration
    return low, high


@examples(100)
@given(
    st.builds(RateLimiter, **limits),
    st.lists(st.tuples(any_speed, st.floats(1e-4, 1.0)), min_size=1, max_size=40),
)
def test_whatever_is_asked_at_whatever_intervals_the_output_is_within_bounds(limiter, asked):
    last = before = 0.0
    for value, dt in asked:
        limited = limiter.limit(value, last, before, dt)
        room = 1e-9 * (1.0 + abs(limited) + abs(last))
        if not math.isnan(limiter.max_value):
            assert limiter.min_value <= limited <= limiter.max_value
        low, high = bounds_of_change(limiter, last)
        assert low * dt - room <= limited - last <= high * dt + room
        change, change_before = limited - last, last - before
        is_gaining = (change - change_before) * change > room
        if not math.isnan(limiter.max_jerk) and is_gaining:
            gain = change - change_before
            assert limiter.min_jerk * dt**2 - room <= gain <= limiter.max_jerk * dt**2 + room
        last, before = limited, last


@pytest.mark.parametrize('seed', range(20))
def test_a_command_within_all_limits_is_left_alone(seed):
    dice = random.Random(seed)
    limiter, dt = random_limiter(dice), 0.01
    last, before = 0.0, 0.0
    for value in commands(dice, 200):
        limited = limiter.limit(value, last, before, dt)
        assert limiter.limit(limited, last, before, dt) == pytest.approx(limited, abs=ROUNDING)
        last, before = limited, last


def test_a_constant_command_is_reached_and_then_kept():
    limiter = RateLimiter(max_value=1.0, max_acceleration=2.0)
    value = 0.0
    for _ in range(100):
        value = limiter.limit(0.7, value, 0.0, 0.01)
    assert value == 0.7


def test_forward_and_reverse_mirror_each_other():
    dice = random.Random(0)
    limiter = RateLimiter(max_value=1.0, max_acceleration=2.0, max_deceleration=-3.0,
                          max_acceleration_reverse=-2.0, max_deceleration_reverse=3.0,
                          max_jerk=40.0)  # fmt: skip
    for _ in range(500):
        value, last, before = (dice.uniform(-2.0, 2.0) for _ in range(3))
        forward = limiter.limit(value, last, before, 0.01)
        assert limiter.limit(-value, -last, -before, 0.01) == -forward


def test_without_limits_everything_passes():
    dice = random.Random(0)
    for _ in range(100):
        value, last, before = (dice.uniform(-9.0, 9.0) for _ in range(3))
        assert RateLimiter().limit(value, last, before, 0.01) == value


# --- rows ----------------------------------------------------------------------------------------

CALLS = {
    'limit': lambda limiter, r: limiter.limit(r['v'], r['v0'], r['v1'], r['dt']),
    'limit_value': lambda limiter, r: limiter.limit_value(r['v']),
    'limit_first_derivative': lambda limiter, r: limiter.limit_acceleration(
        r['v'], r['v0'], r['dt']
    ),
    'limit_second_derivative': lambda limiter, r: limiter.limit_jerk(
        r['v'], r['v0'], r['v1'], r['dt']
    ),
}


@pytest.mark.parametrize('row', ROWS, ids=lambda row: f'{row["fn"]} {row["v"]} {row["v0"]}')
def test_rows_of_control_toolbox(row):
    limited = CALLS[row['fn']](RateLimiter(*nan_for_none(row['limiter'])), row)
    assert limited == pytest.approx(row['expect'], abs=1e-12)
    assert limited / row['v'] == pytest.approx(row['factor'], abs=1e-12)


def test_no_row_is_lost():
    assert (len(ROWS), len(CONSTRUCTED['accepted']), len(CONSTRUCTED['rejected'])) == (22, 11, 4)


@pytest.mark.parametrize('limits', CONSTRUCTED['accepted'], ids=str)
def test_accepted_limits(limits):
    RateLimiter(*nan_for_none(limits))


@pytest.mark.parametrize('limits', CONSTRUCTED['rejected'], ids=str)
def test_rejected_limits(limits):
    with pytest.raises(ParameterError, match='Invalid .* limits: the lower is .* above the'):
        RateLimiter(*nan_for_none(limits))


@pytest.mark.parametrize(
    ('limits', 'message'),
    [
        ({'min_value': 2.0, 'max_value': 1.0}, 'Invalid value limits'),
        ({'max_deceleration': 2.0, 'max_acceleration': 1.0}, 'Invalid first derivative limits'),
        ({'min_jerk': 2.0, 'max_jerk': 1.0}, 'Invalid second derivative limits'),
    ],
)
def test_the_message_names_the_kind(limits, message):
    with pytest.raises(ParameterError, match=message):
        RateLimiter(**limits)


def test_limits_may_meet():
    limiter = RateLimiter(0.5, 0.5, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0)
    assert limiter.limit(9.0, 0.5, 0.5, 0.01) == 0.5


def test_what_is_not_set_follows_from_what_is():
    limiter = RateLimiter(max_value=1.0, max_acceleration=2.0, max_jerk=3.0)
    assert (limiter.min_value, limiter.min_jerk) == (-1.0, -3.0)
    assert (limiter.max_acceleration_reverse, limiter.max_deceleration) == (-2.0, -2.0)
    assert limiter.max_deceleration_reverse == 2.0
    assert math.isnan(RateLimiter(max_value=1.0).max_acceleration)


def test_ramps_take_as_many_steps_as_upstream():
    limiter = RateLimiter(**RAMP['limits'])
    speed = 0.0
    for phase in RAMP['phases']:
        for step in range(1, phase['steps'] + 1):
            if step == phase['steps']:
                wheel = speed / RAMP['wheel_radius']
                assert wheel == pytest.approx(phase['wheel_one_step_before'], abs=1e-9)
            speed = limiter.limit(phase['target'], speed, speed, RAMP['dt'])
        wheel = speed / RAMP['wheel_radius']
        assert wheel == pytest.approx(phase['wheel_rad_s_at_last'], abs=1e-9)
