# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
mecanum_drive_controller/MecanumDriveController: a twist to four mecanum wheels, and odometry.

Wheels seen from above have their rollers along an X, so that those of opposite corners are
parallel. With the sum l of the distances of a wheel from the centre along x and along y::

    front left  = (vx − vy − l·ω) / r        front right = (vx + vy + l·ω) / r
    rear left   = (vx + vy − l·ω) / r        rear right  = (vx − vy + l·ω) / r        rad/s

for the centre of the wheels, which ``base_frame_offset`` places in the base.

Differences from mecanum_drive_controller 4.x:

- a command that times out brakes with the deceleration of the limits, if there are any;
- a command that is not finite, instead of only NaN, is no command;
- when deactivated the wheels are commanded 0, where the original commands NaN: nothing;
- with ``reference_timeout`` 0, the default, each command counts for a single update; this is
  warned of.

Addition: ``tf_odometry_topic``, where the transform is published; ``/tf`` has the effect that one
expects. A remapping ``~/tf_odometry:=/tf`` works as well.
"""

from collections.abc import Sequence
from dataclasses import dataclass
import math
from typing import Any, ClassVar, TypeAlias

from amr_description.clock import NANOSECONDS
from amr_description.control.contracts import (
    Output,
    Port,
)
from amr_description.control.interfaces import (
    CommandInterface,
    InterfaceRequest,
    StateInterface,
    VELOCITY,
)
from amr_description.control.samples import (
    Frames,
    MecanumStateSample,
)
from amr_description.controllers.drives import former_drive_parameters
from amr_description.controllers.drives.command_reception import (
    HOLONOMIC,
    ReferenceReception,
)
from amr_description.controllers.drives.diff_drive_controller import LENGTH, SpeedLimits, tf_prefix
from amr_description.controllers.drives.odometry import HolonomicOdometry, LEAST_PERIOD
from amr_description.controllers.drives.rate_limiter import AxisLimiter
from amr_description.controllers.drives.wheeled_drive import (
    reference_input,
    warn_of_one_shot_reference,
    WheeledDrive,
)
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


Twist: TypeAlias = tuple[float, float, float]
"""m/s along x and y, rad/s about z."""

_AT_REST = (0.0, 0.0, 0.0)


@dataclass(frozen=True, slots=True)
class MecanumKinematics:
    """
    Wheel speeds ↔ the twist of the base.

    The order of the wheels is front left, front right, rear right, rear left. ``offset_x``,
    ``offset_y`` (m) and ``offset_angle`` (rad) are ``base_frame_offset``.
    """

    radius: float
    """m."""
    reach: float
    """m: the distance of a wheel from the centre along x, plus that along y."""
    offset_x: float = 0.0
    offset_y: float = 0.0
    offset_angle: float = 0.0

    @classmethod
    def of(cls, parameters: MecanumKinematicsParameters) -> 'MecanumKinematics':
        """Return the kinematics of the group ``kinematics``."""
        offset = parameters.base_frame_offset
        return cls(
            parameters.wheels_radius,
            parameters.sum_of_robot_center_projection_on_X_Y_axis,
            offset.x,
            offset.y,
            offset.theta,
        )

    def wheels(self, twist: Twist) -> tuple[float, float, float, float]:
        """Return the speeds of the wheels, rad/s, for a twist of the base."""
        linear, lateral, angular = twist
        cosine, sine = math.cos(self.offset_angle), math.sin(self.offset_angle)
        x = cosine * linear - sine * lateral + self.offset_y * angular
        y = sine * linear + cosine * lateral - self.offset_x * angular
        turn = self.reach * angular
        return (
            (x - y - turn) / self.radius,
            (x + y + turn) / self.radius,
            (x - y + turn) / self.radius,
            (x + y - turn) / self.radius,
        )

    def twist(self, wheels: Sequence[float]) -> Twist:
        """Return the twist of the base for speeds of the wheels, rad/s, by least squares."""
        front_left, front_right, rear_right, rear_left = wheels
        quarter = 0.25 * self.radius
        x = quarter * (front_left + rear_left + rear_right + front_right)
        y = quarter * (-front_left + rear_left - rear_right + front_right)
        angular = quarter / self.reach * (-front_left - rear_left + rear_right + front_right)
        x -= self.offset_y * angular
        y += self.offset_x * angular
        cosine, sine = math.cos(self.offset_angle), math.sin(self.offset_angle)
        return cosine * x + sine * y, -sine * x + cosine * y, angular


class MecanumDriveController(WheeledDrive):
    """Drives four mecanum wheels; see the module."""

    parameters_type = MecanumDriveParameters
    axes = ('linear/x', 'linear/y', 'angular/z')
    _odometry: HolonomicOdometry

    # --- transitions -------------------------------------------------------------------------

    def configure(self, parameters: MecanumDriveParameters) -> None:
        """Set the pose to the origin."""
        self._parameters = parameters
        self._kinematics = MecanumKinematics.of(parameters.kinematics)
        self._odometry = HolonomicOdometry()
        self._limiters = tuple(
            AxisLimiter(limits.limiter())
            for limits in (parameters.linear_x, parameters.linear_y, parameters.angular)
        )
        timeout = round(parameters.reference_timeout * NANOSECONDS)
        self._reception = ReferenceReception(timeout, self.log, HOLONOMIC, stops_at_outdated=True)
        warn_of_one_shot_reference(self, timeout)
        self._frames = Frames(
            *parameters.frame_ids(self.context.namespace),
            parameters.pose_covariance_diagonal,
            parameters.twist_covariance_diagonal,
        )
        topics = '~/odometry', parameters.tf_odometry_topic
        self._make_ports(reference_input(), topics, enable_tf=parameters.enable_odom_tf)
        self._state: Output[MecanumStateSample] = Output(
            Port(
                '~/controller_state',
                'control_msgs/msg/MecanumDriveControllerState',
                sample=MecanumStateSample,
            )
        )

    def command_interfaces(self) -> InterfaceRequest:
        """Return the velocity commands: front left, front right, rear right, rear left."""
        names = self._parameters.command_joints
        return InterfaceRequest.individual(f'{name}/{VELOCITY}' for name in names)

    def state_interfaces(self) -> InterfaceRequest:
        """Return the measured velocities, in the same order."""
        names = self._parameters.state_joints
        return InterfaceRequest.individual(f'{name}/{VELOCITY}' for name in names)

    def outputs(self) -> tuple[Output[Any], ...]:
        """Return ``~/odometry``, ``~/tf_odometry`` and ``~/controller_state``."""
        return self._odom, self._transform, self._state

    def activate(
        self, commands: Sequence[CommandInterface], states: Sequence[StateInterface], time: int
    ) -> None:
        """Take the wheels, without a command."""
        super().activate(commands, states, time)
        self._forget_limits()

    def reset(self, time: int) -> None:
        """Start over at the origin."""
        super().reset(time)
        self._forget_limits()

    # --- the cycle ---------------------------------------------------------------------------

    def update(self, time: int, period: int) -> None:
        """Receive a command, update odometry, drive the wheels, publish."""
        self._update_references(time, period)
        states = tuple(state.value for state in self._states)
        if period >= LEAST_PERIOD and all(map(math.isfinite, states)):
            twist = self._kinematics.twist(states)
            self._odometry.update_after_turn(twist, period / NANOSECONDS)
        reference = tuple(each.value for each in self._references)
        limited = self._limited(reference, period / NANOSECONDS)
        self._command_joints(self._kinematics.wheels(limited))
        self._publish_odometry(time)
        self._state.send(MecanumStateSample(time, self._frames.frame_id, states, reference))
        self._set_references(self._none)

    def _limited(self, reference: tuple[float, ...], dt: float) -> Twist:
        wanted = reference if all(map(math.isfinite, reference)) else _AT_REST
        linear, lateral, angular = (
            limiter.limit(value, dt) for limiter, value in zip(self._limiters, wanted, strict=True)
        )
        return linear, lateral, angular

    def _forget_limits(self) -> None:
        for limiter in self._limiters:
            limiter.forget()
