# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
Samples of the broadcasters of sensors, batteries and interfaces → messages of ROS.

``fill_…`` writes into a message that is created once and published many times.
"""

from array import array
from collections.abc import Callable
from typing import Any

from amr_description.control.sensor_samples import (
    BatteriesSample,
    BatterySample,
    InterfaceGroupsSample,
    MagneticFieldSample,
    NamesSample,
    NavSatFixSample,
    PoseSample,
    RangeSample,
    ValuesSample,
    WrenchSample,
)
from amr_description.messages.parts import fill_stamp
from amr_description.messages.plain import message_like


def fill_wrench(sample: WrenchSample, message: Any) -> None:
    """Write force and torque."""
    _fill_header(sample, message)
    _fill_vector(sample.force, message.wrench.force)
    _fill_vector(sample.torque, message.wrench.torque)


def fill_pose(sample: PoseSample, message: Any) -> None:
    """Write a pose."""
    _fill_header(sample, message)
    _fill_vector(sample.position, message.pose.position)
    _fill_quaternion(sample.orientation, message.pose.orientation)


def fill_pose_transform(sample: PoseSample, message: Any) -> None:
    """Write the transform from the frame that has the pose to the one in which it is."""
    if not message.transforms:
        message.transforms = [message_like(message, 'geometry_msgs/msg/TransformStamped')]
    stamped = message.transforms[0]
    _fill_header(sample, stamped)
    stamped.child_frame_id = sample.child_frame_id
    _fill_vector(sample.position, stamped.transform.translation)
    _fill_quaternion(sample.orientation, stamped.transform.rotation)


def fill_range(sample: RangeSample, message: Any) -> None:
    """Write the distance and what is known of the sensor."""
    constants = sample.constants
    fill_stamp(sample.stamp, message.header.stamp)
    message.header.frame_id = constants.frame_id
    message.radiation_type = constants.radiation_type
    message.field_of_view = constants.field_of_view
    message.min_range = constants.min_range
    message.max_range = constants.max_range
    message.variance = constants.variance
    message.range = sample.range


def fill_fix(sample: NavSatFixSample, message: Any) -> None:
    """Write a satellite fix."""
    _fill_header(sample, message)
    message.status.status = sample.status
    message.status.service = sample.service
    message.latitude = sample.latitude
    message.longitude = sample.longitude
    message.altitude = sample.altitude
    message.position_covariance = sample.position_covariance
    message.position_covariance_type = sample.position_covariance_type


def fill_magnetic_field(sample: MagneticFieldSample, message: Any) -> None:
    """Write a magnetic field."""
    _fill_header(sample, message)
    _fill_vector(sample.field, message.magnetic_field)
    message.magnetic_field_covariance = sample.covariance


def fill_names(sample: NamesSample, message: Any) -> None:
    """Write names."""
    fill_stamp(sample.stamp, message.header.stamp)
    message.keys = sample.names


def fill_values(sample: ValuesSample, message: Any) -> None:
    """Write numbers."""
    fill_stamp(sample.stamp, message.header.stamp)
    message.values = array('d', sample.values)


def fill_battery(sample: BatterySample, message: Any) -> None:
    """Write the state of a battery, without that of its cells."""
    _fill_header(sample, message)
    for name in BatterySample.__slots__[2:]:
        setattr(message, name, getattr(sample, name))


def fill_batteries(sample: BatteriesSample, message: Any) -> None:
    """Write the states of several batteries."""
    if len(message.battery_states) != len(sample.batteries):
        message.battery_states = [
            message_like(message, 'sensor_msgs/msg/BatteryState') for _ in sample.batteries
        ]
    for each, below in zip(sample.batteries, message.battery_states, strict=True):
        fill_battery(each, below)


def fill_interface_groups(sample: InterfaceGroupsSample, message: Any) -> None:
    """Write names and values."""
    fill_stamp(sample.stamp, message.header.stamp)
    message.interface_groups = [group.name for group in sample.groups]
    message.interface_values = [
        message_like(
            message,
            'control_msgs/msg/InterfaceValue',
            interface_names=group.interfaces,
            values=array('d', group.values),
        )
        for group in sample.groups
    ]


def _fill_header(sample: Any, message: Any) -> None:
    fill_stamp(sample.stamp, message.header.stamp)
    message.header.frame_id = sample.frame_id


def _fill_vector(values: tuple[float, ...], vector: Any) -> None:
    vector.x, vector.y, vector.z = values


def _fill_quaternion(values: tuple[float, ...], quaternion: Any) -> None:
    quaternion.x, quaternion.y, quaternion.z, quaternion.w = values


_GROUPS = (InterfaceGroupsSample, 'control_msgs/msg/DynamicInterfaceGroupValues')
WRITERS: dict[tuple[type | None, str], Callable[[Any, Any], None]] = {
    _GROUPS: fill_interface_groups,
    (BatteriesSample, 'control_msgs/msg/BatteryStateArray'): fill_batteries,
    (BatterySample, 'sensor_msgs/msg/BatteryState'): fill_battery,
    (MagneticFieldSample, 'sensor_msgs/msg/MagneticField'): fill_magnetic_field,
    (NamesSample, 'control_msgs/msg/Keys'): fill_names,
    (NavSatFixSample, 'sensor_msgs/msg/NavSatFix'): fill_fix,
    (PoseSample, 'geometry_msgs/msg/PoseStamped'): fill_pose,
    (PoseSample, 'tf2_msgs/msg/TFMessage'): fill_pose_transform,
    (RangeSample, 'sensor_msgs/msg/Range'): fill_range,
    (ValuesSample, 'control_msgs/msg/Float64Values'): fill_values,
    (WrenchSample, 'geometry_msgs/msg/WrenchStamped'): fill_wrench,
}
"""Functions that write a sample into a message, likewise."""
