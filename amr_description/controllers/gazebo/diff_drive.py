# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
amr_description/GazeboDiffDrive: a differential drive as Gazebo's plugins drive one.

What differs from ``diff_drive_controller``, on which it is built:

- it subscribes to plain ``geometry_msgs/msg/Twist`` on ``~/cmd_vel``;
- a command is in force until the next one: no timeout brakes the robot;
- odometry is published from the first update on, not from the first command on;
- ``max_wheel_acceleration`` limits how the speed of each side changes, as in Gazebo Classic.

The simulator starts it for a robot whose URDF names such a plugin, see
:mod:`amr_description.model.gazebo.translation`.
"""

from collections.abc import Sequence
from dataclasses import dataclass
import math
from typing import Any

from amr_description.clock import NANOSECONDS
from amr_description.control.contracts import Input, Output, Port
from amr_description.control.interfaces import CommandInterface, StateInterface
from amr_description.control.samples import TwistSample
from amr_description.controllers.drives.diff_drive_controller import (
    DiffDriveController,
    DiffDriveParameters,
)
from amr_description.controllers.drives.odometry import WheelSide
from amr_description.parameters import parameter


@dataclass(frozen=True)
class GazeboDiffDriveParameters(DiffDriveParameters):
    """The table of amr_description/GazeboDiffDrive."""

    cmd_vel_timeout: float = parameter(
        0.0,
        'Age at which a command ends and the robot brakes; 0: never',
        unit='s',
        minimum=0.0,
        magnitude=(1e-6, 1e9),
    )
    tf_frame_prefix_enable: bool = parameter(False, 'Put a prefix before the frame ids')
    publish_odom: bool = parameter(True, 'Publish odometry on ~/odom')
    max_wheel_acceleration: float = parameter(
        math.nan,
        'Largest acceleration of the rim of a wheel; .nan: no limit',
        unit='m/s^2',
        above=0.0,
        nan=True,
    )


class GazeboDiffDrive(DiffDriveController):
    """Drives any number of wheels on each side; see the module."""

    parameters_type = GazeboDiffDriveParameters
    _parameters: GazeboDiffDriveParameters

    def configure(self, parameters: DiffDriveParameters) -> None:
        """Check the parameters against each other, and set the pose to the origin."""
        super().configure(parameters)
        twist = Port('~/cmd_vel', 'geometry_msgs/msg/Twist', sample=TwistSample)
        self._unstamped = Input(twist)

    def inputs(self) -> tuple[Input[Any], ...]:
        """Return ``~/cmd_vel`` and the lock."""
        return self._unstamped, self._emergency_stop

    def outputs(self) -> tuple[Output[Any], ...]:
        """Return those of ``~/odom``, ``/tf`` and ``~/cmd_vel_out`` that are wanted."""
        wanted = (
            (self._odom, self._parameters.publish_odom),
            (self._transform, self._parameters.enable_odom_tf),
            (self._command_out, self._parameters.publish_limited_velocity),
        )
        return tuple(output for output, is_wanted in wanted if is_wanted)

    def activate(
        self, commands: Sequence[CommandInterface], states: Sequence[StateInterface], time: int
    ) -> None:
        """Take the wheels, and hold them at rest until the first command."""
        super().activate(commands, states, time)
        self._set_references(self._held)

    def update(self, time: int, period: int) -> None:
        """Receive a command, limit it, update odometry, publish, drive the wheels."""
        for side in (self._left, self._right):
            if isinstance(side, _AcceleratedSide):
                side.dt = period / NANOSECONDS
        super().update(time, period)

    def _take_wheels(
        self, commands: Sequence[CommandInterface], states: Sequence[StateInterface]
    ) -> None:
        super()._take_wheels(commands, states)
        acceleration = self._parameters.max_wheel_acceleration
        if math.isfinite(acceleration):
            self._left = _AcceleratedSide(self._left, acceleration)
            self._right = _AcceleratedSide(self._right, acceleration)


class _AcceleratedSide(WheelSide):
    """A side whose speed over the ground changes by a limited acceleration, m/s²."""

    def __init__(self, side: WheelSide, acceleration: float) -> None:
        super().__init__(1.0)
        self._side = side
        self._acceleration = acceleration
        self._speed = 0.0
        self.dt = 0.0
        """s, since the previous command."""

    def drive(self, speed: float) -> None:
        """Command a speed, m/s, as far as the acceleration allows."""
        step = self._acceleration * self.dt
        self._speed = min(max(speed, self._speed - step), self._speed + step)
        self._side.drive(self._speed)

    def travel(self) -> float:
        """Return that of the side."""
        return self._side.travel()
