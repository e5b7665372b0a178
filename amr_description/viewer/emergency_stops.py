# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
STOP as pages press it: held until it is released, whatever becomes of the page that pressed it.

On the server's thread.
"""

import asyncio
from collections.abc import Callable
import time

from amr_description.viewer.backend import Backend
from amr_description.viewer.protocol import EmergencyStop, HeldRobot
from amr_description.viewer.stop_latch import StandstillJudge, StopLatch

_PERIOD = 0.05
"""s between two calls of :meth:`Backend.hold`."""


class EmergencyStops:
    """
    Holds robots by way of the backend, and publishes how that goes.

    Args:
        backend: of the server.
        publish: takes the message whenever it may have changed.
        on_free: called when the last stop was released.
    """

    def __init__(
        self,
        backend: Backend,
        publish: Callable[[EmergencyStop], None],
        on_free: Callable[[], None],
    ) -> None:
        self._backend = backend
        self._publish = publish
        self._on_free = on_free
        self._latch = StopLatch()
        self._judges: dict[str, StandstillJudge] = {}
        self._timer: asyncio.TimerHandle | None = None

    @property
    def is_engaged(self) -> bool:
        """Whether any robot is stopped, or will be when it comes."""
        return bool(self._latch)

    def by(self, robot: str) -> str | None:
        """Return who stopped a robot; None: it is free."""
        press = self._latch.of(robot)
        return None if press is None else press.client

    def press(self, robot: str | None, client: str) -> None:
        """Stop a robot, None: all, at once and until it is released."""
        self._latch.press(robot, client, time.time())
        self._hold()

    def release(self, robot: str | None) -> None:
        """Release a robot, None: all; controllers deactivated for it become active again."""
        if not self._latch:
            return
        self._latch.release(robot)
        self._hold()
        if not self._latch:
            self._on_free()

    def end(self) -> None:
        """Leave the robots as they are: held, by the lock, if they are."""
        if self._timer is not None:
            self._timer.cancel()
            self._timer = None

    def _hold(self) -> None:
        self.end()
        loop = asyncio.get_running_loop()
        self._publish(self._held(loop.time()))
        if self._latch:
            self._timer = loop.call_later(_PERIOD, self._hold)

    def _held(self, now: float) -> EmergencyStop:
        robots = [each for each in self._backend.known() if self._latch.of(each)]
        found = self._backend.hold(frozenset(robots))
        self._judges = {each: self._judges.get(each) or StandstillJudge(now) for each in robots}
        held = []
        for each in robots:
            press, hold, judge = self._latch.of(each), found.get(each), self._judges[each]
            if press is None or hold is None:
                continue  # it has left the graph in the meantime
            judge.add(now, hold.motion)
            state = judge.state(now, is_locked=hold.is_locked)
            held.append(
                HeldRobot(
                    each,
                    press.client,
                    press.since,
                    state,
                    hold.is_locked,
                    hold.controllers,
                    hold.deactivated,
                )
            )
        press = self._latch.everywhere
        if press is None:
            return EmergencyStop(None, None, tuple(held))
        return EmergencyStop(press.client, press.since, tuple(held))
