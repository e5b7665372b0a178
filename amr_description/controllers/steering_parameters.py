# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
The parameters of the steering controllers 4.x: names, types, defaults and bounds.

The names with front and rear are those of before traction and steering; they are accepted, each
with the original's warning.
"""

from collections.abc import Callable
from dataclasses import dataclass, replace
from typing import Any, ClassVar, Self

from amr_description.controllers import former_drive_parameters
from amr_description.controllers.diff_drive_parameters import LENGTH
from amr_description.controllers.mecanum_drive_parameters import REFERENCE_TIMEOUT, TF_TOPIC
from amr_description.controllers.steering_kinematics import (
    AckermannKinematics,
    BicycleKinematics,
    SteeringKinematics,
    TricycleKinematics,
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


def _deprecated_size(instead: str) -> Any:
    return parameter(0.0, f"Deprecated: use '{instead}'", **_SIZE)


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
    front_wheel_radius: float = _deprecated_size('traction_wheel_radius')
    rear_wheel_radius: float = _deprecated_size('traction_wheel_radius')

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
