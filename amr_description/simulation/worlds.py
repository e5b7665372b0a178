# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""The world of a simulation."""

from amr_description.control.contracts import Log
from amr_description.sim.world import MujocoWorld
from amr_description.simulation.parameters import SimulationParameters


def world_of(parameters: SimulationParameters, log: Log) -> MujocoWorld:
    """Load the world of some parameters. Raises SimulationError."""
    return MujocoWorld(
        parameters.world,
        settings=parameters.physics,
        seed=parameters.seed,
        strict=parameters.strict,
        log=log,
    )
