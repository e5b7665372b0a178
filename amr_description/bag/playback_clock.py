# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""The time of a recording while it is played: slower or faster, held, set anew."""

from collections.abc import Callable
import math

_LONGEST = 2.0**62  # ns; at the fastest and slowest rates floats reach infinity


class PlaybackClock:
    """
    Recorded time, in ns, that goes on with a steady clock.

    No error accumulates: between two changes each time is computed from the last one of these.
    """

    def __init__(
        self, time: int, steady: Callable[[], int], *, rate: float = 1.0, paused: bool = False
    ) -> None:
        """
        Begin at a time.

        Args:
            time: of the recording, ns.
            steady: returns the time of a clock that nobody sets, ns.
            rate: how many times faster than recorded; above 0.
            paused: whether time stands at first.
        """
        self._steady = steady
        self._time = time
        self._since = steady()
        self._rate = rate
        self._paused = paused

    @property
    def rate(self) -> float:
        """How many times faster than recorded it is played."""
        return self._rate

    @property
    def paused(self) -> bool:
        """Whether time stands."""
        return self._paused

    def now(self) -> int:
        """Return the time of the recording, ns."""
        if self._paused:
            return self._time
        return self._time + int(min((self._steady() - self._since) * self._rate, _LONGEST))

    def until(self, time: int) -> int:
        """Return how long it takes until then, ns of the steady clock; not while it stands."""
        wait = min((time - self._time) / self._rate, _LONGEST)
        return self._since + math.ceil(wait) - self._steady()

    def set_rate(self, rate: float) -> bool:
        """Go on faster or slower; return False, and change nothing, if not above 0."""
        if not 0.0 < rate < math.inf:
            return False
        self.jump(self.now())
        self._rate = rate
        return True

    def pause(self) -> None:
        """Let time stand."""
        self.jump(self.now())
        self._paused = True

    def resume(self) -> None:
        """Let time go on."""
        self.jump(self.now())
        self._paused = False

    def jump(self, time: int) -> None:
        """Go on from another time, ns."""
        self._time = time
        self._since = self._steady()
