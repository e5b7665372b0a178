# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
Time in integer nanoseconds, and what was on its way when it jumped back.

A simulation is reset, or a clock set: messages that were sent before still come in, stamped with
times that are now ahead. Taken for news they would hold up, or outlast, all that comes until their
own time is reached again.
"""

NANOSECONDS = 1_000_000_000
"""In a second."""

_AGE = NANOSECONDS
"""ns: nothing is on its way for longer."""

_EARLY = 100_000_000
"""ns: a message may be here before its time is known here by so much."""


class TimeJumpFilter:
    """Notices that time went back, and which messages are of before; all times in ns."""

    def __init__(self) -> None:
        self._now = self._since = 0
        self._before: int | None = None

    @property
    def is_recent(self) -> bool:
        """Whether something may still be on its way."""
        return self._before is not None

    def observe(self, now: int) -> bool:
        """Take what the clock shows; return whether it went back."""
        went_back = now < self._now
        if went_back:
            self._before, self._since = self._now, now
        elif now > self._since + _AGE:
            self._before = None
        self._now = now
        return went_back

    def is_stale(self, stamp: int) -> bool:
        """Tell whether a message stamped so was sent before time went back."""
        if self._before is None:
            return False
        earliest = max(self._now + _EARLY, self._before - _AGE)
        return earliest < stamp <= self._before + _EARLY
