# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""The parameters of mecanum_drive_controller 4.x: names, types, defaults and bounds."""

from dataclasses import dataclass
from typing import Any, ClassVar

from amr_description.controllers import former_drive_parameters
from amr_description.controllers.diff_drive_parameters import LENGTH, SpeedLimits, tf_prefix
from amr_description.former_parameters import FormerParameter
from amr_description.parameters import group, parameter

TF_TOPIC = 'Where the transform is published, /tf for instance. Not in the original'
REFERENCE_TIMEOUT: dict[str, Any] = {
    'unit': 's',
    'minimum': 0.0,
    'magnitude': (1e-6, 1e9),
}
_TENTHS = (0.1,) * 6


def _joint(wheel: str) -> Any:
    return parameter(
        '', f'Joint by which the {wheel} wheel is driven', read_only=True, not_empty=True
    )


def _state_joint(wheel: str) -> Any:
    return parameter(
        '', f'Joint whose velocity is that of the {wheel} wheel; empty: the same', read_only=True
    )


@dataclass(frozen=True)
class BaseFrameOffset:
    """Where the centre of the wheels is, from the base frame."""

    x: float = parameter(0.0, 'Centre of the wheels along x of the base', unit='m', read_only=True)
    y: float = parameter(0.0, 'Centre of the wheels along y of the base', unit='m', read_only=True)
    theta: float = parameter(
        0.0, 'Turn of the wheels about z of the base', unit='rad', read_only=True
    )


@dataclass(frozen=True)
class MecanumKinematicsParameters:
    """The sizes of the robot."""

    base_frame_offset: BaseFrameOffset = group('base_frame_offset', BaseFrameOffset)
    wheels_radius: float = parameter(
        0.0, 'Radius of a wheel', unit='m', read_only=True, above=0.0, magnitude=LENGTH
    )
    sum_of_robot_center_projection_on_X_Y_axis: float = parameter(  # noqa: N815
        0.0,
        'Distance of a wheel from the centre along x, plus that along y',
        unit='m',
        read_only=True,
        above=0.0,
        magnitude=LENGTH,
    )


@dataclass(frozen=True)
class MecanumDriveParameters:
    """The table of mecanum_drive_controller/MecanumDriveController."""

    former: ClassVar[tuple[FormerParameter, ...]] = former_drive_parameters.MECANUM
    reference_timeout: float = parameter(
        0.0,
        'Age at which a command ends and the robot brakes; 0: after one update',
        **REFERENCE_TIMEOUT,
    )
    front_left_wheel_command_joint_name: str = _joint('front left')
    front_right_wheel_command_joint_name: str = _joint('front right')
    rear_right_wheel_command_joint_name: str = _joint('rear right')
    rear_left_wheel_command_joint_name: str = _joint('rear left')
    front_left_wheel_state_joint_name: str = _state_joint('front left')
    front_right_wheel_state_joint_name: str = _state_joint('front right')
    rear_right_wheel_state_joint_name: str = _state_joint('rear right')
    rear_left_wheel_state_joint_name: str = _state_joint('rear left')
    kinematics: MecanumKinematicsParameters = group('kinematics', MecanumKinematicsParameters)
    tf_frame_prefix_enable: bool = parameter(True, 'Put a prefix before the frame ids')
    tf_frame_prefix: str = parameter(
        '', 'Prefix of the frame ids; ~, or empty: the namespace of the node', read_only=True
    )
    base_frame_id: str = parameter('base_link', 'Frame whose pose is given', read_only=True)
    odom_frame_id: str = parameter('odom', 'Frame in which the pose is given', read_only=True)
    enable_odom_tf: bool = parameter(True, 'Publish the transform from odom to base')
    tf_odometry_topic: str = parameter('~/tf_odometry', TF_TOPIC, not_empty=True)
    twist_covariance_diagonal: tuple[float, ...] = parameter(
        _TENTHS,
        'Variances of the twist: x, y, z, roll, pitch, yaw',
        unit='m²/s², rad²/s²',
        read_only=True,
        length=6,
    )
    pose_covariance_diagonal: tuple[float, ...] = parameter(
        _TENTHS, 'Variances of the pose', unit='m², rad²', read_only=True, length=6
    )
    linear_x: SpeedLimits = group('linear.x', SpeedLimits)
    linear_y: SpeedLimits = group('linear.y', SpeedLimits)
    angular: SpeedLimits = group('angular.z', SpeedLimits)

    @property
    def command_joints(self) -> tuple[str, ...]:
        """The joints to drive: front left, front right, rear right, rear left."""
        return (
            self.front_left_wheel_command_joint_name,
            self.front_right_wheel_command_joint_name,
            self.rear_right_wheel_command_joint_name,
            self.rear_left_wheel_command_joint_name,
        )

    @property
    def state_joints(self) -> tuple[str, ...]:
        """The joints to read, in the same order."""
        others = (
            self.front_left_wheel_state_joint_name,
            self.front_right_wheel_state_joint_name,
            self.rear_right_wheel_state_joint_name,
            self.rear_left_wheel_state_joint_name,
        )
        return tuple(a or b for a, b in zip(others, self.command_joints, strict=True))

    def frame_ids(self, namespace: str) -> tuple[str, str]:
        """Return the ids of the odometry and the base frame, with their prefix."""
        prefix = tf_prefix(self.tf_frame_prefix_enable, self.tf_frame_prefix, namespace)
        return prefix + self.odom_frame_id, prefix + self.base_frame_id
