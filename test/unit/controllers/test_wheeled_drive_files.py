# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""Mecanum, omni wheel and steering drives of parameter files, held against their robot."""

from fixtures.sim.ackermann import ackermann
from fixtures.sim.mecanum import mecanum, omni
import pytest

from amr_description.controllers.checks.wheeled_drive_files import (
    wheeled_drive_faults,
    wheeled_drive_findings,
)
from amr_description.sim.spawning import read_description

HEAD = 'controller_manager: {ros__parameters: {base: {type: %s}}}\nbase:\n  ros__parameters:\n'
MECANUM = (
    HEAD % 'mecanum_drive_controller/MecanumDriveController'
    + """    front_left_wheel_command_joint_name: front_left_joint
    front_right_wheel_command_joint_name: front_right_joint
    rear_right_wheel_command_joint_name: rear_right_joint
    rear_left_wheel_command_joint_name: rear_left_joint
    kinematics: {wheels_radius: 0.05, sum_of_robot_center_projection_on_X_Y_axis: 0.28}
"""
)
OMNI = (
    HEAD % 'omni_wheel_drive_controller/OmniWheelDriveController'
    + """    wheel_names: [omni_0_joint, omni_1_joint, omni_2_joint]
    wheel_offset: 0.0
    wheel_radius: 0.05
    robot_radius: 0.2
"""
)
ACKERMANN = (
    HEAD % 'ackermann_steering_controller/AckermannSteeringController'
    + """    traction_joints_names: [rear_right, rear_left]
    steering_joints_names: [steer_right, steer_left]
    wheelbase: 0.4
    traction_track_width: 0.3
    steering_track_width: 0.3
    traction_wheels_radius: 0.06
"""
)
ROBOTS = {'mecanum': (mecanum(), MECANUM), 'omni': (omni(), OMNI), 'car': (ackermann(), ACKERMANN)}


@pytest.fixture
def texts(tmp_path):
    def check(urdf, parameters):
        path = tmp_path / 'controllers.yaml'
        path.write_text(parameters)
        robot = read_description(urdf, 'robot')
        return [each.text for each in wheeled_drive_findings(robot, [str(path)])]

    return check


@pytest.mark.parametrize('name', ROBOTS)
def test_a_drive_that_fits_its_robot_has_no_findings(texts, name):
    assert texts(*ROBOTS[name]) == []


@pytest.mark.parametrize(
    ('name', 'old', 'new', 'complaint'),
    [
        ('mecanum', 'wheels_radius: 0.05', 'wheels_radius: 0.1', 'expected 0.05 m, the radius'),
        ('mecanum', 'Y_axis: 0.28', 'Y_axis: 0.56', 'expected 0.28 m, half of the wheelbase'),
        (
            'mecanum',
            'front_left_wheel_command_joint_name: front_left_joint',
            'front_left_wheel_command_joint_name: rear_left_joint',
            'joint "rear_left_joint" is not at the corner of front_left_wheel: found (-0.15, ',
        ),
        (
            'mecanum',
            'rear_left_wheel_command_joint_name: rear_left_joint',
            'rear_left_wheel_command_joint_name: rear_right_joint',
            'expected x < 0, y > 0: x ahead, y to the left',
        ),
        (
            'mecanum',
            'front_right_wheel_command_joint_name: front_right_joint',
            'front_right_wheel_command_joint_name: front_left_joint',
            'expected x > 0, y < 0: x ahead, y to the left',
        ),
        ('omni', 'wheel_radius: 0.05', 'wheel_radius: 0.06', 'wheel_radius is not that'),
        ('omni', 'robot_radius: 0.2', 'robot_radius: 0.3', 'expected 0.2 m, as far as the wheels'),
        (
            'omni',
            '[omni_0_joint, omni_1_joint',
            '[omni_1_joint, omni_0_joint',
            'found 120 degrees from x, expected 0 degrees, counter-clockwise',
        ),
        ('omni', 'wheel_offset: 0.0', 'wheel_offset: 1.0', 'found 0 degrees from x, expected 57'),
        ('car', 'wheelbase: 0.4', 'wheelbase: 0.5', 'expected 0.4 m, from axle to axle'),
        ('car', 'traction_track_width: 0.3', 'traction_track_width: 0.6', 'expected 0.3 m, apart'),
        ('car', 'traction_wheels_radius: 0.06', 'rear_wheels_radius: 0.05', 'expected 0.06 m'),
        (
            'car',
            '[steer_right, steer_left]',
            '[steer_left, steer_right]',
            'the steering joints are not in the order right, left',
        ),
    ],
)
def test_what_does_not_fit_the_robot_is_named(texts, name, old, new, complaint):
    urdf, parameters = ROBOTS[name]
    assert old in parameters
    [text] = texts(urdf, parameters.replace(old, new))
    assert complaint in text


@pytest.mark.parametrize(
    ('name', 'old', 'new', 'complaint'),
    [
        (
            'mecanum',
            '<origin xyz="0.15 0.13 -0.02" rpy="0 0 0.0"/><axis xyz="0 1 0"/>',
            '<origin xyz="0.15 0.13 -0.02" rpy="0 0 0.0"/><axis xyz="0 -1 0"/>',
            'the wheel of joint "front_left_joint" turns backwards: found an axis (0, -1, 0)',
        ),
        (
            'omni',
            '<origin xyz="0.2 0.0 -0.02" rpy="0 0 -1.5707963267948966"/><axis xyz="0 1 0"/>',
            '<origin xyz="0.2 0.0 -0.02" rpy="0 0 -1.5707963267948966"/><axis xyz="0 -1 0"/>',
            'the axle of joint "omni_0_joint" does not point outwards: found an axis (-1, 0, 0)',
        ),
        (
            'car',
            '<origin xyz="0.4 -0.15 0"/><axis xyz="0 0 1"/>',
            '<origin xyz="0.4 -0.15 0"/><axis xyz="0 0 -1"/>',
            'joint "steer_right" does not steer to the left where it is positive',
        ),
        (
            'car',
            '<limit lower="-0.9"',
            '<limit lower="-0.8"',
            '',
        ),
    ],
)
def test_axes_that_point_elsewhere_are_named(texts, name, old, new, complaint):
    urdf, parameters = ROBOTS[name]
    assert old in urdf
    found = texts(urdf.replace(old, new), parameters)
    assert len(found) == (1 if complaint else 0)
    assert complaint in ''.join(found)


@pytest.mark.parametrize('follows', [False, True])
def test_a_steered_wheel_that_cannot_roll_is_named(texts, follows):
    """Fixed to the knuckle; a knuckle that follows the other is looked at, too."""
    urdf = ackermann().replace(
        'name="front_left" type="continuous"', 'name="front_left" type="fixed"'
    )
    parameters = ACKERMANN
    if follows:
        mimic = '<mimic joint="steer_right"/></joint>'
        start = urdf.index('<joint name="steer_left" type')
        end = urdf.index('</joint>', start)
        urdf = urdf[:end] + mimic + urdf[end + len('</joint>') :]
        parameters = ACKERMANN.replace('ackermann', 'tricycle').replace('Ackermann', 'Tricycle')
        parameters = parameters.replace('[steer_right, steer_left]', '[steer_right]')
    [text] = texts(urdf, parameters)
    assert 'the wheel on joint "steer_left" is steered and cannot roll: it slides' in text


def test_a_differential_drive_on_mecanum_wheels_is_told_its_separation(texts):
    parameters = (
        HEAD % 'diff_drive_controller/DiffDriveController'
        + """    left_wheel_names: [front_left_joint, rear_left_joint]
    right_wheel_names: [front_right_joint, rear_right_joint]
    wheel_separation: 0.26
    wheel_radius: 0.05
    wheel_separation_multiplier: 1.0
"""
    )
    [text] = texts(mecanum(), parameters)
    assert 'found an effective separation of 0.26 m, expected 0.56 m' in text
    assert 'write wheel_separation_multiplier: 2.15' in text
    assert texts(mecanum(), parameters.replace('1.0', '2.1538')) == []
    assert texts(mecanum(''), parameters) == []


def test_drives_of_other_robots_are_left_out(texts):
    assert texts(omni(), MECANUM) == texts(omni(), ACKERMANN) == texts(mecanum(), OMNI) == []
    assert texts(mecanum(), '') == []


def test_a_description_with_faults_is_left_to_the_checker(tmp_path):
    path = tmp_path / 'controllers.yaml'
    path.write_text(MECANUM.replace('radius: 0.05', 'radius: 0.1'))
    assert len(wheeled_drive_faults(mecanum(), 'x.urdf', [str(path)])) == 1
    broken = mecanum().replace('<parent link="base_link"/>', '<parent link="nowhere"/>')
    assert wheeled_drive_faults(broken, 'x.urdf', [str(path)]) == ()
    assert wheeled_drive_faults('<robot', 'x.urdf', [str(path)]) == ()
