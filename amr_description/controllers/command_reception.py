# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
The velocity command in force: stamps are checked on arrival, ages at every update.

The age of a command is that of its stamp. A command that is too old on arrival is dropped; one
that becomes too old while in force is replaced by zero velocity.
"""

from collections.abc import Iterable
import math

from amr_description.clock import NANOSECONDS, TimeJumpFilter
from amr_description.control.contracts import Log, Severity
from amr_description.control.samples import TwistSample

FOREIGN_CLOCK = 60 * NANOSECONDS
"""
ns: a stamp further ahead than this is of another clock (system time and simulated time are decades
apart). Below it, a stamp ahead keeps the command in force for longer, as in ros2_control.
"""

_AT_REST = (0.0, 0.0)


class CommandReception:
    """The commands of one controller; all times in ns."""

    def __init__(self, timeout: int, log: Log) -> None:
        """``timeout``: the age at which a command expires; 0: never."""
        self._timeout = timeout
        self._log = log
        self._jumps = TimeJumpFilter()
        self.forget(0)

    def forget(self, time: int) -> None:
        """Drop the command; the timeout starts at ``time``, which may have gone back."""
        self._jumps.observe(time)
        self._stamp = time
        self._twist: tuple[float, float] | None = None
        self._is_driving = False

    def receive(self, samples: Iterable[TwistSample], now: int) -> None:
        """Take commands, oldest first; ``now``: the time that the sender's clock can show."""
        for sample in samples:
            if self._jumps.is_stale(sample.stamp):
                continue  # it would stay in force until its own time is reached again
            stamp = self._trusted_stamp(sample.stamp, now)
            if self._timeout and now - stamp >= self._timeout:
                self._refuse(stamp, now)
            else:
                self._stamp = stamp
                self._twist = (sample.linear, sample.angular)

    def receive_unstamped(self, samples: Iterable[TwistSample], now: int) -> None:
        """Take commands without a stamp, as if stamped ``now``."""
        for sample in samples:
            self._stamp = now
            self._twist = (sample.linear, sample.angular)

    def in_force(self, time: int) -> tuple[float, float] | None:
        """
        Return the twist (m/s, rad/s) to drive at ``time``: the latest command, or zero once it has
        timed out. None: no command since :meth:`forget`, or an invalid one.
        """
        self._jumps.observe(time)
        if self._timeout and time - self._stamp > self._timeout:
            if self._is_driving:
                self._log(Severity.WARN, 'Velocity command timed out. Braking.', throttle=1.0)
            self._is_driving = False
            return _AT_REST
        if self._twist is None:
            return None
        if not all(map(math.isfinite, self._twist)):
            self._log(
                Severity.WARN,
                'Command message contains NaNs. Not updating reference interfaces.',
                throttle=1.0,
            )
            return None
        self._is_driving = self._twist != _AT_REST
        return self._twist

    def _trusted_stamp(self, stamp: int, now: int) -> int:
        if stamp == 0:
            self._log(
                Severity.WARN,
                'Received TwistStamped with zero timestamp, setting it to current time, this '
                'message will only be shown once',
                throttle=math.inf,
            )
            return now
        if stamp - now > FOREIGN_CLOCK:
            self._log(
                Severity.WARN,
                f'A command is stamped {stamp / NANOSECONDS:.3f}, but the time here is '
                f'{now / NANOSECONDS:.3f}: its publisher runs on another clock (use_sim_time?). '
                'Such commands count as stamped now; this message will only be shown once',
                throttle=math.inf,
            )
            return now
        return stamp

    def _refuse(self, stamp: int, now: int) -> None:
        self._log(
            Severity.WARN,
            f'Ignoring the received message (timestamp {stamp / NANOSECONDS:.10f}) because it is '
            f'older than the current time by {(now - stamp) / NANOSECONDS:.10f} seconds, which '
            f'exceeds the allowed timeout ({self._timeout / NANOSECONDS:.4f})',
            throttle=1.0,
        )
