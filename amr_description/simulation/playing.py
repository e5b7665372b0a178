# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
Time that passes by the wall clock, until Ctrl-C: to watch a simulation, and to drive it by a page.

What pages ask is done only here: in what else lets time pass, the same calls give the same bits.
"""

from collections.abc import Callable
from dataclasses import dataclass
import time as wall

from amr_description.errors import SimulationError

_PERIOD = 0.02
"""s of the wall clock between two looks at what pages ask."""
HIGHEST_FACTOR = 1000.0


@dataclass
class Playing:
    """How time passes; belongs to the thread of the simulation, others may read it."""

    factor: float = 1.0
    """Simulated seconds per second; 0: as fast as possible."""
    is_on: bool = False
    """Whether :func:`play` runs."""
    is_paused: bool = False

    def set_factor(self, factor: float) -> None:
        """Have time pass faster or slower. Raises SimulationError."""
        if not 0.0 <= factor <= HIGHEST_FACTOR:
            raise SimulationError(
                f'a real-time factor is 0, as fast as possible, to {HIGHEST_FACTOR:g}, '
                f'not {factor:g}'
            )
        self.factor = factor


def play(
    playing: Playing,
    advance: Callable[[int], None],
    timestep: float,
    attend: Callable[[], None],
    seconds: float,
) -> None:
    """
    Let time pass until Ctrl-C, or for some time.

    Args:
        playing: How; pages change it meanwhile.
        advance: Makes physics steps.
        timestep: A physics step, s.
        attend: Does what pages have asked, between two of those; refuses it while nothing plays.
        seconds: Of the wall clock, at most; inf: until Ctrl-C.

    Raises:
        SimulationError: ``seconds`` is not a time, or it plays already.
    """
    if not seconds >= 0.0:
        raise SimulationError(f'{seconds} s are asked; a time not below 0 will do, or none')
    if playing.is_on:
        raise SimulationError('the simulation plays already')
    attend()  # what came too late for the last time does not act now
    begin = due = wall.monotonic()
    playing.is_on, playing.is_paused = True, False
    try:
        while (now := wall.monotonic()) - begin < seconds:
            attend()
            if playing.is_paused:
                due = now + _PERIOD
            else:
                steps = max(1, round(_PERIOD * (playing.factor or 1.0) / timestep))
                advance(steps)
                passed = steps * timestep / playing.factor if playing.factor else 0.0
                due = max(due, now - _PERIOD) + passed  # what was late is not caught up for ever
            wall.sleep(max(0.0, min(due, begin + seconds) - wall.monotonic()))
    except KeyboardInterrupt:
        pass  # it is how this ends
    finally:
        playing.is_on = False
        attend()  # whoever still waits hears that it has ended
