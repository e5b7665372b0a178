# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""The controllers that stand for Gazebo's plugins: drive, moved body, true odometry."""

import math

import pytest
from support.control_fakes import collect, FakeLog, MS

from amr_description.control.contracts import ControllerContext
from amr_description.control.interfaces import CommandInterface, StateInterface
from amr_description.control.samples import CommandsSample, TwistSample
from amr_description.controllers import CONTROLLERS
from amr_description.errors import ControllerError
from amr_description.model.frames import quaternion_from_rpy, Transform
from amr_description.parameters import build

PERIOD = 10 * MS
WHEELS = {
    'left_wheel_names': ['left'],
    'right_wheel_names': ['right'],
    'wheel_separation': 0.5,
    'wheel_radius': 0.1,
}


def controller(kind, **values):
    found = CONTROLLERS.find(f'amr_description/{kind}')
    made = found(ControllerContext('c', FakeLog()))
    made.configure(build(found.parameters_type, values))
    return made


class Drive:
    """Two wheels that do not turn, for the commands only."""

    def __init__(self, **values):
        self.drive = controller('GazeboDiffDrive', **WHEELS, **values)
        self.wheels = [CommandInterface(side, 'velocity') for side in ('left', 'right')]
        self.states = [StateInterface(side, 'position', 0.0) for side in ('left', 'right')]
        self.time = 0
        self.sent = [collect(output) for output in self.drive.outputs()]
        self.drive.activate(self.wheels, self.states, 0)
        self.drive.inputs()[0].open()

    def update(self, count=1):
        for _ in range(count):
            self.time += PERIOD
            self.drive.update(self.time, PERIOD)
        return [wheel.value for wheel in self.wheels]

    def command(self, linear, angular=0.0):
        assert self.drive.inputs()[0].put(TwistSample(0, linear, angular))


def test_a_drive_takes_plain_twists_until_the_next_one():
    bench = Drive()
    port, _ = bench.drive.inputs()
    assert (port.port.name, port.port.message) == ('~/cmd_vel', 'geometry_msgs/msg/Twist')
    bench.command(0.4, 0.8)
    assert bench.update() == pytest.approx([2.0, 6.0])
    assert bench.update(1000) == pytest.approx([2.0, 6.0])
    bench.command(0.0)
    assert bench.update() == [0.0, 0.0]


def test_a_drive_is_at_rest_and_publishes_before_the_first_command():
    bench = Drive()
    assert bench.update(10) == [0.0, 0.0]
    odometry, transform = bench.sent
    assert odometry[0].stamp == transform[0].stamp == PERIOD
    assert (odometry[-1].x, odometry[-1].linear) == (0.0, 0.0)


def test_the_rim_of_a_wheel_accelerates_within_its_limit():
    bench = Drive(max_wheel_acceleration=2.0)
    bench.command(0.05)
    assert bench.update() == pytest.approx([0.2, 0.2])  # 2 m/s² for 10 ms, by a radius of 0.1 m
    assert bench.update(2) == pytest.approx([0.5, 0.5])
    bench.command(-1.0)
    assert bench.update() == pytest.approx([0.3, 0.3])


@pytest.mark.parametrize('odom', [True, False])
@pytest.mark.parametrize('transform', [True, False])
def test_a_drive_publishes_what_is_wanted(odom, transform):
    drive = controller('GazeboDiffDrive', **WHEELS, publish_odom=odom, enable_odom_tf=transform)
    names = [output.port.name for output in drive.outputs()]
    assert names == ['~/odom'] * odom + ['/tf'] * transform


CORNERS = ('front_left', 'front_right', 'rear_right', 'rear_left')
MECANUM = {
    **{f'{corner}_wheel_command_joint_name': corner for corner in CORNERS},
    'kinematics.wheels_radius': 0.1,
    'kinematics.sum_of_robot_center_projection_on_X_Y_axis': 0.5,
}
CAR = {
    'traction_joints_names': ['tr', 'tl'],
    'steering_joints_names': ['sr', 'sl'],
    'wheelbase': 1.0,
    'traction_track_width': 0.5,
    'steering_track_width': 0.5,
    'traction_wheels_radius': 0.1,
}


def driven(kind, twist, **values):
    """The commands for a twist, after a while without another one, and those at rest."""
    drive = controller(kind, **values)
    commands, states = (
        [kind_of(*name.split('/'), 0.0) for name in request.names]
        for kind_of, request in (
            (CommandInterface, drive.command_interfaces()),
            (StateInterface, drive.state_interfaces()),
        )
    )
    drive.activate(commands, states, 0)
    drive.update(PERIOD, PERIOD)
    rest = [each.value for each in commands]
    port, _ = drive.inputs()
    assert (port.port.name, port.port.message) == ('~/cmd_vel', 'geometry_msgs/msg/Twist')
    port.open()
    port.put(TwistSample(0, *twist))
    for time in range(2, 1000):
        drive.update(time * PERIOD, PERIOD)
        for command in commands:
            for state in states:
                if state.name == command.name:
                    state.value = command.value
    return [each.value for each in commands], rest


def test_mecanum_wheels():
    speeds, rest = driven('GazeboMecanumDrive', (0.1, 0.2, '', 0.05), **MECANUM)
    assert speeds == pytest.approx([-0.5, 2.5, 1.5, 0.5])
    assert rest == [0.0] * 4


def test_a_car():
    (right, left, steer_right, steer_left), rest = driven(
        'GazeboAckermannDrive', (0.5, 0.25), **CAR
    )
    assert (right, left) == pytest.approx((5.625, 4.375))
    assert (steer_right, steer_left) == pytest.approx((math.atan(1 / 2.25), math.atan(1 / 1.75)))
    assert rest[:2] == [0.0, 0.0]


@pytest.mark.parametrize('angle, steered', [(0.3, 0.3), (-2.0, -0.4)])
def test_a_car_of_classic_takes_the_angle_of_its_tyres(angle, steered):
    values = {'angular_is_steering': True, 'max_steer': 0.4}
    (right, left, *_), _ = driven('GazeboAckermannDrive', (0.5, angle), **CAR, **values)
    turn = 0.5 * math.tan(steered)
    assert (right, left) == pytest.approx((5.0 + 2.5 * turn, 5.0 - 2.5 * turn))


def test_joints_follow_one_number():
    forward = controller('GazeboJointCommand', joints=['a', 'b'])
    commands = [CommandInterface(*name.split('/')) for name in forward.command_interfaces().names]
    forward.activate(commands, (), 0)
    (port,) = forward.inputs()
    port.open()
    forward.update(PERIOD, PERIOD)
    assert math.isnan(commands[0].value)
    port.put(CommandsSample((0.7,)))
    forward.update(PERIOD, PERIOD)
    port.put(CommandsSample((math.inf,)))
    forward.update(PERIOD, PERIOD)
    assert [each.value for each in commands] == [0.7, 0.7]


def test_a_body_is_moved_by_the_latest_command():
    move = controller('GazeboPlanarMove')
    commands = [CommandInterface(*name.split('/')) for name in move.command_interfaces().names]
    assert [each.interface for each in commands] == ['linear.x', 'linear.y', 'angular.z']
    move.activate(commands, (), 0)
    assert [each.value for each in commands] == [0.0, 0.0, 0.0]
    port, _ = move.inputs()
    port.open()
    port.put(TwistSample(0, 9.0, 9.0))
    port.put(TwistSample(0, 0.1, 0.3, lateral=0.2))
    for time in (PERIOD, 10_000 * PERIOD):
        move.update(time, PERIOD)
        assert [each.value for each in commands] == [0.1, 0.2, 0.3]
    port.put(TwistSample(0, math.nan, 0.0))
    move.update(PERIOD, PERIOD)
    assert commands[0].value == 0.1
    move.reset(0)
    assert [each.value for each in commands] == [0.0, 0.0, 0.0]
    move.deactivate(0)
    with pytest.raises(ControllerError, match='Expected 3 command interfaces, got 2'):
        move.activate(commands[:2], (), 0)


QUARTER = quaternion_from_rpy(0.0, 0.0, math.pi / 2)


def odometry_of(rotation, linear=(1.0, 2.0, 0.5), **values):
    """The odometry of a link at (1, 2, 3) that moves with ``linear``, turning at (0, 0.1, 0.2)."""
    publisher = controller('GazeboOdometryPublisher', link='l', **values)
    values = (1.0, 2.0, 3.0, *rotation, *linear, 0.0, 0.1, 0.2)
    names = [name.rpartition('/') for name in publisher.state_interfaces().names]
    assert names[0] == ('l/ground_truth', '/', 'position.x')
    states = [StateInterface(p, i, v) for (p, _, i), v in zip(names, values, strict=True)]
    sent = [collect(output) for output in publisher.outputs()]
    publisher.activate((), states, 0)
    for time in range(1, 11):
        publisher.update(time * PERIOD, PERIOD)
    return sent


def test_the_truth_is_published_at_its_rate():
    odometry, transform = odometry_of(QUARTER, publish_rate=25.0)
    assert odometry == transform and len(odometry) == 3
    assert odometry[0].pose == Transform((1.0, 2.0, 3.0), QUARTER)
    assert odometry[0].linear == (1.0, 2.0, 0.5) and odometry[0].angular == (0.0, 0.1, 0.2)


def test_flat_truth_and_twists_in_the_world():
    tilted = quaternion_from_rpy(0.1, 0.2, math.pi / 2)
    odometry, _ = odometry_of(tilted, dimensions=2)
    assert odometry[0].pose.translation == (1.0, 2.0, 0.0)
    assert odometry[0].pose.rotation == pytest.approx(QUARTER, abs=1e-12)
    assert odometry[0].linear == (1.0, 2.0, 0.0) and odometry[0].angular == (0.0, 0.0, 0.2)
    odometry, _ = odometry_of(QUARTER, twist_in_world=True)
    assert odometry[0].linear == pytest.approx((-2.0, 1.0, 0.5))


@pytest.mark.parametrize('in_world, x, y', [(False, 1.0, 3.0), (True, 2.0, 2.0)])
def test_offsets(in_world, x, y):
    offset = {'offset.xyz': [1.0, 0.0, 0.0], 'offset.in_world': in_world}
    odometry, _ = odometry_of(QUARTER, **offset)
    assert odometry[0].pose.translation == pytest.approx((x, y, 3.0))
