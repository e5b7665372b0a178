# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""Load and slip of the wheels against what rigid bodies and Coulomb's law say."""

import math

from fixtures.sim.driving import AMR, Drive, LEFT, RIGHT, SEPARATION
import pytest

from amr_description.model.frames import Transform
from amr_description.sim.wheel_slip import WheelSlipReader
from amr_description.sim.world import MujocoWorld

MASS = 7.0
"""kg, of the shipped robot."""
GRAVITY = 9.81


SLAB = """<mujoco><worldbody>
    <geom name="slab" type="box" size="20 20 1" pos="0 0 -1"/></worldbody></mujoco>"""


@pytest.fixture(params=['plane', 'box'])
def drive(request, tmp_path):
    """On a plane, and on a box: MuJoCo names the two geoms of a contact in different orders."""
    if request.param == 'plane':
        return Drive()
    path = tmp_path / 'slab.xml'
    path.write_text(SLAB)
    return Drive(world=MujocoWorld(str(path)))


@pytest.fixture
def contacts(drive):
    return WheelSlipReader(drive.world.engine, drive.robot)


def by_joint(contacts):
    return dict(zip(contacts.joints, contacts.read(), strict=True))


def test_at_rest_the_wheels_carry_the_weight_in_equal_parts_without_slip(contacts):
    wheels = contacts.read()
    assert set(contacts.joints) == {*LEFT, *RIGHT}
    assert sum(wheel.normal_force for wheel in wheels) == pytest.approx(MASS * GRAVITY, rel=1e-3)
    for wheel in wheels:
        assert wheel.is_touching
        assert wheel.normal_force == pytest.approx(MASS * GRAVITY / 4, rel=1e-2)
        assert (wheel.along, wheel.across) == pytest.approx((0.0, 0.0), abs=1e-5)


@pytest.mark.parametrize('speed', [0.5, -0.5])
def test_a_wheel_that_rolls_straight_does_not_slip(drive, contacts, speed):
    drive.run(speed, 0.0, 1.0)
    for wheel in contacts.read():
        assert (wheel.along, wheel.across) == pytest.approx((0.0, 0.0), abs=2e-3)


def test_a_spinning_wheel_slips_backward_and_a_braked_one_forward(drive, contacts):
    for speed, sign in ((2.0, -1), (0.0, 1)):
        drive.run(speed, 0.0, 0.05)
        touching = [wheel for wheel in contacts.read() if wheel.is_touching]
        assert touching
        assert all(sign * wheel.along > 0.05 for wheel in touching)
        drive.run(speed, 0.0, 2.0)


def test_in_a_spin_the_slip_is_that_of_a_rigid_body_over_the_ground(drive, contacts):
    """The surface of a wheel at (a, b) moves with w x r over the ground, less what it rolls."""
    drive.run(0.0, 1.0, 2.0)
    _, (_, _, turn) = drive.robot.velocity('base_footprint')
    wheels = by_joint(contacts)
    for joint, place in (
        ('joint_wheel_front_left', (0.2, 0.15)),
        ('joint_wheel_front_right', (0.2, -0.15)),
        ('joint_wheel_back_left', (-0.2, 0.15)),
        ('joint_wheel_back_right', (-0.2, -0.15)),
    ):
        x, y = place
        rolled = math.copysign(SEPARATION / 2, -y)
        assert wheels[joint].across == pytest.approx(turn * x, rel=0.05), joint
        assert wheels[joint].along == pytest.approx(-turn * y - rolled, rel=0.05), joint


def test_in_the_air_there_is_no_load_and_no_slip(drive, contacts):
    aloft = drive.world.spawn('aloft', AMR, Transform((0.0, 3.0, 1.0)))
    drive.tick()
    wheels = WheelSlipReader(drive.world.engine, aloft).read()
    assert not any(wheel.is_touching for wheel in wheels)
    assert all(wheel.is_touching for wheel in contacts.read())  # found again in the new model


def test_a_robot_without_wheels_has_none(drive):
    box = """<robot name="box"><link name="box"><inertial><mass value="1"/>
        <inertia ixx="1" iyy="1" izz="1" ixy="0" ixz="0" iyz="0"/></inertial>
        <collision><geometry><box size="1 1 1"/></geometry></collision></link></robot>"""
    view = drive.world.spawn('box', box, Transform((0.0, 3.0, 1.0)))
    assert WheelSlipReader(drive.world.engine, view).read() == ()
