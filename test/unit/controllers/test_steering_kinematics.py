# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""The kinematics of steered vehicles, against their closed forms in both directions."""

import math

from hypothesis import assume, given, strategies as st
import pytest
from support.examples import examples

from amr_description.controllers.drives.steering_kinematics import (
    AckermannKinematics,
    BicycleKinematics,
    TricycleKinematics,
)

sizes = st.floats(0.1, 3.0)
speeds = st.floats(-3.0, 3.0).filter(lambda value: abs(value) > 0.01)
turns = st.floats(-2.0, 2.0)


@st.composite
def vehicles(draw):
    base, radius, track, other = (draw(sizes) for _ in range(4))
    return draw(
        st.sampled_from(
            [
                BicycleKinematics(base, radius),
                TricycleKinematics(base, radius, track),
                AckermannKinematics(base, radius, track, other),
            ]
        )
    )


@examples(150)
@given(vehicles(), speeds, turns)
def test_the_twist_of_its_commands_is_the_twist(vehicle, linear, angular):
    commands = vehicle.commands(linear, angular, None)
    found = vehicle.twist(commands.traction, commands.steering)
    assert found == pytest.approx((linear, angular), rel=1e-6, abs=1e-6)


@examples(150)
@given(sizes, sizes, sizes, sizes, speeds, turns)
def test_all_axles_meet_in_one_point(base, radius, track, steering_track, linear, angular):
    assume(abs(angular) > 0.01)
    vehicle = AckermannKinematics(base, radius, track, steering_track)
    commands = vehicle.commands(linear, angular, None)
    centre = linear / angular
    for angle, y in zip(commands.steering, (-steering_track / 2, steering_track / 2), strict=True):
        # The axle of a wheel at (base, y) goes through (0, centre).
        across = -math.sin(angle) * (0.0 - base) + math.cos(angle) * (centre - y)
        along = math.cos(angle) * (0.0 - base) + math.sin(angle) * (centre - y)
        assert along == pytest.approx(0.0, abs=1e-6 * max(1.0, abs(across)))
    for speed, y in zip(commands.traction, (-track / 2, track / 2), strict=True):
        assert speed * radius == pytest.approx(angular * (centre - y), abs=1e-6)


def test_wheels_on_a_known_circle():
    """Wheelbase 1 m, tracks 1 m, radius of the circle 1 m to the left at 1 m/s."""
    car = AckermannKinematics(1.0, 0.1, 1.0, 1.0)
    commands = car.commands(1.0, 1.0, None)
    assert commands.traction == pytest.approx((15.0, 5.0))
    assert commands.steering == pytest.approx((math.atan(1 / 1.5), math.atan(1 / 0.5)))
    assert car.middle_angle(commands.steering) == pytest.approx(math.pi / 4)


def test_the_speed_of_the_driven_wheels_follows_the_measured_angle():
    tricycle = TricycleKinematics(1.0, 0.1, 1.0)
    commands = tricycle.commands(1.0, 1.0, 0.0)
    assert commands.traction == pytest.approx((10.0, 10.0))
    assert commands.steering == pytest.approx((math.pi / 4,))


def test_a_vehicle_that_stands_steers_straight_and_one_that_only_turns_across():
    bicycle = BicycleKinematics(1.0, 0.1)
    assert bicycle.commands(0.0, 0.0, None).steering == (0.0,)
    for angular in (1.0, -1.0):
        commands = bicycle.commands(0.0, angular, None)
        assert commands.steering == (math.copysign(math.pi / 2, angular),)
        assert commands.traction == (0.0,)


def test_in_reverse_the_angle_changes_its_sign():
    bicycle = BicycleKinematics(1.0, 0.1)
    assert bicycle.commands(-1.0, 1.0, None).steering == pytest.approx((-math.pi / 4,))


@pytest.mark.parametrize(
    ('error', 'factor'),
    [(0.5, 1.0), (math.pi / 3, 0.5 / math.cos(math.pi / 6)), (1.57, 0.0115)],
)
def test_it_drives_slowly_until_the_steering_angle_is_reached(error, factor):
    bicycle = BicycleKinematics(1.0, 0.1)
    [speed] = bicycle.commands(1.0, 0.0, error, reduces_speed=True).traction
    assert speed == pytest.approx(10.0 * factor, rel=0.01)
    assert bicycle.commands(1.0, 0.0, error).traction == (10.0,)


def test_a_wheel_that_is_turned_about_says_nothing_about_the_speed():
    """The centre is at the left wheel, 0.5 m from the middle."""
    tricycle = TricycleKinematics(1.0, 0.1, 1.0)
    linear, angular = tricycle.twist((20.0, 0.0), (math.atan(2.0),))
    assert (linear, angular) == pytest.approx((1.0, 2.0))
