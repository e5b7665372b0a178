# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
forward_command_controller: values from a topic, written to command interfaces unchanged.

``ForwardCommandController`` commands one interface of several joints,
``MultiInterfaceForwardCommandController`` several interfaces of one joint. Both subscribe to
``~/commands`` (std_msgs/Float64MultiArray): one value for each interface, in its unit, in force
until the next message; nothing is written before the first.

position_controllers/JointGroupPositionController, velocity_controllers/… and effort_controllers/…
are a ForwardCommandController of one given interface: ``joints`` is their only parameter.

``PassthroughController``, of the demos of ros2_control, commands the interfaces that it names, be
they of several joints or of other controllers, and offers a reference for each: chains are made of
it. A reference that nobody has commanded yet leaves its interface alone.

Differences from forward_command_controller 4.x:

- a command of the wrong size is logged and dropped; it does not end the controller;
- on deactivation, velocity, acceleration and effort commands, which would keep the joint moving,
  are set to zero, and all others to NaN (no command); the original leaves the last command;
- when time goes back, the command is dropped in the same way.
"""

from abc import abstractmethod
from collections.abc import Sequence
from dataclasses import dataclass
import math
from typing import Any

from amr_description.control.contracts import Controller, ControllerContext, Input, Port
from amr_description.control.interfaces import (
    ACCELERATION,
    CommandInterface,
    EFFORT,
    InterfaceRequest,
    POSITION,
    StateInterface,
    VELOCITY,
)
from amr_description.control.samples import CommandsSample
from amr_description.controllers.drives.command_reception import ignore_commands
from amr_description.errors import ControllerError
from amr_description.log import Severity
from amr_description.parameters import parameter

_RATES = (VELOCITY, ACCELERATION, EFFORT)
_NO_COMMAND = math.nan


@dataclass(frozen=True)
class ForwardCommandParameters:
    """The table of forward_command_controller/ForwardCommandController."""

    joints: tuple[str, ...] = parameter((), 'Name of the joints to control')
    interface_name: str = parameter('', 'Name of the interface to command')


@dataclass(frozen=True)
class MultiInterfaceParameters:
    """The table of forward_command_controller/MultiInterfaceForwardCommandController."""

    joint: str = parameter('', 'Name of the joint to control')
    interface_names: tuple[str, ...] = parameter((), 'Names of the interfaces to command')


@dataclass(frozen=True)
class _PassthroughParameters:
    """The table of passthrough_controller/PassthroughController."""

    interfaces: tuple[str, ...] = parameter((), 'Names of the interfaces to command')


class ForwardControllersBase(Controller):
    """All of a forward command controller but the names of its interfaces."""

    def __init__(self, context: ControllerContext) -> None:
        super().__init__(context)
        self._handles: tuple[CommandInterface, ...] = ()
        self._in_force: tuple[float, ...] = ()
        """One value for each interface; empty before the first command."""

    @abstractmethod
    def interface_names(self, parameters: Any) -> tuple[str, ...]:
        """Return ``<joint>/<interface>`` in the order of a command. Raises ControllerError."""

    def configure(self, parameters: Any) -> None:
        """Take over the names."""
        names = self.interface_names(parameters)
        if twice := [name for name in dict.fromkeys(names) if names.count(name) > 1]:
            raise ControllerError(f'interface named more than once: {", ".join(twice)}')
        self._request = InterfaceRequest.individual(names)
        self._commands: Input[CommandsSample] = Input(
            Port('~/commands', 'std_msgs/msg/Float64MultiArray', sample=CommandsSample)
        )
        self.log(Severity.INFO, 'configure successful')

    def command_interfaces(self) -> InterfaceRequest:
        """Return the interfaces, in the order of a command."""
        return self._request

    def inputs(self) -> tuple[Input[CommandsSample], ...]:
        """Return ``~/commands``."""
        return (self._commands,)

    def activate(
        self, commands: Sequence[CommandInterface], states: Sequence[StateInterface], time: int
    ) -> None:
        """Take the interfaces; their values stay until the first command."""
        self._request.require_all(commands, 'command')
        for handle in commands:
            if handle.data_type != 'double':
                raise ControllerError(
                    f"The command interface '{handle.name}' is of type {handle.data_type}; "
                    'only doubles can be forwarded'
                )
        self._handles = tuple(commands)
        self._in_force = ()
        self.log(Severity.INFO, 'activate successful')

    def update(self, time: int, period: int) -> None:
        """Write the latest valid command, at every update."""
        for sample in self._commands.drain():
            if self._is_valid(sample.values):
                self._in_force = sample.values
        if self._in_force:
            for handle, value in zip(self._handles, self._in_force, strict=True):
                handle.value = value

    def deactivate(self, time: int) -> None:
        """Stop what would keep moving."""
        self._forget_command()
        self._handles = ()

    def reset(self, time: int) -> None:
        """Wait for a new command: the simulation was reset."""
        self._commands.drain()
        self._forget_command()

    def set_clock(self, time: int) -> None:
        """Do nothing: a command has no stamp, and stays in force."""

    def _is_valid(self, values: tuple[float, ...]) -> bool:
        """Return whether to forward ``values``; log why not."""
        if not all(map(math.isfinite, values)):
            self.log(Severity.WARN, 'Non-finite value received. Dropping message', throttle=1.0)
            return False
        if len(values) != len(self._handles):
            self.log(
                Severity.ERROR,
                f'command size ({len(values)}) does not match number of interfaces '
                f'({len(self._handles)})',
                throttle=1.0,
            )
            return False
        return True

    def _forget_command(self) -> None:
        self._in_force = ()
        for handle in self._handles:
            kind = handle.interface.rpartition('/')[2]  # of a reference: linear/velocity
            handle.value = 0.0 if kind in _RATES else _NO_COMMAND


class ForwardCommandController(ForwardControllersBase):
    """One interface of several joints."""

    parameters_type = ForwardCommandParameters

    def interface_names(self, parameters: ForwardCommandParameters) -> tuple[str, ...]:
        """Return joints × interface_name."""
        if not parameters.joints:
            raise ControllerError("'joints' parameter was empty")
        if not parameters.interface_name:
            raise ControllerError("'interface_name' parameter was empty")
        return tuple(f'{joint}/{parameters.interface_name}' for joint in parameters.joints)


class MultiInterfaceForwardCommandController(ForwardControllersBase):
    """Several interfaces of one joint."""

    parameters_type = MultiInterfaceParameters

    def interface_names(self, parameters: MultiInterfaceParameters) -> tuple[str, ...]:
        """Return joint × interface_names."""
        if not parameters.joint:
            raise ControllerError("'joint' parameter is empty")
        if not parameters.interface_names:
            raise ControllerError("'interfaces' parameter is empty")
        return tuple(f'{parameters.joint}/{name}' for name in parameters.interface_names)


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


class PassthroughController(ForwardControllersBase):
    """Any interfaces, each from a reference."""

    parameters_type = _PassthroughParameters
    is_chainable = True

    def configure(self, parameters: _PassthroughParameters) -> None:
        """Take over the names, and make a reference of each."""
        super().configure(parameters)
        me = self.context.name
        self._references = tuple(CommandInterface(me, each) for each in parameters.interfaces)

    def interface_names(self, parameters: _PassthroughParameters) -> tuple[str, ...]:
        """Return interfaces."""
        if not parameters.interfaces:
            raise ControllerError("'interfaces' parameter is empty")
        return parameters.interfaces

    def references(self) -> tuple[CommandInterface, ...]:
        """Return ``<controller>/<interface>`` of each, in the order of a command."""
        return self._references

    def update(self, time: int, period: int) -> None:
        """Write the references; unless chained, they are those of the latest valid command."""
        if self.is_chained:
            ignore_commands(self.inputs(), self.log)
        for sample in self._commands.drain():
            if self._is_valid(sample.values):
                self._refer(sample.values)
        for reference, handle in zip(self._references, self._handles, strict=True):
            if not math.isnan(reference.value):
                handle.value = reference.value

    def _forget_command(self) -> None:
        super()._forget_command()
        self._refer([_NO_COMMAND] * len(self._references))

    def _refer(self, values: Sequence[float]) -> None:
        for reference, value in zip(self._references, values, strict=True):
            reference.value = value
