# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
Logs when the control loop stands, and in which call.

A thread looks ten times a second whether a cycle has ended. A loop that waits (for its next
instant, for a call while paused) does not stand; a call that was handed to it between two cycles,
such as a spawn or a switch, may take as long as it takes, and so may pictures that time waits for
(:meth:`LoopPublisher.follow`). Nor does it stand while the thread is ready to run and the machine
has no processor for it.

A call of C that keeps the interpreter's lock holds this thread up too: what it logs then comes
when that call has returned. While it lasts, a thread of ``faulthandler``, which needs no lock,
prints the stack of every thread to stderr.

A watchdog cannot stop motors: while the loop stands in hardware, nobody else may use it. Hardware
has a watchdog of its own for that, which the loop feeds by writing
(``amr_description/SerialBaseSystem``: ``watchdog_timeout``).
"""

from collections.abc import Callable
import faulthandler
from pathlib import Path
import sys
import threading
import time
from types import FrameType
from typing import Protocol

from amr_description.control.loop import Loop
from amr_description.control.ros.loop_publisher import LoopPublisher
from amr_description.log import Log, Severity

LIMIT = 0.5
"""s of a cycle from which on the loop stands."""

_PERIOD = 0.1
"""s between two looks."""

_LOCKED_LIMIT = 5.0
"""s for which this thread has not run, after which the stacks are printed."""

_STDERR = 2
_CALLERS = 3
"""Frames of the stack that are logged."""


class Progress(Protocol):
    """What the watchdog reads of the queue of the control thread."""

    cycles: int
    """Changes with every cycle."""
    has_calls: bool
    """This cycle began with calls of others."""
    is_waiting: bool
    """Nothing is to be done now."""


class WatchdogClock:
    """The time by which a watchdog judges; s."""

    def now(self) -> float:
        """Return the time since some instant."""
        return time.monotonic()

    def wait(self, ended: threading.Event) -> bool:
        """Wait until the next look is due; return whether the watchdog has ended."""
        return ended.wait(_PERIOD)

    def time_without_processor(self, native_id: int) -> float:
        """Return for how long a thread was ready to run and did not; 0: Linux does not tell."""
        try:
            with open(f'/proc/self/task/{native_id}/schedstat', 'rb', buffering=0) as file:
                return int(file.read().split()[1]) * 1e-9
        except (OSError, IndexError, ValueError):
            return 0.0


WALL_CLOCK = WatchdogClock()


class LoopWatchdog:
    """Watches a control thread; see the module."""

    def __init__(self, progress: Progress, log: Log, clock: WatchdogClock = WALL_CLOCK) -> None:
        self._progress = progress
        self._log = log
        self._clock = clock
        self._ended = threading.Event()
        self._thread = threading.Thread(target=self._run, name='loop_watchdog', daemon=True)
        self._watched = self._watched_native = 0
        self._seen = 0
        self._since = self._looked = self._waited = 0.0
        self._is_standing = False

    def start(self) -> None:
        """Watch the calling thread."""
        self._watched, self._watched_native = threading.get_ident(), threading.get_native_id()
        self._restart()
        self._thread.start()

    def stop(self) -> None:
        """Watch no longer."""
        self._ended.set()

    def frame_standing(self) -> FrameType | None:
        """Where the loop has been for :data:`LIMIT`; None: it goes on."""
        if self._has_moved() or self._time_standing() < LIMIT:
            return None
        frame = sys._current_frames().get(self._watched)
        # Calls between two cycles, start, shutdown and what follows a cycle take their time.
        others = Loop._run_calls, LoopPublisher.follow
        in_cycle = is_in(frame, Loop.run) and not any(is_in(frame, each) for each in others)
        return frame if in_cycle else None

    def _run(self) -> None:
        while not self._clock.wait(self._ended):
            faulthandler.dump_traceback_later(_LOCKED_LIMIT, file=_STDERR)
            self._look()
        faulthandler.cancel_dump_traceback_later()

    def _look(self) -> None:
        unseen = self._clock.now() - self._looked - _PERIOD
        self._looked = self._clock.now()
        if self._has_moved():
            if self._is_standing or unseen > LIMIT:
                self._log_going_on(unseen)
            self._restart()
        elif not self._is_standing and (frame := self.frame_standing()):
            self._is_standing = True
            self._log(
                Severity.ERROR,
                f'The control loop has stood for {self._time_standing():.1f} s in '
                f'{describe_call(frame)}.',
            )

    def _log_going_on(self, unseen: float) -> None:
        """Log that the loop goes on; ``unseen``: for how long this thread has not looked, s."""
        lasted = self._time_standing()
        if self._is_standing:
            self._log(Severity.ERROR, f'The control loop goes on after {lasted:.1f} s.')
        elif min(unseen, lasted) > LIMIT and not self._progress.has_calls:
            self._log(
                Severity.ERROR,
                f'The control loop stood for {lasted:.1f} s, and all of this process with it: '
                'it was stopped, or a call of C kept the lock of the interpreter.',
            )

    def _has_moved(self) -> bool:
        return self._progress.is_waiting or self._progress.cycles != self._seen

    def _restart(self) -> None:
        self._seen, self._is_standing = self._progress.cycles, False
        self._since = self._looked = self._clock.now()
        self._waited = self._clock.time_without_processor(self._watched_native)

    def _time_standing(self) -> float:
        """s since the last progress that was seen, but for those without a processor."""
        waited = self._clock.time_without_processor(self._watched_native) - self._waited
        return self._clock.now() - self._since - waited


def is_in(frame: FrameType | None, function: Callable[..., object]) -> bool:
    """Tell whether a thread at ``frame`` is in a call of ``function``, of Python."""
    while frame is not None and frame.f_code is not function.__code__:
        frame = frame.f_back
    return frame is not None


def describe_call(frame: FrameType | None) -> str:
    """Say in one line where a thread is, and whence it was called."""
    calls: list[str] = []
    while frame is not None and len(calls) < _CALLERS:
        path = '/'.join(Path(frame.f_code.co_filename).parts[-2:])
        calls.append(f'{frame.f_code.co_qualname} ({path}, line {frame.f_lineno})')
        frame = frame.f_back
    return ', called by '.join(calls)
