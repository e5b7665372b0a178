# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
Warns when the simulation cannot keep real time, and names the stage of the loop that is slow.

:class:`LoopProfiler` stands between the loop and its stepper, pacer and publisher and adds up the
wall time spent in each, at the cost of six clock readings a cycle. At factor 0 there is nothing to
keep, and nothing is measured. Results do not depend on it: being late costs real-time factor only.
"""

from collections.abc import Callable
from dataclasses import dataclass, field
import time

from amr_description.clock import NANOSECONDS
from amr_description.control.loop import Publisher, Stepper
from amr_description.control.ros.pacing import WallPacer
from amr_description.log import Log, Severity

WINDOW = NANOSECONDS
"""ns of the wall clock over which the factor is taken."""

SLOW_WINDOWS = 2
"""Slow windows in a row before it is logged; the spawning of a robot makes one slow."""

MIN_FACTOR_SHARE = 0.95
"""Share of the requested real-time factor below which a window is slow."""

MAX_IDLE_SHARE = 0.05
"""Share of the wall time; a loop that sleeps more has caught up, whatever the mean says."""

MIN_PROCESSOR_SHARE = 0.6
"""Share of the wall time; a late loop that runs for less of it is kept from the processor."""

THROTTLE = 10.0
"""s of the wall clock between two warnings."""

PHYSICS, CONTROLLERS, PUBLISHING = 'physics', 'controllers and hardware', 'publishing'

_REMEDIES = {
    PHYSICS: 'fewer robots or contacts, or a lower real_time_factor',
    CONTROLLERS: 'a lower update_rate of the controller managers, or fewer controllers',
    PUBLISHING: 'fewer topics or subscribers, or lower publish rates',
}


@dataclass(slots=True)
class _Window:
    wall: int
    """Clock readings at its beginning, ns."""
    processor: int
    simulated: int
    factor: float
    idle: int = 0
    spent: dict[str, int] = field(default_factory=lambda: {PHYSICS: 0, PUBLISHING: 0})


class LoopProfiler:
    """
    Stepper, pacer and publisher of a loop: each call is timed and passed on.

    All calls are made on the control thread.
    """

    def __init__(
        self,
        log: Log,
        stepper: Stepper,
        pacer: WallPacer,
        publisher: Publisher,
        *,
        clock: Callable[[], int] = time.monotonic_ns,
        processor: Callable[[], int] = time.thread_time_ns,
    ) -> None:
        """
        Wrap the ports of a loop.

        Args:
            log: Gets the warnings.
            stepper: Advances the world.
            pacer: Keeps the loop to its ``factor``; 0: as fast as possible.
            publisher: Publishes at the end of a cycle.
            clock: Wall clock, ns.
            processor: Processor time of the calling thread, ns.
        """
        self._log = log
        self._stepper = stepper
        self._pacer = pacer
        self._publisher = publisher
        self._clock = clock
        self._processor = processor
        self._window: _Window | None = None
        """None at factor 0, and before the first cycle."""
        self._slow_windows = 0
        self.set_clocks = publisher.set_clocks

    # --- stepper ------------------------------------------------------------------------------

    @property
    def time(self) -> int:
        """Simulated time, ns."""
        return self._stepper.time

    def advance(self, period: int) -> None:
        """Advance the world by ``period``, ns."""
        window = self._window
        if window is None:
            self._stepper.advance(period)
            return
        start = self._clock()
        self._stepper.advance(period)
        window.spent[PHYSICS] += self._clock() - start

    # --- publisher ----------------------------------------------------------------------------

    def publish(self, time: int) -> None:
        """Publish at ``time``, ns."""
        window = self._window
        if window is None:
            self._publisher.publish(time)
            return
        start = self._clock()
        self._publisher.publish(time)
        window.spent[PUBLISHING] += self._clock() - start

    # --- pacer --------------------------------------------------------------------------------

    def resume(self, time: int) -> None:
        """Begin at ``time`` (ns), or go on after a pause or a jump."""
        self._slow_windows = 0
        self._window = self._window_from(time, self._clock())
        self._pacer.resume(time)

    def pace(self, time: int) -> bool:
        """Wait until ``time`` (ns) is due; False: a call has come before."""
        window = self._window
        if window is None:
            if self._pacer.factor != 0.0:  # it was set since
                self._window = self._window_from(time, self._clock())
            return self._pacer.pace(time)
        start = self._clock()
        is_due = self._pacer.pace(time)
        self._end_cycle(window, time, start)
        return is_due

    # --- windows ------------------------------------------------------------------------------

    def _end_cycle(self, window: _Window, simulated: int, idle_since: int) -> None:
        now = self._clock()
        window.idle += now - idle_since
        if now - window.wall < WINDOW:
            return
        if self._is_slow(window, simulated, now):
            self._slow_windows += 1
            if self._slow_windows >= SLOW_WINDOWS:
                self._warn(window, simulated, now)
        else:
            self._slow_windows = 0
        self._window = self._window_from(simulated, now)

    def _window_from(self, simulated: int, now: int) -> _Window | None:
        """Return a new window; None at factor 0."""
        factor = self._pacer.factor
        return _Window(now, self._processor(), simulated, factor) if factor else None

    def _is_slow(self, window: _Window, simulated: int, now: int) -> bool:
        wall = now - window.wall
        if window.factor != self._pacer.factor:
            return False
        is_late = simulated - window.simulated < MIN_FACTOR_SHARE * window.factor * wall
        return is_late and window.idle < MAX_IDLE_SHARE * wall

    def _warn(self, window: _Window, simulated: int, now: int) -> None:
        wall, passed = now - window.wall, simulated - window.simulated
        rest = wall - window.idle - sum(window.spent.values())
        spent = window.spent | {CONTROLLERS: rest}
        order = sorted(spent, key=spent.__getitem__, reverse=True)
        parts = ', '.join(f'{stage} {spent[stage] / wall:.0%}' for stage in order)
        processor = (self._processor() - window.processor) / wall
        cause = f'Most goes to {order[0]}: {_REMEDIES[order[0]]} would do'
        if processor < MIN_PROCESSOR_SHARE:
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
