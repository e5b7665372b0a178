# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""What pages publish by a form: once, or at a rate until they have enough of it."""

import asyncio
from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

from builtin_interfaces.msg import Time
from rclpy.exceptions import InvalidHandle, InvalidTopicNameException
from rclpy.executors import Executor
from rclpy.node import Node
from rclpy.publisher import Publisher
from rclpy.validate_full_topic_name import validate_full_topic_name

from amr_description.errors import ViewerError
from amr_description.ros.message_fields import set_fields
from amr_description.ros.message_types import message_type
from amr_description.ros.messages import fill_stamp
from amr_description.text import shorten
from amr_description.viewer.requests import Publish, Unpublish
from amr_description.viewer.ros.threads import on_ros_thread

_MOST = 16
"""Topics that a page may publish on."""
_DEPTH = 10


@dataclass(slots=True)
class _PagePublication:
    """One topic of one page."""

    publisher: Publisher
    kind: str
    timer: asyncio.TimerHandle | None = None


@dataclass(slots=True, eq=False)
class _AskedPublication:
    """A request for whose publisher a page waits."""

    page: str
    has_gone: bool = False
    """Whether the page has, in the meantime."""


class Publications:
    """
    All that pages publish by forms; on the server's thread.

    ``refusal`` returns why a topic must not be published on now, None: it may; it is asked for
    each message. ``now`` returns the time, ns, that a stamp of ``now`` becomes. ``log`` logs a
    line.
    """

    def __init__(
        self,
        node: Node,
        executor: Executor,
        refusal: Callable[[str], str | None],
        now: Callable[[], int],
        log: Callable[[str], object],
    ) -> None:
        self._node = node
        self._executor = executor
        self._refusal = refusal
        self._now = now
        self._log = log
        self._of: dict[tuple[str, str], _PagePublication] = {}
        """(page, topic) -> what it publishes."""
        self._asked: set[_AskedPublication] = set()
        self._making = asyncio.Lock()
        """Two requests at once must not make two publishers on one topic of a page."""

    async def publish(self, request: Publish, page: str) -> str:
        """Publish; return one line about it. Raises AmrError."""
        topic, rate = request.topic, request.rate
        self._check(topic)
        kind = message_type(request.message, f'The type of {shorten(topic)}')
        message = kind()
        stamps = set_fields(message, request.values)
        found = await self._publication(page, topic, kind, request.message)
        self._check(topic)  # STOP may have been pressed in the meantime
        if found.timer is not None:
            found.timer.cancel()
            found.timer = None

        def send() -> None:
            now = Time()
            fill_stamp(self._now(), now)
            for stamp in stamps:
                stamp(now)
            found.publisher.publish(message)

        _publish(send)
        often = f'at {rate:g} Hz' if rate else 'once'
        self._log(f'{page} publishes {request.message} on {topic} {often}')
        if rate:
            self._repeat(found, topic, 1.0 / rate, send)
        heard = found.publisher.get_subscription_count()
        listeners = f'{heard} subscription{"s" * (heard != 1)}'
        return f'published {often} on {topic}, to {listeners}'

    async def unpublish(self, request: Unpublish, page: str) -> str:
        """Publish no more on a topic; return one line about it."""
        if self._end_one(page, request.topic):
            return f'nothing more is published on {request.topic}'
        return f'this page publishes nothing on {shorten(request.topic)}'

    def _end_one(self, page: str, topic: str) -> bool:
        """Publish no more on a topic of a page; return whether it did."""
        found = self._of.pop((page, topic), None)
        if found is not None:
            self._end([found])
        return found is not None

    def forget(self, page: str) -> None:
        """A page has gone: what it published ends."""
        for asked in self._asked:
            asked.has_gone |= asked.page == page
        gone = [key for key in self._of if key[0] == page]
        self._end([self._of.pop(key) for key in gone])

    def _check(self, topic: str) -> None:
        """Raise ViewerError: the topic must not be published on now."""
        if (refusal := self._refusal(topic)) is not None:
            raise ViewerError(refusal)

    def _repeat(
        self, found: _PagePublication, topic: str, period: float, send: Callable[[], None]
    ) -> None:
        loop = asyncio.get_running_loop()

        def again(due: float) -> None:
            found.timer = None
            try:
                if self._refusal(topic) is not None:
                    return  # a stop holds; after it, nothing moves by itself
                _publish(send)
            except ViewerError:
                return  # the node ends
            due = max(due + period, loop.time())
            found.timer = loop.call_at(due, again, due)

        due = loop.time() + period
        found.timer = loop.call_at(due, again, due)

    async def _publication(self, page: str, topic: str, kind: Any, name: str) -> _PagePublication:
        """Return what a page publishes on a topic, made if need be. Raises ViewerError."""
        asked = _AskedPublication(page)
        self._asked.add(asked)
        try:
            async with self._making:
                return await self._known_or_made(asked, topic, kind, name)
        finally:
            self._asked.discard(asked)

    async def _known_or_made(
        self, asked: _AskedPublication, topic: str, kind: Any, name: str
    ) -> _PagePublication:
        page = asked.page
        key = page, topic
        found = self._of.get(key)
        if found is not None and found.kind == name:
            return found
        if found is None and sum(each[0] == page for each in self._of) >= _MOST:
            raise ViewerError(f'this page publishes on {_MOST} topics already; end one first')
        try:
            validate_full_topic_name(topic)
        except InvalidTopicNameException as error:
            raise ViewerError(shorten(str(error))) from None
        self._end_one(page, topic)
        publisher = await on_ros_thread(
            self._executor, lambda: self._node.create_publisher(kind, topic, _DEPTH)
        )
        made = _PagePublication(publisher, name)
        if asked.has_gone:
            self._end([made])
            raise ViewerError(f'{page} has gone')
        self._of[key] = made
        return made

    def _end(self, publications: list[_PagePublication]) -> None:
        for each in publications:
            if each.timer is not None:
                each.timer.cancel()
            self._executor.create_task(self._node.destroy_publisher, each.publisher)


def _publish(send: Callable[[], None]) -> None:
    try:
        send()
    except InvalidHandle:
        raise ViewerError('the viewer is ending') from None
