# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""How many messages per second come by a topic."""

from collections import deque

from amr_description.clock import NANOSECONDS
from amr_description.ros.polled_topic import NumberedMessage

_WINDOW = 3.0
"""s of wall-clock time over which the rate of a topic is measured."""


class Rate:
    """Messages per second of a topic, those that were not taken, too, as DDS numbers them."""

    def __init__(self) -> None:
        self._marks: deque[tuple[int, int]] = deque()
        """(when it was received, ns; number)."""

    def add(self, message: NumberedMessage, count: int = 1) -> None:
        """Count messages that were taken, of which this is the last."""
        last = self._marks[-1] if self._marks else (0, 0)
        number = last[1] + count if message.number is None else message.number
        if number <= last[1] or message.received < last[0]:  # of another publisher
            self._marks.clear()
        self._marks.append((message.received, number))
        while message.received - self._marks[0][0] > _WINDOW * NANOSECONDS:
            self._marks.popleft()

    @property
    def value(self) -> float | None:
        """Hz; None: not known yet."""
        if len(self._marks) < 2:  # noqa: PLR2004
            return None
        (received_0, number_0), (received_1, number_1) = self._marks[0], self._marks[-1]
        elapsed = received_1 - received_0
        return (number_1 - number_0) * NANOSECONDS / elapsed if elapsed > 0 else None
