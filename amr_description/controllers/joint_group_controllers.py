# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
position_controllers/JointGroupPositionController, velocity_controllers/… and effort_controllers/…:
the ForwardCommandController with its interface given, so that ``joints`` is all they need.
"""

from dataclasses import dataclass

from amr_description.control.interfaces import EFFORT, POSITION, VELOCITY
from amr_description.controllers.forward_command_controller import (
    ForwardCommandController,
    ForwardCommandParameters,
)
from amr_description.parameters import parameter


@dataclass(frozen=True)
class PositionGroupParameters(ForwardCommandParameters):
    """The table of position_controllers/JointGroupPositionController."""

    interface_name: str = parameter(POSITION, 'Always position', choices=(POSITION,))


@dataclass(frozen=True)
class VelocityGroupParameters(ForwardCommandParameters):
    """The table of velocity_controllers/JointGroupVelocityController."""

    interface_name: str = parameter(VELOCITY, 'Always velocity', choices=(VELOCITY,))


@dataclass(frozen=True)
class EffortGroupParameters(ForwardCommandParameters):
    """The table of effort_controllers/JointGroupEffortController."""

    interface_name: str = parameter(EFFORT, 'Always effort', choices=(EFFORT,))


class JointGroupPositionController(ForwardCommandController):
    """Commands positions, rad or m."""

    parameters_type = PositionGroupParameters


class JointGroupVelocityController(ForwardCommandController):
    """Commands velocities, rad/s or m/s."""

    parameters_type = VelocityGroupParameters


class JointGroupEffortController(ForwardCommandController):
    """Commands efforts, N·m or N."""

    parameters_type = EffortGroupParameters
