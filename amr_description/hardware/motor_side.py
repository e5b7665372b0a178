# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""One side of a robot on wheels: a motor, its encoder, its gear, and the joints that it turns."""

from collections.abc import Sequence
import math

from amr_description.control.interfaces import (
    CommandInterface,
    POSITION,
    StateInterface,
    VELOCITY,
)
from amr_description.errors import HardwareDeactivationError, HardwareError
from amr_description.model.hardware_info import ComponentInfo

COMMANDS, STATES = (VELOCITY,), (POSITION, VELOCITY)


class MotorSide:
    """
    Between the cells of the joints (wheels, rad and rad/s) and the motor shaft (ticks and rad/s).

    ``reduction``: turns of the shaft per turn of a wheel, negative where they turn against each
    other.
    """

    def __init__(self, hardware: str, joints: Sequence[ComponentInfo], reduction: float) -> None:
        """Raises HardwareError for an interface that a motor does not have."""
        self.reduction = reduction
        for joint in joints:
            for kind, interfaces, supported in (
                ('command', joint.command_interfaces, COMMANDS),
                ('state', joint.state_interfaces, STATES),
            ):
                for interface in interfaces:
                    if interface.name not in supported:
                        raise HardwareError(
                            f"hardware component '{hardware}': joint '{joint.name}': {kind} "
                            f"interface '{interface.name}' is asked; there are: "
                            f'{", ".join(supported)}'
                        )
        self.commands = [
            CommandInterface(j.name, interface.name)
            for j in joints
            for interface in j.command_interfaces
        ]
        self.states = [
            StateInterface(j.name, interface.name)
            for j in joints
            for interface in j.state_interfaces
        ]
        self._target = 0.0
        self._position = 0.0
        self._ticks = 0
        self._angle_per_tick = 0.0

    def rebase(self, ticks: int, ticks_per_turn: int) -> None:
        """The encoder stands at ``ticks`` where the wheel is now, which does not move by this."""
        self._ticks = ticks
        self._angle_per_tick = math.tau / (ticks_per_turn * self.reduction)

    def show(self, ticks: int, velocity: float) -> None:
        """
        Write what the encoder says to the states.

        ``ticks``: its 32-bit counter, which wraps around. ``velocity``: of the shaft, rad/s.
        """
        moved = (ticks - self._ticks + 2**31) % 2**32 - 2**31
        self._ticks = ticks
        self._position += moved * self._angle_per_tick
        values = {POSITION: self._position, VELOCITY: velocity / self.reduction}
        for state in self.states:
            state.value = values[state.interface]

    def forget(self) -> None:
        """Want to stand still, until the next command."""
        self._target = 0.0
        for command in self.commands:
            command.value = math.nan

    def wanted(self) -> float:
        """
        Return the velocity that the wheels are commanded, rad/s.

        Raises HardwareDeactivationError when it is infinite, or not the same for all.
        """
        given = [command for command in self.commands if not math.isnan(command.value)]
        if not given:
            return self._target
        first = given[0]
        for command in given:
            if math.isinf(command.value):
                raise HardwareDeactivationError(
                    f"command '{command.name}' is {command.value}; a finite number is needed"
                )
            if command.value != first.value:
                raise HardwareDeactivationError(
                    f"commands '{first.name}' ({first.value}) and '{command.name}' "
                    f'({command.value}) differ, but one motor turns both; give them the same value'
                )
        self._target = first.value
        return self._target
