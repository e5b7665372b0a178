# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
With what each entity of the world was spawned, on ``~/spawned/NAME``.

``simulation_interfaces/msg/SpawnEntity``, reliable, transient local, depth 1: the name, the
namespace, absolute, the description and the pose. So a page knows which robot of the graph an
entity is, and can describe one whose launch file has ended. The topic goes with the entity. What
of a name no topic may have, is ``_`` in its own.
"""

from collections.abc import Callable, Iterable
import re
from typing import Any

from rclpy.node import Node
from rclpy.publisher import Publisher
from simulation_interfaces.msg import SpawnEntity

from amr_description.ros.messages import fill_pose
from amr_description.ros.qos import LATCHED
from amr_description.sim.ros.entities import Entity
from amr_description.simulation.engine import Spawned
from amr_description.simulation.topics.names import WORLD_FRAME

_NO_TOKEN = re.compile(r'[^A-Za-z0-9]+|^(?=[0-9])')


class SpawnedTopics:
    """
    The topics of all entities; on the ROS thread.

    Args:
        node: has the publishers.
        entities: returns those that there are.
    """

    def __init__(self, node: Node, entities: Callable[[], Iterable[Entity]]) -> None:
        self._node = node
        self._entities = entities
        self._publishers: dict[str, tuple[Spawned[Any], Publisher]] = {}

    def update(self) -> None:
        """Publish those that are new; those that have left the world have no topic any more."""
        present = {each.name: each.origin for each in self._entities() if each.origin is not None}
        for name, (origin, publisher) in [*self._publishers.items()]:
            if present.get(name) is not origin:
                del self._publishers[name]
                self._node.destroy_publisher(publisher)
        for name, origin in present.items():
            if name not in self._publishers:
                publisher = self._node.create_publisher(SpawnEntity, self._topic(name), LATCHED)
                self._publishers[name] = (origin, publisher)
                publisher.publish(_message(name, origin))

    def _topic(self, name: str) -> str:
        """Return a topic that no other entity has."""
        token = _NO_TOKEN.sub('_', name)
        taken = {publisher.topic_name for _, publisher in self._publishers.values()}
        topic, number = f'~/spawned/{token}', 1
        while self._node.resolve_topic_name(topic) in taken:
            number += 1
            topic = f'~/spawned/{token}_{number}'
        return topic


def _message(name: str, origin: Spawned[Any]) -> SpawnEntity:
    message = SpawnEntity(name=name, entity_namespace=origin.namespace)
    message.entity_resource.resource_string = origin.robot.text
    message.initial_pose.header.frame_id = WORLD_FRAME
    fill_pose(origin.pose, message.initial_pose.pose)
    return message
