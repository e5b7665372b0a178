# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""A page without a browser: a WebSocket that talks with the node viewer, for tests."""

from contextlib import contextmanager, ExitStack
import json
import socket
import threading
import time
from urllib.parse import urlsplit

from support.running_programs import PATIENCE
from websockets.exceptions import ConnectionClosed

from amr_description.viewer.client import page_socket
from amr_description.viewer.protocol import PROTOCOL

NOW_AND_THEN = 0.02
"""s between two looks at what a test waits for."""


def open_socket(url, subprotocols=(PROTOCOL,), **options):
    """The WebSocket of the page at this address, a context manager."""
    return page_socket(url, subprotocols, open_timeout=PATIENCE, **options)


@contextmanager
def kept_port():
    """
    A TCP port of 127.0.0.1 for one server after the other, and for nobody else in between.

    One that the system chose for a server is anybody's as soon as that has ended. This one stays
    bound by a socket that does not listen, which keeps out all but servers that name the port.
    """
    with socket.socket() as keeper:
        keeper.setsockopt(socket.SOL_SOCKET, socket.SO_REUSEADDR, 1)  # as servers do
        keeper.bind(('127.0.0.1', 0))
        yield keeper.getsockname()[1]


def deaf(url):
    """A page's socket that nobody reads."""
    parts = urlsplit(url)
    client = socket.create_connection((parts.hostname, parts.port), PATIENCE)
    client.sendall(
        (
            f'GET /ws HTTP/1.1\r\nHost: {parts.netloc}\r\nUpgrade: websocket\r\n'
            'Connection: Upgrade\r\nSec-WebSocket-Key: dGhlIHNhbXBsZSBub25jZQ==\r\n'
            f'Sec-WebSocket-Version: 13\r\nSec-WebSocket-Protocol: {PROTOCOL}\r\n\r\n'
        ).encode()
    )
    return client


class Page:
    """
    A connection, and all that came by it; a thread of its own reads.

    ``messages``: the text frames; ``states``: the binary ones.
    """

    def __init__(self, url, **options):
        self.messages = []
        self.states = []
        self._changed = threading.Condition()
        self._is_open = True
        self._stack = ExitStack()
        self.socket = self._stack.enter_context(open_socket(url, **options))
        self._reader = threading.Thread(target=self._read, daemon=True)
        self._reader.start()

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.close()

    def close(self):
        """Say goodbye."""
        self._stack.close()
        self._reader.join(PATIENCE)

    def vanish(self):
        """Close the socket without a goodbye, as a page does whose tab is killed."""
        self.socket.socket.shutdown(2)
        self._reader.join(PATIENCE)

    def say(self, kind, **fields):
        """Send a text frame."""
        self.socket.send(json.dumps({'type': kind, **fields}))

    def ask(self, kind, number, **fields):
        """Send a request; return its reply."""
        self.say(kind, id=number, **fields)
        return self.wait(lambda: next((r for r in self.of('reply') if r['id'] == number), None))

    def of(self, kind):
        """All messages of a type so far."""
        return [message for message in [*self.messages] if message['type'] == kind]

    def last(self, kind):
        """The last message of a type; None: none has come yet."""
        return next((m for m in reversed([*self.messages]) if m['type'] == kind), None)

    @property
    def is_told_that_nobody_drives(self):
        """Whether the last word about a driver is that there is none any more."""
        driver = self.last('driver')
        return driver is not None and driver['client'] is None

    def wait(self, condition):
        """
        Wait until a condition is something; return it.

        It is looked at whenever something came, and now and then: it may be about more than that.
        """
        deadline = time.monotonic() + PATIENCE
        with self._changed:
            while not (found := condition()):
                assert time.monotonic() < deadline, f'in vain: {self.messages}'
                self._changed.wait(NOW_AND_THEN)
        return found

    def wait_closed(self):
        """Wait for the end of the connection; return code and reason of the close."""
        with self._changed:
            assert self._changed.wait_for(lambda: not self._is_open, PATIENCE), 'it stays open'
        return self.socket.protocol.close_code, self.socket.protocol.close_reason

    def _read(self):
        try:
            for frame in self.socket:
                with self._changed:
                    if isinstance(frame, bytes):
                        self.states.append(frame)
                    else:
                        self.messages.append(json.loads(frame))
                    self._changed.notify_all()
        except ConnectionClosed:
            pass
        with self._changed:
            self._is_open = False
            self._changed.notify_all()
