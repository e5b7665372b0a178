# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
amr_description/GazeboPlanarMove: a body that moves over the ground as commanded, whatever its
wheels do, as Gazebo's planar move and VelocityControl move one.

Its command interfaces are those of :mod:`amr_description.hardware.simulated_base`. A command
(``geometry_msgs/msg/Twist`` on ``~/cmd_vel``) is in force until the next one.
"""

from collections.abc import Sequence
from dataclasses import dataclass
import math
from typing import Any

from amr_description.control.contracts import Controller, Input, Port
from amr_description.control.interfaces import CommandInterface, InterfaceRequest, StateInterface
from amr_description.control.samples import TwistSample
from amr_description.controllers.drives.wheeled_drive import EmergencyStop
from amr_description.log import Severity
from amr_description.model.base_interfaces import BASE, COMMAND_AXES
from amr_description.parameters import parameter


@dataclass(frozen=True)
class GazeboPlanarMoveParameters:
    """The table of amr_description/GazeboPlanarMove."""

    base_name: str = parameter(BASE, 'What its command interfaces begin with', not_empty=True)


class GazeboPlanarMove(Controller):
    """Hands the latest command on; see the module."""

    parameters_type = GazeboPlanarMoveParameters

    def configure(self, parameters: GazeboPlanarMoveParameters) -> None:
        """Take over the name of the base."""
        self._request = InterfaceRequest.individual(
            f'{parameters.base_name}/{axis}' for axis in COMMAND_AXES
        )
        self._commands: Sequence[CommandInterface] = ()
        self._emergency_stop = EmergencyStop(self.log)
        self._command: Input[TwistSample] = Input(
            Port('~/cmd_vel', 'geometry_msgs/msg/Twist', sample=TwistSample)
        )

    def command_interfaces(self) -> InterfaceRequest:
        """Return the velocities of the base: along x and y, about z."""
        return self._request

    def inputs(self) -> tuple[Input[Any], ...]:
        """Return ``~/cmd_vel`` and the lock."""
        return self._command, self._emergency_stop

    def activate(
        self, commands: Sequence[CommandInterface], states: Sequence[StateInterface], time: int
    ) -> None:
        """Hold the base at rest until the first command. Raises ControllerError: it lacks one."""
        self._request.require_all(commands, 'command')
        self._commands = commands
        self._move(0.0, 0.0, 0.0)

    def update(self, time: int, period: int) -> None:
        """Take the latest command."""
        if self._emergency_stop.is_engaged:
            self._command.drain()
            self._move(0.0, 0.0, 0.0)
            return
        for sample in self._command.drain()[-1:]:
            twist = sample.linear, sample.lateral, sample.angular
            if all(map(math.isfinite, twist)):
                self._move(*twist)
            else:
                self.log(
                    Severity.WARN,
                    f'a velocity command is {twist}; finite numbers are needed, it is ignored',
                    throttle=1.0,
                )

    def deactivate(self, time: int) -> None:
        """Stop the base."""
        self._move(0.0, 0.0, 0.0)
        self._commands = ()

    def reset(self, time: int) -> None:
        """Drop the command: the base is at rest again."""
        self._command.drain()
        self._move(0.0, 0.0, 0.0)

    def set_clock(self, time: int) -> None:
        """Go on: no stamp is kept."""

    def _move(self, *twist: float) -> None:
        for command, value in zip(self._commands, twist, strict=bool(self._commands)):
            command.value = value
