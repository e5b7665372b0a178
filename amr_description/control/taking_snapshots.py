# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""How a snapshot is taken of the controllers and the resources of a manager."""

from collections.abc import Container, Mapping

from amr_description.control.interfaces import Handle, LifecycleState
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
    controllers: Mapping[str, LoadedController], resources: ResourceManager, rate: int
) -> ManagerSnapshot:
    """Copy what readers may know; on the owner's thread. ``rate``: of the manager, Hz."""
    return ManagerSnapshot(
        controllers=tuple(_controller(controllers[name], rate) for name in sorted(controllers)),
        components=tuple(
            _component(owned, resources, rate) for owned in resources.components.values()
        ),
    )


def _controller(loaded: LoadedController, rate: int) -> ControllerSnapshot:
    is_configured = loaded.state in (LifecycleState.INACTIVE, LifecycleState.ACTIVE)
    references = loaded.controller.references()
    return ControllerSnapshot(
        name=loaded.name,
        type=loaded.type,
        state=loaded.state,
        update_rate=rate // loaded.stride,
        claimed=loaded.required_commands if loaded.is_active else (),
        required_commands=loaded.required_commands,
        required_states=loaded.required_states,
        is_chainable=loaded.controller.is_chainable,
        references=tuple(r.interface for r in references) if is_configured else (),
    )


def _component(owned: OwnedComponent, resources: ResourceManager, rate: int) -> ComponentSnapshot:
    def interfaces(
        handles: Mapping[str, Handle], claims: Container[str]
    ) -> tuple[InterfaceSnapshot, ...]:
        return tuple(
            InterfaceSnapshot(name, handle.data_type, owned.is_available, name in claims)
            for name, handle in handles.items()
        )

    return ComponentSnapshot(
        name=owned.info.name,
        type=owned.info.type,
        plugin=owned.info.plugin,
        state=owned.state,
        rate=min(owned.info.rw_rate or rate, rate),
        commands=interfaces(owned.commands, resources.claims),
        states=interfaces(owned.states, ()),
    )
