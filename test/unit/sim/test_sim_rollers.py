# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""Robots on mecanum and omni wheels move as the kinematics of their controllers have it."""

import math

from fixtures.sim.driving import AMR, Lines
from fixtures.sim.mecanum import CORNERS, HALF_BASE, HALF_TRACK, mecanum, OMNI, omni, RADIUS
import pytest

from amr_description.controllers.drives.mecanum_drive_controller import MecanumKinematics
from amr_description.controllers.drives.omni_wheel_drive_controller import OmniKinematics
from amr_description.log import null_log
from amr_description.model.frames import Transform
from amr_description.model.wheels import Rollers
from amr_description.sim.drop_test import drop_test
from amr_description.sim.robot_spec import build_robot
from amr_description.sim.spawning import read_description
from amr_description.sim.world import MujocoWorld

MECANUM = MecanumKinematics(RADIUS, HALF_BASE + HALF_TRACK)
THREE_OMNI = OmniKinematics(3, 0.0, OMNI, RADIUS)
WHEELS = [f'{name}_joint' for name in CORNERS]
OMNI_WHEELS = [f'omni_{index}_joint' for index in range(3)]
PERIOD = 10_000_000
HEIGHT = RADIUS + 0.02
TWISTS = {
    'ahead': (0.3, 0.0, 0.0),
    'left': (0.0, 0.3, 0.0),
    'diagonal': (0.2, -0.2, 0.0),
    'turn': (0.0, 0.0, 1.0),
    'all at once': (0.2, 0.1, 0.5),
}
X_OF_ROLLERS = {
    f'{name}_joint': Rollers(math.copysign(math.pi / 4, -ahead * left))
    for name, (ahead, left) in CORNERS.items()
}


def world_with(urdf, rollers=None, world='empty', pose=None):
    world = MujocoWorld(world)
    pose = pose or Transform((0.0, 0.0, HEIGHT))
    robot = world.spawn('robot', urdf, pose, rollers=rollers or {})
    return world, robot


def pose_of(robot):
    pose = robot.pose('base_link')
    x, y, z, w = pose.rotation
    return pose.translation, math.atan2(2 * (w * z + x * y), 1 - 2 * (y * y + z * z))


def mean_twist(before, after, seconds):
    """The constant twist (m/s, m/s, rad/s) that leads from one pose to the other."""
    (x0, y0, _), yaw = before
    (x1, y1, _), later = after
    turn = math.remainder(later - yaw, 2 * math.pi)
    cosine, sine = math.cos(yaw), math.sin(yaw)
    along = cosine * (x1 - x0) + sine * (y1 - y0)
    across = -sine * (x1 - x0) + cosine * (y1 - y0)
    # The chord of an arc, turned back by half of the turn and stretched.
    half = turn / 2
    stretch = half / math.sin(half) if half else 1.0
    cosine, sine = math.cos(half), math.sin(half)
    return (
        stretch * (cosine * along + sine * across) / seconds,
        stretch * (-sine * along + cosine * across) / seconds,
        turn / seconds,
    )


def driven(world, robot, joints, speeds):
    """The twist in the second second."""
    wheels = robot.joints(joints)
    wheels.command('velocity', list(speeds))
    poses = []
    for _ in range(2):
        for _ in range(100):
            world.advance(PERIOD)
        poses.append(pose_of(robot))
    return mean_twist(*poses, 1.0)


@pytest.mark.parametrize('twist', TWISTS.values(), ids=TWISTS)
def test_mecanum_wheels_move_the_robot_as_the_closed_form_says(twist):
    world, robot = world_with(mecanum())
    found = driven(world, robot, WHEELS, MECANUM.wheels(twist))
    assert found == pytest.approx(twist, rel=0.02, abs=0.002)


@pytest.mark.parametrize('twist', [TWISTS['left'], TWISTS['all at once']])
def test_omni_wheels_move_the_robot_as_the_closed_form_says(twist):
    world, robot = world_with(omni())
    found = driven(world, robot, OMNI_WHEELS, THREE_OMNI.wheels(twist))
    assert found == pytest.approx(twist, rel=0.02, abs=0.002)


def test_a_controller_may_say_which_wheels_have_rollers():
    twist = TWISTS['left']
    world, robot = world_with(mecanum(''), X_OF_ROLLERS)
    found = driven(world, robot, WHEELS, MECANUM.wheels(twist))
    assert found == pytest.approx(twist, rel=0.02, abs=0.002)


def test_hardly_any_friction_is_that_across_the_rollers_of_a_driven_wheel():
    """As for a base that is pushed by a plugin of Gazebo, driven by a controller instead."""
    lines = Lines()
    slippery = '<gazebo reference="{name}_wheel"><mu1>0.01</mu1><mu2>0.01</mu2></gazebo>'
    robot = read_description(mecanum(slippery), 'robot')
    model = build_robot(robot, lines, named_rollers=X_OF_ROLLERS)
    assert model.rollers['front_left_wheel/wheel'] == Rollers(-math.pi / 4, 1.0, 0.01)
    assert 'a friction of 0.01 in the description' in lines.text
    plain = build_robot(robot, lines)
    assert plain.rollers == {}


def test_without_rollers_it_does_not_go_sideways():
    world, robot = world_with(mecanum(''))
    found = driven(world, robot, WHEELS, MECANUM.wheels(TWISTS['left']))
    assert abs(found[1]) < 0.03


def test_it_rests():
    world, robot = world_with(mecanum())
    for _ in range(100):
        world.advance(PERIOD)
    before = pose_of(robot)
    for _ in range(500):
        world.advance(PERIOD)
    (x, y, z), yaw = pose_of(robot)
    assert (x, y, z) == pytest.approx(before[0], abs=1e-9)
    assert yaw == pytest.approx(before[1], abs=1e-9)
    assert z == pytest.approx(HEIGHT, abs=2e-5)


@pytest.fixture
def box_world(tmp_path):
    """A ground that is a box, where MuJoCo's normals point the other way, at an angle."""

    def write(degrees):
        path = tmp_path / f'box_{degrees}.xml'
        path.write_text(
            f'<mujoco><worldbody><geom type="box" size="5 5 0.1" euler="0 {degrees} 0" '
            'friction="1"/></worldbody></mujoco>'
        )
        return str(path)

    return write


def test_on_a_box_it_moves_as_on_a_plane(box_world):
    twist = TWISTS['all at once']
    pose = Transform((0.0, 0.0, HEIGHT + 0.1))
    world, robot = world_with(mecanum(), world=box_world(0), pose=pose)
    found = driven(world, robot, WHEELS, MECANUM.wheels(twist))
    assert found == pytest.approx(twist, rel=0.02, abs=0.002)


def test_it_holds_and_drives_left_on_a_slope(box_world):
    tilt = math.radians(8)
    up = HEIGHT + 0.1
    rotation = (0.0, math.sin(tilt / 2), 0.0, math.cos(tilt / 2))
    pose = Transform((up * math.sin(tilt), 0.0, up * math.cos(tilt)), rotation)
    world, robot = world_with(mecanum(), world=box_world(8), pose=pose)
    for speed in (0.0, 0.3):
        x, y, _ = driven(world, robot, WHEELS, MECANUM.wheels((0.0, speed, 0.0)))
        assert (x, y) == pytest.approx((0.0, speed), abs=0.01)


def test_a_robot_that_was_removed_leaves_no_rollers():
    world, robot = world_with(mecanum())
    assert world.engine.rollers
    world.remove(robot.name)
    assert not world.engine.rollers
    world.spawn('amr', AMR, Transform((0.0, 0.0, 0.2)))
    world.advance(PERIOD)


def test_the_divided_step_is_the_whole_step_for_other_wheels():
    """With rollers in the world, a robot without any moves as alone."""
    states = []
    for other in (False, True):
        world = MujocoWorld('empty')
        robot = world.spawn('amr', AMR, Transform((0.0, 0.0, 0.2)))
        if other:
            world.spawn('other', mecanum(), Transform((5.0, 5.0, HEIGHT)))
        names = [wheel.joint for wheel in robot.wheels]
        robot.joints(names).command('velocity', [5.0, 3.0, 5.0, 3.0])
        for _ in range(100):
            world.advance(PERIOD)
        states.append(pose_of(robot)[0])
    assert states[0] == pytest.approx(states[1], abs=1e-6)


def test_of_two_sources_the_description_counts():
    model = build_robot(
        read_description(mecanum(), 'robot'), null_log, named_rollers={WHEELS[0]: Rollers(0.0)}
    )
    assert model.rollers['front_left_wheel/wheel'].angle == pytest.approx(-math.pi / 4)
    assert build_robot(read_description(AMR, 'robot'), null_log).rollers == {}


@pytest.mark.parametrize(('urdf', 'is_driven'), [(mecanum(), True), (omni(), False)])
def test_the_drop_test_does_not_drive_omni_wheels_like_others(urdf, is_driven):
    report = drop_test(read_description(urdf, 'robot'))
    assert report.failures == ()
    left_out = 'not driven: its wheels roll in several directions'
    assert (left_out in report.left_out) is not is_driven
