# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
diff_drive_controller/DiffDriveController: a commanded twist to wheel speeds, and odometry.

Inverse kinematics of a differential drive, separation s and radius r (with their multipliers)::

    left  = (v − ω·s/2) / r_left        right = (v + ω·s/2) / r_right        rad/s

Differences from diff_drive_controller 4.x:

- odometry starts with the first command in force after activation, not at time and position zero,
  so that neither an encoder that does not start at zero nor a late start makes the pose jump;
- when time goes back, odometry and its publication start over instead of stopping;
- a stamp a minute or more ahead
  (:data:`~amr_description.controllers.drives.command_reception.FOREIGN_CLOCK`) belongs to another
  clock: it counts as now, so that the timeout still brakes when that publisher dies;
- "Braking." is logged when a command times out, not for every second at rest;
- an infinite wheel state is an error as NaN is, instead of making the pose NaN forever;
- commands on topics that arrive in chained mode, where they are ignored, are warned of.

Additions, off by default or, the lock, until somebody publishes:

- ``enable_cmd_vel_unstamped``: plain ``geometry_msgs/msg/Twist`` on ``~/cmd_vel_unstamped``,
  besides the stamped ones; of two that arrive within one period, the unstamped one counts;
- the lock ``emergency_stop`` (always subscribed), see
  :class:`~amr_description.controllers.drives.wheeled_drive.EmergencyStop`;
- ``preserve_curvature``: a limited command keeps its arc, see
  :mod:`amr_description.controllers.drives.rate_limiter`.
"""

from collections.abc import Sequence
from dataclasses import dataclass
import math
from typing import Any, ClassVar

from amr_description.clock import NANOSECONDS
from amr_description.control.contracts import ControllerContext, Input, Output, Port
from amr_description.control.interfaces import (
    CommandInterface,
    Handle,
    InterfaceRequest,
    NO_INTERFACES,
    POSITION,
    StateInterface,
    VELOCITY,
)
from amr_description.control.samples import Frames, TwistSample
from amr_description.controllers.drives import former_drive_parameters
from amr_description.controllers.drives.command_reception import CommandReception
from amr_description.controllers.drives.odometry import DeadReckoning, Odometry, WheelSide
from amr_description.controllers.drives.rate_limiter import RateLimiter, TwistLimiter
from amr_description.controllers.drives.wheeled_drive import (
    STAMPED_TWIST,
    stamped_twist_input,
    WheeledDrive,
)
from amr_description.errors import ControllerError
from amr_description.former_parameters import FormerParameter
from amr_description.log import Severity
from amr_description.parameters import group, parameter

_NO_LIMIT: dict[str, Any] = {'nan': True}
LENGTH = (1e-3, 100.0)
"""m: from a toy to a mining truck, with room."""
_FACTOR = (0.01, 100.0)
_DEPRECATED = 'Deprecated: set the limits themselves to .nan instead'


@dataclass(frozen=True)
class SpeedLimits:
    """Limits of one component of the commanded twist; NaN: no limit."""

    former: ClassVar[tuple[FormerParameter, ...]] = former_drive_parameters.SPEED_LIMITS
    has_velocity_limits: bool = parameter(True, _DEPRECATED)
    has_acceleration_limits: bool = parameter(True, _DEPRECATED)
    has_jerk_limits: bool = parameter(True, _DEPRECATED)
    max_velocity: float = parameter(math.nan, 'Highest velocity', minimum=0.0, **_NO_LIMIT)
    min_velocity: float = parameter(
        math.nan, 'Lowest velocity; .nan: -max_velocity', maximum=0.0, **_NO_LIMIT
    )
    max_acceleration: float = parameter(
        math.nan, 'Away from zero, forward', minimum=0.0, **_NO_LIMIT
    )
    max_deceleration: float = parameter(
        math.nan,
        'Towards zero, forward; .nan: max_acceleration_reverse',
        maximum=0.0,
        **_NO_LIMIT,
    )
    max_acceleration_reverse: float = parameter(
        math.nan, 'Away from zero, in reverse; .nan: -max_acceleration', maximum=0.0, **_NO_LIMIT
    )
    max_deceleration_reverse: float = parameter(
        math.nan, 'Towards zero, in reverse; .nan: max_acceleration', minimum=0.0, **_NO_LIMIT
    )
    min_acceleration: float = parameter(
        math.nan, 'Deprecated, ignored: use max_deceleration', **_NO_LIMIT
    )
    max_jerk: float = parameter(math.nan, 'Highest jerk', minimum=0.0, **_NO_LIMIT)
    min_jerk: float = parameter(math.nan, 'Lowest jerk; .nan: -max_jerk', maximum=0.0, **_NO_LIMIT)

    @property
    def uses_deprecated(self) -> tuple[str, ...]:
        """The ``has_…`` switches that are off."""
        switches = ('has_velocity_limits', 'has_acceleration_limits', 'has_jerk_limits')
        return tuple(name for name in switches if not getattr(self, name))

    def limiter(self) -> RateLimiter:
        """Return the limiter. Raises ParameterError: a lower limit is above its upper one."""
        limits: dict[str, float] = {}
        if self.has_velocity_limits:
            limits |= {'min_value': self.min_velocity, 'max_value': self.max_velocity}
        if self.has_acceleration_limits:
            limits |= {
                'max_acceleration_reverse': self.max_acceleration_reverse,
                'max_acceleration': self.max_acceleration,
                'max_deceleration': self.max_deceleration,
                'max_deceleration_reverse': self.max_deceleration_reverse,
            }
        if self.has_jerk_limits:
            limits |= {'min_jerk': self.min_jerk, 'max_jerk': self.max_jerk}
        return RateLimiter(**limits)


_SIX_ZEROS = (0.0,) * 6


@dataclass(frozen=True)
class DiffDriveParameters:
    """The table of diff_drive_controller/DiffDriveController."""

    former: ClassVar[tuple[FormerParameter, ...]] = former_drive_parameters.DIFF_DRIVE
    left_wheel_names: tuple[str, ...] = parameter(
        (), 'Joints of the wheels on the left', not_empty=True
    )
    right_wheel_names: tuple[str, ...] = parameter(
        (), 'Joints of the wheels on the right', not_empty=True
    )
    wheel_separation: float = parameter(
        0.0,
        'Shortest distance between the left and the right wheels',
        unit='m',
        above=0.0,
        magnitude=LENGTH,
    )
    wheel_radius: float = parameter(
        0.0, 'Radius of a wheel', unit='m', above=0.0, magnitude=LENGTH
    )
    wheel_separation_multiplier: float = parameter(
        1.0,
        'Factor on the separation: a skid-steered robot scrubs, and turns less',
        not_zero=True,
        magnitude=_FACTOR,
    )
    left_wheel_radius_multiplier: float = parameter(
        1.0, 'Factor on the radius, left', not_zero=True, magnitude=_FACTOR
    )
    right_wheel_radius_multiplier: float = parameter(
        1.0, 'Factor on the radius, right', not_zero=True, magnitude=_FACTOR
    )
    tf_frame_prefix_enable: bool = parameter(True, 'Put a prefix before the frame ids')
    tf_frame_prefix: str = parameter('', 'That prefix; empty: the namespace of the node')
    odom_frame_id: str = parameter('odom', 'Frame in which the pose is given')
    base_frame_id: str = parameter('base_link', 'Frame whose pose is given: the root of the URDF')
    pose_covariance_diagonal: tuple[float, ...] = parameter(
        _SIX_ZEROS, 'Variances of x, y, z, roll, pitch, yaw', unit='m², rad²', length=6
    )
    twist_covariance_diagonal: tuple[float, ...] = parameter(
        _SIX_ZEROS, 'Variances of the twist, in the same order', unit='m²/s², rad²/s²', length=6
    )
    open_loop: bool = parameter(False, 'Odometry from the limited commands, not from the wheels')
    position_feedback: bool = parameter(
        True, 'Odometry from the positions of the wheels, not from their velocities'
    )
    enable_odom_tf: bool = parameter(True, 'Publish the transform from odom to base on /tf')
    cmd_vel_timeout: float = parameter(
        0.5,
        'Age at which a command ends and the robot brakes; 0: never',
        unit='s',
        minimum=0.0,
        magnitude=(1e-6, 1e9),
    )
    publish_limited_velocity: bool = parameter(False, 'Publish the limited command, ~/cmd_vel_out')
    velocity_rolling_window_size: int = parameter(
        10, 'Samples in the mean of the estimated twist', minimum=1, magnitude=(1, 100_000)
    )
    publish_rate: float = parameter(
        50.0, 'Rate of odometry and transform', unit='Hz', above=0.0, magnitude=(1e-3, 1e5)
    )
    enable_cmd_vel_unstamped: bool = parameter(
        False,
        'Subscribe to plain Twist on ~/cmd_vel_unstamped too, which counts as stamped on arrival. '
        'Not in the original (use_stamped_vel of Humble: false moved all input there)',
    )
    preserve_curvature: bool = parameter(
        False,
        'Limit linear and angular velocity by one factor, so that the robot keeps to the arc. '
        'Not in the original',
    )
    linear: SpeedLimits = group('linear.x', SpeedLimits)
    angular: SpeedLimits = group('angular.z', SpeedLimits)

    def frame_ids(self, namespace: str) -> tuple[str, str]:
        """
        Return the ids of the odometry and the base frame, with their prefix.

        The prefix is ``tf_frame_prefix`` or, if that is empty, the namespace of the node.
        """
        prefix = tf_prefix(self.tf_frame_prefix_enable, self.tf_frame_prefix, namespace)
        return prefix + self.odom_frame_id, prefix + self.base_frame_id


def tf_prefix(is_enabled: bool, prefix: str, namespace: str) -> str:
    """
    Return what to put before frame ids: it ends with one slash and begins with none.

    Args:
        is_enabled: False: nothing.
        prefix: as written, where ``~`` stands for the namespace; empty: the namespace.
        namespace: of the controller's node.
    """
    if not is_enabled:
        return ''
    prefix = prefix.replace('~', namespace.strip('/')) or namespace
    return (prefix if prefix.endswith('/') else f'{prefix}/').removeprefix('/')


_UNSTAMPED = 'geometry_msgs/msg/Twist'


class DiffDriveController(WheeledDrive):
    """Drives any number of wheels on each side; see the module."""

    parameters_type = DiffDriveParameters
    keeps_references = True

    def __init__(self, context: ControllerContext) -> None:
        super().__init__(context)
        self._linear, self._angular = self._references

    # --- transitions -------------------------------------------------------------------------

    def configure(self, parameters: DiffDriveParameters) -> None:
        """Check the parameters against each other, and set the pose to the origin."""
        left, right = len(parameters.left_wheel_names), len(parameters.right_wheel_names)
        if left != right:
            raise ControllerError(
                f'The number of left wheels [{left}] and the number of right wheels [{right}] '
                'are different'
            )
        self._parameters = parameters
        self._separation = parameters.wheel_separation_multiplier * parameters.wheel_separation
        self._limiter = TwistLimiter(
            self._rate_limiter(parameters.linear),
            self._rate_limiter(parameters.angular),
            keeps_curvature=parameters.preserve_curvature,
        )
        self._is_fresh = True
        self._reception = CommandReception(
            round(parameters.cmd_vel_timeout * NANOSECONDS), self.log
        )
        self._reckoning = DeadReckoning(
            Odometry(self._separation, parameters.velocity_rolling_window_size),
            is_open_loop=parameters.open_loop,
            has_positions=parameters.position_feedback,
        )
        self._gate = PublishGate(int(NANOSECONDS / parameters.publish_rate))
        self._take_wheels((), ())
        self._odometry = self._reckoning.odometry
        self._frames = Frames(
            *parameters.frame_ids(self.context.namespace),
            parameters.pose_covariance_diagonal,
            parameters.twist_covariance_diagonal,
        )
        topics = '~/odom', '/tf'
        self._make_ports(stamped_twist_input(), topics, enable_tf=parameters.enable_odom_tf)
        self._unstamped: Input[TwistSample] = Input(
            Port('~/cmd_vel_unstamped', _UNSTAMPED, sample=TwistSample)
        )
        self._command_out: Output[TwistSample] = Output(
            Port('~/cmd_vel_out', STAMPED_TWIST, sample=TwistSample)
        )

    def command_interfaces(self) -> InterfaceRequest:
        """Return the velocity command of every wheel: the left side, then the right."""
        return self._wheel_interfaces(VELOCITY)

    def state_interfaces(self) -> InterfaceRequest:
        """Return the position (or velocity) of every wheel, likewise; none in open loop."""
        if self._parameters.open_loop:
            return NO_INTERFACES
        return self._wheel_interfaces(POSITION if self._parameters.position_feedback else VELOCITY)

    def inputs(self) -> tuple[Input[Any], ...]:
        """Return ``~/cmd_vel``, if enabled ``~/cmd_vel_unstamped``, and the lock."""
        optional = (self._unstamped,) if self._parameters.enable_cmd_vel_unstamped else ()
        return (self._command, *optional, self._emergency_stop)

    def outputs(self) -> tuple[Output[Any], ...]:
        """Return ``~/odom``, ``/tf`` and, if enabled, ``~/cmd_vel_out``."""
        optional = (self._command_out,) if self._parameters.publish_limited_velocity else ()
        return (self._odom, self._transform, *optional)

    def activate(
        self, commands: Sequence[CommandInterface], states: Sequence[StateInterface], time: int
    ) -> None:
        """Take the wheels; nothing is written before the first command, or the timeout."""
        _require('command', self.command_interfaces(), commands)
        _require('state', self.state_interfaces(), states)
        self._take_wheels(commands, states)
        if self._is_fresh:
            self._reception.forget(time)
        self._set_references(self._none)
        self._limiter.forget()
        self._reckoning.hold(time)

    def deactivate(self, time: int) -> None:
        """Stop every wheel; the pose stays. The timeout starts now, as in the original."""
        self._is_fresh = False
        self._reception.forget(time)
        self._left.drive(0.0)
        self._right.drive(0.0)
        self._set_references(self._none)
        self._take_wheels((), ())

    def reset(self, time: int) -> None:
        """Start over at the origin: the simulation was reset, and the robot with it."""
        self._reckoning.reset(time)
        self._gate.reset()
        self._limiter.forget()
        for port in self.inputs():
            port.drain()
        self._reception.forget(time)
        self._set_references(self._held)

    def set_clock(self, time: int) -> None:
        """Keep pose and speed; the timeout starts now."""
        self._reckoning.set_clock(time)
        self._gate.reset()
        super().set_clock(time)

    # --- the cycle ---------------------------------------------------------------------------

    def update(self, time: int, period: int) -> None:
        """Receive a command, limit it, update odometry, publish, drive the wheels."""
        self._update_references(time, period)
        linear, angular = self._linear.value, self._angular.value
        if not (math.isfinite(linear) and math.isfinite(angular)):
            self._reckoning.hold(time)
            return
        linear, angular = self._limiter.limit((linear, angular), period / NANOSECONDS)
        self._reckoning.update(self._left, self._right, (linear, angular), time, period)
        self._publish(time, linear, angular)
        turn = angular * self._separation * 0.5
        self._left.drive(linear - turn)
        self._right.drive(linear + turn)

    def _receive(self, now: int) -> None:
        super()._receive(now)
        if unstamped := self._unstamped.drain():
            self._reception.receive_unstamped(unstamped, now)

    def _set_references(self, values: Sequence[float]) -> None:
        self._linear.value, self._angular.value = values

    def _publish(self, time: int, linear: float, angular: float) -> None:
        if self._gate.passes(time):
            self._publish_odometry(time)
        if self._parameters.publish_limited_velocity:
            self._command_out.send(TwistSample(time, linear, angular, self._frames.child_frame_id))

    # --- made at configure and activate --------------------------------------------------------

    def _wheel_interfaces(self, interface: str) -> InterfaceRequest:
        wheels = self._parameters.left_wheel_names + self._parameters.right_wheel_names
        return InterfaceRequest.individual(f'{wheel}/{interface}' for wheel in wheels)

    def _take_wheels(
        self, commands: Sequence[CommandInterface], states: Sequence[StateInterface]
    ) -> None:
        parameters, count = self._parameters, len(self._parameters.left_wheel_names)
        self._left = WheelSide(
            parameters.left_wheel_radius_multiplier * parameters.wheel_radius,
            commands[:count],
            states[:count],
        )
        self._right = WheelSide(
            parameters.right_wheel_radius_multiplier * parameters.wheel_radius,
            commands[count:],
            states[count:],
        )

    def _rate_limiter(self, limits: SpeedLimits) -> RateLimiter:
        for name in limits.uses_deprecated:
            self.log(
                Severity.WARN,
                f'[deprecated] {name} parameter is deprecated, instead set the respective limits '
                'to NAN',
            )
        return limits.limiter()


class PublishGate:
    """
    Decides which updates publish, if fewer than all.

    The first one does, and then each one that is later than the period. The comparison is strict
    and the period counts from the previous due time, as in diff_drive_controller 4.x: at 100 Hz
    with a period of 20 ms the updates 0, 3, 5, 7, … publish.
    """

    def __init__(self, period: int) -> None:
        """``period``: ns."""
        self._period = period
        self._previous: int | None = None

    def passes(self, time: int) -> bool:
        """Return whether the update at ``time`` (ns) publishes."""
        if self._previous is None:
            self._previous = time
            return True
        if self._previous + self._period < time:
            self._previous += self._period
            return True
        return False

    def reset(self) -> None:
        """Have the next update publish."""
        self._previous = None


def _require(kind: str, request: InterfaceRequest, handles: Sequence[Handle]) -> None:
    found = [handle.name for handle in handles]
    for name in request.names:
        if name not in found:
            raise ControllerError(f'Unable to obtain joint {kind} handle for {name}')
