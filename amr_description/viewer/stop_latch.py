# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
STOP: which robots pages hold at rest, and whether they stand still.

Pure; times of :class:`StandstillJudge` are s of any monotonic clock.
"""

from collections import deque
from dataclasses import dataclass
from typing import Literal, TypeAlias

Holding: TypeAlias = Literal['holds', 'braking', 'moves', 'unknown']
"""What becomes of a stop: see :class:`~amr_description.viewer.protocol.HeldRobot`."""

_WINDOW = 0.4
"""s of motion that are looked at."""
_GRACE = 1.0
"""s after the press in which a robot that moves is taken to brake."""
_SLOWER = 0.95
"""The speed that a braking robot has, at most, of that before."""


@dataclass(frozen=True, slots=True)
class Press:
    """Who pressed STOP, and when (system time, s)."""

    client: str
    since: float


class StopLatch:
    """
    The stops in force: of all robots, also of those that come later, or of one.

    Each holds until it is released, whoever pressed it and whoever releases it. A stop that is
    pressed again stays that of who pressed it first.
    """

    def __init__(self) -> None:
        self.everywhere: Press | None = None
        """The stop of all robots."""
        self._robots: dict[str, Press] = {}
        self._exempt: set[str] = set()
        """Those that were released from the stop of all."""

    def __bool__(self) -> bool:
        return self.everywhere is not None or bool(self._robots)

    def of(self, robot: str) -> Press | None:
        """Return the stop of a robot; None: it is free."""
        own = self._robots.get(robot)
        return own if own is not None or robot in self._exempt else self.everywhere

    def press(self, robot: str | None, client: str, time: float) -> None:
        """Stop a robot; None: all."""
        press = Press(client, time)
        if robot is None:
            self.everywhere = self.everywhere or press
            self._exempt.clear()
        elif self.of(robot) is None:
            self._robots[robot] = press

    def release(self, robot: str | None) -> None:
        """Release a robot; None: all."""
        if robot is None:
            self.everywhere = None
            self._robots.clear()
            self._exempt.clear()
            return
        self._robots.pop(robot, None)
        if self.everywhere is not None:
            self._exempt.add(robot)


class StandstillJudge:
    """
    Whether a stopped robot stands still, by its measured motion.

    Motion is given in multiples of what counts as still: below 1 it is at rest.
    """

    def __init__(self, time: float) -> None:
        """``time``: of the press."""
        self._pressed = time
        self._samples: deque[tuple[float, float]] = deque()

    def add(self, time: float, motion: float | None) -> None:
        """Take a measurement; None: nothing has measured it lately."""
        if motion is not None:
            self._samples.append((time, motion))
        while self._samples and time - self._samples[0][0] > 2.0 * _WINDOW:
            self._samples.popleft()

    def state(self, time: float, *, is_locked: bool) -> Holding:
        """
        Return what becomes of the stop.

        Args:
            time: now.
            is_locked: what drives the robot takes part in the lock. It is believed where nothing
                measures the robot, as while time is paused.
        """
        now = [motion for at, motion in self._samples if time - at <= _WINDOW]
        if not now:
            return 'holds' if is_locked else 'unknown'
        latest = max(now)
        if latest < 1.0:
            return 'holds'
        before = [motion for at, motion in self._samples if time - at > _WINDOW]
        is_slower = bool(before) and latest <= _SLOWER * max(before)
        return 'braking' if is_slower or time - self._pressed < _GRACE else 'moves'
