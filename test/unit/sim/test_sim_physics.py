# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
The shipped robot in the empty world, against what a real one would do.

The limits are those that a user is promised; the comment at each says what was measured.
"""

import math
from statistics import pstdev

from fixtures.sim.driving import AMR, Drive, SEPARATION, WHEEL_RADIUS
import pytest

from amr_description.clock import NANOSECONDS
from amr_description.model.frames import Transform
from amr_description.sim.world import MujocoWorld
from amr_description.sim.world_file import WorldSettings

GRAVITY = 9.81


def at_rest(robot):
    """Slower than 1 mm/s and 0.01 rad/s."""
    linear, angular = robot.velocity('base_footprint')
    return math.hypot(*linear) < 1e-3 and math.hypot(*angular) < 1e-2


@pytest.fixture
def dropped():
    """A robot that fell from 0.2 m, one second later."""
    world = MujocoWorld('empty')
    robot = world.spawn('amr', AMR, Transform((0.0, 0.0, 0.2)))
    world.step(500)
    return world, robot


def test_free_fall_is_that_of_a_point():
    world = MujocoWorld('empty')
    robot = world.spawn('amr', AMR, Transform((0.0, 0.0, 5.0)))
    world.step(250)
    # Semi-implicit Euler: z = z0 - g h² n (n + 1) / 2, exactly.
    fallen = GRAVITY * 0.002**2 * 250 * 251 / 2
    assert robot.pose('base_footprint').translation == pytest.approx((0, 0, 5 - fallen), abs=1e-9)
    assert robot.velocity('base_footprint')[0] == pytest.approx((0, 0, -GRAVITY * 0.5), abs=1e-9)


def test_drop_comes_to_rest_within_a_second(dropped):
    world, robot = dropped
    assert world.time == NANOSECONDS
    # Measured: at rest after 0.49 s.
    assert at_rest(robot)
    # Measured: 1e-9 mm off; a wheel that sinks or floats falsifies the wheel radius.
    assert robot.pose('base_footprint').translation[2] == pytest.approx(0.0, abs=5e-5)


def test_rest_does_not_drift_for_a_minute(dropped):
    world, robot = dropped
    before = robot.pose('base_footprint')
    world.step(30_000)
    after = robot.pose('base_footprint')
    # Measured: 1e-9 mm.
    assert math.dist(before.translation, after.translation) < 1e-4
    assert after.rotation == pytest.approx(before.rotation, abs=1e-6)


def test_forward_is_plus_x_and_rolls_without_slip():
    drive = Drive()
    drive.run(0.5, 0.0, 2.0)
    drive.run(0.0, 0.0, 0.5)
    x, y, z = drive.position
    # Measured: 1.0000 of the command and of the odometry.
    assert x == pytest.approx(1.0, rel=0.01)
    assert x == pytest.approx(drive.odometry.x, rel=0.001)
    assert y == pytest.approx(0.0, abs=1e-5)
    assert z == pytest.approx(0.0, abs=1e-4)


@pytest.mark.parametrize('direction', [1, -1])
def test_full_turn_agrees_with_odometry_and_command(direction):
    drive = Drive()
    drive.run(0.0, direction * 1.0, 2 * math.pi)
    drive.run(0.0, 0.0, 0.5)
    # Measured: 1.013 of the odometry, 1.013 of the command.
    assert drive.yaw == pytest.approx(drive.odometry.heading, rel=0.03)
    assert drive.yaw == pytest.approx(direction * 2 * math.pi, rel=0.03)
    # It turns on the spot; measured: 0.00 mm.
    assert math.hypot(*drive.position[:2]) < 0.001


def test_arc_agrees_with_odometry_and_command():
    drive = Drive()
    drive.run(0.5, 1.0, 2 * math.pi)
    drive.run(0.0, 0.0, 0.5)
    x, y, _ = drive.position
    path = 0.5 * 2 * math.pi
    # Measured: 1.003 of the odometry, 1.002 of the command; 0.7 % of the path between the two.
    assert drive.yaw == pytest.approx(drive.odometry.heading, rel=0.05)
    assert drive.yaw == pytest.approx(2 * math.pi, rel=0.05)
    assert math.hypot(x - drive.odometry.x, y - drive.odometry.y) < 0.05 * path


@pytest.mark.parametrize('friction', [0.3, 0.6, 1.0])
def test_skid_steer_turns_by_coulombs_ratio(friction):
    # Four wheels at (±a, ±b) with dry friction turn by b² / (a² + b²) of what their speeds say.
    a, b = 0.2, 0.15
    drive = Drive(settings=WorldSettings(friction=friction))
    drive.run(0.0, 0.3, 5.0)
    drive.run(0.0, 0.0, 0.5)
    left, _, right, _ = drive.wheels.positions()
    # Measured: 0.996, 0.998 and 0.999 of that.
    by_wheels = (right - left) * WHEEL_RADIUS / (2 * b)
    assert drive.yaw / by_wheels == pytest.approx(b**2 / (a**2 + b**2), rel=0.02)


def vertical_accelerations(drive, seconds):
    """Of the chassis, m/s²: the difference of its vertical velocity over each physics step."""
    accelerations = []
    timestep = drive.world.timestep / NANOSECONDS
    before = drive.robot.velocity('base_link')[0][2]
    for _ in range(round(seconds / timestep)):
        drive.world.step(1)
        after = drive.robot.velocity('base_link')[0][2]
        accelerations.append((after - before) / timestep)
        before = after
    return accelerations


@pytest.mark.parametrize('linear, angular', [(0.0, 1.0), (0.0, 2.0), (0.5, 1.0)])
def test_turning_robot_keeps_its_wheels_on_the_ground(linear, angular):
    drive = Drive()
    drive.command(linear, angular)
    # From the step of the command on; measured: 0.16, 0.34 and 0.21. In a steady turn it is 0.000.
    assert pstdev(vertical_accelerations(drive, 3.0)) < 0.5


def test_the_measure_of_hopping_sees_a_hop():
    world = MujocoWorld('empty')
    drive = Drive(world=world)
    world.remove('amr')
    drive.robot = world.spawn('amr', AMR, Transform((0.0, 0.0, 0.01)))
    assert pstdev(vertical_accelerations(drive, 0.5)) > 5.0


@pytest.mark.parametrize('linear', [0.5, -0.5])
def test_stops_within_a_quarter_second(linear):
    drive = Drive()
    drive.run(linear, 0.0, 2.0)
    assert drive.speed == pytest.approx(0.5, rel=0.001)
    drive.command(0.0, 0.0)
    # Measured: 0.108 s. The fastest that Coulomb allows is v / (µ g) = 0.051 s.
    drive.world.step(round(0.05 / 0.002))
    assert drive.speed > 0.01
    drive.world.step(round(0.20 / 0.002))
    for _ in range(250):
        assert drive.speed < 0.01
        drive.world.step(1)


@pytest.mark.parametrize('timestep', [1_000_000, 1_250_000])
def test_a_smaller_physics_step_drives_the_same(timestep):
    drive = Drive(timestep=timestep)
    drive.run(0.0, 1.0, math.pi)
    drive.run(0.0, 0.0, 0.5)
    assert drive.yaw == pytest.approx(drive.odometry.heading, rel=0.03)
    # Measured: yaw 1.0126 at 1 ms, 1.0128 at 1.25 ms, 1.0132 at 2 ms.
    coarse = Drive()
    coarse.run(0.0, 1.0, math.pi)
    coarse.run(0.0, 0.0, 0.5)
    assert drive.yaw == pytest.approx(coarse.yaw, rel=0.002)


def test_heading_does_not_matter():
    pose = Transform.from_xyz_rpy((1.0, -2.0, 0.0), (0.0, 0.0, math.pi / 6))
    drive = Drive(pose=pose)
    drive.run(0.5, 1.0, 2.0)
    plain = Drive()
    plain.run(0.5, 1.0, 2.0)
    assert drive.position == pytest.approx(plain.position, abs=1e-3)
    assert drive.yaw == pytest.approx(plain.yaw, rel=1e-3)


def test_separation_is_that_of_the_shipped_controllers():
    from fixtures.sim.driving import ROOT
    import yaml

    parameters = yaml.safe_load((ROOT / 'config' / 'controllers.yaml').read_text())
    drive = parameters['/**/diff_drive_controller']['ros__parameters']
    multiplier = drive['wheel_separation_multiplier']
    assert drive['wheel_separation'] * multiplier == pytest.approx(SEPARATION)
    assert drive['wheel_radius'] == WHEEL_RADIUS
