# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""Which of its command interfaces each joint obeys: the one that is claimed."""

from collections.abc import Sequence

from amr_description.control.interfaces import CommandInterface
from amr_description.errors import HardwareError


class CommandModes:
    """
    The mode of each joint, told by claims.

    A joint with one command interface has no choice: it obeys that, claimed or not.
    """

    def __init__(self, commands: Sequence[CommandInterface]) -> None:
        """``commands``: all command interfaces of the component."""
        self._commands = {command.name: command for command in commands}
        self._claimed: set[str] = set()
        self._by_joint: dict[str, list[CommandInterface]] = {}
        for command in commands:
            self._by_joint.setdefault(command.prefix, []).append(command)

    def check(self, start: Sequence[str], stop: Sequence[str]) -> None:
        """Refuse two modes on one joint. Raises HardwareError."""
        modes: dict[str, str] = {}
        for name in sorted(self._after(start, stop)):
            command = self._commands[name]
            other = modes.setdefault(command.prefix, command.interface)
            if other != command.interface:
                raise HardwareError(
                    f"joint '{command.prefix}' is to be commanded by {other} and "
                    f'{command.interface} at once; one of them will do'
                )

    def switch(self, start: Sequence[str], stop: Sequence[str]) -> set[str]:
        """Take over what is claimed and released; return the joints concerned."""
        self._claimed = self._after(start, stop)
        names = self._commands.keys() & {*start, *stop}
        return {self._commands[name].prefix for name in names}

    def forget(self) -> None:
        """Nothing is claimed any more."""
        self._claimed.clear()

    def obeyed(self, joint: str) -> CommandInterface | None:
        """The command that the joint obeys; None if there are several and none is claimed."""
        commands = self._by_joint[joint]
        if len(commands) == 1:
            return commands[0]
        return next((command for command in commands if command.name in self._claimed), None)

    @property
    def joints(self) -> tuple[str, ...]:
        """The joints with a command interface."""
        return tuple(self._by_joint)

    def _after(self, start: Sequence[str], stop: Sequence[str]) -> set[str]:
        return (self._claimed - set(stop)) | (self._commands.keys() & set(start))
