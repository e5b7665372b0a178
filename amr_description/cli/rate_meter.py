# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""The rate at which messages arrive."""

from collections import deque

from amr_description.cli.spread import Spread

_REPORT_PERIOD = 1_000_000_000  # ns


class Rate(Spread):
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
