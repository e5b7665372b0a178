# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
Time in integer nanoseconds, and stale messages after it jumped back.

When a simulation is reset or a clock is set back, messages that were sent before still arrive,
with stamps that are now in the future. Taken as new, they would win over all that follow until
their own time is reached again.
"""

import math

NANOSECONDS = 1_000_000_000
"""The nanoseconds of a second."""

_ROUNDING = 1e-6  # of a period

_LONGEST_DELAY = NANOSECONDS  # of a message between its publisher and here
_LARGEST_LEAD = NANOSECONDS // 10  # of a stamp over the clock here, which may lag behind


def instants_until(time: int, rate: float) -> int:
    """
    Return how many of the instants k / rate, k ≥ 1, are not after a time.

    Of 15 Hz the third is at 0.2 s: no error of rounding puts it after that.

    Args:
        time: ns.
        rate: Hz.
    """
    return math.floor(time / NANOSECONDS * rate + _ROUNDING)


class TimeJumpFilter:
    """Detects that time jumped back, and which messages were sent before; all times in ns."""

    def __init__(self) -> None:
        self._now = self._since = 0
        self._before: int | None = None

    @property
    def is_recent(self) -> bool:
        """Whether messages of before the last jump may still arrive."""
        return self._before is not None

    def observe(self, now: int) -> bool:
        """Take the time of the clock; return whether it went back."""
        went_back = now < self._now
        if went_back:
            self._before, self._since = self._now, now
        elif now > self._since + _LONGEST_DELAY:
            self._before = None
        self._now = now
        return went_back

    def is_stale(self, stamp: int) -> bool:
        """Return whether a message with this stamp was sent before time went back."""
        if self._before is None:
            return False
        earliest = max(self._now + _LARGEST_LEAD, self._before - _LONGEST_DELAY)
        return earliest < stamp <= self._before + _LARGEST_LEAD
