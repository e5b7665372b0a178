# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
Somebody else's ``/clock`` as what the loop steps and is paced by: ``use_sim_time`` without being
the simulator.
"""

from collections.abc import Callable

from amr_description.nodes.owner import Mailbox


class HeardClock:
    """``Stepper`` and ``Pacer`` of the loop at once; :meth:`hear` is called by the ROS thread."""

    def __init__(self, mailbox: Mailbox) -> None:
        self._mailbox = mailbox
        self._heard: int | None = None
        self._now = 0
        self.on_start: Callable[[], None] = lambda: None
        """The first time was heard: a call for the owner."""
        self.on_step: Callable[[], None] = lambda: None
        """Time went back: a call for the owner, which begins anew."""

    @property
    def time(self) -> int:
        """Simulated time, ns; while it paces, the instant that is waited for."""
        return self._now

    def hear(self, time_heard: int) -> None:
        """Take a message of ``/clock``, ns, and wake the owner."""
        last, self._heard = self._heard, time_heard
        if last is None:
            self._mailbox.put(self.on_start)
        elif time_heard < last:
            self._mailbox.put(self._begin_anew)
        else:
            self._mailbox.wake()

    def resume(self, time_now: int) -> None:
        """Go on from what was heard last."""
        self._now = self._heard or 0

    def advance(self, period: int) -> None:
        """Aim at the instant ``period`` (ns) from now."""
        self._now += period

    def pace(self, time_due: int) -> bool:
        """Wait until ``time_due`` (ns) was heard; False: not yet, but a call may have come."""
        if self._heard is None or self._heard < time_due:
            self._mailbox.wait()
            return False
        self._now = self._heard
        return True

    def _begin_anew(self) -> None:
        """For the owner: what it waited for comes when the old time is reached again."""
        self.resume(0)
        self.on_step()
