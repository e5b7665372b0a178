# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""What becomes of what the pages say: who drives, what is asked, what is answered."""

import asyncio
from collections.abc import Callable

from amr_description.errors import AmrError
from amr_description.viewer.backend import Backend
from amr_description.viewer.driving import Driving
from amr_description.viewer.pages import Page, Pages
from amr_description.viewer.protocol import Driver, Notice, Reply
from amr_description.viewer.requests import ClientMessage, Drive, Request, SetJoints, Stop

_MOST_PENDING = 32
"""Requests of one page at a time."""
_QUIET = 2.0
"""s between two equal notices to one page."""


class Conversation:
    """On the server's thread."""

    def __init__(self, backend: Backend, pages: Pages, say: Callable[[str], object]) -> None:
        self._backend = backend
        self._pages = pages
        self._say = say
        self._driving = Driving()
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
