# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""Endpoints of topics, and parameters of all nodes."""

from collections.abc import Iterable, Sequence
import time

from rcl_interfaces.srv import GetParameters
from rclpy.client import Client
from rclpy.node import Node
from rclpy.parameter import parameter_value_to_python
from rclpy.qos import DurabilityPolicy, ReliabilityPolicy
from rclpy.task import Future
from rclpy.topic_endpoint_info import TopicEndpointInfo

from amr_description.navigation.contract.observations import ContractEndpoint, ContractTopic
from amr_description.ros.endpoints import endpoint_node
from amr_description.ros.service_calls import ServiceReadiness
from amr_description.ros.type_mismatch import other_topics

UNNAMED = 'a node without a name'
"""Stands for the node of an endpoint that is not known, or not yet."""

_USE_SIM_TIME = 'use_sim_time'
_SERVICE = '/get_parameters'
_PATIENCE = 3.0
"""s that a node has to answer, by the system clock."""
_SPECIAL = {
    'slam_toolbox': ('max_laser_range',),
    'local_costmap': ('robot_radius', 'footprint'),
    'global_costmap': ('robot_radius', 'footprint'),
}
"""What is asked besides, by the last part of a node's name."""


def topic_of(node: Node, name: str) -> ContractTopic:
    """Return who publishes and who subscribes to a topic, ``node`` left out; before remapping."""
    own = node.get_fully_qualified_name()
    return ContractTopic(
        node.resolve_topic_name(name),
        _endpoints(node.get_publishers_info_by_topic(name), own),
        _endpoints(node.get_subscriptions_info_by_topic(name), own),
    )


def command_topics(node: Node, but: str) -> tuple[ContractTopic, ...]:
    """Return the topics on which somebody subscribes to velocities, all but one."""
    return tuple(topic_of(node, name) for name in sorted(other_topics(node)) if name != but)


def topics_elsewhere(node: Node, *types: str) -> dict[str, tuple[ContractTopic, ...]]:
    """Return the published topics of some types, but those of the truth, by type."""
    found: dict[str, list[ContractTopic]] = {}
    for name, kinds in sorted(node.get_topic_names_and_types()):
        topic = topic_of(node, name) if {*kinds} & {*types} else None
        if topic is not None and topic.publishers and 'ground_truth' not in name:
            found.setdefault(topic.publishers[0].type_name, []).append(topic)
    return {kind: tuple(topics) for kind, topics in found.items()}


def _endpoints(found: Iterable[TopicEndpointInfo], own: str) -> tuple[ContractEndpoint, ...]:
    endpoints = [
        ContractEndpoint(
            endpoint_node(each) or UNNAMED,
            each.topic_type,
            each.qos_profile.reliability is not ReliabilityPolicy.BEST_EFFORT,
            each.qos_profile.durability is DurabilityPolicy.TRANSIENT_LOCAL,
        )
        for each in found
    ]
    return tuple(each for each in endpoints if each.node != own)


class ParameterReader:
    """Asks every node of the graph for ``use_sim_time``, and some for more, once each."""

    def __init__(self, node: Node) -> None:
        self._node = node
        self._clients: dict[str, Client] = {}
        self._is_ready: dict[str, ServiceReadiness] = {}
        self._pending: list[tuple[str, tuple[str, ...], Future]] = []
        self._unasked: set[str] = set()
        self._found: dict[str, float] = {}
        self._values: dict[str, dict[str, object]] = {}

    def ask(self) -> None:
        """Ask the nodes that have come up since, as soon as their services are reached."""
        own = self._node.get_fully_qualified_name()
        for service, _ in self._node.get_service_names_and_types():
            name = service.removesuffix(_SERVICE)
            is_hidden = name.rpartition('/')[2].startswith('_')
            if name in (service, own) or is_hidden or name in self._clients:
                continue
            self._clients[name] = self._node.create_client(GetParameters, service)
            self._is_ready[name] = ServiceReadiness(self._node, self._clients[name])
            self._unasked.add(name)
            self._found[name] = time.monotonic()
        for name in [each for each in self._unasked if self._is_ready[each]()]:
            self._unasked.remove(name)
            for parameters in ((_USE_SIM_TIME,), *_asked_of(name)):
                request = GetParameters.Request(names=parameters)
                future = self._clients[name].call_async(request)
                self._pending.append((name, parameters, future))

    @property
    def has_all(self) -> bool:
        """Whether all that were found have answered, or have had time to."""
        self._take()
        latest = time.monotonic() - _PATIENCE
        return bool(self._found) and all(
            name not in self._unanswered() or found < latest for name, found in self._found.items()
        )

    def silent(self) -> tuple[str, ...]:
        """Return the nodes that have had time to answer, and did not."""
        self._take()
        latest = time.monotonic() - _PATIENCE
        return tuple(sorted(name for name in self._unanswered() if self._found[name] < latest))

    def _unanswered(self) -> set[str]:
        return self._unasked | {name for name, _, _ in self._pending}

    def use_sim_time(self, but: Sequence[ContractEndpoint]) -> dict[str, bool]:
        """Return the values, but those of the nodes that have these publishers of ``/clock``."""
        self._take()
        left_out = {each.node for each in but}
        return {
            name: value
            for name, values in self._values.items()
            if isinstance(value := values.get(_USE_SIM_TIME), bool) and name not in left_out
        }

    def special(self) -> dict[str, dict[str, object]]:
        """Return what was asked besides, of the nodes that have it."""
        self._take()
        others = {
            name: {key: value for key, value in values.items() if key != _USE_SIM_TIME}
            for name, values in self._values.items()
        }
        return {name: values for name, values in others.items() if values}

    def _take(self) -> None:
        """Take the responses that have come."""
        waiting = []
        for name, parameters, future in self._pending:
            response = future.result() if future.done() else None
            if response is None:
                waiting.append((name, parameters, future))
                continue
            # Of a parameter that is not declared nodes of C++ return nothing at all.
            for parameter, value in zip(parameters, response.values, strict=False):
                found = parameter_value_to_python(value)
                if found is not None:
                    self._values.setdefault(name, {})[parameter] = found
        self._pending = waiting


def _asked_of(node: str) -> list[tuple[str, ...]]:
    """Return what is asked besides, in a request each: one that is unknown spoils the others."""
    return [(name,) for name in _SPECIAL.get(node.rpartition('/')[2], ())]
