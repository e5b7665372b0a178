# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
The choice of the physics step: the largest divisor of the control period not above 2 ms.

Everything is an integer number of nanoseconds, so that the simulated time of a tick is exact
after any number of steps.
"""

from dataclasses import dataclass

from amr_description.errors import SimulationError

LONGEST_STEP = 2_000_000
"""ns; the contact settings of :mod:`amr_description.sim.contact` are tuned for it."""


@dataclass(frozen=True, slots=True)
class Stepping:
    """``count`` physics steps of ``step`` ns make one control period."""

    step: int
    count: int

    @property
    def period(self) -> int:
        """The control period that results, ns."""
        return self.step * self.count


def physics_stepping(control_period: int, longest: int = LONGEST_STEP) -> Stepping:
    """
    Divide a control period (ns) into equal physics steps, as few as ``longest`` (ns) allows.

    A period without a divisor between ``longest / 2`` and ``longest`` (150 Hz gives 6666667 ns) is
    rounded to the next multiple of a whole step: the result's ``period`` then differs from what
    was asked by less than its ``count`` in ns, which the caller reports. Raises SimulationError
    if the period is not positive.
    """
    if control_period <= 0:
        raise SimulationError(
            f'a control period of {control_period} ns is asked; it must be positive'
        )
    fewest = -(-control_period // longest)
    for count in range(fewest, 2 * fewest):
        if control_period % count == 0:
            return Stepping(control_period // count, count)
    return Stepping(round(control_period / fewest), fewest)


def steps_in(control_period: int, step: int) -> Stepping:
    """
    Fit a control period (ns) to a physics step (ns) that is given: the next whole number of
    steps, at least one.
    """
    return Stepping(step, max(1, round(control_period / step)))
