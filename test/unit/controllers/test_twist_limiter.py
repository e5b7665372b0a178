# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""The limits of a twist: each component within its own, and along the arc if possible."""

import math

from hypothesis import assume, given, strategies as st
import pytest
from support.examples import examples

from amr_description.controllers.drives.rate_limiter import RateLimiter, TwistLimiter

law = examples(50)
speeds = st.floats(-3.0, 3.0).filter(lambda value: value == 0.0 or abs(value) > 1e-3)
twists = st.tuples(speeds, speeds)
dts = st.sampled_from((0.001, 0.01, 0.1))
maxima = st.just(math.nan) | st.floats(0.1, 5.0)
limiters = st.builds(
    RateLimiter,
    min_value=st.just(math.nan) | st.floats(-2.0, -0.1),
    max_value=maxima,
    max_acceleration=maxima,
    max_deceleration=st.just(math.nan) | st.floats(-5.0, -0.1),
    max_jerk=st.just(math.nan) | st.floats(1.0, 50.0),
)
without_jerk = st.builds(RateLimiter, max_value=maxima, max_acceleration=maxima)


def pairs(values):
    return zip(values, values[1:], strict=False)


@law
@given(limiters, limiters, st.lists(twists, min_size=1, max_size=30), dts, st.booleans())
def test_neither_component_ever_exceeds_its_limits(linear, angular, commands, dt, keeps):
    """Limiting the output again changes nothing."""
    limiter = TwistLimiter(linear, angular, keeps_curvature=keeps)
    history = [(0.0, 0.0), (0.0, 0.0)]
    for command in commands:
        history.append(limiter.limit(command, dt))
        for axis, each in enumerate((linear, angular)):
            before, last, limited = (twist[axis] for twist in history[-3:])
            assert each.limit(limited, last, before, dt) == pytest.approx(limited, abs=1e-9)


@law
@given(limiters, limiters, st.lists(twists, min_size=1, max_size=30), dts)
def test_without_being_asked_each_component_is_limited_by_itself(linear, angular, commands, dt):
    limiter = TwistLimiter(linear, angular)
    history = [(0.0, 0.0), (0.0, 0.0)]
    for command in commands:
        (before_v, before_w), (last_v, last_w) = history[-2:]
        history.append(limiter.limit(command, dt))
        assert history[-1] == (
            linear.limit(command[0], last_v, before_v, dt),
            angular.limit(command[1], last_w, before_w, dt),
        )


@law
@given(without_jerk, without_jerk, twists, dts)
def test_from_rest_it_speeds_up_along_the_arc(linear, angular, command, dt):
    """
    With a limit of jerk not always: a component that still speeds up when the other has reached
    its greatest speed cannot stop doing so at once, and a limit goes before the arc.
    """
    limiter = TwistLimiter(linear, angular, keeps_curvature=True)
    for _ in range(200):
        v, w = limiter.limit(command, dt)
        assert v * command[1] == pytest.approx(w * command[0], abs=1e-9)


@law
@given(limiters, limiters, twists, dts)
def test_from_rest_it_speeds_up_until_it_drives_what_it_can(linear, angular, command, dt):
    assume(command != (0.0, 0.0))
    limiter = TwistLimiter(linear, angular, keeps_curvature=True)
    driven = [(0.0, 0.0)] + [limiter.limit(command, dt) for _ in range(200)]
    for (last_v, last_w), (v, w) in pairs(driven):
        assert abs(v) >= abs(last_v) - 1e-9
        assert abs(w) >= abs(last_w) - 1e-9
        assert math.hypot(v, w) <= math.hypot(*command) + 1e-9


@law
@given(without_jerk, without_jerk, twists, dts, st.just(0.0) | st.floats(0.01, 0.99))
def test_it_slows_down_and_brakes_along_the_arc(linear, angular, command, dt, share):
    limiter = TwistLimiter(linear, angular, keeps_curvature=True)
    for _ in range(50):
        first = limiter.limit(command, dt)
    last = first
    for _ in range(100):
        v, w = limiter.limit((share * first[0], share * first[1]), dt)
        assert v * first[1] == pytest.approx(w * first[0], abs=1e-9)
        assert abs(v) <= abs(last[0]) + 1e-9
        assert abs(w) <= abs(last[1]) + 1e-9
        last = v, w


@law
@given(limiters, limiters, twists, twists, dts)
def test_no_component_is_driven_faster_than_it_was_or_is_told(linear, angular, first, then, dt):
    """Whatever the arc may ask for; a jerk limit may carry one on for a moment."""
    assume(math.isnan(linear.max_jerk) and math.isnan(angular.max_jerk))
    limiter = TwistLimiter(linear, angular, keeps_curvature=True)
    last = limiter.limit(first, dt)
    for _ in range(30):
        found = limiter.limit(then, dt)
        for now, before, command in zip(found, last, then, strict=True):
            assert abs(now) <= max(abs(before), abs(command)) + 1e-9
        last = found


@law
@given(st.floats(0.1, 2.0), st.floats(0.1, 2.0), st.lists(twists, min_size=1, max_size=10))
def test_with_limits_of_speed_alone_every_command_keeps_its_curvature(linear, angular, commands):
    limiter = TwistLimiter(
        RateLimiter(max_value=linear), RateLimiter(max_value=angular), keeps_curvature=True
    )
    for command in commands:
        v, w = limiter.limit(command, 0.01)
        assert v * command[1] == pytest.approx(w * command[0], abs=1e-9)
        is_within = abs(command[0]) <= linear and abs(command[1]) <= angular
        assert ((v, w) == command) == is_within


def test_the_numbers():
    """1 m/s² and 1 rad/s² from rest to an arc of radius 2 m; rest comes along the same arc."""
    each = RateLimiter(max_acceleration=1.0)
    limiter = TwistLimiter(each, each, keeps_curvature=True)
    found = [limiter.limit(twist, 0.1) for twist in ((1.0, 0.5), (1.0, 0.5), (0.0, 0.0))]
    assert found == [pytest.approx(twist) for twist in ((0.1, 0.05), (0.2, 0.1), (0.1, 0.05))]
    limiter.forget()
    assert limiter.limit((1.0, 0.5), 0.1) == found[0]


def test_on_to_another_arc_each_component_goes_as_fast_as_it_may():
    """While driving straight on no factor makes a turn in place."""
    limiter = TwistLimiter(RateLimiter(max_acceleration=1.0), RateLimiter(), keeps_curvature=True)
    for _ in range(10):
        limiter.limit((1.0, 0.0), 0.1)
    assert limiter.limit((0.0, 1.0), 0.1) == pytest.approx((0.9, 1.0))


@pytest.mark.parametrize(
    ('then', 'found'),
    [
        ((-0.01, 0.5), (1.9, 0.0)),  # first to rest: until then no reverse arc is driven
        ((0.01, 0.5), (1.9, 0.5)),  # and no turn is made for an arc that is 190 times as wide
        ((1.0, 0.5), (1.9, 0.5)),
    ],
)
def test_while_it_brakes_from_straight_on(then, found):
    limiter = TwistLimiter(RateLimiter(max_acceleration=1.0), RateLimiter(), keeps_curvature=True)
    for _ in range(30):
        limiter.limit((2.0, 0.0), 0.1)
    assert limiter.limit(then, 0.1) == pytest.approx(found)
