# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""The parameter services of nodes, of several concurrently, with timeouts."""

from collections.abc import Iterable, Mapping, Sequence
from typing import Any

from rcl_interfaces.msg import ParameterDescriptor
from rcl_interfaces.srv import DescribeParameters, ListParameters

from amr_description.cli.service_calls import responses
from amr_description.cli.session import Session

_SERVICE_TIMEOUT = 5.0  # s until the services of a node are there
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

    Args:
        session: of the verb.
        service: name of the service below that of the node.
        service_type: of the service.
        requests: by the full names of the nodes.
        changes: as of :func:`amr_description.cli.service_calls.responses`.

    Returns:
        The responses that have arrived in time, by the same names.
    """
    names = {node: f'{node}/{service}' for node in requests}
    found = responses(
        session,
        service_type,
        {names[node]: request for node, request in requests.items()},
        _RESPONSE_TIMEOUT,
        service_timeout=_SERVICE_TIMEOUT,
        changes=changes,
    )
    return {node: found[name] for node, name in names.items() if name in found}


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
