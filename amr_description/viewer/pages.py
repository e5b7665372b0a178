# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
The pages that are connected.

Nothing waits for a page: what is sent goes to its write buffer. A page is spared states while
anything is there, so that what it gets is never old (the system takes little more than it sends,
see ``server``); it is dropped when too much else waits for it, and by websockets when it does not
answer pings.
"""

from collections.abc import Iterable

from websockets.asyncio.connection import broadcast
from websockets.asyncio.server import ServerConnection

from amr_description.viewer.protocol import encode, ServerMessage

MOST_PAGES = 32
_TOO_MUCH_WAITS = 64 * 1024 * 1024
"""Bytes in the write buffer from which on a page is dropped."""


class Page:
    """One page; ``name`` is what others see."""

    def __init__(self, name: str, connection: ServerConnection) -> None:
        self.name = name
        self.connection = connection
        self.pending = 0
        """Requests that wait for their answer."""

    def tell(self, message: ServerMessage) -> None:
        """Send a text frame."""
        self.send(encode(message))

    def send(self, frame: str | bytes) -> None:
        """Send a frame, whatever waits already."""
        broadcast([self.connection], frame)
        if self.waiting > _TOO_MUCH_WAITS:
            self.connection.transport.abort()

    @property
    def waiting(self) -> int:
        """Bytes that the page has not taken yet, beyond what the system buffers."""
        return self.connection.transport.get_write_buffer_size()


class Pages:
    """All pages, and what a new one has to know."""

    def __init__(self) -> None:
        self._pages: dict[str, Page] = {}
        self._count = 0
        self._board: dict[tuple[str, str], str] = {}

    def __len__(self) -> int:
        return len(self._pages)

    @property
    def is_full(self) -> bool:
        """Whether there is no room for another one."""
        return len(self._pages) >= MOST_PAGES

    def name(self) -> str:
        """Return the name of the next page."""
        self._count += 1
        return f'page {self._count}'

    def add(self, page: Page, hello: ServerMessage) -> None:
        """Greet a page, and tell it all that the others know."""
        page.tell(hello)
        for frame in self._board.values():
            page.send(frame)
        self._pages[page.name] = page

    def remove(self, page: Page) -> None:
        """Forget a page."""
        self._pages.pop(page.name, None)

    def tell(self, message: ServerMessage) -> None:
        """Tell all pages, once."""
        self._send(encode(message))

    def show(self, subject: str, message: ServerMessage) -> None:
        """
        Tell all pages, and those that come later; it takes the place of what was last told of this
        kind about ``subject``.
        """
        key, frame = (message.type, subject), encode(message)
        if self._board.get(key) != frame:
            self._board[key] = frame
            self._send(frame)

    def forget(self, keep: Iterable[str]) -> None:
        """Take off the board what is about subjects that are gone."""
        subjects = {'', *keep}
        self._board = {key: each for key, each in self._board.items() if key[1] in subjects}

    def clear(self) -> None:
        """Forget what was told: nobody looks any more, and it grows old."""
        self._board.clear()

    def send_state(self, state: bytes) -> None:
        """Send a state to all who have taken what was sent before."""
        broadcast([page.connection for page in self._pages.values() if not page.waiting], state)

    def _send(self, frame: str) -> None:
        for page in [*self._pages.values()]:
            page.send(frame)
