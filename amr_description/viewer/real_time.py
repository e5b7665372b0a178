# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""How fast simulated time goes, measured by what comes on /clock. Pure: the caller has a clock."""

from collections import deque

from amr_description.clock import NANOSECONDS

WINDOW = 1.0
"""s of wall-clock time over which the real-time factor is measured."""
_ENOUGH = 0.9 * WINDOW
"""s, less is no measurement: a start and a step would look like a simulation that is too slow."""
STALE = 0.5
"""s without any message, after which nothing is known."""
_STANDSTILL = 0.2
"""s without a later time that are a pause."""


class RealTimeFactor:
    """The real-time factor over the last second, of time that goes on."""

    def __init__(self) -> None:
        self._samples: deque[tuple[float, int]] = deque()
        """(wall-clock time, s; simulation time, ns)."""

    def clear(self) -> None:
        """Begin anew: time has jumped back."""
        self._samples.clear()

    def take(self, wall: float, latest: int) -> None:
        """Hear of the time ``latest`` (ns) at ``wall`` (s)."""
        if self._samples and wall - self._samples[-1][0] > STALE:
            self._samples.clear()  # time stood still, which says nothing of how fast it goes now
        if self._samples and latest <= self._samples[-1][1]:
            if len(self._samples) > 1 and wall - self._samples[-1][0] <= _STANDSTILL:
                return
            self._samples.clear()  # a pause is not slow: what was before it does not count
        self._samples.append((wall, latest))
        while wall - self._samples[0][0] > WINDOW and len(self._samples) > 2:  # noqa: PLR2004
            self._samples.popleft()

    @property
    def value(self) -> float | None:
        """Simulated seconds per second of wall-clock time; None: not known yet."""
        if not self._samples:
            return None
        (wall_0, time_0), (wall_1, time_1) = self._samples[0], self._samples[-1]
        elapsed = wall_1 - wall_0
        return (time_1 - time_0) / NANOSECONDS / elapsed if elapsed >= _ENOUGH else None
