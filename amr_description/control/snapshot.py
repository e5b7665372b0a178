# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
How a snapshot is taken of the controllers and the resources of a manager.

What a controller manager is at one moment, for readers on other threads.

Fields follow ``controller_manager_msgs``: ControllerState, HardwareComponentState,
HardwareInterface.
"""

from collections.abc import Container, Iterable, Mapping
from dataclasses import dataclass
from itertools import chain

from amr_description.control.controller_list import ControllerList
from amr_description.control.interfaces import Handle, LifecycleState
from amr_description.control.loaded_component import LoadedComponent
from amr_description.control.loaded_controller import LoadedController
from amr_description.control.resource_manager import ResourceManager


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


def take_snapshot(
    controllers: ControllerList, resources: ResourceManager, rate: int
) -> ManagerSnapshot:
    """Copy what readers may know; on the owner's thread. ``rate``: of the manager, Hz."""
    chains, claims = controllers.chains, resources.claims
    return ManagerSnapshot(
        controllers=tuple(
            _controller(loaded, chains.commands(loaded.name), claims, rate)
            for loaded in controllers
        ),
        components=tuple(
            _component(owned, claims, rate) for owned in resources.components.values()
        ),
    )


def _controller(
    loaded: LoadedController,
    connections: Mapping[str, tuple[str, ...]],
    claims: Container[str],
    rate: int,
) -> ControllerSnapshot:
    return ControllerSnapshot(
        name=loaded.name,
        type=loaded.type,
        state=loaded.state,
        update_rate=rate // loaded.stride,
        claimed=loaded.required_commands if loaded.is_active else (),
        required_commands=loaded.required_commands,
        required_states=loaded.required_states,
        is_chainable=loaded.controller.is_chainable,
        is_chained=loaded.controller.is_chained,
        references=_interfaces(loaded.references, claims, loaded.is_active),
        exported_states=_interfaces(loaded.exported_states, (), loaded.is_active),
        chain_connections=tuple(sorted(connections.items())),
    )


def _component(owned: LoadedComponent, claims: Container[str], rate: int) -> ComponentSnapshot:
    return ComponentSnapshot(
        name=owned.info.name,
        type=owned.info.type,
        plugin=owned.info.plugin,
        state=owned.state,
        rate=min(owned.info.rw_rate or rate, rate),
        commands=_interfaces(owned.commands.values(), claims, owned.is_available),
        states=_interfaces(owned.states.values(), (), owned.is_available),
    )


def _interfaces(
    handles: Iterable[Handle], claims: Container[str], is_available: bool
) -> tuple[InterfaceSnapshot, ...]:
    return tuple(
        InterfaceSnapshot(handle.name, handle.data_type, is_available, handle.name in claims)
        for handle in handles
    )
