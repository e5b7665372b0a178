# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""Messages between the thread that receives them and the one that writes them."""

from collections import deque
from collections.abc import Mapping
import threading

from amr_description.bag.storage import BagMessage, OVERHEAD


class MessageCache:
    """
    A queue of at most so many bytes of memory; on any threads.

    What comes while it is full is lost, and counted: memory does not run out because a disk is
    slow. With ``keep_latest`` the oldest messages go instead, as a snapshot wants it.
    """

    def __init__(self, max_size: int, *, keep_latest: bool = False) -> None:
        """``max_size``: bytes; 0: no bound, as who adds also writes."""
        self._max_size = max_size
        self._keep_latest = keep_latest
        self._messages: deque[BagMessage] = deque()
        self._size = 0
        self._lost: dict[str, int] = {}
        self._has_changed = threading.Condition()
        self._is_closed = False

    @property
    def lost(self) -> Mapping[str, int]:
        """How many messages of each topic were lost."""
        with self._has_changed:
            return dict(self._lost)

    def add(self, *messages: BagMessage) -> None:
        """Add messages; for each that has no room, one is lost."""
        with self._has_changed:
            for message in messages:
                self._add(message)
            self._has_changed.notify()

    def _add(self, message: BagMessage) -> None:
        size = len(message.data) + OVERHEAD
        if self._max_size and self._size and self._size + size > self._max_size:
            if not self._keep_latest:
                self._lost[message.topic] = self._lost.get(message.topic, 0) + 1
                return
            while self._messages and self._size + size > self._max_size:
                self._size -= len(self._messages.popleft().data) + OVERHEAD
        self._messages.append(message)
        self._size += size

    def take(self) -> deque[BagMessage]:
        """Return all that is there, at once."""
        with self._has_changed:
            return self._taken()

    def wait(self, timeout: float | None = None) -> deque[BagMessage] | None:
        """Return what is there when something is, or after ``timeout`` s; None: closed, empty."""
        with self._has_changed:
            self._has_changed.wait_for(lambda: self._messages or self._is_closed, timeout)
            return None if self._is_closed and not self._messages else self._taken()

    def close(self) -> None:
        """Let who waits come to the end."""
        with self._has_changed:
            self._is_closed = True
            self._has_changed.notify_all()

    def _taken(self) -> deque[BagMessage]:
        messages, self._messages, self._size = self._messages, deque(), 0
        return messages
