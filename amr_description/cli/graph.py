# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
The ROS graph: topics and services with their types, and nodes, once discovery has settled.

Names of topics, services and nodes are absolute, unless a function says otherwise.
"""

from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass
import os

from rclpy.node import Node
from rclpy.topic_or_service_is_hidden import topic_or_service_is_hidden

from amr_description.cli.names import full_name
from amr_description.cli.session import Session
from amr_description.errors import AmrError
from amr_description.ros.endpoints import endpoint_node
from amr_description.ros.local_participants import local_participants
from amr_description.ros.transport import reaches_other_hosts
from amr_description.text import did_you_mean

_QUIET = 0.4  # s without changes until discovery is complete; Fast DDS repeats after 0.28 s
_QUIET_WITH_SERVER = 1.5  # s; discovery by a server has several steps, 0.45 s each
_LONGEST_DISCOVERY = 5.0  # s; a graph may never stop changing, and Fast DDS may pause for 3 s
_LOOKUP_TIMEOUT = 2.0  # s to wait for a given name
_LOOKUP_TIMEOUT_OF_HOSTS = 4.0  # s, where it may be on another one, which speaks up every 3 s
_SHOWN_NODES = 5  # in an error

_NODE_LISTS = 'ros_discovery_info'  # on it participants publish their nodes (rmw_dds_common)
_PARAMETER_EVENTS = '/parameter_events'


@dataclass(frozen=True, order=True)
class NodeName:
    """A node of the graph."""

    full_name: str
    name: str
    namespace: str

    @property
    def hidden(self) -> bool:
        """Whether its name, or one of its namespaces, begins with an underscore."""
        return topic_or_service_is_hidden(self.full_name)


def wait_for_discovery(
    session: Session, at_least: float, found: Callable[[], bool] | None = None
) -> None:
    """
    Wait until the graph is complete.

    It is complete when all participants of this host are found, and nothing has changed for 0.4 s:
    a participant that has just ended may still count as found, and hide one that is not. On a busy
    machine changes come in batches, so after late changes the wait is longer; and times are those
    of the session's clock, so that it is longer where this process has to wait its turn.

    Args:
        session: of the verb.
        at_least: shortest time to wait, s.
        found: returns whether a wanted name is there. If not, wait for it, up to 2 s in all; where
            it may be on another host, 4 s.
    """
    start = last_change = session.clock.now()
    known = None
    domain = session.node.context.get_domain_id()
    there = local_participants(domain)
    least = _QUIET_WITH_SERVER if os.environ.get('ROS_DISCOVERY_SERVER') else _QUIET

    def is_complete() -> bool:
        nonlocal known, last_change, there
        now = session.clock.now()
        snapshot = _snapshot(session.node)
        if snapshot != known:
            known, last_change = snapshot, now
        quiet = max(least, (last_change - start) * 0.5)
        if now - start < at_least or now - last_change < quiet:
            return False
        before, there = there, local_participants(domain)
        if before - there:
            last_change = now
            return False
        return _all_found(session.node, len(there))

    session.spin(is_complete, max(at_least, _LONGEST_DISCOVERY))
    if found is not None:
        session.spin(found, start + max(at_least, _lookup_timeout()) - session.clock.now())


def _lookup_timeout() -> float:
    """Return how long to wait for a given name, s."""
    return _LOOKUP_TIMEOUT_OF_HOSTS if reaches_other_hosts() else _LOOKUP_TIMEOUT


def is_there_within(session: Session, is_there: Callable[[], bool], timeout: float | None) -> bool:
    """
    Wait for a node or a server; return whether it is there.

    Args:
        session: of the verb.
        is_there: returns whether it is.
        timeout: how long to wait, s; None: without limit. It is not over before the graph is
            complete: until then nobody knows.
    """
    if session.spin(is_there, timeout):
        return True
    wait_for_discovery(session, 0.0)
    return is_there()


def _snapshot(node: Node) -> object:
    """Return a value that is equal as long as the graph does not change."""
    topics = node.get_topic_names_and_types()
    endpoints = [(node.count_publishers(t), node.count_subscribers(t)) for t, _ in topics]
    services = node.get_service_names_and_types()
    return sorted(node.get_node_names_and_namespaces()), topics, endpoints, services


def _all_found(node: Node, count: int) -> bool:
    """
    Return whether as many participants as are on this host are found, with endpoints and nodes.

    Fast DDS discovers a participant and each of its endpoints separately, either up to a second
    later than the other; what its nodes are called comes last, as a message. Each participant of
    ROS both publishes and subscribes to the lists of nodes, and has a node.
    """
    if len(node.get_node_names()) < count:
        return False
    ends = (
        node.get_publishers_info_by_topic(_NODE_LISTS, no_mangle=True),
        node.get_subscriptions_info_by_topic(_NODE_LISTS, no_mangle=True),
    )
    if any(len(found) < count for found in ends):
        return False
    announcers = node.get_publishers_info_by_topic(_PARAMETER_EVENTS)
    return all(endpoint_node(publisher) is not None for publisher in announcers)


def topics(node: Node, *, hidden: bool = False) -> list[tuple[str, list[str]]]:
    """Return name and types of each topic, sorted; with ``hidden`` also those with a ``_``."""
    return [
        (name, types)
        for name, types in sorted(node.get_topic_names_and_types())
        if hidden or not topic_or_service_is_hidden(name)
    ]


def types_of(node: Node, topic: str) -> list[str]:
    """Return the types of a topic; none if it is not there."""
    return dict(node.get_topic_names_and_types()).get(topic, [])


def is_published(node: Node, topic: str) -> bool:
    """Return whether a topic is there, with any type."""
    return bool(types_of(node, topic))


def only_type_of(node: Node, topic: str) -> str:
    """Return the type of a topic. Raises AmrError if there is none, or several."""
    types = types_of(node, topic)
    if not types:
        print(f'WARNING: topic [{topic}] does not appear to be published yet')
        others = namesakes(node, topic, node.count_publishers)
        there = f'; there is {", ".join(others)}' if others else ''
        raise AmrError(f'Could not determine the type for the passed topic{there}')
    if len(types) > 1:
        raise AmrError(
            f"Cannot echo topic '{topic}', as it contains more than one type: "
            f'[{", ".join(types)}]; name one of them behind the topic'
        )
    return types[0]


def namesakes(node: Node, topic: str, count: Callable[[str], int]) -> list[str]:
    """
    Return other topics with the same last word, and their types: ``/robot1/odom (TYPE)``.

    Args:
        node: of the verb.
        topic: absolute.
        count: returns how many publishers, or subscriptions, a topic has; those without are left
            out.
    """
    last = topic.rpartition('/')[2]
    return [
        f'{name} ({", ".join(types)})'
        for name, types in topics(node)
        if name.rpartition('/')[2] == last and name != topic and count(name)
    ]


def wait_for_type(session: Session, topic: str) -> str:
    """Wait without limit for a topic; return its type. Raises AmrError if there are several."""
    if not session.spin(lambda: is_published(session.node, topic), _lookup_timeout()):
        print(f'WARNING: topic [{topic}] does not appear to be published yet')
        session.spin(lambda: is_published(session.node, topic))
    return only_type_of(session.node, topic)


def nodes(node: Node, *, hidden: bool = False) -> list[NodeName]:
    """Return the nodes, sorted by full name; two nodes of one name are two entries."""
    found = (
        NodeName(f'{namespace.rstrip("/")}/{name}', name, namespace)
        for name, namespace in node.get_node_names_and_namespaces()
    )
    return sorted(n for n in found if hidden or not n.hidden)


def node_name(word: str) -> str:
    """Return the full name of a node as it is typed, with or without the first slash."""
    return '/' + word.removeprefix('/')


def find_node(session: Session, word: str, timeout: float) -> str:
    """
    Return the full name of a node once it is there, hidden or not.

    Args:
        session: of the verb.
        word: the node's name as it is typed.
        timeout: how long to wait for it, s.

    Raises:
        AmrError: it is not a name, or the node is not there.
    """
    name = full_name(session.node, node_name(word), 'a node')

    def known() -> list[str]:
        return [node.full_name for node in nodes(session.node, hidden=True)]

    if not is_there_within(session, lambda: name in known(), timeout):
        others = [node.full_name for node in nodes(session.node)]
        raise AmrError(f'Node not found{_other_nodes(name, others)}')
    return name


def _other_nodes(name: str, known: Sequence[str]) -> str:
    """Return the end of an error: which nodes could be meant, or which there are."""
    if not known:
        return ': there are no nodes'
    more = ', ...' if len(known) > _SHOWN_NODES else ''
    return did_you_mean(name, known) or f'; there are {", ".join(known[:_SHOWN_NODES])}{more}'


def services(node: Node, *, hidden: bool = False) -> list[tuple[str, list[str]]]:
    """Return name and types of each service, sorted; with ``hidden`` also those with a ``_``."""
    return [
        (name, types)
        for name, types in sorted(node.get_service_names_and_types())
        if hidden or not topic_or_service_is_hidden(name)
    ]


def types_of_service(node: Node, service: str) -> list[str]:
    """Return the types of a service, with servers or clients; none if it is not there."""
    return dict(node.get_service_names_and_types()).get(service, [])


def explain_absent_service(
    service: str, type_name: str, known: Iterable[tuple[str, list[str]]]
) -> str:
    """
    Return why a call gets no response, '' if unknown: another type, or another name.

    Args:
        service: the name that is called.
        type_name: the type that it is called with.
        known: name and types of all services, including that of the call itself.
    """
    types = dict(known)
    others = [name for name in types.pop(service, []) if name != type_name]
    if others:
        return f'you call {service} as {type_name}, but it is {" and ".join(others)}; use that'
    hint = did_you_mean(service, types)
    return f'there is no service {service}{hint}' if hint else ''
