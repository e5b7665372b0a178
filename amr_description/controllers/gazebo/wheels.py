# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
amr_description/GazeboMecanumDrive and amr_description/GazeboAckermannDrive: mecanum wheels and a
car as Gazebo's plugins drive them.

What differs from ``mecanum_drive_controller`` and ``ackermann_steering_controller``, on which they
are built:

- they subscribe to plain ``geometry_msgs/msg/Twist`` on ``~/cmd_vel``;
- a command is in force until the next one: no timeout brakes the robot.

Gazebo Classic's car takes ``angular.z`` as the angle of its tyres, δ, not as a rate of turn:
with ``angular_is_steering`` the twist is (v, v tan δ / wheelbase).
"""

from collections.abc import Iterable
from dataclasses import dataclass, replace
import math
from typing import Any

from amr_description.control.contracts import Input, Output, Port
from amr_description.control.samples import TwistSample
from amr_description.controllers.drives.command_reception import (
    CommandReception,
    HOLONOMIC,
    PLANAR,
    ReferenceReception,
    Twist,
)
from amr_description.controllers.drives.mecanum_drive_controller import (
    MecanumDriveController,
    MecanumDriveParameters,
    REFERENCE_TIMEOUT,
)
from amr_description.controllers.drives.steering_controllers import (
    AckermannSteeringController,
    AckermannSteeringParameters,
    SteeringParameters,
)
from amr_description.log import Log
from amr_description.parameters import parameter

_NOT_USED = 'Not used: a command is in force until the next one'
_ABOUT_ODOM = 'Publish odometry on ~/odometry'


@dataclass(frozen=True)
class GazeboMecanumDriveParameters(MecanumDriveParameters):
    """The table of amr_description/GazeboMecanumDrive."""

    reference_timeout: float = parameter(1.0, _NOT_USED, **REFERENCE_TIMEOUT)
    tf_frame_prefix_enable: bool = parameter(False, 'Put a prefix before the frame ids')
    tf_odometry_topic: str = parameter('/tf', 'Topic of the transform', not_empty=True)


@dataclass(frozen=True)
class GazeboAckermannDriveParameters(AckermannSteeringParameters):
    """The table of amr_description/GazeboAckermannDrive."""

    reference_timeout: float = parameter(1.0, _NOT_USED, **REFERENCE_TIMEOUT)
    tf_odometry_topic: str = parameter('/tf', 'Topic of the transform', not_empty=True)
    publish_odom: bool = parameter(True, _ABOUT_ODOM)
    angular_is_steering: bool = parameter(
        False, 'angular.z of a command is the angle of the tyres, as in Gazebo Classic'
    )
    max_steer: float = parameter(
        math.nan, 'Largest angle of the tyres; .nan: no limit', unit='rad', above=0.0, nan=True
    )


class LatestTwist(ReferenceReception):
    """The latest command, which never expires; at rest before the first one."""

    def __init__(self, log: Log, axes: tuple[str, ...]) -> None:
        """``axes``: as of :class:`CommandReception`."""
        super().__init__(0, log, axes, stops_at_outdated=False)

    def receive(self, samples: Iterable[TwistSample], now: int) -> None:
        """Take commands, oldest first."""
        self.receive_unstamped(samples, now)

    def in_force(self, time: int) -> Twist:
        """Return the twist to drive at ``time``."""
        return CommandReception.in_force(self, time) or self._at_rest


def _twist_input() -> Input[TwistSample]:
    return Input(Port('~/cmd_vel', 'geometry_msgs/msg/Twist', sample=TwistSample))


class GazeboMecanumDrive(MecanumDriveController):
    """Drives four mecanum wheels; see the module."""

    parameters_type = GazeboMecanumDriveParameters

    def configure(self, parameters: MecanumDriveParameters) -> None:
        """Set the pose to the origin."""
        super().configure(parameters)
        self._reception = LatestTwist(self.log, HOLONOMIC)
        self._command = _twist_input()

    def outputs(self) -> tuple[Output[Any], ...]:
        """Return ``~/odometry`` and, if it is wanted, the transform."""
        return (self._odom, self._transform) if self._parameters.enable_odom_tf else (self._odom,)


class GazeboAckermannDrive(AckermannSteeringController):
    """Drives two wheels of a car and steers two; see the module."""

    parameters_type = GazeboAckermannDriveParameters
    _parameters: GazeboAckermannDriveParameters

    def configure(self, parameters: SteeringParameters) -> None:
        """Check the numbers of joints and the sizes, and set the pose to the origin."""
        super().configure(parameters)
        self._reception = _LatestSteering(self.log, self._parameters)
        self._command = _twist_input()

    def outputs(self) -> tuple[Output[Any], ...]:
        """Return those of ``~/odometry`` and the transform that are wanted."""
        wanted = (
            (self._odom, self._parameters.publish_odom),
            (self._transform, self._parameters.enable_odom_tf),
        )
        return tuple(output for output, is_wanted in wanted if is_wanted)


class _LatestSteering(LatestTwist):
    """The latest command of a car, whose angle may be that of its tyres."""

    def __init__(self, log: Log, parameters: GazeboAckermannDriveParameters) -> None:
        super().__init__(log, PLANAR)
        self._car = parameters

    def receive(self, samples: Iterable[TwistSample], now: int) -> None:
        """Take commands, oldest first."""
        super().receive(map(self._as_twist, samples), now)

    def _as_twist(self, sample: TwistSample) -> TwistSample:
        if not self._car.angular_is_steering:
            return sample
        most = self._car.max_steer if math.isfinite(self._car.max_steer) else math.pi / 2.0
        angle = min(max(sample.angular, -most), most)
        turn = sample.linear * math.tan(angle) / self._car.wheelbase
        return replace(sample, angular=turn)
