# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
Chains of controllers: who commands or reads whom, and what order follows from it.

A controller that commands a **reference** of another **precedes** it: it is updated before, so
that its command arrives within the same tick. One that reads a **state** which another exports is
updated after that one, unless it also (perhaps by way of others) commands it: that is feedback,
and it reads the state of the tick before.

In both cases it **needs** the other, which has to be active first. A controller that would need
itself closes a circle, and cannot be.
"""

from collections.abc import Collection, Iterable, Mapping
from dataclasses import dataclass
from graphlib import CycleError, TopologicalSorter

from amr_description.errors import ControllerError


@dataclass(frozen=True, slots=True)
class ChainInterfaces:
    """The interfaces, by their full names, by which one controller can be linked to others."""

    commands: tuple[str, ...] = ()
    states: tuple[str, ...] = ()
    references: tuple[str, ...] = ()
    exported_states: tuple[str, ...] = ()


class Chains:
    """The links between some controllers; every answer is in alphabetical or in update order."""

    def __init__(self, ends: Mapping[str, ChainInterfaces]) -> None:
        """``ends``: of each controller, by its name. Raises ControllerError at a circle."""
        commanded = {each: name for name in ends for each in ends[name].references}
        exported = {each: name for name in ends for each in ends[name].exported_states}
        self._commands = {name: _by_owner(ends[name].commands, commanded) for name in ends}
        self._reads = {name: _by_owner(ends[name].states, exported) for name in ends}
        self.activation_order = _sorted_by({name: self.needs(name) for name in ends})
        """Whoever is needed comes first."""
        self.update_order = _sorted_by(self._earlier())
        """Preceding controllers come first."""

    def commands(self, name: str) -> Mapping[str, tuple[str, ...]]:
        """The controllers that it commands, each with those of its references."""
        return self._commands.get(name, {})

    def needs(self, name: str) -> set[str]:
        """The controllers that must be active for it to be."""
        return {*self._commands.get(name, ()), *self._reads.get(name, ())}

    def needed_by(self, name: str) -> list[str]:
        """The controllers that can be active only while it is."""
        return [user for user in sorted(self._commands) if name in self.needs(user)]

    def commanded_by(self, name: str) -> list[str]:
        """The controllers that command it."""
        return [user for user in sorted(self._commands) if name in self._commands[user]]

    def affected_by(self, names: Iterable[str]) -> set[str]:
        """
        These controllers and all that cannot go on without them.

        Those are the ones that need them, and the ones that they command, which nobody would
        command any more; and so on along the chain. Whose states they only read goes on.
        """
        reached, ahead = set(), set(names)
        while ahead:
            name = ahead.pop()
            reached.add(name)
            ahead |= {*self.needed_by(name), *self.commands(name)} - reached
        return reached

    def _earlier(self) -> dict[str, set[str]]:
        """Whom each controller is updated after."""
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
    """Return the names, each behind those before it, and by the alphabet where that leaves it."""
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
