# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
How many bytes a topic takes.

What is said of a window of times: their mean, and how they scatter.

How old messages are when they arrive.

The rate at which messages arrive.
"""

from collections import deque
from collections.abc import Collection
from dataclasses import dataclass
from math import sqrt
from typing import Self

from amr_description.clock import NANOSECONDS

# From how many bytes per second on, the divisor, its decimals and its name. (1 KB is 1000 B.)
_UNITS = ((1e6, 1e6, 2, 'MB'), (1e3, 1e3, 2, 'KB'), (0.0, 1.0, 0, 'B'))


@dataclass(frozen=True)
class Bandwidth:
    """Bytes per second, and the sizes of the messages of the window, in bytes."""

    rate: float
    mean: float
    smallest: int
    largest: int
    window: int

    def __str__(self) -> str:
        """Return the two lines that ``ros2 topic bw`` prints, all in the unit of the rate."""
        _, divisor, decimals, unit = next(row for row in _UNITS if self.rate >= row[0])
        rate, mean, smallest, largest = (
            f'{count / divisor:.{decimals}f} {unit}'
            for count in (self.rate, self.mean, self.smallest, self.largest)
        )
        return (
            f'{rate}/s from {self.window} messages\n'
            f'\tMessage size mean: {mean} min: {smallest} max: {largest}'
        )


class BandwidthMeter:
    """Takes the sizes, bytes, of messages and the times, ns, at which they arrived."""

    def __init__(self, window: int) -> None:
        """Keep the last ``window`` messages."""
        self._messages: deque[tuple[int, int]] = deque(maxlen=window)

    def add(self, now: int, size: int) -> None:
        """Take a message, in its serialized form."""
        self._messages.append((now, size))

    def report(self, now: int) -> Bandwidth | None:
        """
        Return what came from the first message of the window until now; None if less than two did.

        Time that went back starts all over.
        """
        if len(self._messages) < 2:
            return None
        start = self._messages[0][0]
        if now <= start:
            self._messages.clear()
            return None
        sizes = [size for _, size in self._messages]
        return Bandwidth(
            rate=sum(sizes) / (now - start) * NANOSECONDS,
            mean=sum(sizes) / len(sizes),
            smallest=min(sizes),
            largest=max(sizes),
            window=len(sizes),
        )


@dataclass(frozen=True)
class WindowStatistics:
    """
    Times of a window, s.

    ``deviation`` = sqrt(mean((time - mean)²)), that of the whole window and not an estimate from
    a sample.
    """

    mean: float
    shortest: float
    longest: float
    deviation: float
    window: int

    @classmethod
    def of(cls, times: Collection[int]) -> Self:
        """Describe times, ns, of which there is at least one."""
        mean = sum(times) / len(times)
        variance = sum((time - mean) ** 2 for time in times) / len(times)
        return cls(
            mean=mean / NANOSECONDS,
            shortest=min(times) / NANOSECONDS,
            longest=max(times) / NANOSECONDS,
            deviation=sqrt(variance) / NANOSECONDS,
            window=len(times),
        )

    def __str__(self) -> str:
        """Return the second line of what ``ros2 topic hz`` and ``delay`` print."""
        return (
            f'\tmin: {self.shortest:.3f}s max: {self.longest:.3f}s '
            f'std dev: {self.deviation:.5f}s window: {self.window}'
        )


class Delay(WindowStatistics):
    """The ages of the messages of a window, s."""

    def __str__(self) -> str:
        """Return the two lines that ``ros2 topic delay`` prints."""
        return f'average delay: {self.mean:.3f}\n{super().__str__()}'


class DelayMeter:
    """Takes the times, ns, at which messages were stamped and arrived."""

    def __init__(self, window: int) -> None:
        """Keep the last ``window`` delays."""
        self._delays: deque[int] = deque(maxlen=window)
        self._last = 0
        self._news = False

    def add(self, now: int, stamp: int) -> bool:
        """
        Take a message; return False if time went back, which starts all over.

        Simulation time that has not begun is 0, and nothing can be said of it.
        """
        went_back = now < self._last
        if went_back:
            self._delays.clear()
            self._news = False
        self._last = now
        if now > 0:
            self._delays.append(now - stamp)
            self._news = True
        return not went_back

    @property
    def started(self) -> bool:
        """Whether there is a delay to report, be it old or new."""
        return bool(self._delays)

    def report(self) -> Delay | None:
        """Return the delays if messages came since the last report, else None."""
        if not self._news:
            return None
        self._news = False
        return Delay.of(self._delays)


_REPORT_PERIOD = NANOSECONDS


class Rate(WindowStatistics):
    """The intervals between the messages of a window, s."""

    @property
    def rate(self) -> float:
        """1 / mean, Hz."""
        return 1.0 / self.mean if self.mean > 0.0 else 0.0

    def __str__(self) -> str:
        """Return the two lines that ``ros2 topic hz`` prints."""
        return f'average rate: {self.rate:.3f}\n{super().__str__()}'


class RateMeter:
    """Takes the times of messages, ns, and knows when a report is due."""

    def __init__(self, window: int) -> None:
        """Keep the last ``window`` intervals."""
        self._intervals: deque[int] = deque(maxlen=window)
        self._last: int | None = None
        self._reported: int | None = None

    def add(self, now: int) -> bool:
        """Take the time of a message; return False if time went back, which starts all over."""
        if self._last is not None and now < self._last:
            self.__init__(self._intervals.maxlen or 0)
            self._last = now
            return False
        if self._last is not None:
            self._intervals.append(now - self._last)
        self._last = now
        return True

    def report(self) -> Rate | None:
        """Return the rate if messages came for a second since the last report, else None."""
        if self._last is None or not self._intervals:
            return None
        if self._reported is None:
            self._reported = self._last
        if self._last < self._reported + _REPORT_PERIOD:
            return None
        self._reported = self._last
        return Rate.of(self._intervals)
