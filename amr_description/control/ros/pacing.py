# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
The machine's own time as what the loop steps and is paced by: a robot without a simulator.

Time is that of the system clock, as everybody's stamps are. Between two ticks it is measured by
the monotonic clock, so that a step of the system clock (a robot without a battery for its clock
finds NTP) never shows as a long or a negative period; it is noticed, said, and all begin anew.

Somebody else's ``/clock`` as what the loop steps and is paced by: ``use_sim_time`` without being
the simulator.
"""

from collections.abc import Callable
import math
import time

from amr_description.clock import NANOSECONDS
from amr_description.control.contracts import Log, Severity
from amr_description.control.ros.loop_thread import CallQueue

CLOCK_STEP = 50_000_000
"""ns: how far the system clock may drift from the monotonic one before it counts as set anew."""


class SystemClockPacer:
    """
    ``Stepper`` and ``Pacer`` of the loop at once, for a manager at ``rate`` Hz.

    While it paces, :attr:`time` is the instant that is waited for; afterwards the true one.
    """

    def __init__(
        self, mailbox: CallQueue, log: Log, rate: int, *, manages_overruns: bool = True
    ) -> None:
        """
        ``manages_overruns``: leave out the cycles that were missed; otherwise they are made good
        in a burst.
        """
        self._mailbox = mailbox
        self._log = log
        self._rate = rate
        self._period = round(NANOSECONDS / rate)
        self._slack = self._period // 10
        self._manages_overruns = manages_overruns
        self.on_step: Callable[[], None] = lambda: None
        """The system clock was set: a call for the owner, which begins anew."""
        self.resume(0)

    @property
    def time(self) -> int:
        """ns since 1970."""
        return self._now

    def resume(self, time_now: int) -> None:
        """Read the system clock; ``time_now`` is not needed, as nobody sets this one."""
        self._offset = _offset()
        self._now = self._read()

    def advance(self, period: int) -> None:
        """Aim at the instant ``period`` (ns) from now."""
        self._now += period

    def pace(self, time_due: int) -> bool:
        """Sleep until ``time_due`` (ns); False: not yet, or the clock was set."""
        if abs(_offset() - self._offset) > CLOCK_STEP:
            self._begin_anew()
            return False
        delay = time_due - self._read()
        if delay > 0:
            if self._mailbox.wait(delay / NANOSECONDS):
                return False
        elif -delay > self._slack and self._manages_overruns:
            self._skip(time_due, -delay)
            return False
        self._now = self._read() if self._manages_overruns else time_due
        return True

    def _read(self) -> int:
        return time.monotonic_ns() + self._offset

    def _skip(self, due: int, late: int) -> None:
        """Aim at the first cycle that can still be kept; ``late``: ns after ``due``."""
        missed = math.ceil(late / self._period)
        self._now = due + missed * self._period
        self._log(
            Severity.WARN,
            'Overrun detected! The controller manager missed its desired rate of '
            f'{self._rate} Hz. The loop took {(late + self._period) / 1e6:f} ms (missed cycles : '
            f'{missed + 1}).',
            throttle=1.0,
        )

    def _begin_anew(self) -> None:
        step = (_offset() - self._offset) / NANOSECONDS
        self._log(
            Severity.WARN,
            f'The system clock was set by {step:+.3f} s: controllers begin anew at its time',
        )
        self._mailbox.put(self.on_step)
        self.resume(0)


def _offset() -> int:
    """
    ns from the monotonic to the system clock: of three readings the quickest.

    A thread that is held up between the two clocks would take that for a clock that was set.
    """
    readings = []
    for _ in range(3):
        before = time.monotonic_ns()
        system = time.time_ns()
        readings.append((time.monotonic_ns() - before, system - before))
    return min(readings)[1]


class SimTimePacer:
    """``Stepper`` and ``Pacer`` of the loop at once; :meth:`hear` is called by the ROS thread."""

    def __init__(self, mailbox: CallQueue) -> None:
        self._mailbox = mailbox
        self._heard: int | None = None
        self._now = 0
        self.on_start: Callable[[], None] = lambda: None
        """The first time was heard: a call for the owner."""
        self.on_step: Callable[[], None] = lambda: None
        """Time went back: a call for the owner, which begins anew."""

    @property
    def time(self) -> int:
        """Simulated time, ns; while it paces, the instant that is waited for."""
        return self._now

    def hear(self, time_heard: int) -> None:
        """Take a message of ``/clock``, ns, and wake the owner."""
        last, self._heard = self._heard, time_heard
        if last is None:
            self._mailbox.put(self.on_start)
        elif time_heard < last:
            self._mailbox.put(self._begin_anew)
        else:
            self._mailbox.wake()

    def resume(self, time_now: int) -> None:
        """Go on from what was heard last."""
        self._now = self._heard or 0

    def advance(self, period: int) -> None:
        """Aim at the instant ``period`` (ns) from now."""
        self._now += period

    def pace(self, time_due: int) -> bool:
        """Wait until ``time_due`` (ns) was heard; False: not yet, but a call may have come."""
        if self._heard is None or self._heard < time_due:
            self._mailbox.wait()
            return False
        self._now = self._heard
        return True

    def _begin_anew(self) -> None:
        """For the owner: what it waited for comes when the old time is reached again."""
        self.resume(0)
        self.on_step()
