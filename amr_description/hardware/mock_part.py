# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""A joint, sensor or GPIO of ``mock_components/GenericSystem``: its cells, and how they follow."""

import math

from amr_description.control.interfaces import (
    ACCELERATION,
    CommandInterface,
    POSITION,
    StateInterface,
    VELOCITY,
)
from amr_description.model.hardware_info import ComponentInfo, ComponentType

MODES = (POSITION, VELOCITY, ACCELERATION)
"""What a joint with dynamics can be commanded by."""


class MockPart:
    """States that follow commands; of a joint also those that it has without showing them."""

    def __init__(
        self,
        info: ComponentInfo,
        offset: float = 0.0,
        custom: str = '',
        commands_states: bool = False,
    ) -> None:
        """
        ``offset``: added to the position command, or to what ``custom`` gets if that is given.
        ``commands_states``: every state can be commanded.
        """
        self.info = info
        self.mode = POSITION
        self.states = {i.name: StateInterface.of(info, i) for i in info.state_interfaces}
        wanted = {interface.name: interface for interface in info.command_interfaces}
        if commands_states:
            wanted = {i.name: i for i in info.state_interfaces} | wanted
        self._initial = {name: CommandInterface.of(info, i).value for name, i in wanted.items()}
        self.commands = {name: CommandInterface.of(info, i) for name, i in wanted.items()}
        self._offset, self._custom = offset, custom
        self._values = dict.fromkeys(MODES, 0.0)

    def set_initial_states(self) -> None:
        """Go back to the values of the tag; a joint has 0.0 where it gives none."""
        is_joint = self.info.type is ComponentType.JOINT
        self._values = dict.fromkeys(MODES, 0.0)
        for interface in self.info.state_interfaces:
            first = StateInterface.of(self.info, interface).value
            self._values[interface.name] = 0.0 if is_joint and math.isnan(first) else first
        if not self._custom:
            self._values[POSITION] += self._offset
        self._show()

    def set_initial_commands(self) -> None:
        """Forget every command of an earlier life."""
        for name, command in self.commands.items():
            command.value = self._initial[name]

    def stop(self) -> None:
        """Stand still where it is."""
        self._values[VELOCITY] = self._values[ACCELERATION] = 0.0

    def follow(self) -> None:
        """Take over every command that is set."""
        self._mirror(skipped=(POSITION,))
        position = self._commanded(POSITION)
        if position is not None:
            self._values[POSITION] = position + self._own_offset
        self._show()

    def integrate(self, dt: float) -> None:
        """
        Advance by ``dt`` (s, positive) in the present mode; other commands as in :meth:`follow`.

        Backward Euler, ``v += a·dt; x += v·dt``, which the command of its mode enters first;
        what is commanded has its derivatives as differences over ``dt``.
        """
        self._mirror(skipped=MODES)
        values, command = self._values, self._commanded(self.mode)
        before = values[POSITION], values[VELOCITY]
        if self.mode == POSITION:
            if command is not None:
                values[POSITION] = command + self._own_offset
                values[VELOCITY] = (values[POSITION] - before[0]) / dt
        else:
            if command is not None:
                values[self.mode] = command
            if self.mode == ACCELERATION:
                values[VELOCITY] += values[ACCELERATION] * dt
            values[POSITION] += values[VELOCITY] * dt
        if self.mode != ACCELERATION and command is not None:
            values[ACCELERATION] = (values[VELOCITY] - before[1]) / dt
        self._show()

    def mimic(self, source: 'MockPart') -> None:
        """Position = offset + multiplier · that of ``source``; derivatives without the offset."""
        mimic = self.info.mimic
        assert mimic is not None
        for name in MODES:
            offset = mimic.offset if name == POSITION else 0.0
            self._values[name] = offset + mimic.multiplier * source._values[name]
        self._show()

    @property
    def _own_offset(self) -> float:
        return 0.0 if self._custom else self._offset

    def _commanded(self, name: str) -> float | None:
        command = self.commands.get(name)
        return command.value if command is not None and command.is_set else None

    def _mirror(self, skipped: tuple[str, ...]) -> None:
        for name, command in self.commands.items():
            if name not in skipped and command.is_set:
                self._values[name] = command.value
        position = self._commanded(POSITION)
        if self._custom in self.states and position is not None:
            self._values[self._custom] = position + self._offset

    def _show(self) -> None:
        for name, state in self.states.items():
            state.value = self._values[name]
