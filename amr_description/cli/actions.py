# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""The actions of the ROS graph, with their types, clients and servers."""

from collections.abc import Callable

from rclpy.action import (
    get_action_client_names_and_types_by_node,
    get_action_names_and_types,
    get_action_server_names_and_types_by_node,
)
from rclpy.node import Node

from amr_description.cli import graph

ActionEndpoints = list[tuple[str, list[str]]]
"""Full names of nodes, each with the types under which it uses an action."""


def actions(node: Node) -> list[tuple[str, list[str]]]:
    """Return name and types of each action, sorted."""
    return sorted(get_action_names_and_types(node))


def clients_of(node: Node, action: str) -> ActionEndpoints:
    """Return the clients of an action, given by its absolute name."""
    return _endpoints(node, action, get_action_client_names_and_types_by_node)


def servers_of(node: Node, action: str) -> ActionEndpoints:
    """Return the servers of an action, given by its absolute name."""
    return _endpoints(node, action, get_action_server_names_and_types_by_node)


def _endpoints(
    node: Node, action: str, of_node: Callable[..., list[tuple[str, list[str]]]]
) -> ActionEndpoints:
    found = (
        (other.full_name, dict(of_node(node, other.name, other.namespace)).get(action))
        for other in graph.nodes(node, hidden=True)
    )
    return [(name, types) for name, types in found if types]
