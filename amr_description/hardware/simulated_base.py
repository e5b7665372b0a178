# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
``amr_description/SimulatedBase``: the body of a simulated robot as a whole.

Its command interfaces move the body over the ground, whatever its wheels do; its state interfaces
are the true motion of links. It has those of :mod:`amr_description.model.base_interfaces`: the
GPIO ``gazebo_base``, and a sensor for each link, ``<link>/ground_truth``.
"""

from collections.abc import Sequence
import math

from amr_description.control.contracts import HardwareComponent
from amr_description.control.interfaces import CommandInterface, StateInterface
from amr_description.control.world import World
from amr_description.errors import HardwareError, SimulationError
from amr_description.log import Log
from amr_description.model.base_interfaces import link_of
from amr_description.model.hardware_info import HardwareInfo


class SimulatedBase(HardwareComponent):
    """Moves the root link; reads the truth of links."""

    def __init__(self, info: HardwareInfo, log: Log, world: World | None) -> None:
        """Raises HardwareError: there is no world, or no such link."""
        super().__init__(info, log, world)
        if world is None:
            raise HardwareError(
                f"hardware component '{info.name}': {info.plugin} needs a simulated world and "
                'there is none; start it in the simulator'
            )
        self._world = world
        self._commands = [
            CommandInterface.of(gpio, interface)
            for gpio in info.gpios
            for interface in gpio.command_interfaces
        ]
        self._truths = [
            (link_of(sensor.name), [StateInterface.of(sensor, i) for i in sensor.state_interfaces])
            for sensor in info.sensors
        ]

    def state_interfaces(self) -> Sequence[StateInterface]:
        """Return the truth of every link."""
        return [state for _, states in self._truths for state in states]

    def command_interfaces(self) -> Sequence[CommandInterface]:
        """Return the velocities of the root link, if it is moved."""
        return self._commands

    def configure(self) -> None:
        """Read the states, which become available now. Raises HardwareError: no such link."""
        self.read(0, 0)

    def activate(self) -> None:
        """Hold the body at rest until the first command."""
        self._rest()

    def deactivate(self) -> None:
        """Stop the body."""
        self._rest()

    def reset(self, time: int) -> None:
        """Drop all commands."""
        self._rest()

    def read(self, time: int, period: int) -> None:
        """Read the truth. Raises HardwareError: there is no such link."""
        try:
            for link, states in self._truths:
                pose, (linear, angular) = self._world.pose(link), self._world.velocity(link)
                values = (*pose.translation, *pose.rotation, *linear, *angular)
                for state, value in zip(states, values, strict=True):
                    state.value = value
        except SimulationError as cause:
            raise HardwareError(f"hardware component '{self.info.name}': {cause}") from cause

    def write(self, time: int, period: int) -> None:
        """Move the body; without a command it is at rest."""
        if self._commands:
            x, y, yaw = (c.value if math.isfinite(c.value) else 0.0 for c in self._commands)
            self._world.move_base(x, y, yaw)

    def _rest(self) -> None:
        for command in self._commands:
            command.value = math.nan
        self.write(0, 0)
