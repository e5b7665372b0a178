# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
When a simulated sensor measures, and the random numbers of its noise.

Both follow from simulated time alone: a sensor without subscribers for a while, and a second run,
measure at the same instants, and with the same noise; a reset begins both anew.
"""

from collections.abc import Sequence

import numpy as np

from amr_description.clock import instants_until


class SensorSchedule:
    """Says in which control cycles a sensor measures: the first at or after k / rate, k ≥ 0."""

    def __init__(self, rate: float, time: int) -> None:
        """
        Begin at the next instant that is due.

        Args:
            rate: Hz of simulated time; 0: in every cycle.
            time: The present simulated time, ns.
        """
        self._rate = rate
        self._latest = time
        self._count = instants_until(time, rate)

    def restart(self) -> None:
        """Have time 0 be due, which time goes back to; even if no instant behind it was asked."""
        self._latest = self._count = -1

    def is_due(self, time: int) -> bool:
        """Whether to measure at ``time``, ns; to be asked once in every cycle, in order."""
        latest, self._latest = self._latest, time
        if time == latest:  # time stands still
            return False
        if self._rate <= 0.0:
            return True
        before, self._count = self._count, instants_until(time, self._rate)
        return time < latest or self._count != before


class CycleBudget:
    """How much sensors may measure on the control thread in one cycle, in any unit."""

    def __init__(self, most: int) -> None:
        """``most``: in a cycle, of all sensors together."""
        self._most = self._left = most
        self._time: int | None = None

    def take(self, time: int, amount: int) -> bool:
        """Whether ``amount`` is left in the cycle at ``time``, ns; it is taken then."""
        if time != self._time:
            self._time, self._left = time, self._most
        if amount > self._left:
            return False
        self._left -= amount
        return True


def noise_generator(seed: Sequence[int], sensor: str, time: int) -> np.random.Generator:
    """
    Return the random numbers of one measurement.

    Args:
        seed: Of the robot: numbers ≥ 0.
        sensor: The name of the sensor.
        time: Of the measurement, ns; for what is drawn only once, such as a bias, a negative one.
    """
    words = np.random.SeedSequence((*seed, *sensor.encode())).generate_state(2, np.uint64)
    counter = np.array([0, 0, 0, time % 2**64], np.uint64)
    return np.random.Generator(np.random.Philox(key=words, counter=counter))
