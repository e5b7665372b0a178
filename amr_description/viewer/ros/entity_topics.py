# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""With what the simulators of the graph say that they have spawned their entities."""

from collections.abc import Callable, Mapping
from functools import partial

from rclpy.node import Node
from rclpy.subscription import Subscription
from simulation_interfaces.msg import SpawnEntity

from amr_description.ros.qos import LATCHED
from amr_description.viewer.entities import SpawnedEntity


class EntityTopics:
    """
    The subscriptions; on the ROS thread.

    Args:
        node: of the viewer.
        on_change: called when something new is known.
    """

    def __init__(self, node: Node, on_change: Callable[[], None]) -> None:
        self.spawned: Mapping[str, tuple[SpawnedEntity, ...]] = {}
        """By the simulator; replaced, never modified: all threads may read it."""
        self._node = node
        self._on_change = on_change
        self._subscriptions: dict[str, Subscription] = {}
        self._simulators: dict[str, str] = {}
        self._known: dict[str, SpawnedEntity] = {}
        """By the topic."""

    def find(self, topics: Mapping[str, tuple[str, ...]]) -> None:
        """Subscribe to these topics of simulators, by their ids, and to no others."""
        self._simulators = {topic: name for name, each in topics.items() for topic in each}
        for topic in self._subscriptions.keys() - self._simulators.keys():
            self._node.destroy_subscription(self._subscriptions.pop(topic))
            self._known.pop(topic, None)
        for topic in self._simulators.keys() - self._subscriptions.keys():
            self._subscriptions[topic] = self._node.create_subscription(
                SpawnEntity, topic, partial(self._receive, topic), LATCHED
            )
        self._set_spawned()

    def _receive(self, topic: str, message: SpawnEntity) -> None:
        self._known[topic] = SpawnedEntity(
            message.name,
            f'/{message.entity_namespace.strip("/")}',
            message.entity_resource.resource_string,
        )
        self._set_spawned()
        self._on_change()

    def _set_spawned(self) -> None:
        found: dict[str, list[SpawnedEntity]] = {}
        for topic, each in sorted(self._known.items()):
            found.setdefault(self._simulators[topic], []).append(each)
        self.spawned = {name: tuple(each) for name, each in found.items()}
