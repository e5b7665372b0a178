# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""Listens to topics of robot descriptions, and asks who has which."""

import time

from rclpy.qos import DurabilityPolicy, QoSProfile
from rclpy.topic_endpoint_info import TopicEndpointInfo
from std_msgs.msg import String

from amr_description.doctor.observations.description import Description, DescriptionTopic
from amr_description.doctor.ros.probe_context import ProbeContext
from amr_description.doctor.ros.queries import ParameterQuery, parameters_of
from amr_description.doctor.ros.topic_probe import TopicProbe
from amr_description.ros.endpoints import endpoint_node

_TYPE = 'std_msgs/msg/String'
_NAME = 'robot_description'
_QOS = QoSProfile(depth=10, durability=DurabilityPolicy.TRANSIENT_LOCAL)
_LEAST = 0.5
"""s that a second publisher's description is waited for."""


class DescriptionProbe:
    """Observes ``description``."""

    def __init__(self) -> None:
        self._probes: dict[str, TopicProbe] = {}
        self._texts: dict[str, dict[str, None]] = {}
        self._asked: dict[str, ParameterQuery] = {}

    def begin(self, context: ProbeContext) -> None:
        """Subscribe to all topics of the name, and ask each robot_state_publisher."""
        node = context.node
        self._node = node
        self._began = time.monotonic()
        for topic, types in node.get_topic_names_and_types():
            if _TYPE in types and topic.rpartition('/')[2] == _NAME:
                self._probes[topic] = TopicProbe(node, String, topic, depth=10, qos=_QOS)
                self._texts[topic] = {}
        for name, namespace in node.get_node_names_and_namespaces():
            if name == 'robot_state_publisher':
                full = f'{namespace.rstrip("/")}/{name}'
                self._asked[full] = parameters_of(node, full, (_NAME,))

    @property
    def is_done(self) -> bool:
        """Whether a description has come from each publisher that keeps it, and all answered."""
        self._take()
        if any(each.values is None for each in self._asked.values()):
            return False
        latched = {topic: self._publishers(topic)[1] for topic in self._probes}
        if any(latched[topic] and not texts for topic, texts in self._texts.items()):
            return False
        has_two = any(len(found) > 1 for found in latched.values())
        return not has_two or time.monotonic() - self._began > _LEAST

    def observe(self) -> Description:
        """Return what was seen."""
        self._take()
        topics = []
        own = self._node.get_fully_qualified_name()
        for topic, texts in self._texts.items():
            publishers, latched = self._publishers(topic)
            subscriptions = self._node.get_subscriptions_info_by_topic(topic)
            subscribers = [each for each in map(_name, subscriptions) if each != own]
            if publishers or subscribers:
                topics.append(
                    DescriptionTopic(
                        topic=topic,
                        publishers=tuple(map(_name, publishers)),
                        volatile=tuple(_name(each) for each in publishers if each not in latched),
                        subscribers=tuple(subscribers),
                        texts=tuple(texts),
                    )
                )
        values = {name: each.values or {} for name, each in self._asked.items()}
        return Description(
            topics=tuple(topics),
            of_state_publishers={
                name: text
                for name, found in values.items()
                if isinstance(text := found.get(_NAME), str)
            },
        )

    def _publishers(self, topic: str) -> tuple[list[TopicEndpointInfo], list[TopicEndpointInfo]]:
        """Return all publishers of a topic, and those that keep the message."""
        found = self._node.get_publishers_info_by_topic(topic)
        kept = [
            each
            for each in found
            if each.qos_profile.durability == DurabilityPolicy.TRANSIENT_LOCAL
        ]
        return found, kept

    def _take(self) -> None:
        for topic, probe in self._probes.items():
            self._texts[topic].update((message.data, None) for message, *_ in probe.messages())


def _name(endpoint: TopicEndpointInfo) -> str:
    return endpoint_node(endpoint) or 'a node without a name'
