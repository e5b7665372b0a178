# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
Says when the simulation cannot keep real time, and which stage of the loop takes the time.

It stands between the loop and its ports and adds up the wall time spent in each; that costs four
readings of a clock a turn. Results do not depend on it: being late costs real-time factor only.
"""

from collections.abc import Callable
from dataclasses import dataclass, field
import time

from amr_description.clock import NANOSECONDS
from amr_description.control.contracts import Log, Severity
from amr_description.control.loop import Pacer, Publisher, Stepper

WINDOW = NANOSECONDS
"""ns of the wall clock over which the factor is taken."""

SLOW_WINDOWS = 2
"""In a row, until it is told; one may be that of a robot that was spawned."""

LEAST_SHARE = 0.95
"""Of the real-time factor that is asked for."""

MOST_IDLE = 0.05
"""Of the wall time: who sleeps more has caught up, whatever the mean says."""

LEAST_PROCESSOR = 0.6
"""Of the wall time: a loop in a hurry that has the processor for less of it is kept from it."""

THROTTLE = 10.0
"""s of the wall clock between two lines."""

PHYSICS, CONTROLLERS, PUBLISHING = 'physics', 'controllers and hardware', 'publishing'

_REMEDIES = {
    PHYSICS: 'fewer robots or contacts, or a lower real_time_factor',
    CONTROLLERS: 'a lower update_rate of the controller managers, or fewer controllers',
    PUBLISHING: 'fewer topics or subscribers, or lower publish rates',
}


@dataclass(slots=True)
class _Window:
    wall: int
    """Readings at its beginning, ns."""
    processor: int
    simulated: int
    factor: float
    idle: int = 0
    spent: dict[str, int] = field(default_factory=lambda: {PHYSICS: 0, PUBLISHING: 0})


class LoopProfiler:
    """
    Everything on the control thread.

    ``factor``: tells the real-time factor that is asked for, 0 for none. ``clock`` and
    ``processor``: ns of the wall clock, and of the processor that this thread had.
    """

    def __init__(
        self,
        log: Log,
        factor: Callable[[], float],
        clock: Callable[[], int] = time.monotonic_ns,
        processor: Callable[[], int] = time.thread_time_ns,
    ) -> None:
        self._log = log
        self._factor = factor
        self._clock = clock
        self._processor = processor
        self._window: _Window | None = None
        self._slow = 0

    def stepper(self, stepper: Stepper) -> Stepper:
        """A port like ``stepper`` that is watched."""
        return _WatchedStepper(stepper, self)

    def pacer(self, pacer: Pacer) -> Pacer:
        """A port like ``pacer`` that is watched."""
        return _WatchedPacer(pacer, self)

    def publisher(self, publisher: Publisher) -> Publisher:
        """A port like ``publisher`` that is watched."""
        return _WatchedPublisher(publisher, self)

    def begin(self, simulated: int) -> None:
        """Time begins, or goes on after a pause or a jump, at ``simulated`` ns."""
        self._slow = 0
        self._open(simulated, self._clock())

    def spend(self, stage: str, since: int) -> None:
        """Count the wall time from ``since`` (ns) to now as that of ``stage``."""
        if self._window is not None:
            self._window.spent[stage] += self._clock() - since

    def end_turn(self, simulated: int, since: int) -> None:
        """The turn up to ``simulated`` ns is over, and the pacer was idle from ``since`` on."""
        window, now = self._window, self._clock()
        if window is None:
            return
        window.idle += now - since
        if now - window.wall < WINDOW:
            return
        if self._is_slow(window, simulated, now):
            self._slow += 1
            if self._slow >= SLOW_WINDOWS:
                self._tell(window, simulated, now)
        else:
            self._slow = 0
        self._open(simulated, now)

    def now(self) -> int:
        """The wall clock, ns."""
        return self._clock()

    def _open(self, simulated: int, now: int) -> None:
        self._window = _Window(now, self._processor(), simulated, self._factor())

    def _is_slow(self, window: _Window, simulated: int, now: int) -> bool:
        wall = now - window.wall
        if window.factor == 0.0 or window.factor != self._factor():
            return False
        is_late = simulated - window.simulated < LEAST_SHARE * window.factor * wall
        return is_late and window.idle < MOST_IDLE * wall

    def _tell(self, window: _Window, simulated: int, now: int) -> None:
        wall, passed = now - window.wall, simulated - window.simulated
        rest = wall - window.idle - sum(window.spent.values())
        spent = window.spent | {CONTROLLERS: rest}
        order = sorted(spent, key=spent.__getitem__, reverse=True)
        parts = ', '.join(f'{stage} {spent[stage] / wall:.0%}' for stage in order)
        processor = (self._processor() - window.processor) / wall
        cause = f'Most goes to {order[0]}: {_REMEDIES[order[0]]} would do'
        if processor < LEAST_PROCESSOR:
            cause = (
                f'The loop has the processor for {processor:.0%} of the time only: other '
                'programs, or the callbacks of this one, take it; end some, or ask for a lower '
                'real_time_factor'
            )
        self._log(
            Severity.WARN,
            f'real time is not kept: factor {passed / wall:.2g} instead of {window.factor:g}. Of '
            f'the time goes to {parts}. {cause}. Results are right all the same',
            throttle=THROTTLE,
        )


class _WatchedStepper:
    def __init__(self, stepper: Stepper, watch: LoopProfiler) -> None:
        self._stepper = stepper
        self._watch = watch

    @property
    def time(self) -> int:
        return self._stepper.time

    def advance(self, period: int) -> None:
        since = self._watch.now()
        self._stepper.advance(period)
        self._watch.spend(PHYSICS, since)


class _WatchedPublisher:
    def __init__(self, publisher: Publisher, watch: LoopProfiler) -> None:
        self.set_clocks = publisher.set_clocks
        self._publisher = publisher
        self._watch = watch

    def publish(self, time: int) -> None:
        since = self._watch.now()
        self._publisher.publish(time)
        self._watch.spend(PUBLISHING, since)


class _WatchedPacer:
    def __init__(self, pacer: Pacer, watch: LoopProfiler) -> None:
        self._pacer = pacer
        self._watch = watch

    def resume(self, time: int) -> None:
        self._watch.begin(time)
        self._pacer.resume(time)

    def pace(self, time: int) -> bool:
        since = self._watch.now()
        is_due = self._pacer.pace(time)
        self._watch.end_turn(time, since)
        return is_due
