# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""The controllers of a manager, in the order in which they are updated."""

from collections.abc import Collection, Iterable, Iterator

from amr_description.control.chains import Chains
from amr_description.control.loaded_controller import LoadedController


class ControllerList:
    """
    The loaded controllers by name; iteration is in the order of their updates.

    That order, and the links between controllers, are found by :meth:`link`.
    """

    def __init__(self) -> None:
        self._by_name: dict[str, LoadedController] = {}
        self.ordered: tuple[LoadedController, ...] = ()
        """In the order of their updates."""
        self.chains = Chains({})

    def __contains__(self, name: str) -> bool:
        return name in self._by_name

    def __iter__(self) -> Iterator[LoadedController]:
        return iter(self.ordered)

    def __getitem__(self, name: str) -> LoadedController:
        return self._by_name[name]

    def get(self, name: str) -> LoadedController | None:
        """Return a controller by name; None: there is none."""
        return self._by_name.get(name)

    def add(self, loaded: LoadedController) -> None:
        """Add a controller, whose name is new."""
        self._by_name[loaded.name] = loaded
        self.link()

    def remove(self, name: str) -> None:
        """Remove a controller."""
        del self._by_name[name]
        self.link()

    def link(self) -> None:
        """
        Update the chains, after the interfaces of a controller have changed.

        Raises ControllerError for a circular chain, changing nothing.
        """
        self.chains = Chains(
            {name: loaded.chain_interfaces for name, loaded in self._by_name.items()}
        )
        self.ordered = tuple(self._by_name[name] for name in self.chains.update_order)

    @property
    def active(self) -> list[LoadedController]:
        """The active controllers, in the order of their updates."""
        return [loaded for loaded in self.ordered if loaded.is_active]

    def activation_order(self, chosen: Collection[LoadedController]) -> list[LoadedController]:
        """Return the chosen controllers, each after those that it needs."""
        return [self[n] for n in self.chains.activation_order if self[n] in chosen]

    def needed(self, loaded: LoadedController) -> list[LoadedController]:
        """Return the controllers that must be active while it is."""
        return [self[name] for name in sorted(self.chains.needs(loaded.name))]

    def needing(self, loaded: LoadedController) -> list[LoadedController]:
        """Return the controllers that can be active only while it is."""
        return [self[name] for name in self.chains.needed_by(loaded.name)]

    def commanding(self, loaded: LoadedController) -> list[LoadedController]:
        """Return the controllers that command it."""
        return [self[name] for name in self.chains.commanded_by(loaded.name)]

    def active_chains_of(self, chosen: Iterable[LoadedController]) -> list[LoadedController]:
        """Return the active ones of the chosen controllers and of all they affect."""
        names = self.chains.affected_by(loaded.name for loaded in chosen)
        return [loaded for loaded in self.active if loaded.name in names]
