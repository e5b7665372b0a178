# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
The MuJoCo model and its state: built, stepped, and rebuilt when a robot comes or goes.

What MuJoCo's compiler says, as lines of a log.

The choice of the physics step: the largest divisor of the control period not above 2 ms.

Everything is an integer number of nanoseconds, so that the simulated time of a tick is exact
after any number of steps.
"""

from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass
import warnings

import mujoco
import numpy as np

from amr_description.clock import NANOSECONDS
from amr_description.control.contracts import Log, null_log, Severity
from amr_description.errors import SimulationError
from amr_description.text import unwrap


def one_line(text: str) -> str:
    """MuJoCo's message without its line breaks and its leading ``Error:``."""
    return unwrap(text).removeprefix('Error: ')


@contextmanager
def compiler_warnings(log: Log, source: str) -> Iterator[None]:
    """Tell ``log`` in one line each what is warned of meanwhile; ``source``: of what."""
    with warnings.catch_warnings(record=True) as caught:
        warnings.simplefilter('always', UserWarning)
        yield
    for line in dict.fromkeys(one_line(str(warning.message)) for warning in caught):
        log(Severity.WARN, f'{source}: MuJoCo: {line}')


LONGEST_STEP = 2_000_000
"""ns; the contact settings of :mod:`amr_description.sim.wheel_contact` are tuned for it."""


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


_INTEGRATION = mujoco.mjtState.mjSTATE_INTEGRATION


class Engine:
    """
    One ``mjModel`` and one ``mjData``, with the spec they come from.

    Whoever keeps views into ``data`` compares ``generation`` and binds them anew when it changed:
    a recompile makes a new model and new data.
    """

    def __init__(self, spec: mujoco.MjSpec, timestep: int = LONGEST_STEP) -> None:
        """Compile ``spec``; ``timestep``: physics step, ns. Raises MuJoCo's ValueError."""
        self.spec = spec
        self.generation = 0
        self._timestep = timestep
        self._steps = 0
        self._time_at_step_0 = 0
        self._truth_at: tuple[int, int] | None = None
        spec.option.timestep = timestep / NANOSECONDS
        self.model: mujoco.MjModel = spec.compile()
        self.data = mujoco.MjData(self.model)

    @property
    def time(self) -> int:
        """Simulated time, ns: a count of steps, never a sum of floats."""
        return self._time_at_step_0 + self._steps * self._timestep

    @time.setter
    def time(self, time: int) -> None:
        self._time_at_step_0, self._steps = time, 0
        self.data.time = time / NANOSECONDS
        self.forget_truth()

    @property
    def timestep(self) -> int:
        """The physics step, ns; time goes on from where it is when it is set."""
        return self._timestep

    @timestep.setter
    def timestep(self, timestep: int) -> None:
        if timestep <= 0:
            raise SimulationError(f'a physics step of {timestep} ns is asked; it must be positive')
        self._time_at_step_0, self._steps = self.time, 0
        self._timestep = timestep
        self.forget_truth()
        seconds = timestep / NANOSECONDS
        self.spec.option.timestep = self.model.opt.timestep = seconds

    def state(self) -> bytes:
        """All that the next step follows from, and the time: equal bytes, equal futures."""
        state = np.empty(mujoco.mj_stateSize(self.model, _INTEGRATION))
        mujoco.mj_getState(self.model, self.data, state, _INTEGRATION)
        return self.time.to_bytes(8) + state.tobytes()

    def step(self, count: int) -> None:
        """Advance by ``count`` physics steps, in one call into C."""
        mujoco.mj_step(self.model, self.data, count)
        self._steps += count

    def recompile(self) -> None:
        """Follow the edits of ``spec``, keeping state and time. Raises ValueError, unchanged."""
        with compiler_warnings(null_log, ''):  # told of the world and of each robot by itself
            self.model, self.data = self.spec.recompile(self.model, self.data)
        self.generation += 1

    def reset(self) -> None:
        """Time 0, everything where the model has it, commands zero."""
        mujoco.mj_resetData(self.model, self.data)
        self._time_at_step_0 = self._steps = 0
        self._truth_at = None

    def forget_truth(self) -> None:
        """The state was changed otherwise than by a step."""
        self._truth_at = None

    def refresh_truth(self) -> None:
        """
        Bring body poses and velocities up to the present state.

        After ``mj_step`` they lag one step behind ``qpos``. This recomputes nothing that a step
        starts from, so looking does not change what follows.
        """
        now = (self.generation, self._steps)
        if self._truth_at == now:
            return
        mujoco.mj_kinematics(self.model, self.data)
        mujoco.mj_comPos(self.model, self.data)
        mujoco.mj_comVel(self.model, self.data)
        self._truth_at = now
