# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
amr_description/GazeboJointCommand: one number on ``~/command`` for a joint, or for several alike.

So Gazebo's JointPositionController and JointController are commanded, by ``std_msgs/msg/Float64``.
"""

from dataclasses import dataclass
from typing import Any

from amr_description.control.contracts import Input, Port
from amr_description.control.interfaces import POSITION
from amr_description.control.samples import CommandsSample
from amr_description.controllers.forward_command_controller import ForwardControllersBase
from amr_description.parameters import parameter


@dataclass(frozen=True)
class GazeboJointCommandParameters:
    """The table of amr_description/GazeboJointCommand."""

    joints: tuple[str, ...] = parameter((), 'Joints that follow the command', not_empty=True)
    interface_name: str = parameter(POSITION, 'Command interface', not_empty=True)


class GazeboJointCommand(ForwardControllersBase):
    """Forwards the latest command to every joint; see the module."""

    parameters_type = GazeboJointCommandParameters

    def interface_names(self, parameters: GazeboJointCommandParameters) -> tuple[str, ...]:
        """Return one for each joint."""
        return tuple(f'{joint}/{parameters.interface_name}' for joint in parameters.joints)

    def configure(self, parameters: Any) -> None:
        """Take over the names."""
        super().configure(parameters)
        self._commands = Input(Port('~/command', 'std_msgs/msg/Float64', sample=CommandsSample))

    def update(self, time: int, period: int) -> None:
        """Write the latest valid command, at every update."""
        for sample in self._commands.drain():
            values = sample.values * len(self._handles)
            if self._is_valid(values):
                self._in_force = values
        super().update(time, period)
