# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
Samples of the shipped controllers → messages of ROS, and the table of these converters.

``fill_…`` writes into a message that is created once and published many times. It writes
attributes only, so that a message may be of rclpy, or a plain one.
"""

from array import array
from collections.abc import Callable
import math
from typing import Any

from amr_description.control.contracts import Port
from amr_description.control.samples import (
    AckermannSample,
    BodyOdometrySample,
    DynamicJointStateSample,
    DynamicLayout,
    EmptySample,
    Frames,
    ImuConstants,
    ImuSample,
    JointStateSample,
    MecanumStateSample,
    OdometrySample,
    SteeringStateSample,
    TwistSample,
)
from amr_description.messages import dof_writers, sensor_writers, trajectory_writers
from amr_description.messages.parts import fill_pose, fill_stamp, fill_velocity
from amr_description.messages.plain import message_like
from amr_description.messages.readers import find, Key
from amr_description.registry import resolve


def fill_twist(sample: TwistSample, message: Any) -> None:
    """Write a planar twist."""
    fill_stamp(sample.stamp, message.header.stamp)
    message.header.frame_id = sample.frame_id
    message.twist.linear.x = sample.linear
    message.twist.linear.y = sample.lateral
    message.twist.angular.z = sample.angular


def fill_text(sample: str, message: Any) -> None:
    """Write a text."""
    message.data = sample


def fill_odometry(sample: OdometrySample, message: Any) -> None:
    """Write pose, twist and, the first time, frames and covariances."""
    if message.child_frame_id != sample.frames.child_frame_id:
        _fill_constants(sample.frames, message)
    fill_stamp(sample.stamp, message.header.stamp)
    pose = message.pose.pose
    pose.position.x = sample.x
    pose.position.y = sample.y
    pose.orientation.z = math.sin(sample.heading * 0.5)
    pose.orientation.w = math.cos(sample.heading * 0.5)
    twist = message.twist.twist
    twist.linear.x = sample.linear
    twist.linear.y = sample.lateral
    twist.angular.z = sample.angular


def fill_odometry_transform(sample: OdometrySample, message: Any) -> None:
    """Write the transform from the base frame to the odometry frame."""
    if not message.transforms:
        message.transforms = [message_like(message, 'geometry_msgs/msg/TransformStamped')]
    stamped = message.transforms[0]
    fill_stamp(sample.stamp, stamped.header.stamp)
    stamped.header.frame_id = sample.frames.frame_id
    stamped.child_frame_id = sample.frames.child_frame_id
    transform = stamped.transform
    transform.translation.x = sample.x
    transform.translation.y = sample.y
    transform.rotation.z = math.sin(sample.heading * 0.5)
    transform.rotation.w = math.cos(sample.heading * 0.5)


def fill_mecanum_state(sample: MecanumStateSample, message: Any) -> None:
    """Write the wheels and the reference."""
    fill_stamp(sample.stamp, message.header.stamp)
    message.header.frame_id = sample.frame_id
    (
        message.front_left_wheel_velocity,
        message.front_right_wheel_velocity,
        message.back_right_wheel_velocity,
        message.back_left_wheel_velocity,
    ) = sample.wheels
    twist = message.reference_velocity
    twist.linear.x, twist.linear.y, twist.angular.z = sample.reference


def fill_steering_state(sample: SteeringStateSample, message: Any) -> None:
    """Write the arrays."""
    fill_stamp(sample.stamp, message.header.stamp)
    message.header.frame_id = sample.frame_id
    message.traction_wheels_position = array('d', sample.traction_positions)
    message.traction_wheels_velocity = array('d', sample.traction_velocities)
    message.steer_positions = array('d', sample.steering_positions)
    message.linear_velocity_command = array('d', sample.traction_commands)
    message.steering_angle_command = array('d', sample.steering_commands)


def fill_ackermann(sample: AckermannSample, message: Any) -> None:
    """Write an ackermann_msgs/AckermannDrive."""
    message.speed = sample.speed
    message.steering_angle = sample.steering_angle


def fill_nothing(sample: EmptySample, response: Any) -> None:
    """Leave a response without fields as it is."""


def fill_body_odometry(sample: BodyOdometrySample, message: Any) -> None:
    """Write pose, twist and, the first time, frames and covariances."""
    if message.child_frame_id != sample.frames.child_frame_id:
        _fill_constants(sample.frames, message)
    fill_stamp(sample.stamp, message.header.stamp)
    fill_pose(sample.pose, message.pose.pose)
    fill_velocity(sample.linear, sample.angular, message.twist.twist)


def fill_body_transform(sample: BodyOdometrySample, message: Any) -> None:
    """Write the transform from the body to the odometry frame."""
    if not message.transforms:
        message.transforms = [message_like(message, 'geometry_msgs/msg/TransformStamped')]
    stamped = message.transforms[0]
    fill_stamp(sample.stamp, stamped.header.stamp)
    stamped.header.frame_id = sample.frames.frame_id
    stamped.child_frame_id = sample.frames.child_frame_id
    place, turn = stamped.transform.translation, stamped.transform.rotation
    place.x, place.y, place.z = sample.pose.translation
    turn.x, turn.y, turn.z, turn.w = sample.pose.rotation


def fill_joint_state(sample: JointStateSample, message: Any) -> None:
    """Write the arrays of numbers and, when they have changed, the names."""
    fill_stamp(sample.stamp, message.header.stamp)
    if message.name is not sample.name:
        message.header.frame_id = sample.frame_id
        message.name = sample.name
    message.position = array('d', sample.position)
    message.velocity = array('d', sample.velocity)
    message.effort = array('d', sample.effort)


def fill_dynamic_joint_state(sample: DynamicJointStateSample, message: Any) -> None:
    """Write the values and, when they have changed, the names."""
    if message.joint_names is not sample.layout.names:
        _fill_names(sample.layout, message)
    fill_stamp(sample.stamp, message.header.stamp)
    for interfaces, values in zip(message.interface_values, sample.values, strict=True):
        interfaces.values = array('d', values)


def fill_imu(sample: ImuSample, message: Any) -> None:
    """Write what is measured and, the first time, frame and covariances."""
    if message.header.frame_id != sample.constants.frame_id:
        _fill_imu_constants(sample.constants, message)
    fill_stamp(sample.stamp, message.header.stamp)
    orientation = message.orientation
    orientation.x, orientation.y, orientation.z, orientation.w = sample.orientation
    for vector, values in (
        (message.angular_velocity, sample.angular_velocity),
        (message.linear_acceleration, sample.linear_acceleration),
    ):
        vector.x, vector.y, vector.z = values


def _fill_constants(frames: Frames, message: Any) -> None:
    message.header.frame_id = frames.frame_id
    message.child_frame_id = frames.child_frame_id
    for covariance, variances in (
        (message.pose.covariance, frames.pose_variances),
        (message.twist.covariance, frames.twist_variances),
    ):
        for axis, variance in enumerate(variances):
            covariance[7 * axis] = variance


def _fill_names(layout: DynamicLayout, message: Any) -> None:
    message.header.frame_id = layout.frame_id
    message.joint_names = layout.names
    message.interface_values = [
        message_like(message, _INTERFACES, interface_names=row) for row in layout.interfaces
    ]


def _fill_imu_constants(constants: ImuConstants, message: Any) -> None:
    message.header.frame_id = constants.frame_id
    message.orientation_covariance = constants.orientation_covariance
    message.angular_velocity_covariance = constants.angular_velocity_covariance
    message.linear_acceleration_covariance = constants.linear_acceleration_covariance


_INTERFACES = 'control_msgs/msg/InterfaceValue'
WRITERS: dict[Key, Callable[[Any, Any], None]] = {
    (AckermannSample, 'ackermann_msgs/msg/AckermannDrive'): fill_ackermann,
    (BodyOdometrySample, 'nav_msgs/msg/Odometry'): fill_body_odometry,
    (BodyOdometrySample, 'tf2_msgs/msg/TFMessage'): fill_body_transform,
    (DynamicJointStateSample, 'control_msgs/msg/DynamicJointState'): fill_dynamic_joint_state,
    (EmptySample, 'std_srvs/srv/Empty_Response'): fill_nothing,
    (ImuSample, 'sensor_msgs/msg/Imu'): fill_imu,
    (JointStateSample, 'sensor_msgs/msg/JointState'): fill_joint_state,
    (MecanumStateSample, 'control_msgs/msg/MecanumDriveControllerState'): fill_mecanum_state,
    (OdometrySample, 'nav_msgs/msg/Odometry'): fill_odometry,
    (OdometrySample, 'tf2_msgs/msg/TFMessage'): fill_odometry_transform,
    (SteeringStateSample, 'control_msgs/msg/SteeringControllerStatus'): fill_steering_state,
    (TwistSample, 'geometry_msgs/msg/TwistStamped'): fill_twist,
    (str, 'std_msgs/msg/String'): fill_text,
    **dof_writers.WRITERS,
    **sensor_writers.WRITERS,
    **trajectory_writers.WRITERS,
}


def writer_of(port: Port) -> Callable[[Any, Any], None]:
    """Return ``(sample, message) -> None`` of an output. Raises whatever finding it raises."""
    if port.convert:
        found: Callable[[Any, Any], None] = resolve(port.convert)
        return found
    return find(WRITERS, port)
