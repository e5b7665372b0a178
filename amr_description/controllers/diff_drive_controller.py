# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
diff_drive_controller/DiffDriveController: a commanded twist to wheel speeds, and odometry back.

Inverse kinematics of a differential drive, separation s and radius r (with their multipliers)::

    left  = (v − ω·s/2) / r_left        right = (v + ω·s/2) / r_right        rad/s

Where this departs from diff_drive_controller 4.x:

- previous wheel positions and the odometry's clock start at activation, not at zero, so neither
  an encoder that does not start at zero nor a late start makes the pose jump;
- when time goes back, odometry and its publication begin anew instead of falling silent;
- a stamp that is further ahead than clocks drift apart (:data:`FOREIGN_CLOCK`) is of another
  clock: it counts as now, so that the time-out still brakes when that publisher dies;
- "Braking." is said when a command times out, not every second of rest.
"""

from collections.abc import Sequence
import math

from amr_description.control.contracts import (
    Controller,
    ControllerContext,
    Input,
    Output,
    Port,
    Severity,
)
from amr_description.control.interfaces import (
    CommandInterface,
    InterfaceRequest,
    NANOSECONDS,
    NO_INTERFACES,
    POSITION,
    StateInterface,
    VELOCITY,
)
from amr_description.control.samples import Frames, OdometrySample, TwistSample
from amr_description.controllers.diff_drive_parameters import DiffDriveParameters, SpeedLimits
from amr_description.controllers.odometry import Odometry
from amr_description.controllers.publish_gate import PublishGate
from amr_description.controllers.rate_limiter import RateLimiter
from amr_description.errors import ControllerError, ParameterError

FOREIGN_CLOCK = NANOSECONDS
"""ns: a command stamped further ahead than this was stamped by another clock."""

_LEAST_STEP = 100_000
"""ns: odometry ignores an update that comes sooner after the one before."""

_CONVERT = 'amr_description.nodes.converters'
_ZERO_STAMP = (
    'Received TwistStamped with zero timestamp, setting it to current time, this message will '
    'only be shown once'
)


class DiffDriveController(Controller):
    """Drives any number of wheels a side; see the module for the formulas and departures."""

    parameters_type = DiffDriveParameters
    is_chainable = True

    def __init__(self, context: ControllerContext) -> None:
        super().__init__(context)
        self._references = tuple(
            CommandInterface(context.name, f'{axis}/{VELOCITY}') for axis in ('linear', 'angular')
        )
        self._left: Sequence[CommandInterface] = ()
        self._right: Sequence[CommandInterface] = ()
        self._left_states: Sequence[StateInterface] = ()
        self._right_states: Sequence[StateInterface] = ()
        self._last_travel: tuple[float, float] | None = None
        self._last_time = 0

    # --- transitions -------------------------------------------------------------------------

    def configure(self, parameters: DiffDriveParameters) -> None:
        """Check what one parameter alone cannot show, and set the pose to the origin."""
        left, right = len(parameters.left_wheel_names), len(parameters.right_wheel_names)
        if left != right:
            raise ControllerError(
                f'The number of left wheels [{left}] and the number of right wheels [{right}] '
                'are different'
            )
        self._parameters = parameters
        self._separation = parameters.wheel_separation_multiplier * parameters.wheel_separation
        self._left_radius = parameters.left_wheel_radius_multiplier * parameters.wheel_radius
        self._right_radius = parameters.right_wheel_radius_multiplier * parameters.wheel_radius
        self._linear_limiter = self._limiter('linear', parameters.linear)
        self._angular_limiter = self._limiter('angular', parameters.angular)
        self._timeout = round(parameters.cmd_vel_timeout * NANOSECONDS)
        self._odometry = Odometry(self._separation, parameters.velocity_rolling_window_size)
        self._gate = PublishGate(int(NANOSECONDS / parameters.publish_rate))
        self._last_travel = None
        self._limited = ((0.0, 0.0), (0.0, 0.0))
        self._make_ports(parameters)

    def command_interfaces(self) -> InterfaceRequest:
        """One velocity command a wheel: the left side, then the right."""
        return self._wheel_interfaces(VELOCITY)

    def state_interfaces(self) -> InterfaceRequest:
        """One position (or velocity) a wheel, in the same order; none in open loop."""
        if self._parameters.open_loop:
            return NO_INTERFACES
        return self._wheel_interfaces(self._feedback)

    def references(self) -> tuple[CommandInterface, ...]:
        """``linear/velocity`` in m/s and ``angular/velocity`` in rad/s."""
        return self._references

    def inputs(self) -> tuple[Input[TwistSample], ...]:
        """``~/cmd_vel``."""
        return (self._command,)

    def outputs(self) -> tuple[Output, ...]:
        """``~/odom``, ``/tf`` and, when asked for, ``~/cmd_vel_out``."""
        optional = (self._command_out,) if self._parameters.publish_limited_velocity else ()
        return (self._odom, self._transform, *optional)

    def activate(
        self, commands: Sequence[CommandInterface], states: Sequence[StateInterface], time: int
    ) -> None:
        """Take the wheels; nothing is written before a command, or the time-out, is there."""
        wheels = len(self._parameters.left_wheel_names)
        if len(commands) != 2 * wheels:
            raise ControllerError('Unable to obtain joint command handles for all the wheels')
        if not self._parameters.open_loop and (
            len(states) != 2 * wheels or any(s.interface != self._feedback for s in states)
        ):
            raise ControllerError(
                f'Unable to obtain a {self._feedback} joint state handle for each wheel'
            )
        self._left, self._right = commands[:wheels], commands[wheels:]
        self._left_states, self._right_states = states[:wheels], states[wheels : 2 * wheels]
        self._forget_commands(time)
        self._set_references(math.nan, math.nan)
        if self._parameters.open_loop or self._last_travel is None:
            self._last_time = time

    def deactivate(self, time: int) -> None:
        """Stop every wheel; the pose stays."""
        for wheel in (*self._left, *self._right):
            wheel.value = 0.0
        self._set_references(math.nan, math.nan)
        self._left = self._right = self._left_states = self._right_states = ()

    def reset(self, time: int) -> None:
        """Begin anew at the origin: simulated time went back, and the robot with it."""
        self._odometry.reset()
        self._gate.reset()
        self._last_travel = None
        self._last_time = time
        self._limited = ((0.0, 0.0), (0.0, 0.0))
        self._command.drain()
        self._forget_commands(time)
        self._set_references(0.0, 0.0)

    # --- the cycle ---------------------------------------------------------------------------

    def update(self, time: int, period: int) -> None:
        """Command, limits, odometry, publication, wheels: in this order."""
        self._take_commands(time)
        linear, angular = (reference.value for reference in self._references)
        if not (math.isfinite(linear) and math.isfinite(angular)):
            return
        linear, angular = self._limit(linear, angular, period / NANOSECONDS)
        self._update_odometry(linear, angular, time, period)
        self._publish(time, linear, angular)
        turn = angular * self._separation * 0.5
        left, right = (linear - turn) / self._left_radius, (linear + turn) / self._right_radius
        for wheel in self._left:
            wheel.value = left
        for wheel in self._right:
            wheel.value = right

    def _take_commands(self, time: int) -> None:
        for sample in self._command.drain():
            self._accept(sample, time)
        if self._timeout and time - self._command_time > self._timeout:
            if self._is_driving:
                self.log(Severity.WARN, 'Velocity command timed out. Braking.', throttle=1.0)
            self._is_driving = False
            self._set_references(0.0, 0.0)
        elif self._commanded is not None:
            linear, angular = self._commanded
            if math.isfinite(linear) and math.isfinite(angular):
                self._set_references(linear, angular)
                self._is_driving = linear != 0.0 or angular != 0.0
            else:
                self.log(
                    Severity.WARN,
                    'Command message contains NaNs. Not updating reference interfaces.',
                    throttle=1.0,
                )

    def _accept(self, sample: TwistSample, time: int) -> None:
        stamp = sample.stamp
        if stamp == 0:
            self.log(Severity.WARN, _ZERO_STAMP, throttle=math.inf)
            stamp = time
        elif stamp - time > FOREIGN_CLOCK:
            self.log(
                Severity.WARN,
                f'A command is stamped {stamp / NANOSECONDS:.3f}, but the time here is '
                f'{time / NANOSECONDS:.3f}: its publisher runs on another clock (use_sim_time?). '
                'Such commands count as stamped now; this message will only be shown once',
                throttle=math.inf,
            )
            stamp = time
        age = time - stamp
        if self._timeout and age >= self._timeout:
            self.log(
                Severity.WARN,
                f'Ignoring the received message (timestamp {stamp / NANOSECONDS:.10f}) because it '
                f'is older than the current time by {age / NANOSECONDS:.10f} seconds, which '
                f'exceeds the allowed timeout ({self._timeout / NANOSECONDS:.4f})',
                throttle=1.0,
            )
            return
        self._command_time = stamp
        self._commanded = (sample.linear, sample.angular)

    def _forget_commands(self, time: int) -> None:
        self._command_time = time
        self._commanded: tuple[float, float] | None = None
        self._is_driving = False

    def _set_references(self, linear: float, angular: float) -> None:
        self._references[0].value = linear
        self._references[1].value = angular

    def _limit(self, linear: float, angular: float, dt: float) -> tuple[float, float]:
        (linear_1, angular_1), (linear_2, angular_2) = self._limited
        limited = (
            self._linear_limiter.limit(linear, linear_1, linear_2, dt),
            self._angular_limiter.limit(angular, angular_1, angular_2, dt),
        )
        self._limited = (limited, self._limited[0])
        return limited

    def _update_odometry(self, linear: float, angular: float, time: int, period: int) -> None:
        left, right = self._wheel_travel(period)
        last_left, last_right = self._last_travel = self._last_travel or (left, right)
        elapsed = time - self._last_time
        if elapsed < _LEAST_STEP:
            return
        self._last_time = time
        dt = elapsed / NANOSECONDS
        if self._parameters.open_loop:
            self._odometry.update_open_loop(linear, angular, dt)
            return
        if self._parameters.position_feedback:
            self._last_travel = (left, right)
            left, right = left - last_left, right - last_right
        self._odometry.update_from_travel(left, right, dt)

    def _wheel_travel(self, period: int) -> tuple[float, float]:
        """Mean travel of each side, m: since the wheels' zero, or within ``period``."""
        if self._parameters.open_loop:
            return 0.0, 0.0
        left = self._mean(self._left_states) * self._left_radius
        right = self._mean(self._right_states) * self._right_radius
        if self._parameters.position_feedback:
            return left, right
        return left * period / NANOSECONDS, right * period / NANOSECONDS

    def _mean(self, states: Sequence[StateInterface]) -> float:
        values = [state.value for state in states]
        for index, value in enumerate(values):
            if math.isnan(value):
                raise ControllerError(
                    f'Either the left or right wheel {self._feedback} is invalid for index '
                    f'[{index}]: {states[index].name} is NaN'
                )
        return sum(values) / len(values)

    def _publish(self, time: int, linear: float, angular: float) -> None:
        if self._gate.passes(time):
            odometry = self._odometry
            sample = OdometrySample(
                stamp=time,
                x=odometry.x,
                y=odometry.y,
                heading=odometry.heading,
                linear=odometry.linear,
                angular=odometry.angular,
                frames=self._frames,
            )
            self._odom.send(sample)
            if self._parameters.enable_odom_tf:
                self._transform.send(sample)
        if self._parameters.publish_limited_velocity:
            self._command_out.send(TwistSample(time, linear, angular, self._frames.child_frame_id))

    # --- made at configure -------------------------------------------------------------------

    @property
    def _feedback(self) -> str:
        return POSITION if self._parameters.position_feedback else VELOCITY

    def _wheel_interfaces(self, interface: str) -> InterfaceRequest:
        wheels = self._parameters.left_wheel_names + self._parameters.right_wheel_names
        return InterfaceRequest.individual(f'{wheel}/{interface}' for wheel in wheels)

    def _limiter(self, axis: str, limits: SpeedLimits) -> RateLimiter:
        for name in limits.uses_deprecated:
            self.log(
                Severity.WARN,
                f'[deprecated] {name} parameter is deprecated, instead set the respective limits '
                'to NAN',
            )
        try:
            return limits.limiter()
        except ParameterError as error:
            raise ControllerError(f'Failed to configure {axis} speed limiter: {error}') from error

    def _make_ports(self, parameters: DiffDriveParameters) -> None:
        odom, base = frame_ids(parameters, self.context.namespace)
        self._frames = Frames(
            odom, base, parameters.pose_covariance_diagonal, parameters.twist_covariance_diagonal
        )
        stamped = 'geometry_msgs/msg/TwistStamped'
        self._command: Input[TwistSample] = Input(
            Port('~/cmd_vel', stamped, f'{_CONVERT}:twist_sample')
        )
        self._odom: Output[OdometrySample] = Output(
            Port('~/odom', 'nav_msgs/msg/Odometry', f'{_CONVERT}:fill_odometry')
        )
        self._transform: Output[OdometrySample] = Output(
            Port('/tf', 'tf2_msgs/msg/TFMessage', f'{_CONVERT}:fill_odometry_transform')
        )
        self._command_out: Output[TwistSample] = Output(
            Port('~/cmd_vel_out', stamped, f'{_CONVERT}:fill_twist')
        )


def frame_ids(parameters: DiffDriveParameters, namespace: str) -> tuple[str, str]:
    """
    Return the ids of the odometry and the base frame, with the prefix that they ask for.

    The prefix is ``tf_frame_prefix``, or the node's namespace where that is empty; it ends with
    one slash and begins with none.
    """
    prefix = ''
    if parameters.tf_frame_prefix_enable:
        prefix = parameters.tf_frame_prefix or namespace
        prefix = (prefix if prefix.endswith('/') else f'{prefix}/').removeprefix('/')
    return prefix + parameters.odom_frame_id, prefix + parameters.base_frame_id
