# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""The steering controllers: commands, odometry, chain, topics, deprecated parameters."""

import math

import pytest
from support.control_fakes import FakeLog, MS
from support.wheel_bench import PERIOD, WheelBench

from amr_description.controllers import CONTROLLERS
from amr_description.controllers.drives.steering_kinematics import (
    AckermannKinematics,
    BicycleKinematics,
    TricycleKinematics,
)
from amr_description.errors import ControllerError, ParameterError
from amr_description.log import Severity
from amr_description.parameters import build

BICYCLE = {
    'traction_joints_names': ['rear'],
    'steering_joints_names': ['steer'],
    'wheelbase': 1.0,
    'traction_wheel_radius': 0.1,
}
TRICYCLE = {
    'traction_joints_names': ['right', 'left'],
    'steering_joints_names': ['steer'],
    'wheelbase': 1.0,
    'traction_wheels_radius': 0.1,
    'traction_track_width': 0.8,
}
ACKERMANN = TRICYCLE | {'steering_joints_names': ['steer_right', 'steer_left']}
LAYOUTS = {'bicycle': BICYCLE, 'tricycle': TRICYCLE, 'ackermann': ACKERMANN}


def controller_of(layout):
    name = f'{layout}_steering_controller/{layout.capitalize()}SteeringController'
    return CONTROLLERS.find(name)


def bench(layout, chained=False, **values):
    return WheelBench(controller_of(layout), LAYOUTS[layout] | values, chained=chained)


@pytest.mark.parametrize('layout', LAYOUTS)
@pytest.mark.parametrize('source', ['position', 'velocity', 'open loop'])
def test_a_circle_closes(layout, source):
    robot = bench(layout, position_feedback=source == 'position', open_loop=source == 'open loop')
    robot.drive(math.pi / 2, angular=math.pi / 4, seconds=4.01)
    x, y, heading = robot.pose()
    # Half of a circle of radius 2 m about (0, 2).
    assert (x, y, heading) == pytest.approx((0.0, 4.0, math.pi), abs=0.05)
    robot.drive(math.pi / 2, angular=math.pi / 4, seconds=4.0)
    later = robot.pose()
    assert later[2] - heading == pytest.approx(math.pi, abs=1e-6)
    assert math.hypot(later[0] - x, later[1] - y) == pytest.approx(4.0, abs=1e-4)
    odometry = robot.sent['~/odometry'][-1]
    assert (odometry.linear, odometry.angular) == pytest.approx((math.pi / 2, math.pi / 4))


def test_wheels_that_do_not_begin_at_zero_make_no_jump():
    robot = bench('ackermann', position_feedback=True)
    for state in robot.states.values():
        state.value = 0.0 if 'steer' in state.name else 1000.0
    robot.update(3)
    assert robot.pose() == (0.0, 0.0, 0.0)


def test_a_command_times_out_and_the_steering_stays():
    robot = bench('ackermann', reference_timeout=0.1)
    robot.send(1.0, angular=0.5)
    driven = robot.update(10)
    assert driven[0] > driven[1] > 0.0
    stopped = robot.update(2)
    assert stopped[:2] == (0.0, 0.0)
    assert stopped[2:] == driven[2:]
    assert 0.0 < stopped[2] < stopped[3]
    assert robot.log.texts(Severity.WARN) == ['Reference timed out. Braking.']


def test_an_outdated_command_is_refused_and_the_one_in_force_stays():
    robot = bench('bicycle')
    robot.update(200)
    robot.drive(1.0)
    robot.send(2.0, stamp=robot.time - 1100 * MS)
    assert robot.update()[0] == pytest.approx(10.0)
    [error] = robot.log.texts(Severity.ERROR)
    assert 'which is more then allowed timeout (1.0000)' in error


def test_without_a_timeout_a_command_counts_once():
    robot = bench('bicycle', reference_timeout=0.0)
    robot.send(1.0)
    assert robot.update()[0] == pytest.approx(10.0)
    assert robot.update()[0] == 0.0


def test_a_command_that_is_not_finite_is_none():
    robot = bench('bicycle')
    robot.drive(1.0, angular=0.5)
    stopped = robot.drive(1.0, angular=math.nan)
    assert stopped == (0.0, pytest.approx(math.atan(0.5)))


def test_the_preceding_controller_commands_and_has_to_go_on():
    robot = bench('tricycle', chained=True)
    names = [reference.name for reference in robot.controller.references()]
    assert names == ['drive/linear/velocity', 'drive/angular/velocity']
    robot.refer(1.0, 0.0)
    robot.send(2.0)
    assert robot.update() == pytest.approx((10.0, 10.0, 0.0))
    assert 'in chained mode' in robot.log.texts(Severity.WARN)[0]
    assert robot.update() == (0.0, 0.0, 0.0)


def test_open_loop_odometry_stands_without_a_command():
    robot = bench('ackermann', open_loop=True)
    robot.drive(1.0)
    before = robot.pose()
    assert before[0] == pytest.approx(0.01)
    robot.update(200)
    assert robot.pose()[0] == pytest.approx(1.01)  # until the timeout of 1 s
    assert robot.sent['~/odometry'][-1].linear == 0.0


def test_it_drives_slowly_until_the_steering_angle_is_reached():
    robot = bench('bicycle', reduce_wheel_speed_until_steering_reached=True)
    robot.follows = False
    speed, angle = robot.drive(1.0, angular=10.0)
    assert angle == pytest.approx(math.atan(10.0))
    assert speed == pytest.approx(10.0 * math.cos(angle) / math.cos(math.pi / 6))


@pytest.mark.parametrize('feedback', ['position', 'velocity'])
def test_topics_and_states(feedback):
    robot = bench('ackermann', position_feedback=feedback == 'position', tf_odometry_topic='/tf')
    assert set(robot.sent) == {'~/odometry', '/tf', '~/controller_state'}
    robot.drive(1.0, angular=0.5)
    robot.update()
    state = robot.sent['~/controller_state'][-1]
    commanded = robot.commanded
    assert state.traction_commands == commanded[:2]
    assert state.steering_commands == state.steering_positions == commanded[2:]
    read = (state.traction_positions, state.traction_velocities)
    assert [len(each) for each in read] == ([2, 0] if feedback == 'position' else [0, 2])
    odometry = robot.sent['/tf'][-1]
    assert odometry.frames.pose_variances == (0.0, 7.0, 14.0, 21.0, 28.0, 35.0)
    assert (odometry.frames.frame_id, odometry.frames.child_frame_id) == ('odom', 'base_link')


def test_deactivation_stops_and_a_reset_goes_to_the_origin():
    robot = bench('bicycle')
    robot.drive(1.0, angular=0.5, seconds=1.0)
    robot.controller.deactivate(robot.time)
    assert robot.commanded == (0.0, pytest.approx(math.atan(0.5)))
    robot.follow(PERIOD)
    robot.activate()
    before = robot.pose()
    robot.update()
    assert robot.pose() == before
    robot.controller.reset(0)
    robot.update()
    assert robot.pose() == (0.0, 0.0, 0.0)


@pytest.mark.parametrize(
    ('layout', 'values', 'complaint'),
    [
        (
            'bicycle',
            {'traction_joints_names': []},
            'Bicycle configuration requires exactly one traction joint, but 0 were provided',
        ),
        (
            'tricycle',
            {'traction_joints_names': ['a']},
            'Tricycle configuration requires exactly two traction joints, but 1 were provided',
        ),
        (
            'ackermann',
            {'steering_joints_names': ['a']},
            'Ackermann configuration requires exactly two steering joints, but 1 were provided',
        ),
        (
            'ackermann',
            {'steering_joints_state_names': ['a']},
            'two steering joints, but 1 state interface names were provided',
        ),
        (
            'ackermann',
            {'traction_track_width': 0.0},
            "parameter 'traction_track_width' is not set, cannot configure odometry",
        ),
        ('bicycle', {'traction_wheel_radius': 0.0}, "'traction_wheel_radius' is not set"),
    ],
)
def test_joints_and_sizes_have_to_fit(layout, values, complaint):
    with pytest.raises(ControllerError, match=complaint):
        bench(layout, **values)


@pytest.mark.parametrize(
    ('values', 'complaint'),
    [
        ({'wheelbase': 0.0}, "'wheelbase' must be greater than 0"),
        ({'traction_joints_names': list('abcde')}, 'must have fewer than 5 elements'),
        ({'traction_joints_names': ['a', 'a']}, 'must not hold anything twice'),
        ({'traction_track_width': -1.0}, "'traction_track_width' must be at least 0"),
    ],
)
def test_values_are_checked(values, complaint):
    with pytest.raises(ParameterError, match=complaint):
        build(controller_of('ackermann').parameters_type, ACKERMANN | values)


# --- deprecated parameters -----------------------------------------------------------------------


def modernized(layout, **values):
    log = FakeLog()
    table = build(controller_of(layout).parameters_type, values)
    return table.modernized(log), log.texts(Severity.WARN)


@pytest.mark.parametrize('front_steering', [True, False])
def test_front_and_rear_become_steering_and_traction(front_steering):
    table, warnings = modernized(
        'ackermann',
        front_steering=front_steering,
        front_wheels_names=['a', 'b'],
        rear_wheels_names=['c', 'd'],
        front_wheels_state_names=['e', 'f'],
        rear_wheels_state_names=['g', 'h'],
        front_wheels_radius=0.1,
        rear_wheels_radius=0.2,
        front_wheel_track=0.3,
        rear_wheel_track=0.4,
        wheelbase=1.0,
    )
    front = (table.steering_joints_names, table.steering_joints_state_names)
    rear = (table.traction_joints_names, table.traction_joints_state_names)
    if not front_steering:
        front, rear = rear, front
    assert front == (('a', 'b'), ('e', 'f'))
    assert rear == (('c', 'd'), ('g', 'h'))
    tracks = (0.4, 0.3) if front_steering else (0.3, 0.4)
    radius = 0.2 if front_steering else 0.1
    assert table.kinematics() == AckermannKinematics(1.0, radius, *tracks)
    expected = [
        "DEPRECATED parameter 'front_wheels_names', set 'traction_joints_names' or "
        "'steering_joints_names' instead",
        "DEPRECATED parameter 'rear_wheels_state_names', set 'traction_joints_state_names' or "
        "'steering_joints_state_names' instead",
        "DEPRECATED parameter 'rear_wheel_radius', set 'traction_wheels_radius' instead",
        "DEPRECATED parameter 'front_wheel_track', set 'traction_track_width' or "
        "'steering_track_width' instead",
    ]
    assert set(expected) < set(warnings)
    switch = [line for line in warnings if "'front_steering'" in line]
    assert len(switch) == (0 if front_steering else 1)


def test_sizes_of_the_bicycle_and_the_tricycle():
    table, warnings = modernized('bicycle', wheelbase=1.0, rear_wheel_radius=0.3)
    assert table.kinematics() == BicycleKinematics(1.0, 0.3)
    assert warnings == [
        "DEPRECATED parameter 'rear_wheel_radius', set 'traction_wheel_radius' instead"
    ]
    table, warnings = modernized(
        'tricycle', wheelbase=1.0, wheel_track=0.5, front_wheels_radius=0.1
    )
    assert table.kinematics() == TricycleKinematics(1.0, 0.1, 0.5)
    assert warnings[-1] == (
        "DEPRECATED parameter 'wheel_track', set 'traction_track_width' instead"
    )


def test_a_steering_track_that_is_not_set_is_that_of_the_driven_wheels():
    table, warnings = modernized('ackermann', **ACKERMANN)
    assert table.kinematics() == AckermannKinematics(1.0, 0.1, 0.8, 0.8)
    assert warnings == []
