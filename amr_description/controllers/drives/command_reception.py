# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
The velocity command in force: stamps are checked on arrival, ages at every update.

The age of a command is that of its stamp. A command that is too old on arrival is dropped; one
that becomes too old while in force is replaced by zero velocity.
"""

from collections.abc import Iterable
import math
from operator import attrgetter
from typing import Any, TypeAlias

from amr_description.clock import NANOSECONDS, TimeJumpFilter
from amr_description.control.contracts import Input
from amr_description.control.samples import TwistSample
from amr_description.log import Log, Severity

FOREIGN_CLOCK = 60 * NANOSECONDS
"""
ns: a stamp further ahead than this is of another clock (system time and simulated time are decades
apart). Below it, a stamp ahead keeps the command in force for longer, as in ros2_control.
"""

Twist: TypeAlias = tuple[float, ...]
"""m/s and rad/s, in the order of the axes of the reception."""

PLANAR = ('linear', 'angular')
HOLONOMIC = ('linear', 'lateral', 'angular')

_MOST = 1e12
"""m/s, rad/s"""


class CommandReception:
    """The commands of one controller; all times in ns."""

    def __init__(self, timeout: int, log: Log, axes: tuple[str, ...] = PLANAR) -> None:
        """
        Begin without a command.

        Args:
            timeout: the age at which a command expires; 0: never.
            log: of the controller.
            axes: the fields of a sample that make up a twist, two or more.
        """
        self._timeout = timeout
        self._components = attrgetter(*axes)
        self._at_rest: Twist = (0.0,) * len(axes)
        self._log = log
        self._jumps = TimeJumpFilter()
        self.forget(0)

    def forget(self, time: int) -> None:
        """Drop the command; the timeout starts at ``time``, which may have gone back."""
        self._jumps.observe(time)
        self._stamp = time
        self._twist: Twist | None = None
        self._is_driving = False

    def discard(self, ports: Iterable[Input[Any]], time: int) -> None:
        """Drop the command, and those that wait, at ``time``: an emergency stop is engaged."""
        for port in ports:
            port.drain()
        self.forget(time)

    def receive(self, samples: Iterable[TwistSample], now: int) -> None:
        """Take commands, oldest first; ``now``: the time that the sender's clock can show."""
        for sample in samples:
            if self._jumps.is_stale(sample.stamp):
                continue  # it would stay in force until its own time is reached again
            stamp = self._trusted_stamp(sample.stamp, now)
            if self._timeout and now - stamp >= self._timeout:
                self._refuse(stamp, now)
            else:
                self._accept(sample, stamp)

    def receive_unstamped(self, samples: Iterable[TwistSample], now: int) -> None:
        """Take commands without a stamp, as if stamped ``now``."""
        for sample in samples:
            self._accept(sample, now)

    def _accept(self, sample: TwistSample, stamp: int) -> None:
        """Take a command, unless it is finite and beyond all robots: positions would be lost."""
        twist = self._components(sample)
        if any(_MOST < abs(each) < math.inf for each in twist):
            self._log(
                Severity.WARN,
                f'A command of over {_MOST:g} m/s or rad/s is ignored, as no robot drives so',
                throttle=1.0,
            )
            return
        self._stamp, self._twist = stamp, twist

    def age(self, time: int) -> int:
        """Return how old the command in force is at ``time``, ns; without one, since when."""
        return time - self._stamp

    def in_force(self, time: int) -> Twist | None:
        """
        Return the twist (m/s, rad/s) to drive at ``time``: the latest command, or zero once it has
        timed out. None: no command since :meth:`forget`, or an invalid one.
        """
        self._jumps.observe(time)
        if self._timeout and self.age(time) > self._timeout:
            if self._is_driving:
                self._log(Severity.WARN, 'Velocity command timed out. Braking.', throttle=1.0)
            self._is_driving = False
            return self._at_rest
        if self._twist is None:
            return None
        if not all(map(math.isfinite, self._twist)):
            self._log(
                Severity.WARN,
                'Command message contains NaNs. Not updating reference interfaces.',
                throttle=1.0,
            )
            return None
        self._is_driving = self._twist != self._at_rest
        return self._twist

    def _trusted_stamp(self, stamp: int, now: int) -> int:
        if stamp == 0:
            self._warn_of_zero_stamp()
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

    def _warn_of_zero_stamp(self) -> None:
        self._log(
            Severity.WARN,
            'Received TwistStamped with zero timestamp, setting it to current time, this '
            'message will only be shown once',
            throttle=math.inf,
        )

    def _refuse(self, stamp: int, now: int) -> None:
        self._log(
            Severity.WARN,
            f'Ignoring the received message (timestamp {stamp / NANOSECONDS:.10f}) because it is '
            f'older than the current time by {(now - stamp) / NANOSECONDS:.10f} seconds, which '
            f'exceeds the allowed timeout ({self._timeout / NANOSECONDS:.4f})',
            throttle=1.0,
        )


class ReferenceReception(CommandReception):
    """
    The commands on ``~/reference`` of the mecanum drive and steering controllers.

    They differ from ``~/cmd_vel``: with a timeout of 0 a command counts for one update, and once
    one has timed out there is no command, instead of zero velocity.
    """

    def __init__(
        self, timeout: int, log: Log, axes: tuple[str, ...], *, stops_at_outdated: bool
    ) -> None:
        """
        Begin without a command.

        Args:
            timeout: the age at which a command expires; 0: after one update.
            log: of the controller.
            axes: as of :class:`CommandReception`.
            stops_at_outdated: a command that is too old on arrival ends the one in force.
        """
        super().__init__(timeout, log, axes)
        self._stops_at_outdated = stops_at_outdated

    def receive(self, samples: Iterable[TwistSample], now: int) -> None:
        """Take commands, oldest first; ``now``: the time that the sender's clock can show."""
        for sample in samples:
            if self._jumps.is_stale(sample.stamp):
                continue
            stamp = self._trusted_stamp(sample.stamp, now)
            if self._timeout and now - stamp > self._timeout:
                self._refuse(stamp, now)
                if self._stops_at_outdated:
                    self._twist = None
            else:
                self._accept(sample, stamp)

    def in_force(self, time: int) -> Twist | None:
        """Return the twist to drive at ``time``; None: there is none, or it is not finite."""
        self._jumps.observe(time)
        twist = self._twist
        if twist is None:
            return None
        if self._timeout == 0:
            self._twist = None
        elif time - self._stamp > self._timeout:
            self._twist = None
            if twist != self._at_rest:
                self._log(Severity.WARN, 'Reference timed out. Braking.', throttle=1.0)
            return None
        return twist if all(map(math.isfinite, twist)) else None

    def _warn_of_zero_stamp(self) -> None:
        self._log(
            Severity.WARN,
            'Timestamp in header is missing, using current time as command timestamp.',
            throttle=1.0,
        )

    def _refuse(self, stamp: int, now: int) -> None:
        self._log(
            Severity.ERROR,
            f'Received message has timestamp {stamp / NANOSECONDS:.10f} older for '
            f'{(now - stamp) / NANOSECONDS:.10f} which is more then allowed timeout '
            f'({self._timeout / NANOSECONDS:.4f}).',
            throttle=1.0,
        )


def ignore_commands(ports: Iterable[Input[Any]], log: Log) -> None:
    """Drop what has arrived on topics in chained mode, and warn of it."""
    for port in ports:
        if port.drain():
            log(
                Severity.WARN,
                f"Ignoring commands on '{port.port.name}': in chained mode the preceding "
                'controller commands',
                throttle=1.0,
            )
