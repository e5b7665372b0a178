# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
Wrenches from outside on links: as by Gazebo's system ApplyLinkWrench.

A wrench acts on the origin of a link, in the axes of the world, as there; MuJoCo takes it at the
centre of mass (``xfrc_applied``).
"""

from collections.abc import Callable
from dataclasses import dataclass
from typing import TypeAlias

import numpy as np

from amr_description.model.frames import Vector
from amr_description.sim.engine import Engine

MOST = 1e5
"""N, N m, m/s, rad/s: with more physics loses the state of a robot that weighs some kilograms."""

BodyOf: TypeAlias = Callable[[str, str], int]
"""Returns MuJoCo's body of (robot, link) at present; raises SimulationError."""


@dataclass(frozen=True, slots=True)
class WorldWrench:
    """N and N m, in the axes of the world; the force acts on the link's origin."""

    force: Vector
    torque: Vector


class Wrenches:
    """The wrenches that act on links: for one physics step, or until they are cleared."""

    def __init__(self, engine: Engine, body_of: BodyOf) -> None:
        self._engine = engine
        self._body_of = body_of
        self._lasting: dict[tuple[str, str], WorldWrench] = {}
        self._once: list[tuple[tuple[str, str], WorldWrench]] = []

    def __bool__(self) -> bool:
        """Return whether any wrench acts."""
        return bool(self._lasting or self._once)

    def push(self, robot: str, link: str, wrench: WorldWrench) -> None:
        """Apply a wrench in the next physics step. Raises SimulationError."""
        self._body_of(robot, link)
        self._once.append(((robot, link), wrench))

    def hold(self, robot: str, link: str, wrench: WorldWrench) -> None:
        """
        Apply a wrench from now on, in place of the one before; one of zeros is none.

        Raises SimulationError.
        """
        self._body_of(robot, link)
        self._lasting.pop((robot, link), None)
        if any((*wrench.force, *wrench.torque)):
            self._lasting[robot, link] = wrench

    def clear(self, robot: str, link: str | None = None) -> None:
        """Hold no wrench on a link any more; None: on no link of the robot."""
        for key in [*self._lasting]:
            if key[0] == robot and link in (None, key[1]):
                del self._lasting[key]

    def forget(self, robot: str) -> None:
        """Drop all wrenches on a robot that leaves, those of the next step, too."""
        self.clear(robot)
        self._once = [each for each in self._once if each[0][0] != robot]

    def clear_all(self) -> None:
        """Hold no wrench on any link, and forget those of the next step."""
        self._lasting.clear()
        self._once.clear()

    def step(self, count: int) -> None:
        """Advance by ``count`` physics steps under the wrenches."""
        while count > 0 and self:
            applied = [*self._lasting.items(), *self._once]
            # The offset of the centre of mass turns with the link, so it is taken for each step.
            self._engine.refresh_kinematics()
            for (robot, link), wrench in applied:
                self._apply(self._body_of(robot, link), wrench)
            self._once.clear()
            self._engine.step(1)
            self._engine.data.xfrc_applied[:] = 0.0
            count -= 1
        if count > 0:
            self._engine.step(count)

    def _apply(self, body: int, wrench: WorldWrench) -> None:
        data = self._engine.data
        force = np.array(wrench.force)
        arm = data.xpos[body] - data.xipos[body]
        data.xfrc_applied[body, :3] += force
        data.xfrc_applied[body, 3:] += wrench.torque + np.cross(arm, force)
