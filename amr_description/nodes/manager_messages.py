# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""Snapshots of a controller manager → ``controller_manager_msgs``."""

from collections.abc import Iterable

from controller_manager_msgs.msg import (
    ChainConnection,
    ControllerState,
    HardwareComponentState,
    HardwareInterface,
)

from amr_description.control.snapshots import (
    ComponentSnapshot,
    ControllerSnapshot,
    InterfaceSnapshot,
)


def controller_message(controller: ControllerSnapshot) -> ControllerState:
    """Make one entry of ``list_controllers``."""
    return ControllerState(
        name=controller.name,
        type=controller.type,
        state=controller.state.label,
        update_rate=controller.update_rate,
        claimed_interfaces=controller.claimed,
        required_command_interfaces=controller.required_commands,
        required_state_interfaces=controller.required_states,
        is_chainable=controller.is_chainable,
        is_chained=controller.is_chained,
        exported_state_interfaces=_own(i.name for i in controller.exported_states),
        reference_interfaces=_own(i.name for i in controller.references),
        chain_connections=[
            ChainConnection(name=following, reference_interfaces=_own(references))
            for following, references in controller.chain_connections
        ],
    )


def _own(names: Iterable[str]) -> list[str]:
    """Take the controller's own name, which stands in front, away."""
    return [name.partition('/')[2] for name in names]


def component_message(component: ComponentSnapshot) -> HardwareComponentState:
    """Make one entry of ``list_hardware_components``."""
    message = HardwareComponentState(
        name=component.name,
        type=component.type,
        rw_rate=component.rate,
        class_type=component.plugin,
        plugin_name=component.plugin,
        command_interfaces=[interface_message(each) for each in component.commands],
        state_interfaces=[interface_message(each) for each in component.states],
    )
    message.state.id = component.state
    message.state.label = component.state.label
    return message


def interface_message(interface: InterfaceSnapshot) -> HardwareInterface:
    """Make one interface of either list."""
    return HardwareInterface(
        name=interface.name,
        data_type=interface.data_type,
        is_available=interface.is_available,
        is_claimed=interface.is_claimed,
    )
