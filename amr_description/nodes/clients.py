# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""What a program needs that asks others and then ends: waiting in words, and calling services."""

from collections.abc import Callable
import time
from typing import Any

import rclpy
from rclpy.client import Client
from rclpy.node import Node

from amr_description.errors import AmrError

_POLL = 0.05
"""s: how soon a change of the graph is seen; messages and responses are seen at once."""


class NoAnswerError(AmrError):
    """A service did not answer in time."""


def wait_until[Result](
    node: Node,
    condition: Callable[[], Result | None],
    say: Callable[[], None],
    *,
    every: float,
    timeout: float = 0.0,
) -> Result | None:
    """
    Serve the node until ``condition()`` is something, and return it.

    ``say`` is called every ``every`` s of waiting. ``timeout``: s, 0 for ever; then ``None``.
    """
    start = time.monotonic()
    said = start
    while (result := condition()) is None:
        now = time.monotonic()
        if timeout and now - start >= timeout:
            return None
        if now - said >= every:
            said = now
            say()
        rclpy.spin_once(node, timeout_sec=_POLL)
    return result


def ask_until_answered(
    node: Node, client: Client, request: Any, *, timeout: float = 10.0
) -> Any:
    """
    Send a request that changes nothing, again every second until it is answered.

    Fast DDS finds the endpoints of two participants in either direction by itself, one perhaps a
    second after the other. A server that does not know the client's yet does what it is asked for
    and throws its response away. Once it has answered, other requests need to be sent only once.
    Raises NoAnswerError.
    """
    pending = [client.call_async(request)]
    response = wait_until(
        node,
        lambda: next((future.result() for future in pending if future.done()), None),
        lambda: pending.append(client.call_async(request)),
        every=1.0,
        timeout=timeout,
    )
    if response is None:
        raise NoAnswerError(f'service {client.srv_name} has not answered within {timeout:g} s')
    return response


def call(
    node: Node, service_type: Any, name: str, request: Any, *, timeout: float = 10.0
) -> Any:
    """Call a service that is there, once; return the response. Raises NoAnswerError."""
    client = node.create_client(service_type, name)
    try:
        return call_with(node, client, request, timeout=timeout)
    finally:
        node.destroy_client(client)


def call_with(node: Node, client: Client, request: Any, *, timeout: float = 10.0) -> Any:
    """As :func:`call`, with a client that is there already."""
    name, deadline = client.srv_name, time.monotonic() + timeout
    while not client.service_is_ready():
        if time.monotonic() >= deadline:
            raise NoAnswerError(
                f'service {name} is not there after {timeout:g} s; is its node running?'
            )
        rclpy.spin_once(node, timeout_sec=_POLL)
    future = client.call_async(request)
    rclpy.spin_until_future_complete(
        node, future, timeout_sec=max(0.0, deadline - time.monotonic())
    )
    if not future.done():
        raise NoAnswerError(f'service {name} has not answered within {timeout:g} s')
    return future.result()
