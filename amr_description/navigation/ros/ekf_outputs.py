# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""What a filter publishes: its state as messages, and the publishers for them."""

from collections.abc import Sequence

from diagnostic_msgs.msg import DiagnosticArray, DiagnosticStatus, KeyValue
from geometry_msgs.msg import (
    AccelWithCovarianceStamped,
    TransformStamped,
)
from nav_msgs.msg import Odometry
import numpy as np
from rclpy.node import Node
from rclpy.publisher import Publisher
from rclpy.qos import QoSProfile
from rclpy.qos_overriding_options import QoSOverridingOptions

from amr_description.model.frames import quaternion_from_rpy, Transform, Vector
from amr_description.navigation.ekf import (
    ACCELERATION,
    ANGLES,
    Array,
    Ekf,
    POSE,
    POSITION,
    TURN_RATE,
    TWIST,
    VELOCITY,
)
from amr_description.navigation.ekf_diagnostics import EkfStatus
from amr_description.navigation.ekf_estimator import Estimator
from amr_description.navigation.ekf_parameters import EkfParameters
from amr_description.ros.messages import (
    fill_pose,
    fill_stamp,
    fill_velocity,
    nanoseconds,
    transform_of,
)
from amr_description.tf2_ros.broadcaster import TransformBroadcaster
from amr_description.tf2_ros.buffer import transform_message
from amr_description.tf2_ros.time_cache import StampedTransform


class Outputs:
    """The publishers of a filter."""

    def __init__(
        self, node: Node, parameters: EkfParameters, overriding: QoSOverridingOptions
    ) -> None:
        """``overriding``: which QoS parameters there are."""
        self._parameters = parameters
        self.odometry: Publisher = node.create_publisher(
            Odometry, 'odometry/filtered', QoSProfile(depth=10), qos_overriding_options=overriding
        )
        self.acceleration: Publisher | None = None
        if parameters.is_on('publish_acceleration'):
            self.acceleration = node.create_publisher(
                AccelWithCovarianceStamped,
                'accel/filtered',
                QoSProfile(depth=10),
                qos_overriding_options=overriding,
            )
        self.transform: TransformBroadcaster | None = None
        if parameters.is_on('publish_tf'):
            self.transform = TransformBroadcaster(node)
        if parameters.is_on('print_diagnostics'):
            self.diagnostics: Publisher = node.create_publisher(
                DiagnosticArray, '/diagnostics', QoSProfile(depth=1)
            )

    def send_transform(self, odometry: Odometry) -> None:
        """Publish the pose of a message as a transform."""
        self._send(odometry, odometry.child_frame_id, transform_of(odometry.pose.pose))

    def send_map_transform(self, odometry: Odometry, odom_in_base: Transform) -> None:
        """
        Publish where the odometry's frame must be for the robot to be where it was estimated.

        Args:
            odometry: the pose of the robot in the map.
            odom_in_base: the pose of the odometry's frame in the robot.
        """
        pose = transform_of(odometry.pose.pose) @ odom_in_base
        self._send(odometry, self._parameters.odom_frame, pose)

    def _send(self, odometry: Odometry, child: str, pose: Transform) -> None:
        offset = self._parameters.nanoseconds('transform_time_offset')
        time = nanoseconds(odometry.header.stamp) + offset
        message: TransformStamped = transform_message(
            StampedTransform(odometry.header.frame_id, child, time, pose)
        )
        if self.transform is not None:
            self.transform.sendTransform(message)


def odometry_message(each: Ekf, parameters: EkfParameters) -> Odometry:
    """Return the pose in the world frame, and the velocity in the robot's axes."""
    message = Odometry()
    fill_stamp(each.time, message.header.stamp)
    message.header.frame_id = parameters.world_frame
    message.child_frame_id = parameters.base_link_frame_output
    roll, pitch, yaw = _vector(each.state[ANGLES])
    pose = Transform(_vector(each.state[POSITION]), quaternion_from_rpy(roll, pitch, yaw))
    fill_pose(pose, message.pose.pose)
    fill_velocity(
        _vector(each.state[VELOCITY]), _vector(each.state[TURN_RATE]), message.twist.twist
    )
    message.pose.covariance = each.covariance[POSE, POSE].ravel()
    message.twist.covariance = each.covariance[TWIST, TWIST].ravel()
    return message


def acceleration_message(
    estimator: Estimator, parameters: EkfParameters
) -> AccelWithCovarianceStamped:
    """Return the acceleration in the robot's axes: linear as estimated, angular by difference."""
    each = estimator.filter
    message = AccelWithCovarianceStamped()
    fill_stamp(each.time, message.header.stamp)
    message.header.frame_id = parameters.base_link_frame_output
    fill_velocity(
        _vector(each.state[ACCELERATION]),
        _vector(estimator.angular_acceleration),
        message.accel.accel,
    )
    covariance = np.zeros((6, 6))
    covariance[:3, :3] = each.covariance[ACCELERATION, ACCELERATION]
    covariance[3:, 3:] = estimator.angular_covariance
    message.accel.covariance = covariance.ravel()
    return message


def diagnostic_array(name: str, found: Sequence[EkfStatus], now: int) -> DiagnosticArray:
    """Return statuses as a message; ``name``: of the node; ``now``: ns."""
    message = DiagnosticArray()
    fill_stamp(now, message.header.stamp)
    message.status = [
        DiagnosticStatus(
            level=bytes([each.level]),
            name=f'{name}: {each.name}',
            message=each.message,
            hardware_id='none',
            values=[KeyValue(key=key, value=value) for key, value in each.values],
        )
        for each in found
    ]
    return message


def _vector(numbers: Array) -> Vector:
    x, y, z = (float(number) for number in numbers)
    return (x, y, z)
