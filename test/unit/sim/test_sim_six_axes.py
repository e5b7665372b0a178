# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""A six-axis arm: it holds, follows and stands where forward kinematics has it."""

import math

from fixtures.sim.arm import follow, GRAVITY
from fixtures.sim.driving import AMR, Lines, ROOT
import pytest

from amr_description.model.frames import Transform
from amr_description.model.kinematics import link_poses
from amr_description.sim.world import MujocoWorld

URDF = (ROOT / 'test' / 'fixtures' / 'sim' / 'six_axes.urdf').read_text()
JOINTS = [f'joint_{number}' for number in range(1, 7)]
START = [0.0, -0.6, 1.2, 0.0, 0.0, 0.0]
"""The initial_value of its URDF, rad."""
STRETCHED = [0.0] * 6


@pytest.fixture
def arm():
    log = Lines()
    world = MujocoWorld('empty', log=log)
    robot = world.spawn('arm', URDF)
    assert log.lines == []
    return world, robot, robot.joints(JOINTS)


def expected_tool(robot, positions):
    """Where forward kinematics has the tool."""
    return link_poses(robot.description, dict(zip(JOINTS, positions, strict=True)))['tool0']


def test_it_holds_where_it_begins(arm):
    world, robot, joints = arm
    assert joints.positions() == START
    follow(world, joints, START, 10.0)
    # Measured: 0.1 mrad.
    assert joints.positions() == pytest.approx(START, abs=5e-4)
    assert joints.velocities() == pytest.approx([0.0] * 6, abs=1e-4)


def test_stretched_out_its_motors_carry_what_statics_asks_for(arm):
    world, robot, joints = arm
    follow(world, joints, STRETCHED, 4.0)
    assert robot.pose('tool0').translation == pytest.approx((0.95, 0.0, 0.52), abs=1e-3)
    # Mass and distance of each link's centre from the first pitching axis.
    loads = [(3.5, 0.2), (2.5, 0.575), (0.8, 0.8), (0.5, 0.88), (0.3, 0.93)]

    def torque(about):
        return GRAVITY * sum(mass * (x - about) for mass, x in loads if x > about)

    efforts = [0.0, -torque(0.0), -torque(0.4), 0.0, -torque(0.85), 0.0]
    assert joints.efforts() == pytest.approx(efforts, abs=0.05)


@pytest.mark.parametrize(
    'targets',
    [
        [1.5, -1.0, 1.8, 0.5, -0.8, 2.0],
        [-2.0, -1.2, 0.4, -1.5, 1.2, -3.0],
        [0.3, -0.3, 0.9, 3.0, 0.5, 6.0],
    ],
)
def test_it_goes_to_a_pose_and_stays_there(arm, targets):
    world, robot, joints = arm
    track = follow(world, joints, targets, 4.0)
    assert joints.positions() == pytest.approx(targets, abs=5e-4)
    tool, expected = robot.pose('tool0'), expected_tool(robot, targets)
    assert math.dist(tool.translation, expected.translation) < 1e-3
    cosine = sum(a * b for a, b in zip(tool.rotation, expected.rotation, strict=True))
    assert abs(cosine) == pytest.approx(1.0, abs=1e-6)
    limits = [joint.limit.velocity for joint in map(robot.description.joint, JOINTS)]
    for _, velocities in track:
        for velocity, limit in zip(velocities, limits, strict=True):
            assert abs(velocity) < 1.02 * limit


def test_it_follows_a_motion_with_one_lag_of_all_axes(arm):
    world, robot, joints = arm
    omega = 1.5
    # Upwards, clear of the ground, rad.
    swings = [0.5, -0.4, 0.3, 0.5, -0.5, 0.5]

    def motion(seconds):
        phase = 1.0 - math.cos(omega * seconds)
        return [start + swing * phase for start, swing in zip(START, swings, strict=True)]

    for tick in range(600):
        joints.command('position', motion(tick / 100.0))
        world.step(5)
        if tick > 50:
            # A command acts for 10 ms; measured: 36 ms of lag (the cascade's 40 ms and sampling).
            expected = motion(tick / 100.0 - 0.036)
            # Measured: 0.9 mrad, of up to 0.75 rad/s · 36 ms = 27 mrad of lag.
            assert joints.positions() == pytest.approx(expected, abs=0.002)


def test_all_axes_turn_at_the_speed_that_is_commanded(arm):
    world, robot, joints = arm
    speeds = [0.4, -0.2, 0.3, -0.5, 0.2, 1.0]
    joints.command('velocity', speeds)
    world.step(250)
    before = joints.positions()
    world.step(500)
    assert joints.velocities() == pytest.approx(speeds, abs=2e-3)
    turned = [after - b for after, b in zip(joints.positions(), before, strict=True)]
    assert turned == pytest.approx(speeds, abs=2e-3)


def test_it_works_beside_a_robot_that_drives():
    world = MujocoWorld('warehouse')
    arm = world.spawn('arm', URDF, Transform((0.0, 1.0, 0.0))).joints(JOINTS)
    amr = world.spawn('amr', AMR, Transform((-3.0, 0.0, 0.0)))
    wheels = [joint.name for joint in amr.description.joints if joint.has_position]
    amr.joints(wheels).command('velocity', [5.0] * 4)
    follow(world, arm, STRETCHED, 3.0)
    assert arm.positions() == pytest.approx(STRETCHED, abs=5e-4)
    assert amr.pose('base_footprint').translation == pytest.approx((-1.51, 0, 0), abs=0.01)


def test_it_may_ride_on_a_robot():
    # The same arm without its world and its pedestal, on the back of the amr.
    own = URDF[URDF.index('<joint name="joint_1"') : URDF.index('</robot>')]
    own = own.replace('<parent link="pedestal"/>', '<parent link="base_link"/>')
    own = own.replace('<origin xyz="0 0 0.2"/>', '<origin xyz="0 0 0.05"/>')
    world = MujocoWorld('empty')
    robot = world.spawn('mobile', AMR.replace('</robot>', own + '</robot>'))
    joints = robot.joints(JOINTS)
    folded = [0.0, -2.0, 2.6, 0.0, 0.0, 0.0]
    follow(world, joints, folded, 3.0)
    wheels = robot.joints([wheel.joint for wheel in robot.wheels])
    wheels.command('velocity', [3.0] * 4)
    start = robot.pose('base_footprint').translation
    follow(world, joints, folded, 2.0)
    assert joints.positions() == pytest.approx(folded, abs=2e-3)
    x, y, z = robot.pose('base_footprint').translation
    assert x - start[0] == pytest.approx(0.6, rel=0.05)
    assert z == pytest.approx(0.0, abs=2e-3)
