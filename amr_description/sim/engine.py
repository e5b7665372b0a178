# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""The MuJoCo model and its state: built, stepped, and rebuilt when a robot comes or goes."""

import mujoco
import numpy as np

from amr_description.errors import SimulationError
from amr_description.sim.compiling import compiler_warnings
from amr_description.sim.spawning import say_nothing
from amr_description.sim.stepping import LONGEST_STEP

NANOSECONDS = 1_000_000_000
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
        with compiler_warnings(say_nothing, ''):  # told of the world and of each robot by itself
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
