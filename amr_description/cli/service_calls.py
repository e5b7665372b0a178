# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""Service calls of verbs."""

from collections.abc import Mapping
from typing import Any

from rclpy.client import Client
from rclpy.task import Future

from amr_description.cli.session import Session


def response_to(session: Session, client: Client, request: Any, timeout: float | None) -> Any:
    """Send a request once; return its response, or None if there is none within ``timeout`` s."""
    future = client.call_async(request)
    session.serve(future.done, timeout)
    if future.done():
        return future.result()
    client.remove_pending_request(future)
    return None


def responses(
    session: Session, service_type: Any, requests: Mapping[str, Any], timeout: float | None
) -> dict[str, Any]:
    """
    Call several services of one type concurrently, each as soon as it is there.

    Args:
        session: of the verb.
        service_type: of all services.
        requests: by the names of the services.
        timeout: for all of them, s; None: no limit.

    Returns:
        The responses that have arrived in time, by the same names.
    """
    clients = {name: session.node.create_client(service_type, name) for name in requests}
    futures: dict[str, Future] = {}

    def all_answered() -> bool:
        for name, client in clients.items():
            if name not in futures and client.service_is_ready():
                futures[name] = client.call_async(requests[name])
        return len(futures) == len(clients) and all(future.done() for future in futures.values())

    session.spin(all_answered, timeout)
    for client in clients.values():
        session.node.destroy_client(client)
    return {name: future.result() for name, future in futures.items() if future.done()}
