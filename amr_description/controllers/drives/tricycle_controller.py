# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
tricycle_controller/TricycleController: a twist to one wheel that is driven and steered.

The wheel is L ahead of the axle of two passive ones, in the middle of which the base is::

    angle = atan(ω L / v)        wheel = v / (r cos angle)        rad, rad/s

At v = 0 the wheel is turned by a right angle, and the base turns on the spot. The speed is reduced
while the measured angle is off by more than 30 degrees, then both are limited.

Differences from tricycle_controller 4.x: ``cmd_vel_timeout`` 0 means never; a command that is not
finite is warned of, and is none; the warnings of stamps are those of the diff_drive_controller;
without the package ackermann_msgs, which is not part of this one, ``~/cmd_ackermann`` is left out.
"""

from dataclasses import dataclass, replace
import math
from typing import Any, ClassVar

from amr_description.clock import NANOSECONDS
from amr_description.control.contracts import Output, Port, Service, ServicePort
from amr_description.control.interfaces import (
    InterfaceRequest,
    POSITION,
    VELOCITY,
)
from amr_description.control.samples import (
    AckermannSample,
    EmptySample,
    Frames,
)
from amr_description.controllers.drives import former_drive_parameters
from amr_description.controllers.drives.command_reception import CommandReception
from amr_description.controllers.drives.diff_drive_controller import LENGTH
from amr_description.controllers.drives.odometry import LEAST_PERIOD, PlanarOdometry
from amr_description.controllers.drives.wheeled_drive import stamped_twist_input, WheeledDrive
from amr_description.errors import ControllerError
from amr_description.former_parameters import FormerParameter
from amr_description.log import Severity
from amr_description.parameters import group, parameter

_BIG = 1000.0
_NO_LIMIT: dict[str, Any] = {'nan': True}


def _limit(doc: str, unit: str) -> Any:
    return parameter(math.nan, doc, unit=unit, **_NO_LIMIT)


@dataclass(frozen=True)
class TractionLimits:
    """Limits of the speed of the wheel; .nan: none."""

    max_velocity: float = _limit('Highest speed', 'rad/s')
    min_velocity: float = _limit('Lowest speed', 'rad/s')
    max_acceleration: float = _limit('Highest rate away from zero', 'rad/s²')
    min_acceleration: float = _limit('Lowest rate away from zero', 'rad/s²')
    max_deceleration: float = _limit('Highest rate towards zero', 'rad/s²')
    min_deceleration: float = _limit('Lowest rate towards zero', 'rad/s²')
    max_jerk: float = _limit('Highest jerk', 'rad/s³')
    min_jerk: float = _limit('Lowest jerk', 'rad/s³')

    def check(self) -> None:
        """Raise ControllerError if a limit is negative, or a lower one above its upper one."""
        _check(self, 'traction', ('velocity', 'acceleration', 'deceleration', 'jerk'))

    def limit(self, value: float, previous: float, before_previous: float, dt: float) -> float:
        """
        Return the limited speed, rad/s.

        Args:
            value: the command.
            previous: the previous command, as limited.
            before_previous: the command before that.
            dt: since the previous command, s.
        """
        low, high = _pair(self.min_jerk, self.max_jerk)
        if not math.isnan(low):
            slope = previous - before_previous
            value = previous + slope + _sized(value - previous - slope, low, high, 2.0 * dt * dt)
        low, high = _pair(self.min_acceleration, self.max_acceleration)
        if not math.isnan(low):
            if abs(value) < abs(previous):
                low, high = _pair(self.min_deceleration, self.max_deceleration)
            value = previous + _sized(value - previous, low, high, dt)
        low, high = _pair(self.min_velocity, self.max_velocity)
        return value if math.isnan(low) else _sized(value, low, high, 1.0)


@dataclass(frozen=True)
class SteeringLimits:
    """Limits of the steering angle; .nan: none."""

    max_position: float = _limit('Greatest angle', 'rad')
    min_position: float = _limit('Least angle', 'rad')
    max_velocity: float = _limit('Highest speed', 'rad/s')
    min_velocity: float = _limit('Lowest speed', 'rad/s')
    max_acceleration: float = _limit('Highest acceleration', 'rad/s²')
    min_acceleration: float = _limit('Lowest acceleration', 'rad/s²')

    def check(self) -> None:
        """Raise ControllerError if a rate is negative, or a lower limit above its upper one."""
        _check(self, 'steering', ('velocity', 'acceleration'))
        low, high = self._positions()
        if low > high:
            raise ControllerError(
                f'Error configuring steering limiter: min_position {low:g} is above max_position '
                f'{high:g}'
            )

    def limit(self, value: float, previous: float, before_previous: float, dt: float) -> float:
        """Return the limited angle, rad; arguments as of :meth:`TractionLimits.limit`."""
        low, high = _pair(self.min_acceleration, self.max_acceleration)
        if not math.isnan(low):
            slope = previous - before_previous
            value = previous + slope + _sized(value - previous - slope, low, high, 2.0 * dt * dt)
        low, high = _pair(self.min_velocity, self.max_velocity)
        if not math.isnan(low):
            value = previous + _sized(value - previous, low, high, dt)
        low, high = self._positions()
        return value if math.isnan(low) else min(max(value, low), high)

    def _positions(self) -> tuple[float, float]:
        low, high = self.min_position, self.max_position
        return (-high if math.isnan(low) else low), (-low if math.isnan(high) else high)


def _pair(low: float, high: float) -> tuple[float, float]:
    """Return both limits, NaN if none is set."""
    if math.isnan(low) and math.isnan(high):
        return low, high
    return (0.0 if math.isnan(low) else low), (_BIG if math.isnan(high) else high)


def _sized(change: float, low: float, high: float, scale: float) -> float:
    """Return a change with its size within the limits, times ``scale``; NaN: no limit."""
    size = abs(change)
    if not math.isnan(low):
        size = min(max(size, low * scale), high * scale)
    return math.copysign(size, change) if change else size


def _check(limits: TractionLimits | SteeringLimits, name: str, kinds: tuple[str, ...]) -> None:
    for kind in kinds:
        low, high = _pair(getattr(limits, f'min_{kind}'), getattr(limits, f'max_{kind}'))
        if low < 0.0 or high < 0.0:
            raise ControllerError(
                f'Error configuring {name} limiter: {kind} cannot be negative, found '
                f'{min(low, high):g}: the positive limit is applied to both directions'
            )
        if low > high:
            raise ControllerError(
                f'Error configuring {name} limiter: min_{kind} {low:g} is above max_{kind} '
                f'{high:g}'
            )


_MILLISECOND = 1_000_000
"""ns."""
_SIX_ZEROS = (0.0,) * 6
_AT_REST = (0.0, 0.0)


@dataclass(frozen=True)
class TricycleParameters:
    """The table of tricycle_controller/TricycleController."""

    former: ClassVar[tuple[FormerParameter, ...]] = former_drive_parameters.STAMPED_ONLY
    traction_joint_name: str = parameter('', 'Joint that is driven', not_empty=True)
    steering_joint_name: str = parameter('', 'Joint that is steered', not_empty=True)
    wheelbase: float = parameter(
        0.0,
        'Shortest distance between the wheel and the other axle',
        unit='m',
        above=0.0,
        magnitude=LENGTH,
    )
    wheel_radius: float = parameter(
        0.0, 'Radius of the wheel', unit='m', above=0.0, magnitude=LENGTH
    )
    odom_frame_id: str = parameter('odom', 'Frame in which the pose is given')
    base_frame_id: str = parameter('base_link', 'Frame whose pose is given')
    pose_covariance_diagonal: tuple[float, ...] = parameter(
        _SIX_ZEROS, 'Variances of x, y, z, roll, pitch, yaw', unit='m², rad²', length=6
    )
    twist_covariance_diagonal: tuple[float, ...] = parameter(
        _SIX_ZEROS, 'Variances of the twist, in the same order', unit='m²/s², rad²/s²', length=6
    )
    open_loop: bool = parameter(False, 'Odometry from the commands, not from the wheel')
    enable_odom_tf: bool = parameter(False, 'Publish the transform from odom to base on /tf')
    odom_only_twist: bool = parameter(
        False, 'Publish odometry without a pose, which another node integrates'
    )
    cmd_vel_timeout: int = parameter(
        500, 'Age at which a command ends and the robot brakes; 0: never', unit='ms', minimum=0
    )
    publish_ackermann_command: bool = parameter(
        False, 'Publish the limited commands, ~/cmd_ackermann'
    )
    velocity_rolling_window_size: int = parameter(
        10, 'Samples in the mean of the estimated twist', minimum=1, magnitude=(1, 100_000)
    )
    traction: TractionLimits = group('traction', TractionLimits)
    steering: SteeringLimits = group('steering', SteeringLimits)


class TricycleController(WheeledDrive):
    """Drives and steers one wheel; see the module."""

    parameters_type = TricycleParameters
    is_chainable = False
    axes = ()
    _odometry: PlanarOdometry

    # --- transitions -------------------------------------------------------------------------

    def configure(self, parameters: TricycleParameters) -> None:
        """Check the limits, and set the pose to the origin."""
        parameters.traction.check()
        parameters.steering.check()
        self._parameters = parameters
        self._odometry = PlanarOdometry(parameters.velocity_rolling_window_size)
        self._reception = CommandReception(parameters.cmd_vel_timeout * _MILLISECOND, self.log)
        self._last = self._before_last = _AT_REST
        self._frames = Frames(
            parameters.odom_frame_id,
            parameters.base_frame_id,
            parameters.pose_covariance_diagonal,
            parameters.twist_covariance_diagonal,
        )
        self._make_ports(
            stamped_twist_input(), ('~/odom', '/tf'), enable_tf=parameters.enable_odom_tf
        )
        self._command_out: Output[AckermannSample] = Output(
            Port(
                '~/cmd_ackermann',
                'ackermann_msgs/msg/AckermannDrive',
                sample=AckermannSample,
                is_optional=True,
            )
        )
        self._reset_odometry: Service[EmptySample, EmptySample] = Service(
            ServicePort('~/reset_odometry', 'std_srvs/srv/Empty', EmptySample, EmptySample),
            self._reset,
        )

    def command_interfaces(self) -> InterfaceRequest:
        """Return the velocity of the driven joint, and the position of the steered one."""
        return self._interfaces()

    def state_interfaces(self) -> InterfaceRequest:
        """Return the same."""
        return self._interfaces()

    def outputs(self) -> tuple[Output[Any], ...]:
        """Return ``~/odom`` and, if enabled, ``/tf`` and ``~/cmd_ackermann``."""
        transform = (self._transform,) if self._parameters.enable_odom_tf else ()
        command = (self._command_out,) if self._parameters.publish_ackermann_command else ()
        return (self._odom, *transform, *command)

    def services(self) -> tuple[Service[Any, Any], ...]:
        """Return ``~/reset_odometry``."""
        return (self._reset_odometry,)

    def deactivate(self, time: int) -> None:
        """Stop the wheel, and steer straight; the pose stays."""
        self._last = self._before_last = _AT_REST
        super().deactivate(time)

    def reset(self, time: int) -> None:
        """Start over at the origin."""
        super().reset(time)
        self._last = self._before_last = _AT_REST

    # --- the cycle ---------------------------------------------------------------------------

    def update(self, time: int, period: int) -> None:
        """Receive a command, update odometry, publish, drive and steer."""
        if self._emergency_stop.is_engaged:
            self._reception.discard(self.inputs(), time)
        self._reception.receive(self._command.drain(), time - period)
        linear, angular = self._reception.in_force(time) or _AT_REST
        speed, angle = (state.value for state in self._states)
        dt = period / NANOSECONDS
        if period >= LEAST_PERIOD:
            self._update_odometry((linear, angular), speed, angle, dt)
        self._publish(time)
        wanted_speed, wanted_angle = self.wheel(linear, angular)
        wanted_speed *= _speed_scale(abs(wanted_angle - angle))
        traction, steering = self._parameters.traction, self._parameters.steering
        limited = (
            traction.limit(wanted_speed, self._last[0], self._before_last[0], dt),
            steering.limit(wanted_angle, self._last[1], self._before_last[1], dt),
        )
        self._last, self._before_last = limited, self._last
        if self._parameters.publish_ackermann_command:
            self._command_out.send(AckermannSample(*limited))
        self._command_joints(limited)

    def wheel(self, linear: float, angular: float) -> tuple[float, float]:
        """Return speed (rad/s) and angle (rad) of the wheel for a twist, m/s and rad/s."""
        base, radius = self._parameters.wheelbase, self._parameters.wheel_radius
        if linear == 0.0:
            angle = math.copysign(math.pi / 2.0, angular) if angular else 0.0
            return abs(angular) * base / radius, angle
        angle = math.atan(angular * base / linear)
        return linear / (radius * math.cos(angle)), angle

    def _update_odometry(
        self, twist: tuple[float, float], speed: float, angle: float, dt: float
    ) -> None:
        if self._parameters.open_loop:
            self._odometry.update_open_loop(*twist, dt)
            return
        if not (math.isfinite(speed) and math.isfinite(angle)):
            found = ', '.join(f'{state.name} is {state.value}' for state in self._states)
            raise ControllerError(f'Could not read feedback value: {found}')
        rim = speed * self._parameters.wheel_radius
        turn = rim * math.sin(angle) / self._parameters.wheelbase
        self._odometry.update(rim * math.cos(angle) * dt, turn * dt, dt)

    def _publish(self, time: int) -> None:
        sample = self._odometry.sample(time, self._frames)
        if self._parameters.enable_odom_tf:
            self._transform.send(sample)
        if self._parameters.odom_only_twist:
            sample = replace(sample, x=0.0, y=0.0, heading=0.0)
        self._odom.send(sample)

    # --- made at configure -------------------------------------------------------------------

    def _interfaces(self) -> InterfaceRequest:
        return InterfaceRequest.individual(
            (
                f'{self._parameters.traction_joint_name}/{VELOCITY}',
                f'{self._parameters.steering_joint_name}/{POSITION}',
            )
        )

    def _reset(self, request: EmptySample) -> EmptySample:
        self.log(Severity.INFO, 'Odometry reset requested')
        self._odometry.reset()
        return request


def _speed_scale(error: float) -> float:
    """Return the factor on the speed while the steering angle is off by ``error`` (rad)."""
    if error < math.pi / 6.0:
        return 1.0
    return 0.01 if error > math.pi / 2.0 else math.cos(error)
