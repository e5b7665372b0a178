# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""Samples as messages: what is written each time, and what only once."""

import math

from control_msgs.msg import (
    DynamicJointState,
    MecanumDriveControllerState,
    SteeringControllerStatus,
)
from geometry_msgs.msg import Twist, TwistStamped
from nav_msgs.msg import Odometry
import pytest
from rclpy.serialization import deserialize_message, serialize_message
from sensor_msgs.msg import Imu, JointState
from std_msgs.msg import Float64MultiArray
from support.control_fakes import FakeLog

from amr_description.control.contracts import ControllerContext, Port
from amr_description.control.samples import (
    CommandsSample,
    DynamicJointStateSample,
    DynamicLayout,
    Frames,
    ImuConstants,
    ImuSample,
    JointStateSample,
    MecanumStateSample,
    OdometrySample,
    SteeringStateSample,
    TwistSample,
)
from amr_description.controllers import CONTROLLERS
from amr_description.errors import ControllerError
from amr_description.messages import readers, writers
from amr_description.parameters import build
from amr_description.ros.message_types import message_type

STAMP = 3_000_000_007
LAYOUT = DynamicLayout('base', ('wheel', 'imu'), (('position', 'velocity'), ('gyro.x',)))


def sent(message):
    """What arrives at the other end."""
    return deserialize_message(serialize_message(message), type(message))


def dynamic(values, layout=LAYOUT, stamp=STAMP):
    return DynamicJointStateSample(stamp, values, layout)


def test_joint_states_arrive_as_they_were():
    message = JointState()
    sample = JointStateSample(STAMP, 'base', ('a', 'b'), (1.0, 2.0), (3.0, math.nan), (5.0, 6.0))
    writers.fill_joint_state(sample, message)
    arrived = sent(message)
    assert (arrived.header.stamp.sec, arrived.header.stamp.nanosec) == (3, 7)
    assert arrived.header.frame_id == 'base'
    assert arrived.name == ['a', 'b']
    assert list(arrived.position) == [1.0, 2.0]
    assert arrived.velocity[0] == 3.0
    assert math.isnan(arrived.velocity[1])
    assert list(arrived.effort) == [5.0, 6.0]


def test_joint_names_that_change_are_written_again():
    message = JointState()
    for name in (('a', 'b'), ('b', 'a')):
        zeros = (0.0, 0.0)
        sample = JointStateSample(STAMP, 'base', name, zeros, zeros, zeros)
        writers.fill_joint_state(sample, message)
        assert sent(message).name == list(name)


def test_dynamic_joint_states_arrive_as_they_were():
    message = DynamicJointState()
    writers.fill_dynamic_joint_state(dynamic(((1.0, 2.0), (3.0,))), message)
    arrived = sent(message)
    assert (arrived.header.stamp.sec, arrived.header.frame_id) == (3, 'base')
    assert arrived.joint_names == ['wheel', 'imu']
    assert [row.interface_names for row in arrived.interface_values] == [
        ['position', 'velocity'],
        ['gyro.x'],
    ]
    assert [list(row.values) for row in arrived.interface_values] == [[1.0, 2.0], [3.0]]


def test_only_values_and_stamp_of_a_dynamic_joint_state_are_written_again():
    message = DynamicJointState()
    writers.fill_dynamic_joint_state(dynamic(((1.0, 2.0), (3.0,))), message)
    rows = message.interface_values
    writers.fill_dynamic_joint_state(dynamic(((4.0, 5.0), (6.0,)), stamp=0), message)
    assert message.interface_values is rows
    arrived = sent(message)
    assert [list(row.values) for row in arrived.interface_values] == [[4.0, 5.0], [6.0]]
    assert arrived.header.stamp.sec == 0


def test_other_interfaces_of_the_same_joints_are_written_again():
    message = DynamicJointState()
    writers.fill_dynamic_joint_state(dynamic(((1.0, 2.0), (3.0,))), message)
    names = ('wheel', 'imu')
    other = DynamicLayout('map', tuple(list(names)), (('effort',), ('gyro.x', 'gyro.y')))
    writers.fill_dynamic_joint_state(dynamic(((1.0,), (3.0, 4.0)), other), message)
    arrived = sent(message)
    assert arrived.header.frame_id == 'map'
    assert [row.interface_names for row in arrived.interface_values] == [
        ['effort'],
        ['gyro.x', 'gyro.y'],
    ]


def test_commands_are_the_plain_list_of_numbers():
    message = Float64MultiArray(data=[1.0, -2.5])
    assert readers.commands_sample(sent(message)) == CommandsSample((1.0, -2.5))


def test_an_imu_message_arrives_as_it_was():
    covariances = [tuple(first + i for i in range(9)) for first in (0.0, 10.0, 20.0)]
    constants = ImuConstants('imu_link', *covariances)
    message = Imu()
    for stamp in (0, STAMP):
        sample = ImuSample(
            stamp, (0.1, 0.2, 0.3, 0.4), (1.0, 2.0, 3.0), (4.0, 5.0, 6.0), constants
        )
        writers.fill_imu(sample, message)
    arrived = sent(message)
    assert (arrived.header.stamp.sec, arrived.header.frame_id) == (3, 'imu_link')
    orientation = arrived.orientation
    assert (orientation.x, orientation.y, orientation.z, orientation.w) == (0.1, 0.2, 0.3, 0.4)
    assert (arrived.angular_velocity.x, arrived.angular_velocity.z) == (1.0, 3.0)
    assert (arrived.linear_acceleration.y, arrived.linear_acceleration.z) == (5.0, 6.0)
    found = (
        arrived.orientation_covariance,
        arrived.angular_velocity_covariance,
        arrived.linear_acceleration_covariance,
    )
    assert [tuple(covariance) for covariance in found] == covariances


def test_a_twist_and_odometry_have_their_part_to_the_left():
    message = TwistStamped()
    message.twist.linear.x, message.twist.linear.y, message.twist.angular.z = 1.0, 2.0, 3.0
    sample = readers.twist_sample(sent(message))
    assert sample == TwistSample(0, 1.0, 3.0, '', 2.0)
    again = TwistStamped()
    writers.fill_twist(sample, again)
    assert again == message
    frames = Frames('odom', 'base', (0.0,) * 6, (0.0,) * 6)
    odometry = Odometry()
    writers.fill_odometry(OdometrySample(0, 1, 2, 0, 3.0, 4.0, frames, 5.0), odometry)
    assert sent(odometry).twist.twist.linear.y == 5.0


def test_the_state_of_mecanum_wheels_names_each_wheel():
    message = MecanumDriveControllerState()
    sample = MecanumStateSample(STAMP, 'odom', (1.0, 2.0, 3.0, 4.0), (0.1, 0.2, 0.3))
    writers.fill_mecanum_state(sample, message)
    arrived = sent(message)
    assert (arrived.header.stamp.sec, arrived.header.frame_id) == (3, 'odom')
    assert arrived.front_left_wheel_velocity == 1.0
    assert arrived.front_right_wheel_velocity == 2.0
    assert arrived.back_right_wheel_velocity == 3.0
    assert arrived.back_left_wheel_velocity == 4.0
    twist = arrived.reference_velocity
    assert (twist.linear.x, twist.linear.y, twist.angular.z) == (0.1, 0.2, 0.3)


def test_the_state_of_steered_wheels_arrives_as_it_was():
    message = SteeringControllerStatus()
    sample = SteeringStateSample(STAMP, 'odom', (), (1.0, 2.0), (0.1, 0.2), (3.0, 4.0), (0.3, 0.4))
    writers.fill_steering_state(sample, message)
    arrived = sent(message)
    assert (arrived.header.stamp.nanosec, arrived.header.frame_id) == (7, 'odom')
    assert list(arrived.traction_wheels_position) == []
    assert list(arrived.traction_wheels_velocity) == [1.0, 2.0]
    assert list(arrived.steer_positions) == [0.1, 0.2]
    assert list(arrived.linear_velocity_command) == [3.0, 4.0]
    assert list(arrived.steering_angle_command) == [0.3, 0.4]


@pytest.mark.parametrize(
    ('controller', 'values'),
    [
        ('joint_state_broadcaster/JointStateBroadcaster', {}),
        (
            'forward_command_controller/ForwardCommandController',
            {'joints': ['a'], 'interface_name': 'velocity'},
        ),
        (
            'imu_sensor_broadcaster/IMUSensorBroadcaster',
            {'sensor_name': 'imu', 'frame_id': 'imu_link'},
        ),
        (
            'mecanum_drive_controller/MecanumDriveController',
            {
                **{
                    f'{corner}_wheel_command_joint_name': corner
                    for corner in ('front_left', 'front_right', 'rear_right', 'rear_left')
                },
                'kinematics.wheels_radius': 0.1,
                'kinematics.sum_of_robot_center_projection_on_X_Y_axis': 0.5,
            },
        ),
        (
            'tricycle_controller/TricycleController',
            {
                'traction_joint_name': 'a',
                'steering_joint_name': 'b',
                'wheelbase': 1.0,
                'wheel_radius': 0.1,
            },
        ),
        (
            'bicycle_steering_controller/BicycleSteeringController',
            {
                'traction_joints_names': ['a'],
                'steering_joints_names': ['b'],
                'wheelbase': 1.0,
                'traction_wheel_radius': 0.1,
            },
        ),
    ],
)
def test_the_converters_of_every_port_exist(controller, values):
    found = CONTROLLERS.find(controller)
    made = found(ControllerContext('made', FakeLog()))
    made.configure(build(found.parameters_type, values))
    functions = [
        *((readers.reader_of(each.port), each.port) for each in made.inputs()),
        *((writers.writer_of(each.port), each.port) for each in made.outputs()),
    ]
    assert functions
    for function, port in functions:
        assert callable(function)
        assert message_type(port.message)()


@pytest.mark.parametrize(
    ('find', 'port', 'sample'),
    [
        (readers.reader_of, Port('~/in', 'sensor_msgs/msg/Imu', sample=ImuSample), 'ImuSample'),
        (writers.writer_of, Port('~/out', 'sensor_msgs/msg/Imu'), 'no type of sample'),
    ],
)
def test_a_port_without_a_converter_is_explained(find, port, sample):
    with pytest.raises(ControllerError) as caught:
        find(port)
    assert str(caught.value) == (
        f"There is no converter for '{port.name}' (sensor_msgs/msg/Imu, {sample}); name one as "
        "convert='module:function' of its Port"
    )


@pytest.mark.parametrize('count', [0, 1, 40])
def test_any_number_of_joints_goes(count):
    names = tuple(f'joint_{i}' for i in range(count))
    values = tuple((float(i),) for i in range(count))
    message = DynamicJointState()
    layout = DynamicLayout('', names, (('position',),) * count)
    writers.fill_dynamic_joint_state(dynamic(values, layout), message)
    assert [row.values[0] for row in sent(message).interface_values] == list(range(count))


def test_a_plain_twist_has_no_stamp_and_keeps_the_planar_part():
    message = Twist()
    message.linear.x, message.linear.y, message.angular.z = 0.5, 9.0, -0.25
    assert readers.unstamped_twist_sample(message) == TwistSample(0, 0.5, -0.25, lateral=9.0)
