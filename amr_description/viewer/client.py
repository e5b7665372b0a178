# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""A page without a browser: the client of the WebSocket, for measurements and tests."""

from collections.abc import Sequence
import json
import threading
from typing import Any, Self
from urllib.parse import urlsplit

from websockets.exceptions import ConnectionClosed
from websockets.sync.client import ClientConnection, connect

from amr_description.viewer.http import SOCKET_PATH
from amr_description.viewer.protocol import PROTOCOL


def page_socket(
    url: str, subprotocols: Sequence[str] | None = (PROTOCOL,), **options: Any
) -> ClientConnection:
    """Open the WebSocket of the page at ``url``, as the viewer logs it; a context manager."""
    parts = urlsplit(url)
    query = f'?{parts.query}' if parts.query else ''
    return connect(
        f'ws://{parts.netloc}{SOCKET_PATH}{query}',
        subprotocols=subprotocols,  # type: ignore[arg-type]
        max_size=None,
        **options,
    )


class PageClient:
    """
    A page that counts states and keeps what it shows; it receives in a thread of its own.

    It sends no ``watch``, as a page does that shows what it shows at first: none of the tables and
    layers whose values are collected only while a page shows them.
    """

    def __init__(self, url: str) -> None:
        self.states = 0
        self.robots: tuple[dict[str, Any], ...] = ()
        """The robots of the latest graph message."""
        self.layouts: tuple[dict[str, Any], ...] = ()
        """The robots of the latest layout message: what the states have of each."""
        self._socket = page_socket(url)
        self._reader = threading.Thread(target=self._read, name='page')
        self._reader.start()

    def __enter__(self) -> Self:
        return self

    def __exit__(self, *_: object) -> None:
        self._socket.close()
        self._reader.join()

    def send(self, kind: str, **fields: Any) -> None:
        """Send a text frame."""
        self._socket.send(json.dumps({'type': kind, **fields}))

    def _read(self) -> None:
        try:
            for frame in self._socket:
                if isinstance(frame, bytes):
                    self.states += 1
                    continue
                message = json.loads(frame)
                if message['type'] == 'graph':
                    self.robots = tuple(message['robots'])
                elif message['type'] == 'layout':
                    self.layouts = tuple(message['robots'])
        except ConnectionClosed:
            pass  # the viewer has ended
