# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""Service calls of verbs."""

from collections.abc import Mapping
import math
from typing import Any

from rclpy.client import Client
from rclpy.task import Future

from amr_description.cli.session import Session

_REPEAT_PERIOD = 0.25  # s between two requests to a node that has not answered


def response_to(session: Session, client: Client, request: Any, timeout: float | None) -> Any:
    """Send a request once; return its response, or None if there is none within ``timeout`` s."""
    future = client.call_async(request)
    session.serve(future.done, timeout)
    if future.done():
        return future.result()
    client.remove_pending_request(future)
    return None


def responses(
    session: Session,
    service_type: Any,
    requests: Mapping[str, Any],
    timeout: float | None,
    *,
    changes: bool = False,
) -> dict[str, Any]:
    """
    Call several services of one type concurrently, each as soon as it is there.

    A server that has not discovered the client yet, as on a busy machine, throws its response
    away. So a request that changes nothing is sent again until it is answered.

    Args:
        session: of the verb.
        service_type: of all services.
        requests: by the names of the services.
        timeout: for all of them, s; None: no limit.
        changes: whether the requests change something; they are then sent once.

    Returns:
        The responses that have arrived in time, by the same names.
    """
    clients = {name: session.node.create_client(service_type, name) for name in requests}
    futures: dict[str, list[Future]] = {name: [] for name in requests}
    due = dict.fromkeys(requests, session.clock.now())

    def answers() -> dict[str, Any]:
        done = ((name, each) for name, found in futures.items() for each in found if each.done())
        return {name: future.result() for name, future in done}

    def all_answered() -> bool:
        missing = requests.keys() - answers().keys()
        for name in missing:
            if session.clock.now() >= due[name] and clients[name].service_is_ready():
                futures[name].append(clients[name].call_async(requests[name]))
                due[name] = math.inf if changes else session.clock.now() + _REPEAT_PERIOD
        return not missing

    session.spin(all_answered, timeout)
    for client in clients.values():
        session.node.destroy_client(client)
    return answers()
