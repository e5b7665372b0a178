# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""Which wheels a description says to have rollers, and how these point."""

import math

from fixtures.sim.mecanum import mecanum
import pytest

from amr_description.model.gazebo.physics import gazebo_physics_of
from amr_description.model.wheels import described_rollers, roller_angle, Rollers
from amr_description.sim.spawning import read_description

EIGHTH = math.pi / 4
WHEEL = 'front_left_wheel'
ODE = '<collision><surface><friction><ode>{}</ode></friction></surface></collision>'


def described(urdf):
    robot = read_description(urdf, 'robot')
    return described_rollers(robot, gazebo_physics_of(robot))


def rollers_of(saying):
    block = '<gazebo reference="{name}_wheel" xmlns:ignition="http://i">' + saying + '</gazebo>'
    return described(mecanum(block))


@pytest.mark.parametrize(
    'saying',
    [
        '<mu1>1.0</mu1><mu2>0.0</mu2><fdir1>1 -1 0</fdir1>',
        '<mu>1.0</mu><mu2>0.05</mu2><fdir1>1 -1 0</fdir1>',
        '<mu1 value="1.0"/><mu2 value="0"/><fdir1 value="1 -1 0"/>',
        ODE.format(
            '<mu>1</mu><mu2>0</mu2><fdir1 ignition:expressed_in="base_link">1 -1 0</fdir1>'
        ),
        '<mu1>0</mu1><mu2>1</mu2><fdir1>1 1 0</fdir1>',
    ],
)
def test_friction_in_one_direction_is_that_of_rollers(saying):
    [found] = {rollers_of(saying)[WHEEL]}
    assert math.remainder(found.angle + EIGHTH, math.pi) == pytest.approx(0.0)
    assert found.grip == 1.0
    assert found.free <= 0.05


@pytest.mark.parametrize(
    'saying',
    [
        '<mu1>1.0</mu1><mu2>0.9</mu2><fdir1>1 0 0</fdir1>',
        '<mu1>1.0</mu1><mu2>0.0</mu2>',
        '<mu1>0.0</mu1><mu2>0.0</mu2><fdir1>1 0 0</fdir1>',
        '<mu1>1.0</mu1><mu2>0.0</mu2><fdir1>0 0 1</fdir1>',
        '<mu1>1.0</mu1><mu2>0.0</mu2><fdir1>1 0</fdir1>',
        '<mu1>one</mu1><mu2>0.0</mu2><fdir1>1 0 0</fdir1>',
        '<mu1>-1</mu1><mu2>0.0</mu2><fdir1>1 0 0</fdir1>',
        '<fdir1>1 0 0</fdir1>',
    ],
)
def test_anything_else_is_not(saying):
    assert rollers_of(saying) == {}


def test_each_wheel_has_its_own():
    found = described(mecanum())
    angles = {link: rollers.angle for link, rollers in found.items()}
    assert angles == {
        'front_left_wheel': pytest.approx(-EIGHTH),
        'front_right_wheel': pytest.approx(EIGHTH),
        'rear_right_wheel': pytest.approx(-EIGHTH),
        'rear_left_wheel': pytest.approx(EIGHTH),
    }
    assert found['front_left_wheel'] == Rollers(pytest.approx(-EIGHTH), 1.0, 0.0)


def test_links_that_are_no_wheels_have_none():
    urdf = mecanum('').replace(
        '<ros2_control',
        '<gazebo reference="base_link"><mu1>1</mu1><mu2>0</mu2><fdir1>1 0 0</fdir1></gazebo>'
        '<gazebo><mu1>1</mu1><mu2>0</mu2><fdir1>1 0 0</fdir1></gazebo><ros2_control',
    )
    assert described(urdf) == {}


@pytest.mark.parametrize(('side', 'sign'), [(1.0, 1.0), (-1.0, -1.0)])
def test_the_angle_is_from_where_the_wheel_rolls_to_its_axle(side, sign):
    """A wheel whose axle points to the right rolls backwards."""
    axle = (0.0, side, 0.0)
    assert roller_angle(axle, (sign, 0.0, 0.0)) == pytest.approx(0.0)
    assert roller_angle(axle, axle) == pytest.approx(math.pi / 2)
    assert roller_angle((0.0, 0.0, 1.0), (1.0, 0.0, 0.0)) is None
    assert roller_angle(axle, (0.0, 0.0, 2.0)) is None
