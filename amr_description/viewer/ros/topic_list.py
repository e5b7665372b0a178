# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
The nodes, topics and services of the ROS graph, and the rates of topics; asked for while a page
shows them.

All of it runs on the ROS thread.
"""

from collections.abc import Iterable

from rclpy.action import get_action_names_and_types
from rclpy.node import Node
from rclpy.qos import DurabilityPolicy, ReliabilityPolicy
from rclpy.topic_endpoint_info import TopicEndpointInfo

from amr_description.cdr.layouts import Layout, Many, Number
from amr_description.errors import AmrError
from amr_description.ros.endpoints import endpoint_node
from amr_description.ros.layouts import layout_of
from amr_description.ros.polled_topic import PolledTopic
from amr_description.ros.rclpy_internals import RCLError
from amr_description.viewer.forms import CallInfo, Services
from amr_description.viewer.graph import SENSORS
from amr_description.viewer.introspection import Endpoint, TopicInfo, Topics
from amr_description.viewer.ros.source import source_of, TopicSource
from amr_description.viewer.ros.topic_rate import Rate

_UNKNOWN = '?'
_MOST = 1000
"""Messages of several publishers between two measurements, which are half a second apart."""


def list_topics(node: Node, rates: 'TopicRates') -> Topics:
    """Return all nodes and topics; what ``node`` itself has is left out."""
    own = node.get_name(), node.get_namespace()
    nodes = {
        f'{namespace.rstrip("/")}/{name}'
        for name, namespace in node.get_node_names_and_namespaces()
        if (name, namespace) != own
    }
    topics = []
    for name, types in node.get_topic_names_and_types():
        publishers = _endpoints(node.get_publishers_info_by_topic(name), own)
        subscriptions = _endpoints(node.get_subscriptions_info_by_topic(name), own)
        if publishers or subscriptions:
            topics.append(
                TopicInfo(name, tuple(types), publishers, subscriptions, rates.value(name))
            )
    return Topics(tuple(sorted(nodes)), tuple(sorted(topics, key=lambda each: each.name)))


def list_services(node: Node) -> Services:
    """Return all services and actions that somebody serves; hidden services are left out."""
    found = [
        CallInfo(name, kind, is_action=False)
        for name, kinds in node.get_service_names_and_types()
        if '/_' not in name and node.count_services(name)
        for kind in kinds
    ]
    found += [
        CallInfo(name, kind, is_action=True)
        for name, kinds in get_action_names_and_types(node)
        if node.count_services(f'{name}/_action/send_goal')
        for kind in kinds
    ]
    return Services(tuple(sorted(found, key=lambda each: (each.name, each.kind))))


def _endpoints(found: Iterable[TopicEndpointInfo], own: tuple[str, str]) -> tuple[Endpoint, ...]:
    return tuple(
        Endpoint(endpoint_node(each) or _UNKNOWN, _qos(each))
        for each in found
        if (each.node_name, each.node_namespace) != own
    )


def _qos(endpoint: TopicEndpointInfo) -> str:
    profile = endpoint.qos_profile
    reliable = profile.reliability == ReliabilityPolicy.RELIABLE
    latched = profile.durability == DurabilityPolicy.TRANSIENT_LOCAL
    return (
        f'{"reliable" if reliable else "best effort"}, '
        f'{"transient local" if latched else "volatile"}'
    )


class TopicRates:
    """
    Measures topics whose messages are small, and which nobody has to measure anything for.

    Sensors are left out: who hears one of a simulator has it measured. Messages of one publisher
    are counted by the numbers that DDS gives them; those of several have to be taken for it.
    """

    def __init__(self, node: Node) -> None:
        self._node = node
        self._topics: dict[TopicSource, PolledTopic[bytes] | None] = {}
        self._rates: dict[str, Rate] = {}

    def measure(self, names: Iterable[str]) -> None:
        """Measure these topics from now on, as far as they can be, and no others."""
        found = {each for name in names if (each := source_of(self._node, name)) is not None}
        for source in self._topics.keys() - found:
            self._destroy(source)
        for source in found - self._topics.keys():
            self._topics[source] = self._subscription(source)
            self._rates[source.topic] = Rate()
        for source, topic in self._topics.items():
            if topic is not None:
                self._count(topic, self._rates[source.topic], is_alone=source.is_alone)

    def value(self, topic: str) -> float | None:
        """Return the rate of a topic, Hz; None: not known."""
        rate = self._rates.get(topic)
        return None if rate is None else rate.value

    def _count(self, topic: PolledTopic[bytes], rate: Rate, *, is_alone: bool) -> None:
        count, last = 0, None
        while count < _MOST and (message := topic.take_numbered()) is not None:
            count, last = count + 1, message
        if last is not None:
            rate.add(last if is_alone else last._replace(number=None), count)

    def _subscription(self, source: TopicSource) -> PolledTopic[bytes] | None:
        if source.types[0] in SENSORS:
            return None
        try:
            kind = source.message_type()
            if has_octets(layout_of(kind)):
                return None
            depth = 1 if source.is_alone else _MOST
            return PolledTopic(self._node, kind, source.topic, bytes, depth=depth)
        except (AmrError, RCLError):  # such as another type that this process has the topic with
            return None

    def _destroy(self, source: TopicSource) -> None:
        topic = self._topics.pop(source)
        if topic is not None:
            topic.destroy()
        self._rates.pop(source.topic, None)


def has_octets(layout: Layout) -> bool:
    """Return whether messages have sequences of octets, as pictures and clouds do."""
    match layout:
        case Many(element=Number(size=1), count=None):
            return True
        case Many(element=element):
            return has_octets(element)
        case Number() | _ if not hasattr(layout, 'fields'):
            return False
        case _:
            return any(has_octets(field) for _, field in layout.fields)
