# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
What goes wrong in the physics: one line for each, with robot, joint, value, cause and remedy.

MuJoCo hands its warnings to one function of the process; without it a MUJOCO_LOG.TXT would appear
in the user's folder. A step without a fault costs a look at an empty queue and at two numbers.
Nothing is mended: what is lost stays lost until a reset that somebody asks for.

Nor is it contained: a value that is not finite in one robot is in all of them after the same step,
as MuJoCo's solver weighs its start for the whole world at once. What is told is the robot where it
began. To keep the others going, every step would have to be made again without that robot, from
a state saved before.
"""

from collections import deque
from collections.abc import Callable, Iterable
import math
import re

import mujoco
import numpy as np

from amr_description.control.contracts import Log, Severity
from amr_description.sim.compiling import one_line
from amr_description.sim.engine import Engine, NANOSECONDS
from amr_description.sim.fault_causes import (
    dof_of_position,
    has_ground,
    likely_cause,
    place_of_actuator,
    place_of_dof,
    robots_of_dofs,
)

FALL_HEIGHT = -0.1
"""m; the root of a robot below this height, with nothing under it, has left the ground."""

HIGHEST_SPEED = 2000.0
"""m/s or rad/s; no part of a robot is so fast, a rotor of a drone included."""

CAPPED_LOOKS = 5
"""Looks in a row that find the solver at its cap until it is told: one is nothing."""

LOOK_INTERVAL = 100_000_000
"""ns of simulated time between two looks at what is not looked at after each step."""

QUIET = 5 * NANOSECONDS
"""ns of simulated time without a fault until it counts as a new one, and is told again."""

_warnings: deque[str] = deque(maxlen=1000)

_BAD_VALUE = re.compile(r'value in (QPOS|QVEL|QACC|CTRL) at \w+ (\d+)')
_QUANTITY = {'QPOS': 'position', 'QVEL': 'velocity', 'QACC': 'acceleration', 'CTRL': 'command'}


def listen_to_mujoco() -> None:
    """Have MuJoCo's warnings collected, of all worlds in this process."""
    mujoco.set_mju_user_warning(_warnings.append)


class FaultMonitor:
    """Watches an engine after its steps and tells what it sees to a log."""

    def __init__(self, engine: Engine, log: Log) -> None:
        self.on_fault: Callable[[], None] = lambda: None
        """Called after a line was told."""
        self._engine = engine
        self._log = log
        self.reset()

    def reset(self) -> None:
        """Forget what was told: time and robots are set back."""
        _warnings.clear()
        self._state_is_lost = False
        self._last_seen: dict[str, int] = {}
        self._capped = 0
        self._next_look = 0

    def check(self, roots: Iterable[tuple[str, int]]) -> None:
        """
        Look after a step; ``roots``: name of each floating robot and the index of its root's
        height in ``qpos``.
        """
        while _warnings:
            self._tell_warning(_warnings.popleft())
        if not self._state_is_lost:
            self._check_speeds()
            self._check_solver()
        if self._engine.time >= self._next_look:
            self._next_look = self._engine.time + LOOK_INTERVAL
            self._look(roots)

    def _look(self, roots: Iterable[tuple[str, int]]) -> None:
        data = self._engine.data
        data.warning.number[:] = 0  # else MuJoCo says each of them once in its life
        if self._state_is_lost:
            # It may have gone with the robot that was taken out of the world.
            if np.isfinite(data.qpos).all() and data.qvel.dot(data.qvel) < HIGHEST_SPEED**2:
                self.reset()
            return
        for name, index in roots:
            height = float(data.qpos[index])
            if height < FALL_HEIGHT and not has_ground(
                self._engine.model, data, data.qpos[index - 2 : index + 1]
            ):
                self._tell_fall(name, height)

    # --- what MuJoCo says ---------------------------------------------------------------------

    def _tell_warning(self, text: str) -> None:
        if self._state_is_lost:
            return  # The first bad value is the cause; what follows from it is not told.
        bad = _BAD_VALUE.search(text)
        if bad is None:
            self._tell(Severity.WARN, f'mujoco {text[:20]}', f'MuJoCo: {one_line(text)}')
        elif bad[1] == 'CTRL':
            where = place_of_actuator(self._engine.model, int(bad[2]))
            value = float(self._engine.data.ctrl[int(bad[2])])
            self._tell(
                Severity.ERROR,
                f'command {where}',
                f'{where}: the command is {value:g}{self._when}; MuJoCo takes all commands of the '
                'world as 0 then. Command finite values',
            )
        else:
            self._tell_loss(bad[1], int(bad[2]))

    def _tell_loss(self, quantity: str, index: int) -> None:
        self._state_is_lost = True
        model, data = self._engine.model, self._engine.data
        dof = dof_of_position(model, index) if quantity == 'QPOS' else index
        where = place_of_dof(model, dof)
        value = float(getattr(data, quantity.lower())[index])
        self._tell(
            Severity.ERROR,
            f'lost {where}',
            f'{where}: the {_QUANTITY[quantity]} is not finite, or huge, '
            f'({value:g}){self._when}; the state is lost until a reset. Likely: '
            f'{likely_cause(model, data, dof)}',
        )

    # --- what is seen in the state ------------------------------------------------------------

    def _check_speeds(self) -> None:
        speeds = self._engine.data.qvel
        # One product instead of a maximum; a NaN passes, and the next step's warning names it.
        if not speeds.dot(speeds) >= HIGHEST_SPEED**2:
            return
        dof = int(np.abs(speeds).argmax())
        speed = float(speeds[dof])
        if abs(speed) < HIGHEST_SPEED:
            return
        model = self._engine.model
        where = place_of_dof(model, dof)
        self._tell(
            Severity.ERROR,
            f'speed {where}',
            f'{where}: the velocity is {speed:.4g} {where.unit}{self._when}: the physics explodes '
            f'there. Likely: {likely_cause(model, self._engine.data, dof, speed)}',
        )

    def _check_solver(self) -> None:
        data = self._engine.data
        cap = self._engine.model.opt.iterations
        counts = data.solver_niter[: max(1, data.nisland)].tolist()
        if max(counts) < cap:
            self._capped = 0
            return
        self._capped += 1
        if self._capped < CAPPED_LOOKS:
            return
        dofs = range(self._engine.model.nv)
        if data.nisland:
            islands = data.dof_island.tolist()
            dofs = [dof for dof in dofs if islands[dof] >= 0 and counts[islands[dof]] >= cap]
        robots = robots_of_dofs(self._engine.model, dofs)
        names = ', '.join(f"'{name}'" for name in robots) or 'none'
        self._tell(
            Severity.WARN,
            f'solver {names}',
            f'robot {names}: the solver stops at its cap of {cap} iterations, {self._capped} '
            f'times in a row{self._when}, with {data.ncon} contacts in the world; motions are '
            'less exact. Likely: bodies wedged between others, or actuators far stronger than the '
            'masses they move. Free them, lower the gains, or raise <option iterations="…"/> in '
            'the world',
        )

    def _tell_fall(self, name: str, height: float) -> None:
        model = self._engine.model
        shapes = [
            geom
            for geom in range(model.ngeom)
            if model.body(int(model.geom_bodyid[geom])).name.startswith(f'{name}/')
            and (model.geom_contype[geom] or model.geom_conaffinity[geom])
        ]
        cause = (
            'there is no ground where it is: spawn it above the ground, or drive on it'
            if shapes
            else 'none of its links has a <collision>: give it one'
        )
        self._tell(
            Severity.ERROR,
            f'fall {name}',
            f"robot '{name}' is below the ground: its root is at z = {height:.2f} m{self._when}. "
            f'Likely: {cause}',
        )

    # --- telling ------------------------------------------------------------------------------

    @property
    def _when(self) -> str:
        return f' at {self._engine.time / NANOSECONDS:.3f} s'

    def _tell(self, severity: Severity, fault: str, line: str) -> None:
        """Say ``line`` unless ``fault`` goes on since it was told."""
        now = self._engine.time
        seen = self._last_seen.get(fault, -math.inf)
        self._last_seen[fault] = now
        if now - seen > QUIET:
            self._log(severity, line)
            self.on_fault()
