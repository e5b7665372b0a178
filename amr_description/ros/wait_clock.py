# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""The time that a program has really waited for others."""

from collections.abc import Callable
import time


class WaitClock:
    """
    ``time.monotonic()`` without the time in which this process wanted to run and could not.

    On a busy machine, or after Ctrl-Z, that is time in which it has not looked for what it waits
    for, which may have come long ago.
    """

    def __init__(self) -> None:
        self._lost = 0.0  # s

    def now(self) -> float:
        """Return the time, s."""
        return time.monotonic() - self._lost

    def wait(self, timeout: float, wait: Callable[[float], object]) -> None:
        """Call ``wait(timeout)``, s; beyond the timeout only the processor time of it counts."""
        began, worked = time.monotonic(), time.thread_time()
        wait(timeout)
        took = time.monotonic() - began
        self._lost += max(0.0, took - timeout - (time.thread_time() - worked))
