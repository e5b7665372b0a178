# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
Services of others, awaited on the asyncio thread of the page's server.

Clients are made and removed on the ROS thread, as soon as their services are there: a server that
does not know a client yet throws its response away.
"""

import asyncio
from collections.abc import Mapping
from typing import Any

from rclpy.client import Client
from rclpy.node import Node
from rclpy.task import Future

from amr_description.errors import ViewerError

_READY_TIMEOUT = 5.0
_POLL = 0.05


class Services:
    """Clients by the names of their services."""

    def __init__(self, node: Node) -> None:
        self._node = node
        self._clients: dict[str, Client] = {}

    def keep(self, wanted: Mapping[str, type]) -> None:
        """Have these clients and no others; on the ROS thread."""
        kept = {name: each for name, each in self._clients.items() if name in wanted}
        gone = [each for name, each in self._clients.items() if name not in wanted]
        for name, service_type in wanted.items():
            if name not in kept:
                kept[name] = self._node.create_client(service_type, name)
        self._clients = kept
        for client in gone:
            self._node.destroy_client(client)

    def __contains__(self, name: str) -> bool:
        """Tell whether there is such a service; on any thread."""
        return name in self._clients

    async def call(self, name: str, request: Any, timeout: float = 10.0) -> Any:
        """Return the response; on the asyncio thread. Raises ViewerError."""
        client = self._clients.get(name)
        if client is None:
            raise ViewerError(f'there is no service {name}; is its node running?')
        await _ready(client)
        loop = asyncio.get_running_loop()
        answered = loop.create_future()
        pending = client.call_async(request)

        def settle(_: Future) -> None:
            loop.call_soon_threadsafe(lambda: answered.done() or answered.set_result(None))

        pending.add_done_callback(settle)
        try:
            await asyncio.wait_for(answered, timeout)
        except TimeoutError:
            raise ViewerError(f'service {name} has not answered within {timeout:g} s') from None
        finally:
            client.remove_pending_request(pending)
        return pending.result()


async def _ready(client: Client) -> None:
    loop = asyncio.get_running_loop()
    deadline = loop.time() + _READY_TIMEOUT
    while not client.service_is_ready():
        if loop.time() > deadline:
            raise ViewerError(
                f'service {client.srv_name} is not there after {_READY_TIMEOUT:g} s; is its node '
                'running?'
            )
        await asyncio.sleep(_POLL)
