# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""The world of a simulation, and what topics of Gazebo are called there."""

from amr_description.ament_index import path_of
from amr_description.control.contracts import Log
from amr_description.errors import ParameterError, ResourceError, SimulationError
from amr_description.model.gazebo_bridge import Bridge, NO_BRIDGE, read_bridge
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


def bridge_of(parameters: SimulationParameters) -> Bridge:
    """Return what topics are called in ROS. Raises SimulationError."""
    if not parameters.bridge:
        return NO_BRIDGE
    try:
        return read_bridge(path_of(parameters.bridge, 'bridge'))
    except (ParameterError, ResourceError) as error:
        raise SimulationError(str(error)) from error
