# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""``~/activity`` of a controller manager: states of all controllers and components, latched."""

from collections.abc import Sequence

from controller_manager_msgs.msg import ControllerManagerActivity, NamedLifecycleState
from rclpy.node import Node
from rclpy.qos import DurabilityPolicy, QoSProfile

from amr_description.control.snapshots import (
    ComponentSnapshot,
    ControllerSnapshot,
    ManagerSnapshot,
)

_LATCHED = QoSProfile(depth=1, durability=DurabilityPolicy.TRANSIENT_LOCAL)


class ActivityTopic:
    """Told, on the owner's thread, of every new snapshot; publishes when a state has changed."""

    def __init__(self, node: Node) -> None:
        self._clock = node.get_clock()
        self._publisher = node.create_publisher(ControllerManagerActivity, '~/activity', _LATCHED)
        self._said: ControllerManagerActivity | None = None

    def tell(self, snapshot: ManagerSnapshot) -> None:
        """Publish at once, not with the turn's outbox: after the last turn, there is none."""
        controllers, components = _states(snapshot.controllers), _states(snapshot.components)
        said = self._said
        if said and (said.controllers, said.hardware_components) == (controllers, components):
            return
        self._said = ControllerManagerActivity(
            controllers=controllers, hardware_components=components
        )
        self._said.header.stamp = self._clock.now().to_msg()
        self._publisher.publish(self._said)


def _states(
    entries: Sequence[ControllerSnapshot] | Sequence[ComponentSnapshot],
) -> list[NamedLifecycleState]:
    states = []
    for each in entries:
        named = NamedLifecycleState(name=each.name)
        named.state.id, named.state.label = each.state, each.state.label
        states.append(named)
    return states
