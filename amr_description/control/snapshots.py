# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
What a controller manager is at one moment, for readers on other threads.

Fields follow ``controller_manager_msgs``: ControllerState, HardwareComponentState,
HardwareInterface.
"""

from collections.abc import Iterable
from dataclasses import dataclass
from itertools import chain

from amr_description.control.interfaces import LifecycleState


@dataclass(frozen=True, slots=True)
class InterfaceSnapshot:
    """One command or state interface."""

    name: str
    data_type: str
    is_available: bool
    is_claimed: bool = False


@dataclass(frozen=True, slots=True)
class ControllerSnapshot:
    """One controller; ``claimed`` only when active, ``required_…`` only once configured."""

    name: str
    type: str
    state: LifecycleState
    update_rate: int
    claimed: tuple[str, ...]
    required_commands: tuple[str, ...]
    required_states: tuple[str, ...]
    is_chainable: bool
    is_chained: bool = False
    """True in chained mode: others command it, not its topics."""
    references: tuple[InterfaceSnapshot, ...] = ()
    """What others may command of it, once configured; available while it is active."""
    exported_states: tuple[InterfaceSnapshot, ...] = ()
    """What others may read of it, likewise."""
    chain_connections: tuple[tuple[str, tuple[str, ...]], ...] = ()
    """The controllers that it commands, each with the full names of those references."""


@dataclass(frozen=True, slots=True)
class ComponentSnapshot:
    """One hardware component."""

    name: str
    type: str
    plugin: str
    state: LifecycleState
    rate: int
    """Reads and writes per s."""
    commands: tuple[InterfaceSnapshot, ...]
    states: tuple[InterfaceSnapshot, ...]


@dataclass(frozen=True, slots=True)
class ManagerSnapshot:
    """
    All of one manager: controllers in the order of their updates, components in that of the
    description.
    """

    controllers: tuple[ControllerSnapshot, ...] = ()
    components: tuple[ComponentSnapshot, ...] = ()

    @property
    def active_controllers(self) -> tuple[str, ...]:
        """The names of the active controllers."""
        return tuple(c.name for c in self.controllers if c.state is LifecycleState.ACTIVE)

    @property
    def commands(self) -> tuple[InterfaceSnapshot, ...]:
        """Every command interface of hardware and, as references, of controllers, by name."""
        return _by_name(
            *(component.commands for component in self.components),
            *(controller.references for controller in self.controllers),
        )

    @property
    def states(self) -> tuple[InterfaceSnapshot, ...]:
        """Every state interface of hardware, and what controllers export, by name."""
        return _by_name(
            *(component.states for component in self.components),
            *(controller.exported_states for controller in self.controllers),
        )


def _by_name(*groups: Iterable[InterfaceSnapshot]) -> tuple[InterfaceSnapshot, ...]:
    return tuple(sorted(chain(*groups), key=lambda interface: interface.name))
