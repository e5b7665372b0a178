# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""When a controller publishes, if less often than it updates."""


class PublishGate:
    """
    Lets the first update through, and then every update that lies beyond the period.

    The comparison is strict and the next instant is counted from the one before, as in
    diff_drive_controller 4.x: at 100 Hz with a period of 20 ms the updates 0, 3, 5, 7, … pass.
    """

    def __init__(self, period: int) -> None:
        """``period``: ns."""
        self._period = period
        self._previous: int | None = None

    def passes(self, time: int) -> bool:
        """Tell whether the update at ``time`` (ns) publishes."""
        if self._previous is None:
            self._previous = time
            return True
        if self._previous + self._period < time:
            self._previous += self._period
            return True
        return False

    def reset(self) -> None:
        """Let the next update through."""
        self._previous = None
