# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
What paces the control loop: the wall clock, the system clock, or another process's ``/clock``.

===================== ========= ==============================================================
class                 is also   for
===================== ========= ==============================================================
``WallPacer``                   a simulated world, at so many times real time
``SystemClockPacer``  Stepper   a real robot
``SimTimePacer``      Stepper   a robot under ``use_sim_time`` that another process simulates
===================== ========= ==============================================================

All are used on the control thread, but for :meth:`SimTimePacer.receive`. A call that arrives in
their :class:`~amr_description.control.ros.loop_thread.CallQueue` ends a sleep. Times are in ns.
"""

from collections.abc import Callable
import math
import time

from amr_description.clock import NANOSECONDS
from amr_description.control.ros.loop_thread import CallQueue
from amr_description.log import Log, Severity

CLOCK_STEP = 50_000_000
"""ns: how far the system clock may drift from the monotonic one before it counts as set anew."""

_GIVE_UP_LAG = 0.1
"""s: a :class:`WallPacer` that is later than this does not catch up, but counts from now on."""
_YIELD_PERIOD = 0.005
"""s: how long it runs as fast as possible before it lets other threads run."""


class WallPacer:
    """
    Keeps simulated time at ``factor`` times the wall clock; 0: as fast as possible.

    Deadlines are absolute, so that the error of one sleep does not add up. Being late costs
    real-time factor, never results.
    """

    def __init__(self, factor: float, calls: CallQueue) -> None:
        self.factor = factor
        """The real-time factor; :meth:`set_factor` sets it."""
        self._calls = calls
        self._wall_start = self._start = 0.0
        self._yielded = 0.0

    def set_factor(self, factor: float, time_now: int) -> None:
        """Keep to another factor from the simulated time ``time_now`` on."""
        self.factor = factor
        self.resume(time_now)

    def resume(self, time_now: int) -> None:
        """Count from the simulated time ``time_now`` on."""
        self._wall_start = time.monotonic()
        self._start = time_now / NANOSECONDS

    def pace(self, time_due: int) -> bool:
        """Sleep until the simulated time ``time_due`` is due; False: a call came before."""
        if self.factor == 0.0:
            self._yield()
            return True
        due = self._wall_start + (time_due / NANOSECONDS - self._start) / self.factor
        delay = due - time.monotonic()
        if delay > 0.0:
            return not self._calls.wait(delay)
        if delay < -_GIVE_UP_LAG:
            self.resume(time_due)
        return True

    def _yield(self) -> None:
        """Let the ROS thread have the interpreter's lock now and then; each time costs."""
        now = time.monotonic()
        if now - self._yielded > _YIELD_PERIOD:
            time.sleep(0)
            self._yielded = time.monotonic()


class SystemClockPacer:
    """
    ``Stepper`` and ``Pacer`` of a real robot: time is that of the system clock, as in all stamps.

    Between two cycles it is measured by the monotonic clock. So a step of the system clock (a
    robot without a battery for its clock finds NTP) never shows as a long or a negative period:
    it is noticed and logged, and all managers begin anew at the new time.

    While it paces, :attr:`time` is the instant that is waited for; afterwards the true one.
    """

    def __init__(
        self, calls: CallQueue, log: Log, rate: int, *, manages_overruns: bool = True
    ) -> None:
        """
        Begin at the present time.

        Args:
            calls: A call that arrives ends a sleep.
            log: Gets a line about each overrun, and each step of the system clock.
            rate: Of the manager, Hz.
            manages_overruns: Leave out the cycles that were missed; False: make up for them in a
                burst.
        """
        self._calls = calls
        self._log = log
        self._rate = rate
        self._period = round(NANOSECONDS / rate)
        self._slack = self._period // 10
        self._manages_overruns = manages_overruns
        self.on_time_jump: Callable[[], None] = lambda: None
        """The system clock was set: what the control thread is then to call."""
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
        """Aim at the instant ``period`` ns from now."""
        self._now += period

    def pace(self, time_due: int) -> bool:
        """Sleep until ``time_due``; False: not yet, or the system clock was set."""
        if abs(_offset() - self._offset) > CLOCK_STEP:
            self._restart()
            return False
        delay = time_due - self._read()
        if delay > 0:
            if self._calls.wait(delay / NANOSECONDS):
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

    def _restart(self) -> None:
        step = (_offset() - self._offset) / NANOSECONDS
        self._log(
            Severity.WARN,
            f'The system clock was set by {step:+.3f} s: controllers begin anew at its time',
        )
        self._calls.put(self.on_time_jump)
        self.resume(0)


def _offset() -> int:
    """
    Return the offset of the system clock from the monotonic one, ns: of three readings the
    quickest.

    A thread that is held up between the two clocks would take that for a clock that was set.
    """
    readings = []
    for _ in range(3):
        before = time.monotonic_ns()
        system = time.time_ns()
        readings.append((time.monotonic_ns() - before, system - before))
    return min(readings)[1]


class SimTimePacer:
    """``Stepper`` and ``Pacer`` by ``/clock``, whose messages the ROS thread hands over."""

    def __init__(self, calls: CallQueue) -> None:
        self._calls = calls
        self._received: int | None = None
        self._now = 0
        self.on_start: Callable[[], None] = lambda: None
        """The first message came: what the control thread is then to call."""
        self.on_time_jump: Callable[[], None] = lambda: None
        """Time went back: what the control thread is then to call."""

    @property
    def time(self) -> int:
        """Simulated time; while it paces, the instant that is waited for."""
        return self._now

    @property
    def has_begun(self) -> bool:
        """Whether a message has come."""
        return self._received is not None

    def receive(self, time_received: int) -> None:
        """Take the time of a message, and wake the control thread; on the ROS thread."""
        last, self._received = self._received, time_received
        if last is None:
            self._calls.put(self.on_start)
        elif time_received < last:
            self._calls.put(self._restart)
        else:
            self._calls.wake()

    def resume(self, time_now: int) -> None:
        """Go on from the latest message; ``time_now`` is not needed."""
        self._now = self._received or 0

    def advance(self, period: int) -> None:
        """Aim at the instant ``period`` ns from now."""
        self._now += period

    def pace(self, time_due: int) -> bool:
        """Wait until a message has ``time_due``; False: not yet, but a call may have come."""
        if self._received is None or self._received < time_due:
            self._calls.wait()
            return False
        self._now = self._received
        return True

    def _restart(self) -> None:
        """Aim at the present time: what is waited for would come only with the old time."""
        self.resume(0)
        self.on_time_jump()
