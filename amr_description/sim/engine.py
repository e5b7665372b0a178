# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
The MuJoCo model and its state: compiled, stepped, and recompiled when a robot comes or goes.

Times are integer nanoseconds: simulated time is a count of physics steps and exact after any
number of them. The physics step is the longest divisor of the control period that is not above
:data:`LONGEST_STEP`, see :func:`physics_stepping`.
"""

from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from hashlib import blake2b
import warnings

import mujoco
import numpy as np

from amr_description.clock import NANOSECONDS
from amr_description.errors import SimulationError
from amr_description.log import Log, null_log, Severity
from amr_description.sim.fleet_solver import FleetSolver
from amr_description.sim.rollers import RollerContacts
from amr_description.text import unwrap

_INTEGRATION = mujoco.mjtState.mjSTATE_INTEGRATION

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
    Divide a control period into equal physics steps, as few as ``longest`` allows.

    A period without a divisor between ``longest / 2`` and ``longest`` (150 Hz gives 6666667 ns) is
    rounded to the nearest multiple of a whole step. The ``period`` of the result then differs from
    the requested one by less than ``count`` ns; the caller reports it.

    Args:
        control_period: ns.
        longest: The longest physics step, ns.

    Raises:
        SimulationError: The period is not positive.
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
    """Round a control period (ns) to a whole number of physics steps (ns), at least one."""
    return Stepping(step, max(1, round(control_period / step)))


class Engine:
    """
    One ``mjModel`` and one ``mjData``, with the spec they come from.

    A recompile makes a new model and new data and increments ``generation``: code that keeps views
    into ``data`` compares it and makes its views anew when it has changed.
    """

    def __init__(self, spec: mujoco.MjSpec, timestep: int = LONGEST_STEP) -> None:
        """Compile ``spec``; ``timestep``: physics step, ns. Raises MuJoCo's ValueError."""
        self.spec = spec
        self.generation = 0
        self._timestep = timestep
        self._time = 0
        self._kinematics_at: tuple[int, int] | None = None
        spec.option.timestep = timestep / NANOSECONDS
        self.rollers = RollerContacts()
        """The wheels with rollers; an edit counts from the next recompile on."""
        self._solver = FleetSolver(self.rollers)
        self.model: mujoco.MjModel = spec.compile()
        self.data = mujoco.MjData(self.model)
        self._bind()

    @property
    def time(self) -> int:
        """Simulated time, ns: of whole steps, never a sum of floats."""
        return self._time

    @time.setter
    def time(self, time: int) -> None:
        self._time = time
        self.data.time = time / NANOSECONDS
        self.invalidate_kinematics()

    @property
    def timestep(self) -> int:
        """The physics step, ns; time goes on from where it is when it is set."""
        return self._timestep

    @timestep.setter
    def timestep(self, timestep: int) -> None:
        if timestep <= 0:
            raise SimulationError(f'a physics step of {timestep} ns is asked; it must be positive')
        self._timestep = timestep
        self.invalidate_kinematics()
        seconds = timestep / NANOSECONDS
        self.spec.option.timestep = self.model.opt.timestep = seconds

    def state(self) -> bytes:
        """Return everything the next step depends on, and the time: equal bytes, equal futures."""
        state = np.empty(mujoco.mj_stateSize(self.model, _INTEGRATION))
        mujoco.mj_getState(self.model, self.data, state, _INTEGRATION)
        return self.time.to_bytes(8) + self._solver.state() + state.tobytes()

    def constants(self) -> bytes:
        """Return a digest of the whole model: what :meth:`state` does not have."""
        buffer = np.empty(mujoco.mj_sizeModel(self.model), np.uint8)
        mujoco.mj_saveModel(self.model, None, buffer)
        return blake2b(buffer, digest_size=16).digest()

    def step(self, count: int) -> None:
        """Advance by ``count`` physics steps, in one call into C if nothing is done between."""
        if self._is_plain:
            mujoco.mj_step(self.model, self.data, count)
        elif self._solver:
            self._solver.step(self.model, self.data, count)
        else:
            self.rollers.step(self.model, self.data, count)
        self._time += count * self._timestep

    def _bind(self) -> None:
        """Take the present model, which was compiled anew."""
        self.rollers.bind(self.model)
        self._solver.bind(self.model)
        self._is_plain = not (self._solver or self.rollers)
        """Whether nothing is done between two steps."""

    def load(self, spec: mujoco.MjSpec, timestep: int) -> None:
        """
        Begin anew with another spec, at time 0.

        Raises MuJoCo's ValueError; nothing has changed then.
        """
        spec.option.timestep = timestep / NANOSECONDS
        model = spec.compile()
        self.spec, self.model, self.data = spec, model, mujoco.MjData(model)
        self._timestep, self._time = timestep, 0
        self._kinematics_at = None
        self._bind()
        self.generation += 1

    def recompile(self) -> None:
        """
        Apply the edits of ``spec``; state and time are kept.

        Raises MuJoCo's ValueError; nothing has changed then.
        """
        # The warnings were logged when the world and each robot were compiled by themselves.
        with compiler_warnings(null_log, ''):
            self.model, self.data = self.spec.recompile(self.model, self.data)
        self._bind()
        self.generation += 1

    def reset(self) -> None:
        """Set the time to 0, the state to that of the model, all commands to zero."""
        mujoco.mj_resetData(self.model, self.data)
        self._solver.begin(self.model)
        self._time = 0
        self._kinematics_at = None

    def invalidate_kinematics(self) -> None:
        """Note that the state was changed other than by a step: body poses are outdated."""
        self._kinematics_at = None

    def refresh_kinematics(self) -> None:
        """
        Bring body poses and velocities up to the present state.

        After ``mj_step`` they lag one step behind ``qpos``. Nothing that the next step starts from
        is recomputed, so that reading the world does not change its future.
        """
        now = (self.generation, self._time)
        if self._kinematics_at == now:
            return
        mujoco.mj_kinematics(self.model, self.data)
        mujoco.mj_comPos(self.model, self.data)
        mujoco.mj_comVel(self.model, self.data)
        self._kinematics_at = now


def compiler_message(text: str) -> str:
    """Return a message of MuJoCo without its line breaks and its leading ``Error:``."""
    return unwrap(text).removeprefix('Error: ')


@contextmanager
def compiler_warnings(log: Log, source: str) -> Iterator[None]:
    """
    Log what MuJoCo's compiler warns of while inside, each warning once and in one line.

    Args:
        log: Gets the warnings.
        source: What is compiled; begins each line.
    """
    with warnings.catch_warnings(record=True) as caught:
        warnings.simplefilter('always', UserWarning)
        yield
    for line in dict.fromkeys(compiler_message(str(warning.message)) for warning in caught):
        log(Severity.WARN, f'{source}: MuJoCo: {line}')
