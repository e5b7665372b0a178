# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
What goes wrong in the physics, told once, in one line that names the robot and the joint.

MuJoCo hands its warnings to one function of the process; without it a MUJOCO_LOG.TXT would appear
in the user's folder. A step that brings no warning costs one look at an empty queue.
"""

from collections import deque
from collections.abc import Iterable
import re

import mujoco

from amr_description.control.contracts import Log, Severity
from amr_description.sim.engine import Engine, NANOSECONDS

FALL_HEIGHT = -0.1
"""m; the root of a robot below this height has left the ground."""

FALL_CHECK_INTERVAL = 100_000_000
"""ns of simulated time between two looks at the robots' heights."""

_warnings: deque[str] = deque(maxlen=1000)

_BAD_VALUE = re.compile(r'value in (QPOS|QVEL|QACC|CTRL) at \w+ (\d+)')
_QUANTITY = {'QPOS': 'position', 'QVEL': 'velocity', 'QACC': 'acceleration', 'CTRL': 'command'}


def listen_to_mujoco() -> None:
    """Have MuJoCo's warnings collected, of all worlds in this process."""
    mujoco.set_mju_user_warning(_warnings.append)


def one_line(text: str) -> str:
    """MuJoCo's message without its line breaks and its leading ``Error:``."""
    return ' '.join(text.split()).removeprefix('Error: ')


class FaultMonitor:
    """Watches an engine after its steps and tells what it sees to a log."""

    def __init__(self, engine: Engine, log: Log) -> None:
        self._engine = engine
        self._log = log
        self._state_is_lost = False
        self._fallen: set[str] = set()
        self._next_fall_check = 0

    def reset(self) -> None:
        """Forget what was told: time and robots are set back."""
        _warnings.clear()
        self._state_is_lost = False
        self._fallen.clear()
        self._next_fall_check = 0

    def check(self, roots: Iterable[tuple[str, int]]) -> None:
        """
        Look after a step; ``roots``: name of each floating robot and the index of its root's
        height in ``qpos``.
        """
        while _warnings:
            self._tell_warning(_warnings.popleft())
        time = self._engine.time
        if time >= self._next_fall_check and not self._state_is_lost:
            self._next_fall_check = time + FALL_CHECK_INTERVAL
            for name, index in roots:
                self._check_fall(name, float(self._engine.data.qpos[index]))

    def _tell_warning(self, text: str) -> None:
        if self._state_is_lost:
            return  # The first bad value is the cause; what follows from it is not told.
        bad = _BAD_VALUE.search(text)
        if bad is None:
            self._log(Severity.WARN, f'MuJoCo: {one_line(text)}')
        else:
            self._state_is_lost = True
            where = _place(self._engine.model, bad[1], int(bad[2]))
            self._log(
                Severity.ERROR,
                f'{where}: the {_QUANTITY[bad[1]]} is not finite, or huge, at '
                f'{self._engine.time / NANOSECONDS:.3f} s; the state is lost until a reset. Look '
                'at the masses, inertias and limits there, and at what was commanded',
            )

    def _check_fall(self, name: str, height: float) -> None:
        if height >= FALL_HEIGHT:
            self._fallen.discard(name)
        elif name not in self._fallen:
            self._fallen.add(name)
            self._log(
                Severity.ERROR,
                f"robot '{name}' is below the ground: its root is at z = {height:.2f} m. Do its "
                'links have <collision>, and is there ground where it was spawned?',
            )


def _place(model: mujoco.MjModel, quantity: str, index: int) -> str:
    """``robot 'amr': joint 'joint_wheel_front_left'`` of an index into MuJoCo's vectors."""
    if quantity == 'CTRL':
        element = model.actuator(index).name
    elif quantity == 'QPOS':
        # The last joint that begins at or before this coordinate.
        element = model.joint(int((model.jnt_qposadr <= index).sum()) - 1).name
    else:
        element = model.joint(int(model.dof_jntid[index])).name
    robot, _, part = element.partition('/')
    return f"robot '{robot}': joint '{part}'" if part else f"joint '{element}'"
