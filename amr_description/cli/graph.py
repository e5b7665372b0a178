# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""Who is there: topics with their types, and nodes, once discovery has come to rest."""

from collections.abc import Callable
from dataclasses import dataclass
import os
import time

from rclpy.node import Node
from rclpy.topic_or_service_is_hidden import topic_or_service_is_hidden

from amr_description.cli.local_participants import count_local_participants
from amr_description.cli.session import Session
from amr_description.errors import AmrError
from amr_description.ros.endpoints import endpoint_node

_QUIET = 0.4  # s without news before discovery counts as done; Fast DDS asks again after 0.28 s
_QUIET_WITH_SERVER = 1.5  # s; a discovery server is asked step by step, each 0.45 s later
_AT_MOST = 5.0  # s; a graph may go on changing for ever, and Fast DDS may be silent for 3 s
_PATIENCE = 2.0  # s for something asked for by its name

_NODE_LISTS = 'ros_discovery_info'  # each participant publishes its nodes there (rmw_dds_common)
_OF_EVERY_NODE = '/parameter_events'


@dataclass(frozen=True, order=True)
class NodeName:
    """A node of the graph."""

    full_name: str
    name: str
    namespace: str

    @property
    def hidden(self) -> bool:
        """Whether its name, or a namespace that it is in, begins with an underscore."""
        return topic_or_service_is_hidden(self.full_name)


def wait_for_discovery(
    session: Session, at_least: float, found: Callable[[], bool] | None = None
) -> None:
    """
    Wait until the graph is complete, and at least so many seconds.

    It is when everybody on this host was found and no news came for 0.4 s, or longer where news
    came late: on a busy machine they come in batches.

    :param found: Tells whether what was asked for is there. If not, wait up to 2 s: it may be on
        another host.
    """
    start = last_change = time.monotonic()
    known = None
    least = _QUIET_WITH_SERVER if os.environ.get('ROS_DISCOVERY_SERVER') else _QUIET

    def at_rest() -> bool:
        nonlocal known, last_change
        now = time.monotonic()
        seen = _snapshot(session.node)
        if seen != known:
            known, last_change = seen, now
        patience = max(least, (last_change - start) * 0.5)
        quiet = now - start >= at_least and now - last_change >= patience
        return quiet and _all_local_found(session.node)

    session.spin(at_rest, max(at_least, _AT_MOST))
    if found is not None:
        session.spin(found, start + max(at_least, _PATIENCE) - time.monotonic())


def _snapshot(node: Node) -> object:
    """Return something that is equal as long as nobody comes, goes, or changes what it does."""
    topics = node.get_topic_names_and_types()
    endpoints = [(node.count_publishers(t), node.count_subscribers(t)) for t, _ in topics]
    services = node.get_service_names_and_types()
    return sorted(node.get_node_names_and_namespaces()), topics, endpoints, services


def _all_local_found(node: Node) -> bool:
    """
    Tell whether all participants of this host were found, and what they publish and subscribe to.

    Fast DDS tells these two apart from each other, either may come up to a second later. Each
    participant of ROS both publishes and reads the lists of nodes.
    """
    there = count_local_participants(node.context.get_domain_id())
    ends = (
        node.get_publishers_info_by_topic(_NODE_LISTS, no_mangle=True),
        node.get_subscriptions_info_by_topic(_NODE_LISTS, no_mangle=True),
    )
    if any(len(found) < there for found in ends):
        return False
    announcers = node.get_publishers_info_by_topic(_OF_EVERY_NODE)
    return all(endpoint_node(publisher) is not None for publisher in announcers)


def topics(node: Node, *, hidden: bool = False) -> list[tuple[str, list[str]]]:
    """Return name and types of each topic, sorted; with ``hidden`` also those with a ``_``."""
    return [
        (name, types)
        for name, types in sorted(node.get_topic_names_and_types())
        if hidden or not topic_or_service_is_hidden(name)
    ]


def types_of(node: Node, topic: str) -> list[str]:
    """Return the types under which a topic, given by its absolute name, is used."""
    return dict(node.get_topic_names_and_types()).get(topic, [])


def is_published(node: Node, topic: str) -> bool:
    """Tell whether a topic is there under any type."""
    return bool(types_of(node, topic))


def only_type_of(node: Node, topic: str) -> str:
    """Return the type of a topic, given by its absolute name. Raises AmrError: not just one."""
    types = types_of(node, topic)
    if not types:
        print(f'WARNING: topic [{topic}] does not appear to be published yet')
        raise AmrError('Could not determine the type for the passed topic')
    if len(types) > 1:
        raise AmrError(
            f"Cannot echo topic '{topic}', as it contains more than one type: "
            f'[{", ".join(types)}]; name one of them behind the topic'
        )
    return types[0]


def wait_for_type(session: Session, topic: str) -> str:
    """Wait, for ever, until a topic is there; return its type. Raises AmrError: several."""
    if not session.spin(lambda: is_published(session.node, topic), _PATIENCE):
        print(f'WARNING: topic [{topic}] does not appear to be published yet')
        session.spin(lambda: is_published(session.node, topic))
    return only_type_of(session.node, topic)


def nodes(node: Node, *, hidden: bool = False) -> list[NodeName]:
    """Return the nodes, sorted by full name; one that is there twice stands there twice."""
    found = (
        NodeName(f'{namespace.rstrip("/")}/{name}', name, namespace)
        for name, namespace in node.get_node_names_and_namespaces()
    )
    return sorted(n for n in found if hidden or not n.hidden)
