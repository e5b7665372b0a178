# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""What an inertial measurement unit on a simulated robot measures."""

import math

from fixtures.sim.arm import ARM, arm
from fixtures.sim.driving import AMR, Drive
import pytest

from amr_description.errors import SimulationError
from amr_description.model.frames import rotate, Transform
from amr_description.sim.world import MujocoWorld

GRAVITY = 9.81
HERE = Transform()


def close(expected, tolerance):
    return pytest.approx(expected, abs=tolerance)


def test_at_rest_it_measures_gravity_upwards():
    reading = Drive().robot.imu('base_link', HERE)
    assert reading.orientation == close((0, 0, 0, 1), 1e-6)
    assert reading.angular_velocity == close((0, 0, 0), 1e-6)
    assert reading.linear_acceleration == close((0, 0, GRAVITY), 1e-5)


def test_at_rest_before_the_first_step():
    robot = MujocoWorld('empty').spawn('amr', AMR)
    assert robot.imu('base_link', HERE).linear_acceleration == close((0, 0, GRAVITY), 1e-9)


def test_in_free_fall_it_measures_nothing():
    world = MujocoWorld('empty')
    robot = world.spawn('amr', AMR, Transform((0.0, 0.0, 5.0)))
    world.step(100)
    assert robot.imu('base_link', HERE).linear_acceleration == close((0, 0, 0), 1e-9)


@pytest.mark.parametrize('rpy', [(0.5, 0.0, 0.0), (0.0, -0.4, 1.0), (math.pi, 0.0, 0.0)])
@pytest.mark.parametrize('link', ['world', 'base'])
def test_orientation_turns_gravity_into_the_axes_of_the_unit(link, rpy):
    world = MujocoWorld('empty')
    tilt = Transform.from_xyz_rpy((0.0, 0.0, 3.0), rpy)
    robot = world.spawn('arm', ARM, tilt)
    place = Transform.from_xyz_rpy((0.1, 0.2, 0.3), (0.3, 0.2, 0.1))
    reading = robot.imu(link, place)
    assert reading.orientation == close((tilt @ place).rotation, 1e-9)
    up = rotate(reading.orientation, reading.linear_acceleration)
    assert up == close((0, 0, GRAVITY), 1e-9)


def test_turning_unit_measures_rate_and_centripetal_acceleration():
    world, robot = arm()
    spindle = robot.joints(['spindle'])
    spindle.command('effort', [0.2])
    world.step(1000)
    rate, change, radius = 4.0, 2.0, 0.3
    middle = robot.imu('flywheel', HERE)
    assert middle.angular_velocity == close((0, 0, rate), 1e-9)
    assert middle.linear_acceleration == close((0, 0, GRAVITY), 1e-9)
    # On the rim, at r along x: -ω² r inwards, α r along the path.
    rim = robot.imu('flywheel', Transform((radius, 0.0, 0.0)))
    expected = (-(rate**2) * radius, change * radius, GRAVITY)
    assert rim.linear_acceleration == close(expected, 1e-6)


def test_acceleration_is_the_derivative_of_the_velocity():
    drive = Drive()
    drive.command(0.5, 0.0)
    for _ in range(50):
        (before, *_), _ = drive.robot.velocity('base_link')
        drive.world.step(1)
        (after, *_), _ = drive.robot.velocity('base_link')
        measured = drive.robot.imu('base_link', HERE).linear_acceleration[0]
        # Gravity has a share of it while the robot pitches.
        assert measured == close((after - before) / 0.002, 0.05)


def test_reading_does_not_change_the_future():
    def run(look):
        drive = Drive()
        drive.command(0.3, 1.0)
        for _ in range(100):
            drive.world.step(1)
            if look:
                drive.robot.imu('base_link', HERE)
        return drive.wheels.positions(), drive.robot.imu('base_link', HERE)

    assert run(look=True) == run(look=False)


def test_an_unknown_link_is_reported_with_the_known_ones():
    _, robot = arm()
    with pytest.raises(SimulationError, match="there is no link 'imu_link'.*base, upper"):
        robot.imu('imu_link', HERE)
