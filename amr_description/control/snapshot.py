# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
The state of a controller manager at one instant, for readers on other threads.

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
    """One controller; ``claimed`` is empty unless active, ``required_…`` unless configured."""

    name: str
    type: str
    state: LifecycleState
    update_rate: int
    claimed: tuple[str, ...]
    required_commands: tuple[str, ...]
    required_states: tuple[str, ...]
    is_chainable: bool
    is_chained: bool = False
    """True in chained mode: another controller commands it, not its topics."""
    references: tuple[InterfaceSnapshot, ...] = ()
    """What others may command, once it is configured; available while it is active."""
    exported_states: tuple[InterfaceSnapshot, ...] = ()
    """What others may read, likewise."""
    chain_connections: tuple[tuple[str, tuple[str, ...]], ...] = ()
    """The controllers that it commands, each with the full names of the references."""


@dataclass(frozen=True, slots=True)
class ComponentSnapshot:
    """One hardware component."""

    name: str
    type: str
    plugin: str
    state: LifecycleState
    rate: int
    """Of its reads and writes, Hz."""
    commands: tuple[InterfaceSnapshot, ...]
    states: tuple[InterfaceSnapshot, ...]


@dataclass(frozen=True, slots=True)
class ManagerSnapshot:
    """
    A manager: controllers in the order of their updates, components in that of the description.
    """

    controllers: tuple[ControllerSnapshot, ...] = ()
    components: tuple[ComponentSnapshot, ...] = ()

    @property
    def active_controllers(self) -> tuple[str, ...]:
        """The names of the active controllers."""
        return tuple(c.name for c in self.controllers if c.state is LifecycleState.ACTIVE)

    @property
    def commands(self) -> tuple[InterfaceSnapshot, ...]:
        """The command interfaces of hardware and the references of controllers, by name."""
        return _by_name(
            *(component.commands for component in self.components),
            *(controller.references for controller in self.controllers),
        )

    @property
    def states(self) -> tuple[InterfaceSnapshot, ...]:
        """The state interfaces of hardware and those that controllers export, by name."""
        return _by_name(
            *(component.states for component in self.components),
            *(controller.exported_states for controller in self.controllers),
        )


def take_snapshot(
    controllers: ControllerList, resources: ResourceManager, rate: int
) -> ManagerSnapshot:
    """
    Take a snapshot; on the control thread.

    Args:
        controllers: of the manager.
        resources: of the manager.
        rate: of the manager, Hz.
    """
    chains, claims = controllers.chains, resources.claims
    return ManagerSnapshot(
        controllers=tuple(
            _controller(loaded, chains.commands(loaded.name), claims, rate)
            for loaded in controllers
        ),
        components=tuple(
            _component(component, claims, rate) for component in resources.components.values()
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
        update_rate=rate // loaded.update_divisor,
        claimed=loaded.required_commands if loaded.is_active else (),
        required_commands=loaded.required_commands,
        required_states=loaded.required_states,
        is_chainable=loaded.controller.is_chainable,
        is_chained=loaded.controller.is_chained,
        references=_interfaces(loaded.references, claims, loaded.is_active),
        exported_states=_interfaces(loaded.exported_states, (), loaded.is_active),
        chain_connections=tuple(sorted(connections.items())),
    )


def _component(component: LoadedComponent, claims: Container[str], rate: int) -> ComponentSnapshot:
    return ComponentSnapshot(
        name=component.info.name,
        type=component.info.type,
        plugin=component.info.plugin,
        state=component.state,
        rate=min(component.info.rw_rate or rate, rate),
        commands=_interfaces(component.commands.values(), claims, component.is_available),
        states=_interfaces(component.states.values(), (), component.is_available),
    )


def _interfaces(
    handles: Iterable[Handle], claims: Container[str], is_available: bool
) -> tuple[InterfaceSnapshot, ...]:
    return tuple(
        InterfaceSnapshot(handle.name, handle.data_type, is_available, handle.name in claims)
        for handle in handles
    )


def _by_name(*groups: Iterable[InterfaceSnapshot]) -> tuple[InterfaceSnapshot, ...]:
    return tuple(sorted(chain(*groups), key=lambda interface: interface.name))
