# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""How many bytes a topic takes."""

from collections import deque
from dataclasses import dataclass

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
            rate=sum(sizes) / (now - start) * 1e9,
            mean=sum(sizes) / len(sizes),
            smallest=min(sizes),
            largest=max(sizes),
            window=len(sizes),
        )
