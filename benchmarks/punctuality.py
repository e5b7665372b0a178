# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""How late commands and cycles are, from the instants of both. Pure."""

from collections.abc import Mapping, Sequence
import math
from typing import NamedTuple

from amr_description.clock import NANOSECONDS

_RADIUS = 0.1
"""m, of the wheels of ``config/controllers.yaml``."""
_STEP = 1e-4
"""m/s between two commands, to tell them apart."""
_SLOWEST = 0.1
"""m/s."""
_BASELINE = 200
"""Cycles at each end of a run: the earliest of them is on time."""
_MILLISECOND = NANOSECONDS // 1000


class Tick(NamedTuple):
    """The end of a cycle."""

    wall: int
    """Monotonic clock, ns."""
    simulated: int
    """ns."""
    command: float
    """Of a wheel, rad/s."""


class Punctuality(NamedTuple):
    """Of the cycles of a run in real time."""

    missed: int
    """Cycles that the wall clock has had time for and that were not run."""
    late: float
    """99th percentile of the lateness, ms."""


def percentile(values: Sequence[float], share: float) -> float:
    """Return the smallest value that ``share`` of the values do not exceed."""
    return sorted(values)[max(0, math.ceil(share * len(values)) - 1)]


def speed_of(number: int) -> float:
    """Return the speed of a command (m/s), of which each number has another one."""
    return _SLOWEST + number * _STEP


def latencies(sent: Mapping[int, int], ticks: Sequence[Tick]) -> list[float]:
    """
    Return the time from each command to the first cycle with it, or with a later one, ms.

    Args:
        sent: Monotonic clock (ns) at each command, by its number.
        ticks: In order.
    """
    reached: dict[int, int] = {}
    pending = sorted(sent)
    for tick in ticks:
        if math.isnan(tick.command):
            continue  # before the first command
        number = round((tick.command * _RADIUS - _SLOWEST) / _STEP)
        while pending and pending[0] <= number:
            reached[pending.pop(0)] = tick.wall
    return [(wall - sent[number]) / _MILLISECOND for number, wall in reached.items()]


def punctuality(ticks: Sequence[Tick], period: int) -> Punctuality:
    """
    Return how the cycles of a run in real time were kept; ``period``: ns.

    A cycle's delay is that of its wall time behind its simulated time. The smallest one of the
    first cycles is the schedule. A loop that gives up what it has missed goes on with a greater
    delay: what the last cycles have is lost for good.
    """
    delays = [tick.wall - tick.simulated for tick in ticks]
    first, last = min(delays[:_BASELINE]), min(delays[-_BASELINE:])
    skipped = sum(
        max(0, round((after.simulated - before.simulated) / period) - 1)
        for before, after in zip(ticks, ticks[1:], strict=False)
    )
    lost = max(0, round((last - first) / period))
    late = percentile([delay - min(first, last) for delay in delays], 0.99)
    return Punctuality(skipped + lost, late / _MILLISECOND)
