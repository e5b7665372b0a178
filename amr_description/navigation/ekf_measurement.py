# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
What sensors say, turned into measurements of the filter's states.

A pose is turned into the world-fixed frame, velocities and accelerations into the robot's axes.
With them are turned their covariances and which of them are used: of an IMU that is mounted on its
side, the pitch rate is the yaw rate of the robot. Rules and their order are those of
robot_localization (``ros_filter.cpp``).

``transform`` is the pose of the message's frame in the target frame. Rotations about the fixed
axes x, y, z are roll, pitch, yaw, rad; covariances are those of ROS messages.
"""

from dataclasses import dataclass, field
from typing import TypeAlias

import numpy as np
from numpy.typing import NDArray

from amr_description.clock import NANOSECONDS
from amr_description.model.frames import (
    matrix_from_quaternion,
    Quaternion,
    quaternion_from_rpy,
    rpy_from_quaternion,
    Transform,
    Vector,
)
from amr_description.navigation.ekf import (
    ACCELERATION,
    ANGLES,
    Array,
    NO_THRESHOLD,
    POSE,
    POSITION,
    STATE_SIZE,
    StateMember,
    TURN_RATE,
    TWIST,
    VELOCITY,
)

Mask: TypeAlias = NDArray[np.bool_]

OUT_OF_PLANE = (
    StateMember.Z,
    StateMember.ROLL,
    StateMember.PITCH,
    StateMember.VZ,
    StateMember.VROLL,
    StateMember.VPITCH,
    StateMember.AZ,
)
"""What is zero of a robot that drives in the plane."""

_VARIANCE_OUT_OF_PLANE = 1e-6
_LEAST_SHARE = 1e-6
"""Of an axis that was not used: less of one that was, after a rotation, is a rounding error."""


@dataclass(frozen=True, slots=True, eq=False)
class MeasuredValues:
    """Measured states: 15 values, their covariance (15 × 15), and which of them count."""

    values: Array
    covariance: Array
    used: Mask


@dataclass(frozen=True, slots=True, eq=False)
class MeasurementChannel:
    """One part of a sensor: its pose, its velocities, or its accelerations."""

    name: str
    """``odom0_pose``"""
    used: Mask
    """15; those of the other parts are false."""
    differential: bool = False
    """Whether a pose is used as the velocity since the last one."""
    relative: bool = False
    """Whether a pose is used as that since the first one."""
    threshold: float = NO_THRESHOLD
    """Mahalanobis distance of what is rejected."""

    @property
    def is_used(self) -> bool:
        """Whether there is something to measure."""
        return bool(self.used.any())


@dataclass(slots=True)
class PoseMemory:
    """What is remembered of the poses of one sensor."""

    first: Transform | None = None
    last: Transform | None = None
    last_covariance: Array = field(default_factory=lambda: np.zeros((6, 6)))
    last_time: int = 0
    """ns"""


@dataclass(frozen=True, slots=True, eq=False)
class StampedPose:
    """A measured pose, its covariance (6 × 6) and its stamp, ns."""

    pose: Transform
    covariance: Array
    time: int


def twist_values(
    linear: Vector,
    angular: Vector,
    covariance: Array,
    used: Mask,
    transform: Transform,
    turn_rate: Array,
) -> MeasuredValues:
    """
    Return a velocity in the robot's axes.

    Args:
        linear: m/s, in the axes of the sensor.
        angular: rad/s, in the same.
        covariance: 6 × 6.
        used: 15.
        transform: the pose of the sensor in the robot.
        turn_rate: rad/s, of the robot: a sensor beside its origin moves as it turns.
    """
    rotation = _matrix(transform.rotation)
    values, full = np.zeros(STATE_SIZE), np.zeros((STATE_SIZE, STATE_SIZE))
    values[TURN_RATE] = rotation @ angular
    values[VELOCITY] = rotation @ linear + np.cross(transform.translation, turn_rate)
    full[TWIST, TWIST] = _rotated(covariance, rotation)
    mask = used.copy()
    mask[VELOCITY] = _turned(used[VELOCITY], rotation)
    mask[TURN_RATE] = _turned(used[TURN_RATE], rotation)
    return MeasuredValues(values, full, mask)


def acceleration_values(
    acceleration: Vector,
    covariance: Array,
    used: Mask,
    transform: Transform,
    motion: 'RotationalMotion',
) -> MeasuredValues:
    """
    Return a linear acceleration of the robot's origin, in its axes.

    Args:
        acceleration: m/s², in the axes of the sensor.
        covariance: 3 × 3.
        used: 15.
        transform: the pose of the sensor in the robot.
        motion: of the robot: a sensor beside its origin is accelerated as it turns.
    """
    rotation = _matrix(transform.rotation)
    place = np.array(transform.translation)
    rate = motion.turn_rate
    values, full = np.zeros(STATE_SIZE), np.zeros((STATE_SIZE, STATE_SIZE))
    values[ACCELERATION] = (
        rotation @ acceleration
        + np.cross(place, motion.angular_acceleration)
        - np.cross(np.cross(place, rate), rate)
    )
    full[ACCELERATION, ACCELERATION] = rotation @ covariance @ rotation.T
    mask = used.copy()
    mask[ACCELERATION] = _turned(used[ACCELERATION], rotation)
    return MeasuredValues(values, full, mask)


@dataclass(frozen=True, slots=True, eq=False)
class RotationalMotion:
    """How the robot turns: rad/s and rad/s², three of each, in its axes."""

    turn_rate: Array
    angular_acceleration: Array


def without_gravity(acceleration: Vector, attitude: Quaternion, gravity: float) -> Vector:
    """
    Return an acceleration without what holds the sensor against gravity.

    Args:
        acceleration: m/s², in the axes of the sensor.
        attitude: of the sensor in the world, whose z points up.
        gravity: m/s²
    """
    up = _matrix(attitude).T @ (0.0, 0.0, gravity)
    x, y, z = (float(value) for value in np.subtract(acceleration, up))
    return (x, y, z)


def pose_values(
    stamped: StampedPose,
    channel: MeasurementChannel,
    memory: PoseMemory,
    transform: Transform,
    base: Transform | None = None,
) -> MeasuredValues | None:
    """
    Return a pose in the world-fixed frame, or the velocity since the last one.

    Args:
        stamped: the pose, in the frame of its message.
        channel: of the sensor; a differential one gives velocities.
        memory: of the channel; it is changed.
        transform: the pose of the message's frame in the world-fixed one; of no use to velocities.
        base: the pose of the robot in the frame whose pose this is; None: it is that of the robot.

    Returns:
        None: a first pose has no velocity.
    """
    covariance = stamped.covariance
    if base is not None:
        covariance = _rotated(covariance, _matrix(base.rotation).T)
    if channel.differential:
        stamped = StampedPose(stamped.pose, covariance, stamped.time)
        return _velocity(stamped, channel, memory, base)
    pose = stamped.pose if base is None else stamped.pose @ base
    if channel.relative:
        memory.first = memory.first or pose
        pose = memory.first.inverse() @ pose
    rotation = _matrix(transform.rotation)
    mask = channel.used.copy()
    mask[POSITION] = _turned(channel.used[POSITION], rotation)
    mask[ANGLES] = _turned(channel.used[ANGLES], rotation)
    return _pose(transform @ pose, _rotated(covariance, rotation), mask)


def orientation_values(
    stamped: StampedPose, channel: MeasurementChannel, memory: PoseMemory, transform: Transform
) -> MeasuredValues | None:
    """
    Return the orientation of the robot by that of its IMU, or the turn rates since the last one.

    Args:
        stamped: the orientation of the IMU in the world, in ENU axes, at the origin.
        channel: of the sensor; a differential one gives turn rates.
        memory: of the channel; it is changed.
        transform: the pose of the IMU in the robot.

    Returns:
        None: a first orientation has no rate.
    """
    offsets = rpy_from_quaternion(transform.rotation)
    measured = rpy_from_quaternion(stamped.pose.rotation)
    # Only by its yaw: roll and pitch of an IMU that faces left are pitch and roll of the robot.
    rotation = _matrix(quaternion_from_rpy(0.0, 0.0, offsets[2]))
    angles = np.remainder(np.subtract(measured, offsets) + np.pi, 2.0 * np.pi) - np.pi
    roll, pitch, yaw = (float(angle) for angle in rotation @ angles)
    mask = channel.used.copy()
    mask[ANGLES] = _turned(channel.used[ANGLES], rotation)
    pose = Transform(stamped.pose.translation, quaternion_from_rpy(roll, pitch, yaw))
    covariance = _rotated(stamped.covariance, rotation)
    if channel.differential:
        turned = MeasurementChannel(channel.name, mask, differential=True)
        return _velocity(StampedPose(pose, covariance, stamped.time), turned, memory, None)
    if channel.relative:
        memory.first = memory.first or pose
        pose = memory.first.inverse() @ pose
    return _pose(pose, covariance, mask)


def in_the_plane(measured: MeasuredValues) -> MeasuredValues:
    """Return a measurement that also says that the robot is in the plane z = 0, level."""
    values, covariance, used = (
        measured.values.copy(),
        measured.covariance.copy(),
        measured.used.copy(),
    )
    for index in OUT_OF_PLANE:
        values[index] = 0.0
        covariance[index, :] = covariance[:, index] = 0.0
        covariance[index, index] = _VARIANCE_OUT_OF_PLANE
        used[index] = True
    return MeasuredValues(values, covariance, used)


def _velocity(
    stamped: StampedPose, channel: MeasurementChannel, memory: PoseMemory, base: Transform | None
) -> MeasuredValues | None:
    """Return the velocity between the last pose of a sensor and this one; remember this one."""
    last, last_covariance, last_time = memory.last, memory.last_covariance, memory.last_time
    memory.last, memory.last_covariance = stamped.pose, stamped.covariance
    memory.last_time = stamped.time
    if last is None or stamped.time <= last_time:
        return None
    dt = (stamped.time - last_time) / NANOSECONDS
    moved = last.inverse() @ stamped.pose
    if base is not None:
        moved = base.inverse() @ moved @ base
    values, full = np.zeros(STATE_SIZE), np.zeros((STATE_SIZE, STATE_SIZE))
    values[VELOCITY] = np.array(moved.translation) / dt
    values[TURN_RATE] = np.array(rpy_from_quaternion(moved.rotation)) / dt
    # As in the original: times dt, not through its square, as the units would have it.
    full[TWIST, TWIST] = (stamped.covariance + last_covariance) * dt
    used = np.zeros(STATE_SIZE, dtype=bool)
    used[TWIST] = channel.used[POSE]
    return MeasuredValues(values, full, used)


def _pose(pose: Transform, covariance: Array, used: Mask) -> MeasuredValues:
    """Return a pose as states."""
    values, full = np.zeros(STATE_SIZE), np.zeros((STATE_SIZE, STATE_SIZE))
    values[POSITION] = pose.translation
    values[ANGLES] = rpy_from_quaternion(pose.rotation)
    full[POSE, POSE] = covariance
    return MeasuredValues(values, full, used)


def _matrix(rotation: Quaternion) -> Array:
    return np.array(matrix_from_quaternion(rotation))


def _rotated(covariance: Array, rotation: Array) -> Array:
    """Return a covariance of two vectors (6 × 6) with both turned."""
    both = np.zeros((6, 6))
    both[:3, :3] = both[3:, 3:] = rotation
    return both @ covariance @ both.T


def _turned(used: Mask, rotation: Array) -> Mask:
    """Return which axes have a share of a used one, after a rotation."""
    share: Mask = np.linalg.norm(rotation * used, axis=1) >= _LEAST_SHARE
    return share
