# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
The joints of a simulated robot as a hardware component.

It knows :class:`~amr_description.control.contracts.World` and not what is behind it. A joint whose
command nobody claims is held still, as Gazebo's ``hold_joints`` does.
"""

from collections.abc import Sequence
import math

from amr_description.control.contracts import HardwareComponent, Log, Severity, World
from amr_description.control.interfaces import (
    CommandInterface,
    EFFORT,
    POSITION,
    StateInterface,
    VELOCITY,
)
from amr_description.errors import HardwareError, SimulationError
from amr_description.model.hardware_info import ComponentInfo, HardwareInfo, InterfaceInfo

STATES = (POSITION, VELOCITY, EFFORT)
COMMANDS = (VELOCITY,)


class MujocoSystem(HardwareComponent):
    """
    ``amr_description/MujocoSystem``: position, velocity and effort of joints; velocity commands.
    """

    def __init__(self, info: HardwareInfo, log: Log, world: World | None) -> None:
        """Raises HardwareError: without a world, or for an interface that it does not have."""
        super().__init__(info, log, world)
        if world is None:
            raise HardwareError(
                f"hardware component '{info.name}': {info.plugin} needs a simulated world and "
                'there is none; start it in the simulator, or use mock_components/GenericSystem'
            )
        for component in (*info.sensors, *info.gpios):
            log(
                Severity.WARN,
                f"hardware component '{info.name}': {component.type} '{component.name}' is not "
                'simulated and has no interfaces',
            )
        try:
            self._bind(world)
        except SimulationError as cause:
            raise HardwareError(f"hardware component '{info.name}': {cause}") from cause

    def _bind(self, world: World) -> None:
        joints = self.info.joints
        self._commands = [
            CommandInterface(joint.name, interface.name)
            for joint in joints
            for interface in self._checked(joint, joint.command_interfaces, 'command', COMMANDS)
        ]
        self._states = [
            StateInterface(joint.name, interface.name)
            for joint in joints
            for interface in self._checked(joint, joint.state_interfaces, 'state', STATES)
        ]
        self._commanded = world.joints([command.prefix for command in self._commands])
        self._targets = [0.0] * len(self._commands)
        self._sources = []
        for interface in STATES:
            cells = [state for state in self._states if state.interface == interface]
            if cells:
                group = world.joints([cell.prefix for cell in cells])
                read = {
                    POSITION: group.positions,
                    VELOCITY: group.velocities,
                    EFFORT: group.efforts,
                }[interface]
                self._sources.append((cells, read))

    def _checked(
        self,
        joint: ComponentInfo,
        interfaces: Sequence[InterfaceInfo],
        kind: str,
        supported: Sequence[str],
    ) -> Sequence[InterfaceInfo]:
        for interface in interfaces:
            if interface.name not in supported:
                raise HardwareError(
                    f"hardware component '{self.info.name}': joint '{joint.name}': {kind} "
                    f"interface '{interface.name}' is asked; there are: {', '.join(supported)}"
                )
        return interfaces

    def state_interfaces(self) -> Sequence[StateInterface]:
        """As the tag declares them, in its order."""
        return self._states

    def command_interfaces(self) -> Sequence[CommandInterface]:
        """As the tag declares them, in its order."""
        return self._commands

    def configure(self) -> None:
        """Fill the state cells, so that what is available is also valid."""
        self.read(0, 0)

    def activate(self) -> None:
        """Hold still, and forget commands of an earlier life."""
        self._stop()

    def deactivate(self) -> None:
        """Hold still."""
        self._stop()

    def perform_command_mode_switch(self, start: Sequence[str], stop: Sequence[str]) -> None:
        """Joints that are released, or change hands, hold still until the first command."""
        for index, command in enumerate(self._commands):
            if command.name in start or command.name in stop:
                command.value = math.nan
                self._targets[index] = 0.0

    def read(self, time: int, period: int) -> None:
        """Take the joints' present state."""
        for cells, read in self._sources:
            for cell, value in zip(cells, read(), strict=True):
                cell.value = value

    def write(self, time: int, period: int) -> None:
        """Command the joints; NaN keeps the target of before."""
        for index, command in enumerate(self._commands):
            if not math.isnan(command.value):
                self._targets[index] = command.value
        try:
            self._commanded.command_velocities(self._targets)
        except SimulationError as cause:
            self._stop()
            raise HardwareError(f"hardware component '{self.info.name}': {cause}") from cause

    def _stop(self) -> None:
        for command in self._commands:
            command.value = math.nan
        self._targets = [0.0] * len(self._commands)
        self._commanded.command_velocities(self._targets)
