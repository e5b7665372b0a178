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
:mod:`~amr_description.controllers.drives.steering_kinematics`:

- with ``position_feedback`` odometry starts where the wheels are at activation, not at zero;
- when deactivated the driven wheels are commanded 0 and the steering keeps its command, where the
  original commands NaN: nothing;
- deprecated radii are taken over with a warning by the bicycle, too, where the original refuses
  them; where front and rear are given, that of the driven wheels counts;
- a size that is not set is an error for all three.

Addition: ``tf_odometry_topic``, as of the mecanum drive controller.
"""

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
import math
from typing import Any, ClassVar, Self

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
from amr_description.controllers.drives import former_drive_parameters
from amr_description.controllers.drives.command_reception import (
    PLANAR,
    ReferenceReception,
)
from amr_description.controllers.drives.diff_drive_controller import LENGTH
from amr_description.controllers.drives.mecanum_drive_controller import REFERENCE_TIMEOUT, TF_TOPIC
from amr_description.controllers.drives.odometry import LEAST_PERIOD, PlanarOdometry
from amr_description.controllers.drives.steering_kinematics import (
    AckermannKinematics,
    BicycleKinematics,
    SteeringKinematics,
    TricycleKinematics,
)
from amr_description.controllers.drives.wheeled_drive import (
    reference_input,
    warn_of_one_shot_reference,
    WheeledDrive,
)
from amr_description.errors import ControllerError
from amr_description.former_parameters import FormerParameter
from amr_description.log import Log, Severity
from amr_description.parameters import parameter

_JOINTS: dict[str, Any] = {'read_only': True, 'fewer_than': 5, 'unique': True}
_EITHER = "use 'traction_joints_names' or 'steering_joints_names'"
_EITHER_STATE = "use 'traction_joints_state_names' or 'steering_joints_state_names'"
_SIZE: dict[str, Any] = {'unit': 'm', 'minimum': 0.0, 'magnitude': LENGTH}
_SIX = (0.0, 7.0, 14.0, 21.0, 28.0, 35.0)
_LISTS = (
    ('front_wheels_names', 'joints_names'),
    ('rear_wheels_names', 'joints_names'),
    ('front_wheels_state_names', 'joints_state_names'),
    ('rear_wheels_state_names', 'joints_state_names'),
)


def _deprecated_size(instead: str, *, read_only: bool = False) -> Any:
    return parameter(0.0, f"Deprecated: use '{instead}'", read_only=read_only, **_SIZE)


@dataclass(frozen=True)
class SteeringParameters:
    """What the tables of all steering controllers have in common."""

    former: ClassVar[tuple[FormerParameter, ...]] = former_drive_parameters.STAMPED_ONLY
    reference_timeout: float = parameter(
        1.0,
        'Age at which a command ends and the robot brakes; 0: after one update',
        **REFERENCE_TIMEOUT,
    )
    front_steering: bool = parameter(True, f'Deprecated: {_EITHER}', read_only=True)
    rear_wheels_names: tuple[str, ...] = parameter((), f'Deprecated: {_EITHER}', **_JOINTS)
    traction_joints_names: tuple[str, ...] = parameter(
        (), 'Joints of the driven wheels: right, left', **_JOINTS
    )
    front_wheels_names: tuple[str, ...] = parameter((), f'Deprecated: {_EITHER}', **_JOINTS)
    steering_joints_names: tuple[str, ...] = parameter(
        (), 'Joints of the steering, positive to the left: right, left', **_JOINTS
    )
    traction_joints_state_names: tuple[str, ...] = parameter(
        (), 'Joints whose motion is that of the driven wheels; empty: the same', **_JOINTS
    )
    rear_wheels_state_names: tuple[str, ...] = parameter(
        (), f'Deprecated: {_EITHER_STATE}', **_JOINTS
    )
    steering_joints_state_names: tuple[str, ...] = parameter(
        (), 'Joints whose angle is that of the steering; empty: the same', **_JOINTS
    )
    front_wheels_state_names: tuple[str, ...] = parameter(
        (), f'Deprecated: {_EITHER_STATE}', **_JOINTS
    )
    open_loop: bool = parameter(False, 'Odometry from the commands, not from the wheels')
    reduce_wheel_speed_until_steering_reached: bool = parameter(
        False, 'Drive slowly until the steering angle has been reached'
    )
    velocity_rolling_window_size: int = parameter(
        10, 'Samples in the mean of the estimated twist', minimum=1, magnitude=(1, 100_000)
    )
    base_frame_id: str = parameter('base_link', 'Frame whose pose is given')
    odom_frame_id: str = parameter('odom', 'Frame in which the pose is given')
    enable_odom_tf: bool = parameter(True, 'Publish the transform from odom to base')
    tf_odometry_topic: str = parameter('~/tf_odometry', TF_TOPIC, not_empty=True)
    twist_covariance_diagonal: tuple[float, ...] = parameter(
        _SIX, 'Variances of the twist: x, y, z, roll, pitch, yaw', unit='m²/s², rad²/s²', length=6
    )
    pose_covariance_diagonal: tuple[float, ...] = parameter(
        _SIX, 'Variances of the pose', unit='m², rad²', length=6
    )
    position_feedback: bool = parameter(
        False, 'Odometry from the positions of the wheels, not from their velocities'
    )
    wheelbase: float = parameter(
        0.0, 'Distance of the two axles', unit='m', above=0.0, magnitude=LENGTH
    )

    def modernized(self, log: Log) -> Self:
        """Return the parameters with deprecated ones in their place, and warn of each."""
        changes: dict[str, Any] = {}
        if not self.front_steering:
            log(
                Severity.WARN,
                "DEPRECATED parameter 'front_steering'. Instead, set 'traction_joints_names' or "
                "'steering_joints_names'",
            )
        for name, kind in _LISTS:
            if getattr(self, name):
                log(
                    Severity.WARN,
                    f"DEPRECATED parameter '{name}', set 'traction_{kind}' or 'steering_{kind}' "
                    'instead',
                )
                changes[f'{self._role(name)}_{kind}'] = getattr(self, name)
        return replace(self, **changes)

    def kinematics(self) -> SteeringKinematics:
        """Return the kinematics. Raises ControllerError: a size is not set."""
        raise NotImplementedError

    def _role(self, name: str) -> str:
        """Return what the wheels are for that a deprecated parameter is about."""
        return 'steering' if name.startswith('front') == self.front_steering else 'traction'

    def _with_size(self, old: str, new: str, instead: str, log: Log, says: str = '') -> Self:
        """Take a deprecated size over, if it is set."""
        value = getattr(self, old)
        if value <= 0.0:
            return self
        log(Severity.WARN, f"DEPRECATED parameter '{says or old}', set {instead} instead")
        return replace(self, **{new: value})

    def _require(self, *names: str) -> None:
        for name in names:
            if getattr(self, name) <= 0.0:
                raise ControllerError(
                    f"parameter '{name}' is not set, cannot configure odometry; it is the "
                    f'{_MEANINGS[name]} in m, found {getattr(self, name):g}'
                )


_MEANINGS = {
    'traction_wheel_radius': 'radius of the driven wheel',
    'traction_wheels_radius': 'radius of the driven wheels',
    'traction_track_width': 'distance of the driven wheels',
}


@dataclass(frozen=True)
class BicycleSteeringParameters(SteeringParameters):
    """The table of bicycle_steering_controller/BicycleSteeringController."""

    traction_wheel_radius: float = parameter(0.0, 'Radius of the driven wheel', **_SIZE)
    front_wheel_radius: float = _deprecated_size('traction_wheel_radius', read_only=True)
    rear_wheel_radius: float = _deprecated_size('traction_wheel_radius', read_only=True)

    def modernized(self, log: Log) -> Self:
        """Return the parameters with deprecated ones in their place, and warn of each."""
        found = super().modernized(log)
        for name in _by_role(found._role, 'front_wheel_radius', 'rear_wheel_radius'):
            found = found._with_size(name, 'traction_wheel_radius', "'traction_wheel_radius'", log)
        return found

    def kinematics(self) -> SteeringKinematics:
        """Return the kinematics. Raises ControllerError: a size is not set."""
        self._require('traction_wheel_radius')
        return BicycleKinematics(self.wheelbase, self.traction_wheel_radius)


@dataclass(frozen=True)
class _TwoWheelsParameters(SteeringParameters):
    """What the tables for two driven wheels have in common."""

    traction_track_width: float = parameter(0.0, 'Distance of the driven wheels', **_SIZE)
    traction_wheels_radius: float = parameter(0.0, 'Radius of the driven wheels', **_SIZE)
    front_wheels_radius: float = _deprecated_size('traction_wheels_radius')
    rear_wheels_radius: float = _deprecated_size('traction_wheels_radius')

    def modernized(self, log: Log) -> Self:
        """Return the parameters with deprecated ones in their place, and warn of each."""
        found = super().modernized(log)
        for name in _by_role(found._role, 'front_wheels_radius', 'rear_wheels_radius'):
            found = found._with_size(
                name,
                'traction_wheels_radius',
                "'traction_wheels_radius'",
                log,
                name.replace('wheels', 'wheel'),
            )
        return found


@dataclass(frozen=True)
class TricycleSteeringParameters(_TwoWheelsParameters):
    """The table of tricycle_steering_controller/TricycleSteeringController."""

    wheel_track: float = _deprecated_size('traction_track_width')

    def modernized(self, log: Log) -> Self:
        """Return the parameters with deprecated ones in their place, and warn of each."""
        found = super().modernized(log)
        return found._with_size(
            'wheel_track', 'traction_track_width', "'traction_track_width'", log
        )

    def kinematics(self) -> SteeringKinematics:
        """Return the kinematics. Raises ControllerError: a size is not set."""
        self._require('traction_track_width', 'traction_wheels_radius')
        return TricycleKinematics(
            self.wheelbase, self.traction_wheels_radius, self.traction_track_width
        )


@dataclass(frozen=True)
class AckermannSteeringParameters(_TwoWheelsParameters):
    """The table of ackermann_steering_controller/AckermannSteeringController."""

    front_wheel_track: float = _deprecated_size("traction_track_width' or 'steering_track_width")
    steering_track_width: float = parameter(
        0.0, 'Distance of the steered wheels; 0: that of the driven ones', **_SIZE
    )
    rear_wheel_track: float = _deprecated_size("traction_track_width' or 'steering_track_width")

    def modernized(self, log: Log) -> Self:
        """Return the parameters with deprecated ones in their place, and warn of each."""
        found = super().modernized(log)
        for name in ('front_wheel_track', 'rear_wheel_track'):
            found = found._with_size(
                name,
                f'{found._role(name)}_track_width',
                "'traction_track_width' or 'steering_track_width'",
                log,
            )
        return found

    def kinematics(self) -> SteeringKinematics:
        """Return the kinematics. Raises ControllerError: a size is not set."""
        self._require('traction_track_width', 'traction_wheels_radius')
        return AckermannKinematics(
            self.wheelbase,
            self.traction_wheels_radius,
            self.traction_track_width,
            self.steering_track_width or self.traction_track_width,
        )


def _by_role(role: Callable[[str], str], *names: str) -> tuple[str, ...]:
    """Return the names in the order in which they count: that of the driven wheels last."""
    return tuple(sorted(names, key=lambda name: role(name) == 'traction'))


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
