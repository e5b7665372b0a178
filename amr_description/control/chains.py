# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
Chains of controllers: which one commands or reads which, and the resulting order of updates.

A controller that commands a **reference** of another **precedes** it: it is updated first, so that
its command arrives within the same tick. A controller that reads a **state** which another exports
is updated after it, unless it also commands it, directly or through others: then it reads the
state of the previous tick, as feedback.

In both cases it **needs** the other controller, which has to be activated first. A controller that
would need itself is an error, a circular chain.
"""

from collections.abc import Collection, Iterable, Mapping
from dataclasses import dataclass
from graphlib import CycleError, TopologicalSorter

from amr_description.errors import ControllerError


@dataclass(frozen=True, slots=True)
class ChainInterfaces:
    """The full names of the interfaces that can link one controller to others."""

    commands: tuple[str, ...] = ()
    states: tuple[str, ...] = ()
    references: tuple[str, ...] = ()
    exported_states: tuple[str, ...] = ()


class Chains:
    """The links between controllers; lists are in alphabetical order."""

    def __init__(self, of: Mapping[str, ChainInterfaces]) -> None:
        """``of``: the interfaces of each controller. Raises ControllerError: a circular chain."""
        commanded = {each: name for name in of for each in of[name].references}
        exported = {each: name for name in of for each in of[name].exported_states}
        self._commands = {name: _by_owner(of[name].commands, commanded) for name in of}
        self._reads = {name: _by_owner(of[name].states, exported) for name in of}
        self.activation_order = _sorted_by({name: self.needs(name) for name in of})
        """Controllers that others need come first."""
        self.update_order = _sorted_by(self._earlier())
        """Preceding controllers come first."""

    def commands(self, name: str) -> Mapping[str, tuple[str, ...]]:
        """Return the controllers that it commands, each with the references concerned."""
        return self._commands.get(name, {})

    def needs(self, name: str) -> set[str]:
        """Return the controllers that must be active while it is."""
        return {*self._commands.get(name, ()), *self._reads.get(name, ())}

    def needed_by(self, name: str) -> list[str]:
        """Return the controllers that can be active only while it is."""
        return [user for user in sorted(self._commands) if name in self.needs(user)]

    def commanded_by(self, name: str) -> list[str]:
        """Return the controllers that command it."""
        return [user for user in sorted(self._commands) if name in self._commands[user]]

    def affected_by(self, names: Iterable[str]) -> set[str]:
        """
        Return these controllers and all that must be deactivated along with them.

        Those are the controllers that need them and the ones that they command, which would be
        left without commands; and so on along the chain. A controller of which they only read
        states is not affected.
        """
        reached, ahead = set(), set(names)
        while ahead:
            name = ahead.pop()
            reached.add(name)
            ahead |= {*self.needed_by(name), *self.commands(name)} - reached
        return reached

    def _earlier(self) -> dict[str, set[str]]:
        """Return, for each controller, those that are updated before it."""
        earlier = {name: set(self.commanded_by(name)) for name in self._commands}
        for reader in sorted(self._reads):
            for exporter in sorted(self._reads[reader]):
                if not _is_before(reader, exporter, earlier):
                    earlier[reader].add(exporter)
        return earlier


def _by_owner(names: Iterable[str], owners: Mapping[str, str]) -> dict[str, tuple[str, ...]]:
    grouped: dict[str, list[str]] = {}
    for name in names:
        if name in owners:
            grouped.setdefault(owners[name], []).append(name)
    return {owner: tuple(of_owner) for owner, of_owner in grouped.items()}


def _is_before(first: str, second: str, earlier: Mapping[str, Collection[str]]) -> bool:
    return first == second or any(_is_before(first, n, earlier) for n in earlier[second])


def _sorted_by(earlier: Mapping[str, Collection[str]]) -> tuple[str, ...]:
    """Return the names, each after those that are earlier, otherwise in alphabetical order."""
    sorter = TopologicalSorter(earlier)
    try:
        sorter.prepare()
    except CycleError as error:
        raise ControllerError(
            f'circular chain of controllers: {" -> ".join(reversed(error.args[1]))}'
        ) from error
    ordered: list[str] = []
    while sorter.is_active():
        ready = sorted(sorter.get_ready())
        ordered += ready
        sorter.done(*ready)
    return tuple(ordered)
