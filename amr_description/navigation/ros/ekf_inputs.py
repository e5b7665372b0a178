# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
Messages of sensors → measurements of the filter.

Knows no node: transforms and complaints go by callables, so that a test feeds it with messages.
"""

from collections.abc import Callable, Sequence
from typing import TypeAlias

from builtin_interfaces.msg import Time
from geometry_msgs.msg import (
    Pose,
    PoseWithCovariance,
    PoseWithCovarianceStamped,
    TwistWithCovariance,
    TwistWithCovarianceStamped,
)
from nav_msgs.msg import Odometry
import numpy as np
from sensor_msgs.msg import Imu

from amr_description.model.frames import (
    IDENTITY_QUATERNION,
    multiply,
    normalize,
    Quaternion,
    quaternion_from_rpy,
    Transform,
)
from amr_description.navigation.ekf import (
    ACCELERATION,
    ANGLES,
    Array,
    ControlInput,
    Measurement,
    STATE_SIZE,
    StateMember,
    TURN_RATE,
)
from amr_description.navigation.ekf_diagnostics import complaint_on
from amr_description.navigation.ekf_estimator import Estimator
from amr_description.navigation.ekf_measurement import (
    acceleration_values,
    in_the_plane,
    MeasuredValues,
    MeasurementChannel,
    orientation_values,
    pose_values,
    PoseMemory,
    RotationalMotion,
    StampedPose,
    twist_values,
    without_gravity,
)
from amr_description.navigation.ekf_parameters import EkfInput, EkfParameters
from amr_description.ros.messages import nanoseconds, vector_of

Lookup: TypeAlias = Callable[[str, str, int], Transform | None]
"""(target frame, source frame, time in ns) → the pose of the source in the target."""
Complain: TypeAlias = Callable[[str, str], object]
"""Told what is wrong with a topic: a key, and a text."""

MESSAGE_TYPES = {
    'odom': Odometry,
    'pose': PoseWithCovarianceStamped,
    'twist': TwistWithCovarianceStamped,
    'imu': Imu,
}
"""By the kind of an input."""

_LEAST_LENGTH_ERROR = 0.01
_IDENTITY = Transform()


class InputReader:
    """Reads the messages of all inputs into an estimator."""

    def __init__(
        self,
        parameters: EkfParameters,
        estimator: Estimator,
        lookup: Lookup,
        complain: Complain = lambda key, text: None,
    ) -> None:
        self.control: ControlInput | None = None
        """The latest command, which measurements remember."""
        self._parameters = parameters
        self._estimator = estimator
        self._lookup = lookup
        self._complain = complain
        self._is_flat = parameters.is_on('two_d_mode')
        self._gravity = parameters.number('gravitational_acceleration')
        self._not_before = 0
        self._latest: dict[str, int] = {}
        self._memories: dict[str, PoseMemory] = {}

    def reset(self, not_before: int = 0) -> None:
        """Forget all messages; ``not_before``: ns: those that are not later are ignored."""
        self._not_before = not_before
        self._latest.clear()
        self._memories.clear()
        self.control = None

    def read(self, entry: EkfInput, message: object) -> None:
        """Take a message of an input."""
        match message:
            case Odometry():
                self._odometry(entry, message)
            case PoseWithCovarianceStamped():
                frame, stamp = message.header.frame_id, message.header.stamp
                self._pose(entry.pose, message.pose, frame, stamp, '')
            case TwistWithCovarianceStamped():
                frame, stamp = message.header.frame_id, message.header.stamp
                self._twist(entry.twist, message.twist, frame, stamp)
            case Imu():
                self._imu(entry, message)

    def values_of_pose(self, message: PoseWithCovarianceStamped) -> MeasuredValues | None:
        """Return the pose of a ``set_pose``; None: its frame is not known."""
        used = np.ones(STATE_SIZE, dtype=bool)
        channel = MeasurementChannel('set_pose', used)
        transform = self._transform(
            channel.name,
            self._parameters.world_frame,
            message.header.frame_id,
            nanoseconds(message.header.stamp),
        )
        if transform is None:
            return None
        stamped = StampedPose(
            Transform(
                _position(message.pose.pose),
                self._rotation(channel, message.pose.pose.orientation),
            ),
            _matrix(message.pose.covariance, 6),
            nanoseconds(message.header.stamp),
        )
        values = pose_values(stamped, channel, PoseMemory(), transform)
        return in_the_plane(values) if values and self._is_flat else values

    # --- messages -----------------------------------------------------------------------------

    def _odometry(self, entry: EkfInput, message: Odometry) -> None:
        header = message.header
        base = message.child_frame_id if entry.uses_child_frame else ''
        self._pose(entry.pose, message.pose, header.frame_id, header.stamp, base)
        self._twist(entry.twist, message.twist, message.child_frame_id, header.stamp)

    def _imu(self, entry: EkfInput, message: Imu) -> None:
        """Take its three parts; by the message's definition a covariance of -1 is of none."""
        if entry.pose.is_used and message.orientation_covariance[0] != -1.0:
            self._orientation(entry.pose, message)
        if entry.twist.is_used and message.angular_velocity_covariance[0] != -1.0:
            twist = TwistWithCovariance()
            twist.twist.angular = message.angular_velocity
            covariance = np.zeros((6, 6))
            covariance[3:, 3:] = _matrix(message.angular_velocity_covariance, 3)
            twist.covariance = covariance.ravel()
            self._twist(entry.twist, twist, message.header.frame_id, message.header.stamp)
        if entry.acceleration.is_used and message.linear_acceleration_covariance[0] != -1.0:
            self._acceleration(entry, message)

    def _pose(
        self,
        channel: MeasurementChannel,
        message: PoseWithCovariance,
        frame: str,
        stamp: Time,
        base: str,
    ) -> None:
        """``base``: the frame whose pose it is; empty: that of the robot."""
        time = nanoseconds(stamp)
        if not self._is_due(channel, time):
            return
        robot = self._parameters.base_link_frame
        offset = self._transform(channel.name, base or robot, robot, time)
        # A velocity between two poses of one frame is the same in any other.
        transform = (
            _IDENTITY
            if channel.differential
            else self._transform(channel.name, self._parameters.world_frame, frame, time)
        )
        if offset is None or transform is None:
            return
        covariance = self._covariance(channel, message.covariance, StateMember.X, 6)
        rotation = self._rotation(channel, message.pose.orientation)
        stamped = StampedPose(Transform(_position(message.pose), rotation), covariance, time)
        memory = self._memories.setdefault(channel.name, PoseMemory())
        values = pose_values(
            stamped, channel, memory, transform, None if offset is _IDENTITY else offset
        )
        self._add(channel, values, time)

    def _orientation(self, channel: MeasurementChannel, message: Imu) -> None:
        time = nanoseconds(message.header.stamp)
        if not self._is_due(channel, time):
            return
        transform = self._of_sensor(channel, message.header.frame_id, time)
        if transform is None:
            return
        covariance = np.zeros((6, 6))
        covariance[3:, 3:] = self._covariance(
            channel, message.orientation_covariance, ANGLES.start, 3
        )
        pose = Transform(rotation=self._rotation(channel, message.orientation))
        memory = self._memories.setdefault(channel.name, PoseMemory())
        stamped = StampedPose(pose, covariance, time)
        self._add(channel, orientation_values(stamped, channel, memory, transform), time)

    def _twist(
        self, channel: MeasurementChannel, message: TwistWithCovariance, frame: str, stamp: Time
    ) -> None:
        time = nanoseconds(stamp)
        if not self._is_due(channel, time):
            return
        transform = self._of_sensor(channel, frame, time)
        if transform is None:
            return
        values = twist_values(
            vector_of(message.twist.linear),
            vector_of(message.twist.angular),
            self._covariance(channel, message.covariance, StateMember.VX, 6),
            channel.used,
            transform,
            self._estimator.filter.state[TURN_RATE],
        )
        self._add(channel, values, time)

    def _acceleration(self, entry: EkfInput, message: Imu) -> None:
        channel, time = entry.acceleration, nanoseconds(message.header.stamp)
        if not self._is_due(channel, time):
            return
        transform = self._of_sensor(channel, message.header.frame_id, time)
        if transform is None:
            return
        acceleration = vector_of(message.linear_acceleration)
        if entry.removes_gravity:
            attitude = self._attitude(channel, message, transform)
            acceleration = without_gravity(acceleration, attitude, self._gravity)
        covariance = self._covariance(
            channel, message.linear_acceleration_covariance, ACCELERATION.start, 3
        )
        estimator = self._estimator
        motion = RotationalMotion(
            estimator.filter.state[TURN_RATE], estimator.angular_acceleration
        )
        values = acceleration_values(acceleration, covariance, channel.used, transform, motion)
        self._add(channel, values, time)

    # --- parts of messages --------------------------------------------------------------------

    def _attitude(
        self, channel: MeasurementChannel, message: Imu, transform: Transform
    ) -> Quaternion:
        """Return the rotation of an IMU in the world; that of the robot if it measures none."""
        if message.orientation_covariance[0] != -1.0:
            return self._rotation(channel, message.orientation)
        roll, pitch, yaw = (float(angle) for angle in self._estimator.filter.state[ANGLES])
        return multiply(quaternion_from_rpy(roll, pitch, yaw), transform.rotation)

    def _rotation(self, channel: MeasurementChannel, message: object) -> Quaternion:
        """Return a unit quaternion; one of zeros is no rotation, and complained of."""
        x, y, z, w = (float(getattr(message, axis)) for axis in 'xyzw')
        squared = x * x + y * y + z * z + w * w
        if not squared:
            if channel.used[ANGLES].any():
                self._complain(
                    f'{channel.name}_orientation',
                    f'The {channel.name} message contains an invalid orientation quaternion, but '
                    'its configuration is such that orientation data is being used. Correcting...',
                )
            return IDENTITY_QUATERNION
        if abs(squared - 1.0) > 2.0 * _LEAST_LENGTH_ERROR:
            self._complain(
                f'{channel.name}_orientation',
                f'An input was not normalized, this should NOT happen, but will normalize. (The '
                f'quaternion of {channel.name} has the length {squared**0.5:g}.)',
            )
        return normalize((x, y, z, w))

    def _covariance(
        self, channel: MeasurementChannel, numbers: Sequence[float], offset: int, size: int
    ) -> Array:
        matrix = _matrix(numbers, size)
        complaint = complaint_on(matrix, channel.used, offset)
        if complaint:
            self._complain(f'{channel.name}_covariance', complaint)
        return matrix

    def _of_sensor(self, channel: MeasurementChannel, frame: str, time: int) -> Transform | None:
        """Return the pose of a sensor in the robot; one without a frame is in its origin."""
        robot = self._parameters.base_link_frame
        return self._transform(channel.name, robot, frame or robot, time)

    def _transform(self, name: str, target: str, source: str, time: int) -> Transform | None:
        if target == source:
            return _IDENTITY
        found = self._lookup(target, source, time)
        if found is None:
            self._complain(
                f'{name}_transform',
                f"{name}: there is no transform from '{source}', the frame of its messages, to "
                f"'{target}': they are ignored",
            )
        return found

    def _is_due(self, channel: MeasurementChannel, time: int) -> bool:
        """Return whether a message is used, and is not older than the last one."""
        if not channel.is_used:
            return False
        if self._not_before >= time:
            self._complain(
                f'{channel.name}_timestamp',
                f'The {channel.name} message has a timestamp equal to or before the last filter '
                'reset, this message will be ignored. This may indicate an empty or bad '
                f'timestamp. (message time: {_seconds(time)})',
            )
            return False
        if time < self._latest.get(channel.name, time):
            self._complain(
                f'{channel.name}_timestamp',
                f'The {channel.name} message has a timestamp before that of the previous message '
                'received, this message will be ignored. This may indicate a bad timestamp. '
                f'(message time: {_seconds(time)})',
            )
            return False
        self._latest[channel.name] = time
        return True

    def _add(self, channel: MeasurementChannel, values: MeasuredValues | None, time: int) -> None:
        if values is None:
            return
        if self._is_flat:
            values = in_the_plane(values)
        self._estimator.add(
            Measurement(
                channel.name,
                time,
                values.values,
                values.covariance,
                values.used,
                channel.threshold,
                self.control,
            )
        )


def _position(pose: Pose) -> tuple[float, float, float]:
    return (pose.position.x, pose.position.y, pose.position.z)


def _matrix(numbers: Sequence[float], size: int) -> Array:
    return np.array(numbers, dtype=float).reshape(size, size)


def _seconds(time: int) -> str:
    return f'{time / 1e9:.9f}'
