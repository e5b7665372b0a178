# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
The steering controllers: a twist to driven and steered wheels, and odometry.

- ``bicycle_steering_controller/BicycleSteeringController``: one driven, one steered joint
- ``tricycle_steering_controller/TricycleSteeringController``: two driven joints, one steered
- ``ackermann_steering_controller/AckermannSteeringController``: two driven, two steered

Joints are given right before left. Odometry is from the driven wheels and the measured steering
angle or, in open loop, from the commands: exact arcs, with a rolling mean of the twist.

Differences from steering_controllers_library 4.x, besides those of
:mod:`~amr_description.controllers.steering_kinematics`:

- with ``position_feedback`` odometry starts where the wheels are at activation, not at zero;
- when deactivated the driven wheels are commanded 0 and the steering keeps its command, where the
  original commands NaN: nothing;
- deprecated radii are taken over with a warning by the bicycle, too, where the original refuses
  them; where front and rear are given, that of the driven wheels counts;
- a size that is not set is an error for all three.

Addition: ``tf_odometry_topic``, as of the mecanum drive controller.
"""

from collections.abc import Sequence
import math
from typing import Any, ClassVar

from amr_description.clock import NANOSECONDS
from amr_description.control.contracts import Controller, ControllerContext, Input, Output, Port
from amr_description.control.interfaces import (
    CommandInterface,
    InterfaceRequest,
    POSITION,
    StateInterface,
    VELOCITY,
)
from amr_description.control.samples import (
    Frames,
    SteeringStateSample,
)
from amr_description.controllers.command_reception import (
    ignore_commands,
    PLANAR,
    ReferenceReception,
)
from amr_description.controllers.drive_ports import (
    EmergencyStop,
    odometry_outputs,
    reference_input,
    warn_of_one_shot_reference,
)
from amr_description.controllers.odometry import LEAST_PERIOD, PlanarOdometry
from amr_description.controllers.steering_parameters import (
    AckermannSteeringParameters,
    BicycleSteeringParameters,
    SteeringParameters,
    TricycleSteeringParameters,
)
from amr_description.errors import ControllerError

_NONE = (math.nan, math.nan)
_NUMBERS = {1: 'one', 2: 'two'}


class SteeringController(Controller):
    """What the three steering controllers have in common."""

    is_chainable = True

    layout: ClassVar[str]
    """The name of the layout in messages."""
    traction_count: ClassVar[int]
    steering_count: ClassVar[int]

    def __init__(self, context: ControllerContext) -> None:
        super().__init__(context)
        self._references = tuple(
            CommandInterface(context.name, f'{axis}/{VELOCITY}') for axis in ('linear', 'angular')
        )
        self._commands: Sequence[CommandInterface] = ()
        self._states: Sequence[StateInterface] = ()

    # --- transitions -------------------------------------------------------------------------

    def configure(self, parameters: SteeringParameters) -> None:
        """Check the numbers of joints and the sizes, and set the pose to the origin."""
        self._parameters = parameters = parameters.modernized(self.log)
        self._kinematics = parameters.kinematics()
        traction = parameters.traction_joints_names, parameters.traction_joints_state_names
        steering = parameters.steering_joints_names, parameters.steering_joints_state_names
        self._traction_states = self._checked(*traction, self.traction_count, 'traction')
        self._steering_states = self._checked(*steering, self.steering_count, 'steering')
        self._odometry = PlanarOdometry(parameters.velocity_rolling_window_size)
        timeout = round(parameters.reference_timeout * NANOSECONDS)
        self._reception = ReferenceReception(timeout, self.log, PLANAR, stops_at_outdated=False)
        warn_of_one_shot_reference(self, timeout)
        self._steered = 0.0
        self._last_positions: tuple[float, ...] | None = None
        self._make_ports(parameters)

    def command_interfaces(self) -> InterfaceRequest:
        """Return the velocities of the driven joints, then the positions of the steered ones."""
        return InterfaceRequest.individual(
            (
                *(f'{name}/{VELOCITY}' for name in self._parameters.traction_joints_names),
                *(f'{name}/{POSITION}' for name in self._parameters.steering_joints_names),
            )
        )

    def state_interfaces(self) -> InterfaceRequest:
        """Return the velocities (or positions) and the positions that are measured, likewise."""
        feedback = POSITION if self._parameters.position_feedback else VELOCITY
        return InterfaceRequest.individual(
            (
                *(f'{name}/{feedback}' for name in self._traction_states),
                *(f'{name}/{POSITION}' for name in self._steering_states),
            )
        )

    def references(self) -> tuple[CommandInterface, ...]:
        """Return ``linear/velocity`` in m/s and ``angular/velocity`` in rad/s."""
        return self._references

    def inputs(self) -> tuple[Input[Any], ...]:
        """Return ``~/reference`` and the lock."""
        return self._command, self._emergency_stop

    def outputs(self) -> tuple[Output[Any], ...]:
        """Return ``~/odometry``, ``~/tf_odometry`` and ``~/controller_state``."""
        return self._odom, self._transform, self._state

    def activate(
        self, commands: Sequence[CommandInterface], states: Sequence[StateInterface], time: int
    ) -> None:
        """Take the joints, without a command."""
        self._commands, self._states = commands, states
        self._last_positions = None
        self._reception.forget(time)
        self._set_references(_NONE)

    def deactivate(self, time: int) -> None:
        """Stop the driven wheels; the steering and the pose stay."""
        self._stop()
        self._reception.forget(time)
        self._commands = self._states = ()

    def reset(self, time: int) -> None:
        """Start over at the origin."""
        self._odometry.reset()
        self._last_positions = None
        self.set_clock(time)

    def set_clock(self, time: int) -> None:
        """Keep the pose; there is no command."""
        self._command.drain()
        self._reception.forget(time)
        self._set_references(_NONE)

    # --- the cycle ---------------------------------------------------------------------------

    def update(self, time: int, period: int) -> None:
        """Receive a command, update odometry, drive and steer, publish."""
        if self._emergency_stop.is_engaged:
            self._reception.discard(self.inputs(), time)
            self._set_references(_NONE)
        elif self.is_chained:
            ignore_commands(self.inputs(), self.log)
        else:
            self._reception.receive(self._command.drain(), time - period)
            self._set_references(self._reception.in_force(time) or _NONE)
        linear, angular = (reference.value for reference in self._references)
        is_commanded = math.isfinite(linear) and math.isfinite(angular)
        if period >= LEAST_PERIOD:
            twist = (linear, angular) if is_commanded else (0.0, 0.0)
            self._update_odometry(*twist, period / NANOSECONDS)
        if is_commanded:
            self._drive(linear, angular)
        else:
            self._stop()
        self._publish(time)
        self._set_references(_NONE)

    def _update_odometry(self, linear: float, angular: float, dt: float) -> None:
        if self._parameters.open_loop:
            self._odometry.update_open_loop(linear, angular, dt)
            return
        values = [state.value for state in self._states]
        if not all(map(math.isfinite, values)):
            return
        traction = tuple(values[: self.traction_count])
        steering = values[self.traction_count :]
        self._steered = self._kinematics.middle_angle(steering)
        if self._parameters.position_feedback:
            last, self._last_positions = self._last_positions or traction, traction
            traction = tuple((a - b) / dt for a, b in zip(traction, last, strict=True))
        linear, angular = self._kinematics.twist(traction, steering)
        self._odometry.update(linear * dt, angular * dt, dt)

    def _drive(self, linear: float, angular: float) -> None:
        commands = self._kinematics.commands(
            linear,
            angular,
            None if self._parameters.open_loop else self._steered,
            reduces_speed=self._parameters.reduce_wheel_speed_until_steering_reached,
        )
        values = (*commands.traction, *commands.steering)
        for command, value in zip(self._commands, values, strict=True):
            command.value = value

    def _stop(self) -> None:
        for command in self._commands[: self.traction_count]:
            command.value = 0.0

    def _set_references(self, values: tuple[float, ...]) -> None:
        for reference, value in zip(self._references, values, strict=True):
            reference.value = value

    def _publish(self, time: int) -> None:
        sample = self._odometry.sample(time, self._frames)
        self._odom.send(sample)
        if self._parameters.enable_odom_tf:
            self._transform.send(sample)
        count = self.traction_count
        states = tuple(state.value for state in self._states)
        commands = tuple(command.value for command in self._commands)
        has_positions = self._parameters.position_feedback
        self._state.send(
            SteeringStateSample(
                stamp=time,
                frame_id=self._frames.frame_id,
                traction_positions=states[:count] if has_positions else (),
                traction_velocities=() if has_positions else states[:count],
                steering_positions=states[count:],
                traction_commands=commands[:count],
                steering_commands=commands[count:],
            )
        )

    # --- made at configure -------------------------------------------------------------------

    def _checked(
        self, joints: tuple[str, ...], states: tuple[str, ...], count: int, kind: str
    ) -> tuple[str, ...]:
        """Return the joints to read. Raises ControllerError: it is another number of them."""
        required = f'{self.layout} configuration requires exactly {_NUMBERS[count]} {kind} '
        required += 'joint' if count == 1 else 'joints'
        if len(joints) != count:
            raise ControllerError(f'{required}, but {len(joints)} were provided')
        if states and len(states) != count:
            raise ControllerError(
                f'{required}, but {len(states)} state interface names were provided'
            )
        return states or joints

    def _make_ports(self, parameters: SteeringParameters) -> None:
        self._frames = Frames(
            parameters.odom_frame_id,
            parameters.base_frame_id,
            parameters.pose_covariance_diagonal,
            parameters.twist_covariance_diagonal,
        )
        self._emergency_stop = EmergencyStop(self.log)
        self._command = reference_input()
        self._odom, self._transform = odometry_outputs('~/odometry', parameters.tf_odometry_topic)
        self._state: Output[SteeringStateSample] = Output(
            Port(
                '~/controller_state',
                'control_msgs/msg/SteeringControllerStatus',
                sample=SteeringStateSample,
            )
        )


class BicycleSteeringController(SteeringController):
    """One driven and one steered joint; also for a car with a differential."""

    parameters_type = BicycleSteeringParameters
    layout = 'Bicycle'
    traction_count = 1
    steering_count = 1


class TricycleSteeringController(SteeringController):
    """Two driven joints and one that is steered."""

    parameters_type = TricycleSteeringParameters
    layout = 'Tricycle'
    traction_count = 2
    steering_count = 1


class AckermannSteeringController(SteeringController):
    """Two driven joints and two that are steered."""

    parameters_type = AckermannSteeringParameters
    layout = 'Ackermann'
    traction_count = 2
    steering_count = 2
