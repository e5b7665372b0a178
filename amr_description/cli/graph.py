# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
The ROS graph: topics and services with their types, and nodes, once discovery is complete.

Names of topics, services and nodes are absolute, unless a function says otherwise.
"""

from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass

from rclpy.node import Node
from rclpy.topic_or_service_is_hidden import topic_or_service_is_hidden

from amr_description.cli.discovery import is_there_within, lookup_timeout
from amr_description.cli.names import full_name
from amr_description.cli.session import Session
from amr_description.errors import AmrError
from amr_description.text import did_you_mean

_SHOWN_NODES = 5  # in an error


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
        published = [name for name, _ in topics(node) if node.count_publishers(name)]
        there = f'; there is {", ".join(others)}' if others else did_you_mean(topic, published)
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
    if not is_there_within(session, lambda: is_published(session.node, topic), lookup_timeout()):
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
