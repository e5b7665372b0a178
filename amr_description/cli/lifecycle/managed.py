# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""What the verbs of ``ros2 lifecycle`` share: the nodes with a lifecycle, and their services."""

from argparse import ArgumentParser, Namespace
from collections.abc import Mapping
from typing import Any, TYPE_CHECKING

from amr_description.cli.arguments import (
    add_graph_arguments,
    add_hidden_nodes_argument,
    positive_float,
)
from amr_description.errors import AmrError
from amr_description.text import shorten

if TYPE_CHECKING:
    from rclpy.node import Node

    from amr_description.cli.session import Session

TIMEOUT = 5.0
"""How long to wait for the state of a node, s."""

_SERVICE = 'get_state'
_TYPE = 'lifecycle_msgs/srv/GetState'


def add_lifecycle_arguments(parser: ArgumentParser, timeout: float | None = TIMEOUT) -> None:
    """
    Add the flags of a verb that calls services of nodes.

    Args:
        parser: of the verb.
        timeout: the default of ``--timeout``, s; None: no limit.
    """
    add_graph_arguments(parser)
    add_hidden_nodes_argument(parser)
    default = 'for ever' if timeout is None else f'{timeout:g}'
    parser.add_argument(
        '--timeout',
        metavar='N',
        type=positive_float,
        default=timeout,
        help=f'Longest time in seconds to wait for the response of a node (default: {default})',
    )


def lifecycle_nodes(node: 'Node', *, hidden: bool) -> list[str]:
    """Return the full names of the nodes that have a lifecycle, sorted."""
    from amr_description.cli import graph

    served = {name for name, types in graph.services(node, hidden=True) if _TYPE in types}
    names = {found.full_name for found in graph.nodes(node, hidden=hidden)}
    return sorted(name for name in names if f'{name}/{_SERVICE}' in served)


def find_lifecycle_node(session: 'Session', args: Namespace) -> str:
    """Return the full name of ``args.node_name`` once it is there. Raises AmrError."""
    from amr_description.cli import graph
    from amr_description.cli.discovery import wait_for_discovery

    name = graph.node_name(args.node_name)

    def known() -> list[str]:
        return lifecycle_nodes(session.node, hidden=args.include_hidden_nodes)

    wait_for_discovery(session, args.spin_time, lambda: name in known())
    if name in known():
        return name
    there = {node.full_name: node.hidden for node in graph.nodes(session.node, hidden=True)}
    raise AmrError(explain_no_lifecycle(name, there, known()))


def explain_no_lifecycle(name: str, nodes: Mapping[str, bool], managed: list[str]) -> str:
    """
    Return the line for a node without a lifecycle.

    Args:
        name: full name of the node.
        nodes: all nodes; full name -> whether it is hidden.
        managed: the nodes with a lifecycle.
    """
    if name not in nodes:
        reason = 'is not there'
    elif nodes[name]:
        reason = 'is hidden, --include-hidden-nodes would consider it'
    else:
        reason = 'has no lifecycle'
    others = f'those with a lifecycle are {", ".join(managed)}' if managed else 'no node has one'
    return f"Node not found: '{shorten(name)}' {reason}; {others}"


def ask(
    session: 'Session',
    node: str,
    service: str,
    service_type: Any,
    request: Any,
    timeout: float | None,
    *,
    changes: bool = False,
) -> Any:
    """
    Return the response of a node's service, by its name below the node. Raises AmrError.

    ``changes``: as of :func:`amr_description.cli.service_calls.responses`.
    """
    from amr_description.cli.service_calls import responses

    requests = {f'{node}/{service}': request}
    found = responses(session, service_type, requests, timeout, changes=changes)
    if not found:
        raise AmrError(no_response(node, timeout))
    return found[f'{node}/{service}']


def no_response(node: str, timeout: float | None) -> str:
    """Return the line for a node that does not answer."""
    return f"Exception while calling service of node '{node}': no response within {timeout:g} s"
