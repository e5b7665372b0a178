# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""How a snapshot is taken of the controllers and the resources of a manager."""

from collections.abc import Container, Iterable, Mapping

from amr_description.control.controller_list import ControllerList
from amr_description.control.interfaces import Handle
from amr_description.control.loaded_controller import LoadedController
from amr_description.control.owned_component import OwnedComponent
from amr_description.control.resource_manager import ResourceManager
from amr_description.control.snapshots import (
    ComponentSnapshot,
    ControllerSnapshot,
    InterfaceSnapshot,
    ManagerSnapshot,
)


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


def _component(owned: OwnedComponent, claims: Container[str], rate: int) -> ComponentSnapshot:
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
