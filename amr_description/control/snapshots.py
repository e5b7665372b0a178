# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
What a controller manager is at one moment, for readers on other threads.

Fields follow ``controller_manager_msgs``: ControllerState, HardwareComponentState,
HardwareInterface.
"""

from dataclasses import dataclass

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
    references: tuple[str, ...]
    """Names of its reference interfaces without its own name, once configured."""


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
    """All of one manager: controllers by name, components in the order of the description."""

    controllers: tuple[ControllerSnapshot, ...] = ()
    components: tuple[ComponentSnapshot, ...] = ()

    @property
    def active_controllers(self) -> tuple[str, ...]:
        """The names of the active controllers."""
        return tuple(c.name for c in self.controllers if c.state is LifecycleState.ACTIVE)

    @property
    def commands(self) -> tuple[InterfaceSnapshot, ...]:
        """Every command interface, by name."""
        every = (interface for component in self.components for interface in component.commands)
        return tuple(sorted(every, key=lambda interface: interface.name))

    @property
    def states(self) -> tuple[InterfaceSnapshot, ...]:
        """Every state interface, by name."""
        every = (interface for component in self.components for interface in component.states)
        return tuple(sorted(every, key=lambda interface: interface.name))
