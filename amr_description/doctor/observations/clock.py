# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
Time: ``/clock``, what drives it, and the stamps of messages.

All times are integer ns: ``time`` and ``stamp`` as in messages, ``received`` of the system clock
of the machine that listens.
"""

from dataclasses import dataclass
from itertools import pairwise

from amr_description.clock import NANOSECONDS

_FEWEST_TICKS = 3
_SHORTEST_SPAN = NANOSECONDS // 4
"""ns of the system clock over which a factor is taken."""


@dataclass(frozen=True, slots=True)
class ClockTick:
    """A message on ``/clock``."""

    time: int
    received: int


@dataclass(frozen=True, slots=True, kw_only=True)
class TimeSource:
    """A node that can hold time and let it go on."""

    node: str
    resume: str
    """The command that lets it go on."""
    asked_factor: float | None = None
    """Its real-time factor as it was asked for; 0: as fast as possible; None: not known."""
    speed_parameter: str = ''
    """The name of the parameter that has it; empty: none has."""
    report: str = ''
    """What it logged last of a factor that is not kept: the stage that takes the time."""


@dataclass(frozen=True, slots=True, kw_only=True)
class StampSeen:
    """The latest message on a topic, and the present when it was received."""

    topic: str
    publishers: tuple[str, ...]
    stamp: int
    received: int
    time: int | None = None
    """Of ``/clock`` at reception; None: nobody publishes it, or nothing came yet."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Clock:
    """What was received of time."""

    publishers: tuple[str, ...] = ()
    """Each once for each publisher of ``/clock``."""
    ticks: tuple[ClockTick, ...] = ()
    """In the order of reception."""
    seconds: float = 0.0
    """How long was listened since the subscription was known to its publisher, s."""
    sources: tuple[TimeSource, ...] = ()
    stamps: tuple[StampSeen, ...] = ()

    @property
    def is_standing(self) -> bool:
        """Whether messages come, and say the same time."""
        return len(self.ticks) >= _FEWEST_TICKS and len({tick.time for tick in self.ticks}) == 1

    @property
    def factor(self) -> float | None:
        """
        The measured real-time factor.

        None: too little was received, or time stood or went back meanwhile.
        """
        times = [tick.time for tick in self.ticks]
        if len(times) < _FEWEST_TICKS or any(later <= time for time, later in pairwise(times)):
            return None
        first, last = self.ticks[0], self.ticks[-1]
        wall = last.received - first.received
        return None if wall < _SHORTEST_SPAN else (last.time - first.time) / wall
