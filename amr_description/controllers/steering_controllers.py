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
from amr_description.control.contracts import Output, Port
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
    PLANAR,
    ReferenceReception,
)
from amr_description.controllers.odometry import LEAST_PERIOD, PlanarOdometry
from amr_description.controllers.steering_parameters import (
    AckermannSteeringParameters,
    BicycleSteeringParameters,
    SteeringParameters,
    TricycleSteeringParameters,
)
from amr_description.controllers.wheeled_drive import (
    reference_input,
    warn_of_one_shot_reference,
    WheeledDrive,
)
from amr_description.errors import ControllerError

_NUMBERS = {1: 'one', 2: 'two'}


class SteeringController(WheeledDrive):
    """What the three steering controllers have in common."""

    layout: ClassVar[str]
    """The name of the layout in messages."""
    traction_count: ClassVar[int]
    steering_count: ClassVar[int]
    _odometry: PlanarOdometry

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
        self._frames = Frames(
            parameters.odom_frame_id,
            parameters.base_frame_id,
            parameters.pose_covariance_diagonal,
            parameters.twist_covariance_diagonal,
        )
        topics = '~/odometry', parameters.tf_odometry_topic
        self._make_ports(reference_input(), topics, enable_tf=parameters.enable_odom_tf)
        self._state: Output[SteeringStateSample] = Output(
            Port(
                '~/controller_state',
                'control_msgs/msg/SteeringControllerStatus',
                sample=SteeringStateSample,
            )
        )

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

    def outputs(self) -> tuple[Output[Any], ...]:
        """Return ``~/odometry``, ``~/tf_odometry`` and ``~/controller_state``."""
        return self._odom, self._transform, self._state

    def activate(
        self, commands: Sequence[CommandInterface], states: Sequence[StateInterface], time: int
    ) -> None:
        """Take the joints, without a command."""
        super().activate(commands, states, time)
        self._last_positions = None

    def reset(self, time: int) -> None:
        """Start over at the origin."""
        super().reset(time)
        self._last_positions = None

    # --- the cycle ---------------------------------------------------------------------------

    def update(self, time: int, period: int) -> None:
        """Receive a command, update odometry, drive and steer, publish."""
        self._update_references(time, period)
        linear, angular = (reference.value for reference in self._references)
        is_commanded = math.isfinite(linear) and math.isfinite(angular)
        if period >= LEAST_PERIOD:
            twist = (linear, angular) if is_commanded else (0.0, 0.0)
            self._update_odometry(*twist, period / NANOSECONDS)
        if is_commanded:
            self._drive(linear, angular)
        else:
            self._stop()
        self._publish_odometry(time)
        self._publish_state(time)
        self._set_references(self._none)

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
        self._command_joints((*commands.traction, *commands.steering))

    def _stop(self) -> None:
        """Stop the driven wheels; the steering stays."""
        for command in self._commands[: self.traction_count]:
            command.value = 0.0

    def _publish_state(self, time: int) -> None:
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
