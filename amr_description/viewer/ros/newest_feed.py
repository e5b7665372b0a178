# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""A topic of which pages are shown the newest message; what takes long is left to a thread."""

from abc import ABC, abstractmethod
import asyncio
from collections.abc import Callable
from typing import Protocol

from amr_description.errors import AmrError
from amr_description.ros.polled_topic import NumberedMessage
from amr_description.viewer.ros.source import SourceTopic
from amr_description.viewer.ros.topic_rate import Rate


class NumberedTopic(Protocol):
    """A topic whose messages are polled."""

    def take_numbered(self) -> NumberedMessage | None:
        """Return the next message; None: none came. On any thread."""

    def destroy(self) -> None:
        """Unsubscribe."""


class NewestFeed(ABC):
    """One topic; made and destroyed on the ROS thread, polled on the server's thread."""

    def __init__(self, subscribe: Callable[[], NumberedTopic]) -> None:
        """``subscribe`` may raise AmrError: then pages are told it once, in place of samples."""
        self._topic: NumberedTopic | None = None
        self._fault: bytes | None = None
        self._rate = Rate()
        self._due = 0.0
        self._work: asyncio.Future[bytes] | None = None
        try:
            self._topic = subscribe()
        except AmrError as error:
            self._fault = self._unreadable(str(error))

    @abstractmethod
    def _unreadable(self, reason: str) -> bytes:
        """Return a sample that says why there are none."""

    @abstractmethod
    def _next_due(self, due: float, now: float, message: NumberedMessage) -> float:
        """Return when the next message may be taken, s, after one that was ``due``."""

    @abstractmethod
    def _conversion(self, message: NumberedMessage) -> Callable[[], bytes]:
        """Return what makes a sample of a message."""

    @abstractmethod
    def _takes_long(self, message: NumberedMessage) -> bool:
        """Return whether to leave the conversion to another thread."""

    def take(self, now: float, *, is_wanted: bool) -> bytes | None:
        """
        Return a new sample; None: there is none yet, or none is due.

        Args:
            now: s, of a clock that goes on.
            is_wanted: Whether a page can take one now: else no message is taken.
        """
        if self._work is not None:
            return self._result(self._work)
        if self._fault is not None:
            fault, self._fault = self._fault, None
            return fault
        if self._topic is None or not is_wanted or now < self._due:
            return None
        message = self._topic.take_numbered()
        if message is None:
            return None
        self._due = self._next_due(self._due, now, message)
        self._rate.add(message)
        convert = self._conversion(message)
        if not self._takes_long(message):
            return convert()
        self._work = asyncio.get_running_loop().run_in_executor(None, convert)
        return None

    def _result(self, work: asyncio.Future[bytes]) -> bytes | None:
        if not work.done():
            return None
        self._work = None
        return work.result()

    def settle(self) -> None:
        """See :meth:`SourceTopic.settle`."""
        if isinstance(self._topic, SourceTopic):
            self._topic.settle()

    def destroy(self) -> None:
        """Unsubscribe."""
        if self._topic is not None:
            self._topic.destroy()
