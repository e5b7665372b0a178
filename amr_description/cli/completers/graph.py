# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""Completions from the ROS graph."""

from argparse import Namespace
from collections.abc import Iterable, Iterator
from contextlib import contextmanager

from rclpy.node import Node

from amr_description.cli import graph
from amr_description.cli.actions import actions as known_actions
from amr_description.cli.completers import installed
from amr_description.cli.discovery import wait_for_discovery
from amr_description.cli.names import full_name
from amr_description.cli.param.requests import list_all
from amr_description.cli.session import open_session, Session

_LIST_CONTROLLERS = '/list_controllers'


@contextmanager
def discovered() -> Iterator[Session]:
    """Yield a session after a discovery that is as short as possible: a user waits for it."""
    with open_session() as session:
        wait_for_discovery(session, 0.0)
        yield session


def nodes(_args: Namespace, _prefix: str) -> Iterable[str]:
    """Return the full names of nodes."""
    with discovered() as session:
        return [node.full_name for node in graph.nodes(session.node)]


def topics(_args: Namespace, _prefix: str) -> Iterable[str]:
    """Return topics."""
    with discovered() as session:
        return [name for name, _ in graph.topics(session.node)]


def services(_args: Namespace, _prefix: str) -> Iterable[str]:
    """Return services."""
    with discovered() as session:
        return [name for name, _ in graph.services(session.node)]


def actions(_args: Namespace, _prefix: str) -> Iterable[str]:
    """Return actions."""
    with discovered() as session:
        return [name for name, _ in known_actions(session.node)]


def message_types(args: Namespace, prefix: str) -> Iterable[str]:
    """Return the types of the topic on the line; all types if it is not there."""
    with discovered() as session:
        known = _types(session.node, args.topic_name, graph.topics(session.node, hidden=True))
    return known or _of_kind('msg', args, prefix)


def service_types(args: Namespace, prefix: str) -> Iterable[str]:
    """Return the types of the service on the line; all types if it is not there."""
    with discovered() as session:
        known = _types(session.node, args.service_name, graph.services(session.node, hidden=True))
    return known or _of_kind('srv', args, prefix)


def action_types(args: Namespace, prefix: str) -> Iterable[str]:
    """Return the types of the action on the line; all types if it is not there."""
    with discovered() as session:
        known = _types(session.node, args.action_name, known_actions(session.node))
    return known or _of_kind('action', args, prefix)


def used_message_types(_args: Namespace, _prefix: str) -> Iterable[str]:
    """Return the types of all topics."""
    with discovered() as session:
        return {name for _, types in graph.topics(session.node) for name in types}


def used_service_types(_args: Namespace, _prefix: str) -> Iterable[str]:
    """Return the types of all services."""
    with discovered() as session:
        return {name for _, types in graph.services(session.node) for name in types}


def parameters(args: Namespace, _prefix: str) -> Iterable[str]:
    """Return the parameters of the node on the line."""
    with discovered() as session:
        node = full_name(session.node, args.node_name, 'a node')
        return list_all(session, [node]).get(node, [])


def controller_managers(_args: Namespace, _prefix: str) -> Iterable[str]:
    """Return the controller managers."""
    with discovered() as session:
        names = [name for name, _ in graph.services(session.node)]
    return [
        name.removesuffix(_LIST_CONTROLLERS) for name in names if name.endswith(_LIST_CONTROLLERS)
    ]


def _types(node: Node, name: str, known: list[tuple[str, list[str]]]) -> list[str]:
    return dict(known).get(full_name(node, name), [])


def _of_kind(kind: str, args: Namespace, prefix: str) -> list[str]:
    return [name for name in installed.interfaces(args, prefix) if f'/{kind}/' in name]
