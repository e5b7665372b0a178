# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
gpio_controllers/GpioCommandController: commands to GPIOs from a topic, and their states on one.

``~/commands`` and ``~/gpio_states`` are control_msgs/DynamicInterfaceGroupValues: a group for each
GPIO, with names and values of some of its interfaces. A command stays in force until the next one
for that interface, and when the controller is deactivated. Without ``state_interfaces``, all that
the URDF gives the GPIOs are published; without ``command_interfaces``, it commands nothing.

Difference from gpio_controllers 4.x: a command with more names than values, or fewer, is logged
and dropped; it does not end the controller.
"""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
import math
from typing import Any

from amr_description.control.contracts import Controller, ControllerContext, Input, Output, Port
from amr_description.control.interfaces import (
    CommandInterface,
    Handle,
    InterfaceRequest,
    StateInterface,
)
from amr_description.control.sensor_samples import InterfaceGroup, InterfaceGroupsSample
from amr_description.errors import ControllerError
from amr_description.log import Severity
from amr_description.model.ros2_control_tag import hardware_of
from amr_description.parameters import keyed_group, parameter
from amr_description.text import quote

_FLOATS = ('double', 'float32')
_MESSAGE = 'control_msgs/msg/DynamicInterfaceGroupValues'


@dataclass(frozen=True)
class GpioInterfaces:
    """Interfaces of one GPIO."""

    interfaces: tuple[str, ...] = parameter(
        (), 'Names of the interfaces', unique=True, read_only=True
    )


@dataclass(frozen=True)
class GpioParameters:
    """The table of gpio_controllers/GpioCommandController."""

    gpios: tuple[str, ...] = parameter(
        (), 'GPIOs, as <ros2_control> names them', not_empty=True, unique=True, read_only=True
    )
    command_interfaces: Mapping[str, GpioInterfaces] = keyed_group(
        'command_interfaces', 'gpios', GpioInterfaces
    )
    state_interfaces: Mapping[str, GpioInterfaces] = keyed_group(
        'state_interfaces', 'gpios', GpioInterfaces
    )


class GpioCommandController(Controller):
    """Forwards commands, and publishes states at every update."""

    parameters_type = GpioParameters

    def __init__(self, context: ControllerContext) -> None:
        super().__init__(context)
        self._handles: dict[str, CommandInterface] = {}
        self._states: tuple[tuple[str, tuple[str, ...], tuple[StateInterface, ...]], ...] = ()

    def configure(self, parameters: GpioParameters) -> None:
        """Determine the interfaces. Raises ControllerError: there is none."""
        self._gpios = parameters.gpios
        commands = _named(parameters.command_interfaces)
        states = _named(parameters.state_interfaces)
        if not states:
            self.log(
                Severity.INFO,
                'State interfaces are not configured. All available interfaces of configured '
                'GPIOs will be broadcasted.',
            )
            states = self._of_the_urdf()
        if not commands and not states:
            raise ControllerError('No command or state interfaces are configured')
        self._requests = InterfaceRequest.individual(commands), InterfaceRequest.individual(states)
        self._commands: Input[InterfaceGroupsSample] = Input(
            Port('~/commands', _MESSAGE, sample=InterfaceGroupsSample)
        )
        self._published: Output[InterfaceGroupsSample] = Output(
            Port('~/gpio_states', _MESSAGE, sample=InterfaceGroupsSample)
        )
        self.log(Severity.INFO, 'configure successful')

    def command_interfaces(self) -> InterfaceRequest:
        """Return those of the parameters."""
        return self._requests[0]

    def state_interfaces(self) -> InterfaceRequest:
        """Return those of the parameters, or of the URDF."""
        return self._requests[1]

    def inputs(self) -> tuple[Input[Any], ...]:
        """Return ``~/commands``, if there is anything to command."""
        return (self._commands,) if self._requests[0].names else ()

    def outputs(self) -> tuple[Output[Any], ...]:
        """Return ``~/gpio_states``."""
        return (self._published,)

    def activate(
        self, commands: Sequence[CommandInterface], states: Sequence[StateInterface], time: int
    ) -> None:
        """Take the interfaces. Raises ControllerError: some are missing."""
        for request, handles in zip(self._requests, (commands, states), strict=True):
            _require(request, handles)
        self._handles = {handle.name: handle for handle in commands}
        groups = []
        for gpio in self._gpios:
            mine = tuple(state for state in states if state.prefix == gpio)
            groups.append((gpio, tuple(state.interface for state in mine), mine))
        self._states = tuple(groups)
        self.log(Severity.INFO, 'activate successful')

    def update(self, time: int, period: int) -> None:
        """Publish the states, then write the commands that have come."""
        groups = tuple(
            [
                InterfaceGroup(gpio, names, tuple([float(state.value) for state in states]))
                for gpio, names, states in self._states
            ]
        )
        self._published.send(InterfaceGroupsSample(time, groups))
        for sample in self._commands.drain():
            for group in sample.groups:
                self._apply(group)

    def deactivate(self, time: int) -> None:
        """Drop the interfaces; the outputs stay as they are."""
        self._handles, self._states = {}, ()

    def _apply(self, group: InterfaceGroup) -> None:
        if len(group.interfaces) != len(group.values):
            self.log(
                Severity.ERROR,
                f'For gpio {group.name} interfaces_names do not match values',
                throttle=1.0,
            )
            return
        for interface, value in zip(group.interfaces, group.values, strict=True):
            handle = self._handles.get(f'{group.name}/{interface}')
            if handle is None or not (math.isfinite(value) or handle.data_type in _FLOATS):
                self.log(
                    Severity.WARN,
                    f'Ignoring the command {value} to {quote(f"{group.name}/{interface}")}; '
                    f'command_interfaces has: {", ".join(self._handles)}',
                    throttle=1.0,
                )
            else:
                handle.value = _as(handle, value)

    def _of_the_urdf(self) -> tuple[str, ...]:
        """Return all states that the URDF gives the GPIOs, in the order of the parameter."""
        if self.context.robot is None:
            return ()
        found = {
            gpio.name: gpio.state_interfaces
            for hardware in hardware_of(self.context.robot)
            for gpio in hardware.gpios
        }
        return tuple(
            f'{gpio}/{interface.name}' for gpio in self._gpios for interface in found.get(gpio, ())
        )


def _named(groups: Mapping[str, GpioInterfaces]) -> tuple[str, ...]:
    return tuple(f'{gpio}/{name}' for gpio, group in groups.items() for name in group.interfaces)


def _require(request: InterfaceRequest, handles: Sequence[Handle]) -> None:
    found = [handle.name for handle in handles]
    missing = [name for name in request.names if name not in found]
    if missing:
        raise ControllerError(
            f'Expected {len(request.names)} interfaces, got {len(found)}; missing: '
            f'{", ".join(missing)}'
        )


def _as(handle: CommandInterface, value: float) -> float | int | bool:
    """Return a value in the data type of an interface."""
    if handle.data_type in _FLOATS:
        return value
    return bool(value) if handle.data_type == 'bool' else round(value)
