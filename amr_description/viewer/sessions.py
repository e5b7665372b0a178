# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""What becomes of the messages of pages; all on the server's thread."""

import asyncio
from collections.abc import Callable

from amr_description.errors import AmrError, PartlyDoneError
from amr_description.viewer.backend import Backend, Watched
from amr_description.viewer.drive_lock import DriveLock
from amr_description.viewer.emergency_stops import EmergencyStops
from amr_description.viewer.pages import Page, Pages
from amr_description.viewer.protocol import Driver, Notice, Reply
from amr_description.viewer.pushes import Pushes
from amr_description.viewer.requests import (
    ClientMessage,
    Drive,
    PressStop,
    Push,
    Release,
    Request,
    SetJoints,
    Stop,
    Watch,
)

_MOST_PENDING = 32
"""Requests that one page may have in progress."""
_QUIET = 2.0
"""s between two equal notices to one page."""


class MessageRouter:
    """
    Carries out the messages of pages: driving, under its lock, and requests, with their replies.

    Args:
        backend: of the server.
        pages: all of them.
        log_error: logs a line about an exception that is a bug.
        on_free: called when the last robot that was stopped is released.
    """

    def __init__(
        self,
        backend: Backend,
        pages: Pages,
        log_error: Callable[[str], object],
        on_free: Callable[[], None],
    ) -> None:
        self._backend = backend
        self._pages = pages
        self._log_error = log_error
        self._lock = DriveLock()
        self.stops = EmergencyStops(backend, lambda each: pages.publish('', each), on_free)
        self._expiry: asyncio.TimerHandle | None = None
        self._pushes = Pushes(self._apply_push)
        self._push_expiry: asyncio.TimerHandle | None = None
        self._tasks: set[asyncio.Task[None]] = set()
        self._watched = Watched()
        """What the backend collects."""
        self._noticed: dict[tuple[str, str], float] = {}
        """(page, text) -> when it was sent last."""

    def route(self, page: Page, message: ClientMessage) -> None:
        """Carry out a message."""
        match message:
            case Drive():
                self._drive(page, message)
            case Stop():
                self._on_stop(page, message.robot)
            case PressStop():
                self._let_go(page, message.robot)
                self.stops.press(message.robot, page.name)
            case Release():
                self.stops.release(message.robot)
            case SetJoints():
                self._set_joints(page, message)
            case Push():
                now = asyncio.get_running_loop().time()
                self._attempt(page, lambda: self._pushes.push(page.name, message, now))
                self._expire_pushes()
            case Watch():
                begun = frozenset(message.parts) - page.watched.parts
                self._pages.show(page, _watched_of(message))
                self._watch()
                for part in begun:
                    if (latest := self._backend.latest(part)) is not None:
                        page.send_message(latest)
            case _:
                self._start_request(page, message)

    def disconnect(self, page: Page) -> None:
        """Stop the robots of a page that has disconnected; it watches nothing any more."""
        self._command_zero(self._lock.release_all(page.name))
        self._pushes.forget(page.name)
        self._pages.forget_samples()
        self._backend.forget(page.name)
        self._watch()
        self._noticed = {key: at for key, at in self._noticed.items() if key[0] != page.name}

    def stop_all(self) -> None:
        """Stop all robots that pages drive."""
        for robot in self._lock.robots():
            self._stop(robot, '')

    def _watch(self) -> None:
        """Have the backend collect what the pages show."""
        if (watched := self._pages.watched) != self._watched:
            self._watched = watched
            self._backend.watch(watched)

    @property
    def shows_topics(self) -> bool:
        """Whether any page shows a topic."""
        watched = self._watched
        return bool(watched.sensors or watched.messages or watched.fields)

    def _drive(self, page: Page, message: Drive) -> None:
        robot, now = message.robot, asyncio.get_running_loop().time()
        if (client := self.stops.by(robot)) is not None:
            self._lock.block(robot, page.name, now)
            self._notice(page, _stopped(robot, client))
            return
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

    def _set_joints(self, page: Page, message: SetJoints) -> None:
        robot = message.robot
        if (client := self.stops.by(robot)) is not None:
            self._notice(page, _stopped(robot, client))
            return
        self._attempt(page, lambda: self._backend.set_joints(robot, message.positions))

    def _let_go(self, page: Page, robot: str | None) -> None:
        """End what pages do with a robot, None: all, that is stopped, whatever takes it."""
        self._backend.hold_joints(robot)
        known = {*self._backend.robots(), *self._lock.robots()}
        for each in known if robot is None else known & {robot}:
            self._stop(each, page.name)

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

    def _expire_pushes(self) -> None:
        """Let go what is due, and come again when the next is."""
        loop = asyncio.get_running_loop()
        self._pushes.expire(loop.time())
        if self._push_expiry is not None:
            self._push_expiry.cancel()
        due = self._pushes.next_expiry()
        self._push_expiry = None if due is None else loop.call_at(due, self._expire_pushes)

    def _apply_push(self, push: Push) -> None:
        self._backend.push(push.simulator, push.entity, push.link, push.force, push.torque)

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
            answer = await self._backend.handlers.carry_out(request, page.name)
            reply = Reply(request.id, True, answer.message, answer.data)
        except PartlyDoneError as error:
            reply = Reply(request.id, False, str(error), again=error.again)
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


def _stopped(robot: str, client: str) -> str:
    return f'STOP holds {robot}, pressed by {client}; release it, and drive again'


def _watched_of(message: Watch) -> Watched:
    fields = {topic: frozenset(paths) for topic, paths in message.fields.items() if paths}
    return Watched(
        frozenset(message.parts),
        frozenset(message.topics),
        frozenset(message.messages),
        fields,
        frozenset(message.whole),
    )
