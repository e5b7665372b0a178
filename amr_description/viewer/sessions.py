# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
The connected pages, and what becomes of their messages; all on the server's thread.

Nothing waits for a page: a frame that is sent goes to the write buffer of its connection. A page
gets no state while its buffer holds anything, so the states that it gets are never old (the
system's own send buffer is kept small, see ``server``). Nor does it get a sample of a sensor: the
newest of each topic waits for it, and replaces the one that waited before. It is disconnected when
its buffer grows too large, and by websockets when it does not answer pings.
"""

import asyncio
from collections.abc import Callable, Iterable

from websockets.asyncio.connection import broadcast
from websockets.asyncio.server import ServerConnection

from amr_description.errors import AmrError
from amr_description.viewer.backend import Backend
from amr_description.viewer.drive_lock import DriveLock
from amr_description.viewer.protocol import Driver, encode, Notice, Reply, ServerMessage
from amr_description.viewer.requests import (
    ClientMessage,
    Drive,
    Part,
    Request,
    SetJoints,
    Stop,
    Watch,
)
from amr_description.viewer.samples import Sample

MOST_PAGES = 32
_LARGEST_BUFFER = 64 * 1024 * 1024
"""Bytes; a page whose write buffer is larger is disconnected."""
_MOST_PENDING = 32
"""Requests that one page may have in progress."""
_QUIET = 2.0
"""s between two equal notices to one page."""


class Page:
    """One page; ``name`` is what the other pages call it."""

    def __init__(self, name: str, connection: ServerConnection) -> None:
        self.name = name
        self.connection = connection
        self.pending = 0
        """Requests in progress."""
        self.watched: frozenset[Part] = frozenset()
        """The parts of a state that it shows beyond those that every state has."""
        self.topics: frozenset[str] = frozenset()
        """The topics of sensors that it shows."""
        self.waiting: dict[str, bytes] = {}
        """The newest sample of each that was not sent yet."""

    def send_message(self, message: ServerMessage) -> None:
        """Send a text frame."""
        self.send(encode(message))

    def send(self, frame: str | bytes) -> None:
        """Send a frame, whatever the write buffer holds."""
        broadcast([self.connection], frame)
        if self.buffered > _LARGEST_BUFFER:
            self.connection.transport.abort()

    def send_samples(self) -> None:
        """Send what waits, as long as the write buffer is empty."""
        while self.waiting and not self.buffered:
            self.send(self.waiting.pop(next(iter(self.waiting))))

    @property
    def buffered(self) -> int:
        """Bytes in the write buffer: those that the system has not taken yet."""
        return self.connection.transport.get_write_buffer_size()


class Pages:
    """All pages, and the latched messages that a new one is sent."""

    def __init__(self) -> None:
        self._pages: dict[str, Page] = {}
        self._count = 0
        self._latched: dict[tuple[str, str], str] = {}
        """(type of message, subject) -> text frame."""
        self._samples: dict[str, bytes] = {}
        """The latest of each topic that a page shows, for one that comes to show it."""

    def __len__(self) -> int:
        return len(self._pages)

    @property
    def is_full(self) -> bool:
        """Whether no more pages are accepted."""
        return len(self._pages) >= MOST_PAGES

    @property
    def watched(self) -> frozenset[Part]:
        """The parts that any page shows."""
        return frozenset().union(*(page.watched for page in self._pages.values()))

    @property
    def topics(self) -> frozenset[str]:
        """The topics of sensors that any page shows."""
        return frozenset().union(*(page.topics for page in self._pages.values()))

    @property
    def wanted(self) -> frozenset[str]:
        """Those of which a page has had the last sample."""
        pages = self._pages.values()
        return frozenset().union(*(page.topics - page.waiting.keys() for page in pages))

    def next_name(self) -> str:
        """Return the name of the next page."""
        self._count += 1
        return f'page {self._count}'

    def add(self, page: Page, hello: ServerMessage) -> None:
        """Add a page; send it ``hello`` and all latched messages."""
        page.send_message(hello)
        for frame in self._latched.values():
            page.send(frame)
        self._pages[page.name] = page

    def remove(self, page: Page) -> None:
        """Remove a page that has disconnected."""
        self._pages.pop(page.name, None)

    def send_message(self, message: ServerMessage) -> None:
        """Send a message to the pages that are connected now."""
        self._send(encode(message))

    def publish(self, subject: str, message: ServerMessage) -> None:
        """
        Send a message to all pages, also to those that connect later.

        It replaces the latched message of the same type and subject, and is not sent if it is
        equal to that.

        Args:
            subject: the robot or simulator that it is about; '' for none.
            message: to send.
        """
        key, frame = (message.type, subject), encode(message)
        if self._latched.get(key) != frame:
            self._latched[key] = frame
            self._send(frame)

    def retain(self, subjects: Iterable[str]) -> None:
        """Drop the latched messages about all other subjects; they are gone."""
        kept = {'', *subjects}
        self._latched = {key: each for key, each in self._latched.items() if key[1] in kept}

    def clear_latched(self) -> None:
        """Drop all latched messages: without pages they are not kept up to date."""
        self._latched.clear()

    def send_state(self, state: bytes) -> None:
        """Send a state to all pages with an empty write buffer."""
        broadcast([page.connection for page in self._pages.values() if not page.buffered], state)

    def show(self, page: Page, topics: frozenset[str]) -> None:
        """Take note of what a page shows; it gets the latest samples of what it did not show."""
        known = {topic: each for topic, each in self._samples.items() if topic in topics}
        new = {topic: each for topic, each in known.items() if topic not in page.topics}
        waiting = {topic: each for topic, each in page.waiting.items() if topic in topics}
        page.topics, page.waiting = topics, waiting | new
        self.forget_samples()

    def forget_samples(self) -> None:
        """Drop the samples of topics that no page shows any more."""
        topics = self.topics
        self._samples = {topic: each for topic, each in self._samples.items() if topic in topics}

    def send_samples(self, samples: Iterable[Sample]) -> None:
        """Send new samples, and those that wait, to the pages that show them and can take them."""
        for topic, frame in ((each.topic, each.frame) for each in samples):
            self._samples[topic] = frame
            for page in self._pages.values():
                if topic in page.topics:
                    page.waiting[topic] = frame
        for page in [*self._pages.values()]:
            page.send_samples()

    def _send(self, frame: str) -> None:
        for page in [*self._pages.values()]:
            page.send(frame)


class MessageRouter:
    """
    Carries out the messages of pages: driving, under its lock, and requests, with their replies.

    ``log_error`` logs a line about an exception that is a bug.
    """

    def __init__(self, backend: Backend, pages: Pages, log_error: Callable[[str], object]) -> None:
        self._backend = backend
        self._pages = pages
        self._log_error = log_error
        self._lock = DriveLock()
        self._expiry: asyncio.TimerHandle | None = None
        self._tasks: set[asyncio.Task[None]] = set()
        self._watched: tuple[frozenset[Part], frozenset[str]] = (frozenset(), frozenset())
        """The parts, and the topics of sensors, that the backend collects."""
        self._noticed: dict[tuple[str, str], float] = {}
        """(page, text) -> when it was sent last."""

    def route(self, page: Page, message: ClientMessage) -> None:
        """Carry out a message."""
        match message:
            case Drive():
                self._drive(page, message)
            case Stop():
                self._on_stop(page, message.robot)
            case SetJoints():
                self._attempt(
                    page, lambda: self._backend.set_joints(message.robot, message.positions)
                )
            case Watch():
                page.watched = frozenset(message.parts)
                self._pages.show(page, frozenset(message.topics))
                self._watch()
            case _:
                self._start_request(page, message)

    def disconnect(self, page: Page) -> None:
        """Stop the robots of a page that has disconnected; it watches nothing any more."""
        self._command_zero(self._lock.release_all(page.name))
        self._pages.forget_samples()
        self._watch()
        self._noticed = {key: at for key, at in self._noticed.items() if key[0] != page.name}

    def stop_all(self) -> None:
        """Stop all robots that pages drive."""
        for robot in self._lock.robots():
            self._stop(robot, '')

    def _watch(self) -> None:
        """Have the backend collect what the pages show."""
        if (watched := (self._pages.watched, self._pages.topics)) != self._watched:
            self._watched = watched
            self._backend.watch(*watched)

    @property
    def topics(self) -> frozenset[str]:
        """The topics of sensors that pages show."""
        return self._watched[1]

    def _drive(self, page: Page, message: Drive) -> None:
        robot, now = message.robot, asyncio.get_running_loop().time()
        before = self._lock.holder(robot)
        if not self._lock.acquire(robot, page.name, now):
            reason = (
                f'{before} drives {robot}; the stop button stops it for everybody'
                if before
                else f'{robot} was stopped by another page; let go, and drive again'
            )
            self._notice(page, reason)
            return
        if not self._attempt(
            page,
            lambda: self._backend.drive(robot, message.linear, message.angular, message.sideways),
        ):
            self._lock.stop(robot, page.name, now)
        if (driver := self._lock.holder(robot)) != before:
            self._pages.publish(robot, Driver(robot, driver))
        self._schedule_expiry(now)

    def _on_stop(self, page: Page, robot: str | None) -> None:
        """Stop a robot, None for all, whoever drives it."""
        self._backend.hold_joints(robot)
        known = {*self._backend.robots(), *self._lock.robots()}
        if robot is None or robot in known:
            for each in known if robot is None else [robot]:
                self._stop(each, page.name)
        else:  # the backend's error tells the page why not
            self._attempt(page, lambda: self._backend.drive(robot, 0.0, 0.0))

    def _stop(self, robot: str, client: str) -> None:
        stopped = self._lock.stop(robot, client, asyncio.get_running_loop().time())
        self._command_zero([robot], stopped)

    def _command_zero(self, robots: list[str], stopped: str | None = None) -> None:
        """Send each robot one command of zero; ``stopped``: the page that must let go."""
        for robot in robots:
            try:
                self._backend.drive(robot, 0.0, 0.0)
            except AmrError as error:  # the robot has left the graph
                self._pages.send_message(Notice('warning', str(error)))
            self._pages.publish(robot, Driver(robot, self._lock.holder(robot), stopped))

    def _schedule_expiry(self, now: float) -> None:
        due = self._lock.next_expiry()
        if self._expiry is None and due is not None:
            self._expiry = asyncio.get_running_loop().call_at(max(due, now), self._expire)

    def _expire(self) -> None:
        self._expiry = None
        now = asyncio.get_running_loop().time()
        self._command_zero(self._lock.expire(now))
        self._schedule_expiry(now)

    def _start_request(self, page: Page, request: Request) -> None:
        if page.pending >= _MOST_PENDING:
            reason = f'{page.pending} requests of this page wait for their answer already'
            page.send_message(Reply(request.id, False, reason))
            return
        page.pending += 1
        task = asyncio.create_task(self._handle(page, request))
        self._tasks.add(task)
        task.add_done_callback(self._tasks.discard)

    async def _handle(self, page: Page, request: Request) -> None:
        try:
            reply = Reply(request.id, True, await self._backend.handle(request))
        except AmrError as error:
            reply = Reply(request.id, False, str(error))
        except Exception as error:
            self._log_error(f'{request}: {type(error).__name__}: {error}')
            reply = Reply(request.id, False, f'the viewer failed: {type(error).__name__}: {error}')
        page.pending -= 1
        page.send_message(reply)

    def _attempt(self, page: Page, call: Callable[[], None]) -> bool:
        """Make a call; on an AmrError send its message to the page and return False."""
        try:
            call()
        except AmrError as error:
            self._notice(page, str(error))
            return False
        return True

    def _notice(self, page: Page, text: str) -> None:
        """Send a warning to a page, the same one at most every 2 s: pages drive at 60 Hz."""
        now, key = asyncio.get_running_loop().time(), (page.name, text)
        if now - self._noticed.get(key, -_QUIET) >= _QUIET:
            self._noticed[key] = now
            page.send_message(Notice('warning', text))
