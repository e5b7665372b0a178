# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""Parameters of earlier releases: what is made of them, and what is said of it."""

import math

import pytest

from amr_description.controllers.broadcasters.joint_state_broadcaster import BroadcasterParameters
from amr_description.controllers.drives.diff_drive_controller import DiffDriveParameters
from amr_description.controllers.drives.mecanum_drive_controller import MecanumDriveParameters
from amr_description.controllers.drives.tricycle_controller import TricycleParameters
from amr_description.controllers.forward_command_controller import ForwardCommandParameters
from amr_description.controllers.joint_trajectory.parameters import (
    JointTrajectoryParameters,
)
from amr_description.controllers.pid_controller import PidParameters
from amr_description.former_parameters import understand

BRAKES = {'linear.x.max_acceleration': 1.0, 'linear.x.min_acceleration': -3.0}
HARDER = {'linear.x.max_deceleration': -3.0, 'linear.x.max_acceleration_reverse': -3.0}
NO_JERK = {'linear.x.max_jerk': math.nan, 'linear.x.min_jerk': math.nan}


@pytest.mark.parametrize(
    ('table', 'given', 'values', 'text'),
    [
        (
            DiffDriveParameters,
            {'use_stamped_vel': False},
            {'enable_cmd_vel_unstamped': True},
            "parameter 'use_stamped_vel' is false: it is of Humble: plain Twist is taken on "
            '~/cmd_vel_unstamped, besides TwistStamped on ~/cmd_vel; Jazzy takes TwistStamped '
            'only',
        ),
        (
            TricycleParameters,
            {'use_stamped_vel': False},
            {},
            "parameter 'use_stamped_vel' is false: it is of Humble, and has no effect: "
            'TwistStamped is all that is taken',
        ),
        (
            DiffDriveParameters,
            {'wheels_per_side': 2},
            {},
            "parameter 'wheels_per_side' is 2: it is of Foxy, and has no effect: the names of the "
            'wheels say how many there are',
        ),
        (
            DiffDriveParameters,
            BRAKES,
            HARDER,
            "parameter 'linear.x.min_acceleration' is -3.0: it is of Humble: taken as "
            'max_deceleration and max_acceleration_reverse',
        ),
        (
            DiffDriveParameters,
            {'linear.x.max_jerk': 0.0},
            NO_JERK,
            "parameter 'linear.x.max_jerk' is 0.0: with it the robot would never move: taken as "
            'no limit, .nan',
        ),
        (
            DiffDriveParameters,
            {'wheel_radius_multiplier': 0.9, 'left_wheel_radius_multiplier': 1.0},
            {'right_wheel_radius_multiplier': 0.9},
            "parameter 'wheel_radius_multiplier' is 0.9: it is of ROS 1: taken as "
            'left_wheel_radius_multiplier and right_wheel_radius_multiplier',
        ),
        (
            MecanumDriveParameters,
            {'tf_frame_prefix': '~'},
            {'tf_frame_prefix': ''},
            "parameter 'tf_frame_prefix' is ~: it is of releases after Jazzy: the namespace of "
            'the node, as an empty one is here',
        ),
        (
            BroadcasterParameters,
            {'publish_rate': 50},
            {},
            "parameter 'publish_rate' is 50: it is of ROS 1, and has no effect: update_rate, in "
            'Hz, is how often it publishes',
        ),
        (
            JointTrajectoryParameters,
            {'joints': ['a'], 'gains.a.angle_wraparound': True},
            {},
            "parameter 'gains.a.angle_wraparound' is true: it is of Humble, and has no effect: "
            'joints that the URDF calls continuous wrap around',
        ),
        (
            PidParameters,
            {'dof_names': ['a'], 'gains.a.i_clamp': 3, 'gains.b.i_clamp': 4},
            {'gains.a.i_clamp_max': 3.0, 'gains.a.i_clamp_min': -3.0},
            "parameter 'gains.a.i_clamp' is 3: it is of earlier releases: taken as i_clamp_max "
            '3.0 and i_clamp_min -3.0',
        ),
        (
            PidParameters,
            {'dof_names': ['a'], 'gains.a.p': 2},
            {'gains.a.p': 2.0},
            "parameter 'gains.a.p' is 2, an integer, where a double is declared: taken as 2.0; a "
            'node of rclcpp refuses it',
        ),
        (
            DiffDriveParameters,
            {'pose_covariance_diagonal': [0, 0, 0, 0, 0, 1]},
            {'pose_covariance_diagonal': [0.0, 0.0, 0.0, 0.0, 0.0, 1.0]},
            "parameter 'pose_covariance_diagonal' is [0, 0, 0, 0, 0, 1], integers, where a "
            'double_array is declared: taken as [0.0, 0.0, 0.0, 0.0, 0.0, 1.0]; a node of rclcpp '
            'refuses it',
        ),
        (
            DiffDriveParameters,
            {'velocity_rolling_window_size': 5.0},
            {'velocity_rolling_window_size': 5},
            "parameter 'velocity_rolling_window_size' is 5.0, a double, where an integer is "
            'declared: taken as 5; a node of rclcpp refuses it',
        ),
    ],
)
def test_what_is_plain_is_understood_in_one_line(table, given, values, text):
    found = understand(table, given)
    assert repr(found.values) == repr(values)  # NaN equals itself so
    assert {name: type(value) for name, value in found.values.items()} == {
        name: type(value) for name, value in values.items()
    }
    assert list(found.texts.values()) == found.lines == [text]


def test_many_numbers_of_another_type_are_one_line():
    names = [f'gains.{joint}.{gain}' for joint in 'abc' for gain in 'pid']
    given = {'dof_names': ['a', 'b', 'c'], 'gains.a.i_clamp': 3.0} | dict.fromkeys(names, 2)
    found = understand(PidParameters, given)
    assert len(found.texts) == 10
    clamp, numbers = found.lines
    assert "'gains.a.i_clamp' is 3.0" in clamp
    assert numbers == (
        "parameters 'gains.a.p' (2), 'gains.a.i' (2), 'gains.a.d' (2), 'gains.b.p' (2), "
        "'gains.b.i' (2), 'gains.b.d' (2), 3 more are numbers of another type than declared, such "
        'as integers for doubles: taken as those; a node of rclcpp refuses them'
    )
    fewer = understand(PidParameters, {'dof_names': ['a'], 'gains.a.p': 2, 'gains.a.i': 2})
    assert len(fewer.lines) == 2


@pytest.mark.parametrize(
    'given',
    [
        {'use_stamped_vel': True},
        {'use_stamped_vel': False, 'enable_cmd_vel_unstamped': False},
        {'linear.x.has_jerk_limits': False, 'linear.x.max_jerk': 0.0, 'linear.x.min_jerk': 0.0},
        {'linear.x.max_acceleration': 1.0, 'linear.x.min_acceleration': -1.0},
        BRAKES | {'linear.x.max_deceleration': -2.0},
        BRAKES | {'linear.x.has_acceleration_limits': False},
        {'linear.x.min_acceleration': math.nan, 'linear.x.max_acceleration': 1.0},
        {'wheel_radius': 0.1, 'linear.x.max_velocity': math.nan, 'tf_frame_prefix': ''},
        {'wheel_radius': '0.1', 'pose_covariance_diagonal': [0, 1.0], 'left_wheel_names': 'a'},
    ],
)
def test_what_says_the_same_in_jazzy_or_nothing_plain_is_left_alone(given):
    found = understand(DiffDriveParameters, given)
    assert found.values == {}
    assert found.texts == {}


def test_a_variable_of_a_launch_file_is_what_makes_names_of_joints_of_it():
    joints = ['arm_1', 'arm_2', 'hand_1', 'base']
    given = {'joints': ['$(var prefix)1', '$(var prefix)2'], 'interface_name': 'position'}
    found = understand(ForwardCommandParameters, given, joints)
    assert found.values == {'joints': ['arm_1', 'arm_2']}
    assert list(found.texts.values()) == [
        "parameter 'joints' is ['$(var prefix)1', '$(var prefix)2'], for a launch file to "
        "complete: taken as ['arm_1', 'arm_2'], which are names of the robot"
    ]
    assert understand(ForwardCommandParameters, given).texts == {}


@pytest.mark.parametrize(
    ('texts', 'made'),
    [
        (['$(var p)tool0', '$(var p)map'], ['tool0', 'map']),
        (['$(var p)arm_1', '$(var p)tool0'], ['arm_1', 'tool0']),
        (['$(var p)1'], ['arm_1']),
    ],
)
def test_links_and_sensors_count_where_no_joint_is_meant(texts, made):
    """Links that a variable would make of it, too, are not meant where joints are."""
    others = ['tool0', 'left_tool0', 'link_1']
    found = understand(ForwardCommandParameters, {'joints': texts}, ['arm_1'], others)
    assert found.values == {'joints': made}


@pytest.mark.parametrize('joints', [['$(var side)_1'], ['$(var a)_$(var b)'], ['$(var x)3']])
def test_a_variable_that_may_be_several_texts_or_none_is_left(joints):
    found = understand(ForwardCommandParameters, {'joints': joints}, ['arm_1', 'hand_1'])
    assert found.values == {'joints': joints}
    (text,) = found.texts.values()
    assert 'what a launch file puts in is not known: write the names of the robot' in text
