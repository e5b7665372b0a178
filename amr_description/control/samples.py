# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
The samples that the shipped controllers subscribe to and publish: plain values, no ROS messages.

Stamps are integer nanoseconds; quaternions are (x, y, z, w), as everywhere in ROS.
"""

from dataclasses import dataclass
from typing import NamedTuple

from amr_description.model.frames import Transform, Vector


@dataclass(frozen=True, slots=True)
class TwistSample:
    """A planar velocity command: the part of a TwistStamped that a wheeled robot uses."""

    stamp: int
    linear: float
    """m/s along x of the base."""
    angular: float
    """rad/s about z of the base."""
    frame_id: str = ''
    lateral: float = 0.0
    """m/s along y of the base: to the left."""


@dataclass(frozen=True, slots=True)
class FlagSample:
    """A std_msgs/Bool."""

    value: bool


@dataclass(frozen=True, slots=True)
class Frames:
    """The constant part of an odometry message: frames, and variances of six axes."""

    frame_id: str
    child_frame_id: str
    pose_variances: tuple[float, ...]
    twist_variances: tuple[float, ...]


@dataclass(frozen=True, slots=True)
class OdometrySample:
    """A planar nav_msgs/Odometry: pose of the base in the odometry frame, twist of the base."""

    stamp: int
    x: float
    """m."""
    y: float
    """m."""
    heading: float
    """rad, not wrapped."""
    linear: float
    """m/s along x of the child frame."""
    angular: float
    """rad/s about z."""
    frames: Frames
    lateral: float = 0.0
    """m/s along y of the child frame."""


@dataclass(frozen=True, slots=True)
class BodyOdometrySample:
    """A nav_msgs/Odometry of a body in space."""

    stamp: int
    pose: Transform
    """Of the child frame in the frame."""
    linear: Vector
    """m/s."""
    angular: Vector
    """rad/s."""
    frames: Frames


class JointStateSample(NamedTuple):
    """A sensor_msgs/JointState; all four tuples have one length, NaN: not known."""

    stamp: int
    frame_id: str
    name: tuple[str, ...]
    position: tuple[float, ...]
    """rad or m."""
    velocity: tuple[float, ...]
    """rad/s or m/s."""
    effort: tuple[float, ...]
    """N·m or N."""


@dataclass(frozen=True, slots=True)
class DynamicLayout:
    """The constant part of a DynamicJointState: the names, and their order."""

    frame_id: str
    names: tuple[str, ...]
    """Joints, sensors, GPIOs."""
    interfaces: tuple[tuple[str, ...], ...]
    """Of each of them."""


class DynamicJointStateSample(NamedTuple):
    """A control_msgs/DynamicJointState: state interfaces of every kind."""

    stamp: int
    values: tuple[tuple[float, ...], ...]
    """In the order of ``layout.interfaces``, each in its own unit."""
    layout: DynamicLayout


@dataclass(frozen=True, slots=True)
class CommandsSample:
    """A std_msgs/Float64MultiArray of commands, each in the unit of its interface."""

    values: tuple[float, ...]


@dataclass(frozen=True, slots=True)
class ImuConstants:
    """The constant part of an Imu message; 3 × 3 covariances by rows, about x, y, z."""

    frame_id: str
    orientation_covariance: tuple[float, ...]
    """rad²."""
    angular_velocity_covariance: tuple[float, ...]
    """(rad/s)²."""
    linear_acceleration_covariance: tuple[float, ...]
    """(m/s²)²."""


@dataclass(frozen=True, slots=True)
class ImuSample:
    """A sensor_msgs/Imu, in the axes of the sensor."""

    stamp: int
    orientation: tuple[float, ...]
    """(x, y, z, w)."""
    angular_velocity: tuple[float, ...]
    """rad/s."""
    linear_acceleration: tuple[float, ...]
    """m/s²."""
    constants: ImuConstants


@dataclass(frozen=True, slots=True)
class MecanumStateSample:
    """A control_msgs/MecanumDriveControllerState."""

    stamp: int
    frame_id: str
    wheels: tuple[float, ...]
    """rad/s: front left, front right, rear right, rear left."""
    reference: tuple[float, ...]
    """m/s along x and y, rad/s about z; NaN: none."""


@dataclass(frozen=True, slots=True)
class SteeringStateSample:
    """A control_msgs/SteeringControllerStatus; right before left."""

    stamp: int
    frame_id: str
    traction_positions: tuple[float, ...]
    """rad; empty unless odometry is from positions."""
    traction_velocities: tuple[float, ...]
    """rad/s; empty unless odometry is from velocities."""
    steering_positions: tuple[float, ...]
    """rad."""
    traction_commands: tuple[float, ...]
    """rad/s."""
    steering_commands: tuple[float, ...]
    """rad."""


@dataclass(frozen=True, slots=True)
class AckermannSample:
    """An ackermann_msgs/AckermannDrive as the tricycle_controller publishes it."""

    speed: float
    """rad/s, of the wheel; the message means m/s."""
    steering_angle: float
    """rad."""


@dataclass(frozen=True, slots=True)
class EmptySample:
    """Request and response of a std_srvs/Empty."""
