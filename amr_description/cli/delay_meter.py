# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""How old messages are when they arrive."""

from collections import deque

from amr_description.cli.spread import Spread


class Delay(Spread):
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
