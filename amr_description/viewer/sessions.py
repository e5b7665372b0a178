# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
The pages that are connected.

Nothing waits for a page: what is sent goes to its write buffer. A page is spared states while
anything is there, so that what it gets is never old (the system takes little more than it sends,
see ``server``); it is dropped when too much else waits for it, and by websockets when it does not
answer pings.

What becomes of what the pages say: who drives, what is asked, what is answered.
"""

import asyncio
from collections.abc import Callable, Iterable

from websockets.asyncio.connection import broadcast
from websockets.asyncio.server import ServerConnection

from amr_description.errors import AmrError
from amr_description.viewer.backend import Backend
from amr_description.viewer.drive_lock import DriveLock
from amr_description.viewer.protocol import Driver, encode, Notice, Reply, ServerMessage
from amr_description.viewer.requests import ClientMessage, Drive, Request, SetJoints, Stop

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


_MOST_PENDING = 32
"""Requests of one page at a time."""
_QUIET = 2.0
"""s between two equal notices to one page."""


class MessageRouter:
    """On the server's thread."""

    def __init__(self, backend: Backend, pages: Pages, say: Callable[[str], object]) -> None:
        self._backend = backend
        self._pages = pages
        self._say = say
        self._driving = DriveLock()
        self._expiry: asyncio.TimerHandle | None = None
        self._tasks: set[asyncio.Task[None]] = set()
        self._noticed: dict[tuple[str, str], float] = {}

    def hear(self, page: Page, message: ClientMessage) -> None:
        """Do what a page says."""
        match message:
            case Drive():
                self._drive(page, message)
            case Stop():
                self._hear_stop(page, message.robot)
            case SetJoints():
                self._attempt(
                    page, lambda: self._backend.set_joints(message.robot, message.positions)
                )
            case _:
                self._ask(page, message)

    def leave(self, page: Page) -> None:
        """Stop what a page drives that is gone."""
        self._bring_to_rest(self._driving.leave(page.name))
        self._noticed = {key: at for key, at in self._noticed.items() if key[0] != page.name}

    def stop_all(self) -> None:
        """Stop all robots that are driven from here."""
        for robot in self._driving.robots():
            self._stop(robot, '')

    def _drive(self, page: Page, message: Drive) -> None:
        robot, now = message.robot, asyncio.get_running_loop().time()
        before = self._driving.driver(robot)
        if not self._driving.drive(robot, page.name, now):
            reason = (
                f'{before} drives {robot}; the stop button stops it for everybody'
                if before
                else f'{robot} was stopped by another page; let go, and drive again'
            )
            self._notice(page, reason)
            return
        if not self._attempt(
            page, lambda: self._backend.drive(robot, message.linear, message.angular)
        ):
            self._driving.stop(robot, page.name, now)
        self._show_driver(robot, before)
        self._await_expiry(now)

    def _hear_stop(self, page: Page, robot: str | None) -> None:
        """``None``: all, whoever drives them."""
        known = {*self._backend.robots(), *self._driving.robots()}
        if robot is None or robot in known:
            for each in known if robot is None else [robot]:
                self._stop(each, page.name)
        else:
            self._attempt(page, lambda: self._backend.drive(robot, 0.0, 0.0))  # say why not

    def _stop(self, robot: str, client: str) -> None:
        stopped = self._driving.stop(robot, client, asyncio.get_running_loop().time())
        self._bring_to_rest([robot], stopped)

    def _bring_to_rest(self, robots: list[str], stopped: str | None = None) -> None:
        """Command zero, once; ``stopped``: the page that must let go."""
        for robot in robots:
            try:
                self._backend.drive(robot, 0.0, 0.0)
            except AmrError as error:  # it is gone, and with it who would hear
                self._pages.tell(Notice('warning', str(error)))
            self._pages.show(robot, Driver(robot, self._driving.driver(robot), stopped))

    def _await_expiry(self, now: float) -> None:
        due = self._driving.next_expiry()
        if self._expiry is None and due is not None:
            self._expiry = asyncio.get_running_loop().call_at(max(due, now), self._expire)

    def _expire(self) -> None:
        self._expiry = None
        now = asyncio.get_running_loop().time()
        self._bring_to_rest(self._driving.expire(now))
        self._await_expiry(now)

    def _show_driver(self, robot: str, before: str | None) -> None:
        driver = self._driving.driver(robot)
        if driver != before:
            self._pages.show(robot, Driver(robot, driver))

    def _ask(self, page: Page, request: Request) -> None:
        if page.pending >= _MOST_PENDING:
            reason = f'{page.pending} requests of this page wait for their answer already'
            page.tell(Reply(request.id, False, reason))
            return
        page.pending += 1
        task = asyncio.create_task(self._answer(page, request))
        self._tasks.add(task)
        task.add_done_callback(self._tasks.discard)

    async def _answer(self, page: Page, request: Request) -> None:
        try:
            reply = Reply(request.id, True, await self._backend.answer(request))
        except AmrError as error:
            reply = Reply(request.id, False, str(error))
        except Exception as error:
            self._say(f'{request}: {type(error).__name__}: {error}')
            reply = Reply(request.id, False, f'the viewer failed: {type(error).__name__}: {error}')
        page.pending -= 1
        page.tell(reply)

    def _attempt(self, page: Page, call: Callable[[], None]) -> bool:
        """Make a call; False: it cannot be done, and the page was told."""
        try:
            call()
        except AmrError as error:
            self._notice(page, str(error))
            return False
        return True

    def _notice(self, page: Page, text: str) -> None:
        """Tell a page what keeps it from something, but not sixty times a second."""
        now, key = asyncio.get_running_loop().time(), (page.name, text)
        if now - self._noticed.get(key, -_QUIET) >= _QUIET:
            self._noticed[key] = now
            page.tell(Notice('warning', text))
