# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""The parameter services of nodes, of several concurrently, with timeouts."""

from collections.abc import Iterable, Mapping, Sequence
import time
from typing import Any

from rcl_interfaces.msg import ParameterDescriptor
from rcl_interfaces.srv import DescribeParameters, ListParameters
from rclpy.task import Future

from amr_description.cli.session import Session

_SERVICE_TIMEOUT = 5.0  # s until the services of a node are there
_REPEAT_PERIOD = 1.0  # s between two requests to a node that has not answered
_RESPONSE_TIMEOUT = 10.0  # s; a node may have work to do when a parameter is set


def ask_all(
    session: Session,
    service: str,
    service_type: Any,
    requests: Mapping[str, Any],
    *,
    changes: bool = False,
) -> dict[str, Any]:
    """
    Send a request to each of several nodes.

    A server that has not discovered the client yet, as on a busy machine, throws its response
    away. So a request that changes nothing is sent again every second until it is answered.

    Args:
        session: of the verb.
        service: name of the service below that of the node.
        service_type: of the service.
        requests: by the full names of the nodes.
        changes: whether the requests change something; they are then sent once.

    Returns:
        The responses that have arrived in time, by the same names.
    """
    clients = {
        node: session.node.create_client(service_type, f'{node}/{service}') for node in requests
    }
    futures: dict[str, list[Future]] = {}
    sent_at: dict[str, float] = {}

    def send(node: str) -> None:
        futures.setdefault(node, []).append(clients[node].call_async(requests[node]))
        sent_at[node] = time.monotonic()

    def answers() -> dict[str, Any]:
        done = ((node, each) for node, found in futures.items() for each in found if each.done())
        return {node: future.result() for node, future in done}

    def all_sent() -> bool:
        for node, client in clients.items():
            if node not in futures and client.service_is_ready():
                send(node)
        return len(futures) == len(clients)

    def all_answered() -> bool:
        missing = futures.keys() - answers().keys()
        for node in () if changes else missing:
            if time.monotonic() - sent_at[node] >= _REPEAT_PERIOD:
                send(node)
        return not missing

    try:
        session.spin(all_sent, _SERVICE_TIMEOUT)
        session.spin(all_answered, _RESPONSE_TIMEOUT)
        return answers()
    finally:
        for client in clients.values():
            session.node.destroy_client(client)


def list_all(
    session: Session, nodes: Iterable[str], prefixes: Sequence[str] = ()
) -> dict[str, list[str]]:
    """Return the parameters' names, sorted, of each node that answers."""
    request = ListParameters.Request(prefixes=prefixes)
    responses = ask_all(session, 'list_parameters', ListParameters, dict.fromkeys(nodes, request))
    return {node: sorted(response.result.names) for node, response in responses.items()}


def describe_all(
    session: Session, names: Mapping[str, Sequence[str]]
) -> dict[str, dict[str, ParameterDescriptor]]:
    """Return the descriptors by name of each node that answers; none if one name is unknown."""
    requests = {node: DescribeParameters.Request(names=known) for node, known in names.items()}
    responses = ask_all(session, 'describe_parameters', DescribeParameters, requests)
    return {
        node: {descriptor.name: descriptor for descriptor in response.descriptors}
        for node, response in responses.items()
    }
