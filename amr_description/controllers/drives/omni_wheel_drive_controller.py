# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
omni_wheel_drive_controller/OmniWheelDriveController: a twist to omni wheels, and odometry.

Three or more wheels at equal angles on a circle of radius R, the axis of each pointing outwards.
That of wheel i of n, counted counter-clockwise from above, is at θ = offset + 2π i / n from x::

    wheel = (sin θ vx − cos θ vy − R ω) / r        rad/s

Differences from omni_wheel_drive_controller 4.x:

- odometry starts where the wheels are at the first command in force, not at time and position 0;
- ``cmd_vel_timeout`` 0 means never, as for the diff_drive_controller; in the original it brakes;
- a wheel state that is infinite is an error as NaN is.
"""

from collections.abc import Sequence
from dataclasses import dataclass
import math
from typing import ClassVar, TypeAlias

from amr_description.clock import NANOSECONDS
from amr_description.control.interfaces import (
    CommandInterface,
    InterfaceRequest,
    NO_INTERFACES,
    POSITION,
    StateInterface,
    VELOCITY,
)
from amr_description.control.samples import Frames
from amr_description.controllers.drives import former_drive_parameters
from amr_description.controllers.drives.command_reception import (
    CommandReception,
    HOLONOMIC,
)
from amr_description.controllers.drives.diff_drive_controller import LENGTH, tf_prefix
from amr_description.controllers.drives.odometry import HolonomicOdometry, LEAST_PERIOD
from amr_description.controllers.drives.wheeled_drive import stamped_twist_input, WheeledDrive
from amr_description.errors import ControllerError
from amr_description.former_parameters import FormerParameter
from amr_description.parameters import group, parameter

Twist: TypeAlias = tuple[float, float, float]
"""m/s along x and y, rad/s about z."""

_SIX_ZEROS = (0.0,) * 6
_NONE = (math.nan, math.nan, math.nan)


@dataclass(frozen=True)
class DiagonalCovariance:
    """Variances of odometry: x, y, z, roll, pitch, yaw."""

    pose: tuple[float, ...] = parameter(
        _SIX_ZEROS, 'Variances of the pose', unit='m², rad²', read_only=True, length=6
    )
    twist: tuple[float, ...] = parameter(
        _SIX_ZEROS, 'Variances of the twist', unit='m²/s², rad²/s²', read_only=True, length=6
    )


@dataclass(frozen=True)
class OmniWheelDriveParameters:
    """The table of omni_wheel_drive_controller/OmniWheelDriveController."""

    former: ClassVar[tuple[FormerParameter, ...]] = former_drive_parameters.TF_PREFIX
    wheel_offset: float = parameter(
        math.nan, 'Angle of the first wheel from x, counter-clockwise', unit='rad', read_only=True
    )
    wheel_names: tuple[str, ...] = parameter(
        (), 'Joints of the wheels, counter-clockwise from above', read_only=True, not_empty=True
    )
    robot_radius: float = parameter(
        0.0,
        'Distance of the wheels from the middle',
        unit='m',
        read_only=True,
        above=0.0,
        magnitude=LENGTH,
    )
    wheel_radius: float = parameter(
        0.0, 'Radius of a wheel', unit='m', read_only=True, above=0.0, magnitude=LENGTH
    )
    tf_frame_prefix_enable: bool = parameter(
        True, 'Put a prefix before the frame ids', read_only=True
    )
    tf_frame_prefix: str = parameter(
        '', 'Prefix of the frame ids; ~, or empty: the namespace of the node', read_only=True
    )
    odom_frame_id: str = parameter('odom', 'Frame in which the pose is given', read_only=True)
    base_frame_id: str = parameter('base_link', 'Frame whose pose is given', read_only=True)
    diagonal_covariance: DiagonalCovariance = group('diagonal_covariance', DiagonalCovariance)
    open_loop: bool = parameter(
        False, 'Odometry from the commands, not from the wheels', read_only=True
    )
    position_feedback: bool = parameter(
        True,
        'Odometry from the positions of the wheels, not from their velocities',
        read_only=True,
    )
    enable_odom_tf: bool = parameter(
        True, 'Publish the transform from odom to base on /tf', read_only=True
    )
    cmd_vel_timeout: float = parameter(
        0.5,
        'Age at which a command ends and the robot brakes; 0: never',
        unit='s',
        read_only=True,
        minimum=0.0,
        magnitude=(1e-6, 1e9),
    )


@dataclass(frozen=True, slots=True)
class OmniKinematics:
    """Wheel speeds ↔ the twist of the base."""

    count: int
    offset: float
    """rad."""
    robot_radius: float
    """m."""
    wheel_radius: float
    """m."""

    def wheels(self, twist: Twist) -> tuple[float, ...]:
        """Return the speeds of the wheels, rad/s, for a twist of the base."""
        linear, lateral, angular = twist
        turn = angular * self.robot_radius
        return tuple(
            (math.sin(angle) * linear - math.cos(angle) * lateral - turn) / self.wheel_radius
            for angle in self._angles()
        )

    def twist(self, wheels: Sequence[float]) -> Twist:
        """
        Return the twist of the base for speeds of the wheels, rad/s, by least squares.

        Equal angles make the normal matrix diagonal: n/2, n/2, n R².
        """
        rims = [speed * self.wheel_radius for speed in wheels]
        angles = self._angles()
        linear = sum(math.sin(a) * rim for a, rim in zip(angles, rims, strict=True))
        lateral = -sum(math.cos(a) * rim for a, rim in zip(angles, rims, strict=True))
        mean = 1.0 / self.count
        return 2 * mean * linear, 2 * mean * lateral, -mean * sum(rims) / self.robot_radius

    def _angles(self) -> list[float]:
        return [self.offset + 2.0 * math.pi * index / self.count for index in range(self.count)]


class OmniWheelDriveController(WheeledDrive):
    """Drives three or more omni wheels; see the module."""

    parameters_type = OmniWheelDriveParameters
    axes = ('linear/x', 'linear/y', 'angular/z')
    _odometry: HolonomicOdometry
    keeps_references = True

    # --- transitions -------------------------------------------------------------------------

    def configure(self, parameters: OmniWheelDriveParameters) -> None:
        """Check the number of wheels, and set the pose to the origin."""
        count = len(parameters.wheel_names)
        if count < 3:
            raise ControllerError(
                f'The number of wheels is less than 3: {count}. If there are more wheels please '
                'pass them all to the controller or use a different one for your wheel '
                'configuration.'
            )
        self._parameters = parameters
        self._kinematics = OmniKinematics(
            count, parameters.wheel_offset, parameters.robot_radius, parameters.wheel_radius
        )
        self._odometry = HolonomicOdometry()
        self._last_positions: tuple[float, ...] | None = None
        timeout = round(parameters.cmd_vel_timeout * NANOSECONDS)
        self._reception = CommandReception(timeout, self.log, HOLONOMIC)
        prefix = tf_prefix(
            parameters.tf_frame_prefix_enable, parameters.tf_frame_prefix, self.context.namespace
        )
        self._frames = Frames(
            prefix + parameters.odom_frame_id,
            prefix + parameters.base_frame_id,
            parameters.diagonal_covariance.pose,
            parameters.diagonal_covariance.twist,
        )
        topics = '~/odom', '/tf'
        self._make_ports(stamped_twist_input(), topics, enable_tf=parameters.enable_odom_tf)

    def command_interfaces(self) -> InterfaceRequest:
        """Return the velocity command of every wheel."""
        return self._wheel_interfaces(VELOCITY)

    def state_interfaces(self) -> InterfaceRequest:
        """Return the position (or velocity) of every wheel; none in open loop."""
        if self._parameters.open_loop:
            return NO_INTERFACES
        return self._wheel_interfaces(POSITION if self._parameters.position_feedback else VELOCITY)

    def activate(
        self, commands: Sequence[CommandInterface], states: Sequence[StateInterface], time: int
    ) -> None:
        """Take the wheels; nothing is written before the first command, or the timeout."""
        super().activate(commands, states, time)
        self._last_positions = None

    def reset(self, time: int) -> None:
        """Start over at the origin."""
        super().reset(time)
        self._last_positions = None

    # --- the cycle ---------------------------------------------------------------------------

    def update(self, time: int, period: int) -> None:
        """Receive a command, update odometry, publish, drive the wheels."""
        self._update_references(time, period)
        linear, lateral, angular = (reference.value for reference in self._references)
        if not all(map(math.isfinite, (linear, lateral, angular))):
            return
        if period >= LEAST_PERIOD:
            dt = period / NANOSECONDS
            self._odometry.update(self._measured((linear, lateral, angular), dt), dt)
        self._publish_odometry(time)
        self._command_joints(self._kinematics.wheels((linear, lateral, angular)))

    def _measured(self, twist: Twist, dt: float) -> Twist:
        """Return the twist of the wheels or, in open loop, that of the command."""
        if self._parameters.open_loop:
            return twist
        values = tuple(state.value for state in self._states)
        for index, state in enumerate(self._states):
            if not math.isfinite(state.value):
                raise ControllerError(
                    f'The wheel {state.interface} is invalid for index [{index}]: {state.name} '
                    f'is {state.value}'
                )
        if self._parameters.position_feedback:
            last, self._last_positions = self._last_positions or values, values
            values = tuple((a - b) / dt for a, b in zip(values, last, strict=True))
        return self._kinematics.twist(values)

    # --- made at configure -------------------------------------------------------------------

    def _wheel_interfaces(self, interface: str) -> InterfaceRequest:
        names = self._parameters.wheel_names
        return InterfaceRequest.individual(f'{name}/{interface}' for name in names)
