# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
What varies from trial to trial: draws, and what they change in a simulation.

A draw is any function of a :class:`numpy.random.Generator`; those here can be sent to other
processes. What changes a simulation takes a number, so that a report has it beside the outcome,
and lasts until the next reset. For noise and late commands, see
:mod:`amr_description.trials.faults`.
"""

from collections.abc import Callable, Sequence
from dataclasses import dataclass
import math
from typing import Any, TypeVar

import numpy as np

from amr_description.errors import TrialsError
from amr_description.model.frames import Transform
from amr_description.sim.entity_state import pose_of, set_state
from amr_description.simulation.in_process import Simulation
from amr_description.trials.function import Draw, plain_value, Value, VARIED

_Function = TypeVar('_Function', bound=Callable[..., Any])


def vary(**parameters: Draw | Sequence[Value]) -> Callable[[_Function], _Function]:
    """
    Give a trial parameters, by their names.

    Args:
        parameters: A list or tuple is an axis of a grid: each seed is run with each combination. A
            function of a generator, such as ``uniform(0.4, 1.0)``, is drawn anew for each seed.

    Raises:
        TrialsError: A parameter is neither, or an axis is empty.
    """
    for name, each in parameters.items():
        if callable(each):
            continue
        if isinstance(each, str) or not isinstance(each, Sequence) or not each:
            raise TrialsError(
                f"the parameter '{name}' is {each!r}; a list of values, or a function of a "
                'generator, such as uniform(0.4, 1.0), will do'
            )
    axes = {
        name: each
        if callable(each)
        else tuple(plain_value(value, f"a value of '{name}'") for value in each)
        for name, each in parameters.items()
    }

    def note(function: _Function) -> _Function:
        setattr(function, VARIED, axes)
        return function

    return note


@dataclass(frozen=True)
class uniform:  # noqa: N801 - it is written as a function
    """A draw: any number between two, as likely as any other."""

    low: float
    high: float

    def __call__(self, rng: np.random.Generator) -> float:
        """Draw."""
        return float(rng.uniform(self.low, self.high))


@dataclass(frozen=True)
class normal:  # noqa: N801
    """A draw: a number around a mean."""

    mean: float
    stddev: float

    def __call__(self, rng: np.random.Generator) -> float:
        """Draw."""
        return float(rng.normal(self.mean, self.stddev))


def scale_mass(sim: Simulation, factor: float, *links: str, robot: str = '') -> None:
    """
    Multiply the mass and the inertia of links.

    Args:
        sim: The simulation.
        factor: 1.1 is a tenth more.
        links: Names; none: all.
        robot: Its name; empty: the only one.

    Raises:
        SimulationError: There is no such link, or the factor is not above 0.
    """
    sim.altered.model.scale_mass(sim.altered.robot(robot), factor, links)


def scale_friction(sim: Simulation, factor: float, *wheels: str, robot: str = '') -> None:
    """Multiply the friction of wheels on the ground, by their links; as :func:`scale_mass`."""
    sim.altered.model.scale_friction(sim.altered.robot(robot), factor, wheels)


def scale_wheel_radius(sim: Simulation, factor: float, *wheels: str, robot: str = '') -> None:
    """Multiply the radius of wheels, of which controllers know nothing; as :func:`scale_mass`."""
    sim.altered.model.scale_radius(sim.altered.robot(robot), factor, wheels)


def move_start(
    sim: Simulation, x: float = 0.0, y: float = 0.0, yaw: float = 0.0, *, robot: str = ''
) -> None:
    """
    Put a robot elsewhere, at rest; its odometry begins at 0 there.

    Args:
        sim: The simulation.
        x: From where it is, in its own axes, forward, m.
        y: To its left, m.
        yaw: Turned to its left, rad.
        robot: Its name; empty: the only one.

    Raises:
        SimulationError: It stands fixed.
        TrialsError: A number is not finite.
    """
    view = sim.altered.robot(robot)
    if not all(map(math.isfinite, (x, y, yaw))):
        raise TrialsError(f'a start at {x}, {y} m, {yaw} rad; finite numbers will do')
    turn = (0.0, 0.0, math.sin(yaw / 2), math.cos(yaw / 2))
    still = (0.0, 0.0, 0.0)
    set_state(sim.world.engine, view, pose_of(view) @ Transform((x, y, 0.0), turn), still, still)
