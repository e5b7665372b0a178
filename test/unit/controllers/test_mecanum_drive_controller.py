# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""mecanum_drive_controller: its kinematics against the closed form, commands, chain, topics."""

import math

from hypothesis import given, strategies as st
import pytest
from support.control_fakes import MS
from support.examples import examples
from support.wheel_bench import PERIOD, WheelBench

from amr_description.controllers import CONTROLLERS
from amr_description.controllers.drives.mecanum_drive_controller import (
    MecanumDriveController,
    MecanumDriveParameters,
    MecanumKinematics,
)
from amr_description.controllers.drives.odometry import LEAST_PERIOD
from amr_description.errors import ParameterError
from amr_description.log import Severity
from amr_description.parameters import build

CORNERS = ('front_left', 'front_right', 'rear_right', 'rear_left')
JOINTS = {f'{corner}_wheel_command_joint_name': f'{corner}_joint' for corner in CORNERS}
SIZES = {
    'kinematics.wheels_radius': 0.1,
    'kinematics.sum_of_robot_center_projection_on_X_Y_axis': 0.5,
}
VALUES = JOINTS | SIZES | {'reference_timeout': 0.5}

speeds = st.floats(-3.0, 3.0)
sizes = st.floats(0.02, 2.0)


def bench(chained=False, **values):
    names = {name.replace('__', '.'): value for name, value in values.items()}
    return WheelBench(MecanumDriveController, VALUES | names, chained=chained)


@examples(100)
@given(st.tuples(speeds, speeds, speeds), sizes, sizes, speeds, speeds, speeds)
def test_the_twist_of_its_wheels_is_the_twist(twist, radius, reach, x, y, angle):
    kinematics = MecanumKinematics(radius, reach, x, y, angle)
    assert kinematics.twist(kinematics.wheels(twist)) == pytest.approx(twist, abs=1e-9)


@examples(50)
@given(st.tuples(speeds, speeds, speeds), speeds, speeds, speeds)
def test_each_wheel_rolls_on_its_ground_contact(twist, x, y, angle):
    """v of the wheel's middle, less r·speed ahead, has to be along the axis of its roller."""
    radius, half_base, half_track = 0.1, 0.3, 0.2
    kinematics = MecanumKinematics(radius, half_base + half_track, x, y, angle)
    # Where the wheels' centre is, and how it is turned, as seen from the base: the offset maps a
    # point of the base to the frame of the centre.
    cosine, sine = math.cos(angle), math.sin(angle)
    vx = cosine * twist[0] - sine * twist[1] + y * twist[2]
    vy = sine * twist[0] + cosine * twist[1] - x * twist[2]
    places = ((1, 1), (1, -1), (-1, -1), (-1, 1))
    for speed, (ahead, left) in zip(kinematics.wheels(twist), places, strict=True):
        px, py = ahead * half_base, left * half_track
        slip = vx - twist[2] * py - radius * speed, vy + twist[2] * px
        # Front left and rear right: the roller at the ground points to the front left; it turns
        # freely across its axis, and holds along it.
        along = (1.0, -1.0) if ahead == left else (1.0, 1.0)
        assert slip[0] * along[0] + slip[1] * along[1] == pytest.approx(0.0, abs=1e-9)


def test_known_speeds():
    robot = bench()
    assert robot.drive(1.0, 0.0, 0.0) == pytest.approx((10.0, 10.0, 10.0, 10.0))
    assert robot.drive(0.0, 1.0, 0.0) == pytest.approx((-10.0, 10.0, -10.0, 10.0))
    assert robot.drive(0.0, 0.0, 1.0) == pytest.approx((-5.0, 5.0, 5.0, -5.0))


@pytest.mark.parametrize('offset', [{}, {'kinematics.base_frame_offset.x': 0.2}])
def test_a_circle_closes(offset):
    robot = WheelBench(MecanumDriveController, VALUES | offset)
    robot.drive(0.0, math.pi / 2, math.pi / 2, seconds=2.01)
    x, y, heading = robot.pose()
    # Sideways at 1 rad/rad: a circle of radius 1 about (-1, 0); half of it is done.
    assert (x, y, heading) == pytest.approx((-2.0, 0.0, math.pi), abs=0.02)
    robot.drive(0.0, math.pi / 2, math.pi / 2, seconds=2.0)
    assert robot.pose() == pytest.approx((0.0, 0.0, 2 * math.pi), abs=1e-6)


def test_topics_and_their_frames():
    robot = bench(odom_frame_id='o', base_frame_id='b', tf_frame_prefix='~/r')
    assert set(robot.sent) == {'~/odometry', '~/tf_odometry', '~/controller_state'}
    robot.drive(1.0, 2.0, 0.5)
    robot.update()
    [odometry] = robot.sent['~/odometry'][1:]
    assert (odometry.linear, odometry.lateral, odometry.angular) == pytest.approx((1.0, 2.0, 0.5))
    assert (odometry.frames.frame_id, odometry.frames.child_frame_id) == ('r/o', 'r/b')
    assert odometry.frames.pose_variances == (0.1,) * 6
    assert robot.sent['~/tf_odometry'][1:] == [odometry]
    first, second = robot.sent['~/controller_state']
    assert first.reference == (1.0, 2.0, 0.5)
    assert second.wheels == pytest.approx(robot.commanded)
    port = robot.controller.inputs()[0].port
    assert (port.name, port.qos.depth, port.qos.reliability) == ('~/reference', 1, 'best_effort')


def test_the_transform_may_go_to_tf_or_nowhere():
    robot = bench(tf_odometry_topic='/tf')
    robot.update()
    assert len(robot.sent['/tf']) == 1
    robot = bench(enable_odom_tf=False)
    robot.update()
    assert not robot.sent['~/tf_odometry']


def test_a_command_times_out():
    robot = bench()
    robot.send(1.0)
    assert robot.update(50) == pytest.approx((10.0,) * 4)
    assert robot.update(2) == (0.0,) * 4
    assert robot.log.texts(Severity.WARN) == ['Reference timed out. Braking.']


def test_without_a_timeout_a_command_counts_once():
    robot = bench(reference_timeout=0.0)
    [warning] = robot.log.texts(Severity.WARN)
    assert 'for one update only (10 ms)' in warning
    robot.send(1.0)
    assert robot.update() == pytest.approx((10.0,) * 4)
    assert robot.update() == (0.0,) * 4


def test_an_outdated_command_is_refused_and_stops():
    robot = bench()
    robot.update(100)
    robot.drive(1.0)
    robot.send(2.0, stamp=robot.time - 600 * MS)
    assert robot.update() == (0.0,) * 4
    [error] = robot.log.texts(Severity.ERROR)
    assert 'older for 0.6000000000 which is more then allowed timeout (0.5000)' in error


def test_a_command_that_is_not_finite_is_none():
    robot = bench()
    robot.drive(1.0)
    assert robot.drive(math.nan) == (0.0,) * 4


def test_the_preceding_controller_commands_and_has_to_go_on():
    robot = bench(chained=True)
    assert [reference.name for reference in robot.controller.references()] == [
        'drive/linear/x/velocity',
        'drive/linear/y/velocity',
        'drive/angular/z/velocity',
    ]
    robot.refer(0.0, 0.0, 1.0)
    robot.send(1.0)
    assert robot.update() == pytest.approx((-5.0, 5.0, 5.0, -5.0))
    assert 'in chained mode' in robot.log.texts(Severity.WARN)[0]
    assert robot.update() == (0.0,) * 4
    assert all(math.isnan(reference.value) for reference in robot.controller.references())


def test_each_axis_has_its_limits():
    robot = bench(linear__x__max_velocity=0.5, linear__y__max_acceleration=1.0)
    assert robot.drive(1.0) == pytest.approx((5.0,) * 4)
    # 1 m/s² for 10 ms: 0.01 m/s
    assert robot.drive(0.0, 1.0) == pytest.approx((-0.1, 0.1, -0.1, 0.1))


def test_deactivation_stops_and_keeps_the_pose():
    robot = bench()
    robot.drive(1.0, seconds=1.0)
    before = robot.pose()
    robot.controller.deactivate(robot.time)
    assert robot.commanded == (0.0,) * 4
    robot.follow(PERIOD)
    robot.activate()
    robot.update()
    assert robot.pose() == before
    robot.controller.reset(0)
    robot.update()
    assert robot.pose() == (0.0, 0.0, 0.0)


def test_a_period_that_is_too_short_to_be_one_leaves_the_pose():
    robot = bench()
    robot.drive(1.0)
    before = robot.pose()
    robot.controller.update(robot.time + 1, LEAST_PERIOD - 1)
    assert robot.pose() == before


def test_a_state_that_is_not_there_leaves_the_pose():
    robot = bench()
    robot.follows = False
    robot.states['rear_left_joint/velocity'].value = math.nan
    robot.drive(1.0)
    assert robot.pose() == (0.0, 0.0, 0.0)
    assert robot.commanded == pytest.approx((10.0,) * 4)


def test_states_may_be_of_other_joints():
    robot = bench(rear_right_wheel_state_joint_name='other')
    assert robot.controller.state_interfaces().names[2] == 'other/velocity'


@pytest.mark.parametrize(
    'values, complaint',
    [
        ({'rear_left_wheel_command_joint_name': ''}, "rear_left.*' must not be empty"),
        ({'kinematics.wheels_radius': 0.0}, "wheels_radius' must be greater than 0"),
        ({'reference_timeout': -1.0}, "reference_timeout' must be at least 0"),
        ({'twist_covariance_diagonal': [0.0]}, 'must have 6 elements'),
        ({'linear.y.max_velocity': -1.0}, "linear.y.max_velocity' must be at least 0"),
    ],
)
def test_values_are_checked(values, complaint):
    with pytest.raises(ParameterError, match=complaint):
        build(MecanumDriveParameters, VALUES | values)


def test_it_is_found_by_its_type():
    kind = 'mecanum_drive_controller/MecanumDriveController'
    assert CONTROLLERS.find(kind) is MecanumDriveController
