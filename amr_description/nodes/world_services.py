# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
The services of ``simulation_interfaces`` about worlds: which there are, and which one this is.

A world is chosen at the start, by the parameter ``world``. What would need more than that answers
``RESULT_FEATURE_UNSUPPORTED``, with the reason.
"""

from pathlib import Path
from typing import Any

from rclpy.node import Node
from simulation_interfaces.msg import Result, SimulatorFeatures, WorldResource
from simulation_interfaces.srv import (
    GetAvailableWorlds,
    GetCurrentWorld,
    GetNamedPoseBounds,
    GetNamedPoses,
    LoadWorld,
    UnloadWorld,
)

from amr_description.errors import RequestError, SimulationError
from amr_description.nodes.answers import serve
from amr_description.nodes.entity_filters import has_tags
from amr_description.nodes.simulation import Simulation
from amr_description.sim.resources import resolve_uri, shipped_worlds, world_path

FEATURES = (
    SimulatorFeatures.WORLD_INFO_GETTING,
    SimulatorFeatures.AVAILABLE_WORLDS,
)
"""What this file serves."""


class WorldServices:
    """The world of this simulator, and those that it could have been started with."""

    def __init__(self, node: Node, simulation: Simulation) -> None:
        self._world = simulation.parameters.world
        serve(
            node,
            simulation.log,
            (
                (GetCurrentWorld, self._get_current_world),
                (GetAvailableWorlds, self._get_available_worlds),
                (LoadWorld, self._load_world),
                (UnloadWorld, self._unload_world),
                (GetNamedPoses, self._get_named_poses),
                (GetNamedPoseBounds, self._get_named_pose_bounds),
            ),
        )

    async def _get_current_world(
        self, _: GetCurrentWorld.Request, response: GetCurrentWorld.Response
    ) -> None:
        response.world = _resource(world_path(self._world))

    async def _get_available_worlds(
        self, request: GetAvailableWorlds.Request, response: GetAvailableWorlds.Response
    ) -> None:
        """The shipped ones, and the MJCF files of further folders; no world has tags."""
        try:
            paths = list(shipped_worlds().values())
        except SimulationError as error:
            raise RequestError(str(error), response.DEFAULT_SOURCES_FAILED) from error
        for source in request.additional_sources:
            try:
                paths += _worlds_in(source)
            except SimulationError:
                if not request.continue_on_error:
                    raise
        if has_tags((), request.filter):
            response.worlds = [_resource(path) for path in paths]

    async def _load_world(self, _: LoadWorld.Request, __: LoadWorld.Response) -> None:
        raise _unsupported(
            'a world is chosen at the start: ros2 run amr_description mujoco_sim --ros-args -p '
            'world:=…'
        )

    async def _unload_world(self, _: UnloadWorld.Request, __: UnloadWorld.Response) -> None:
        raise _unsupported('the world stays as long as the simulator')

    async def _get_named_poses(self, _: GetNamedPoses.Request, __: Any) -> None:
        raise _unsupported('worlds have no named poses here')

    async def _get_named_pose_bounds(self, _: GetNamedPoseBounds.Request, __: Any) -> None:
        raise _unsupported('worlds have no named poses here')


def _worlds_in(source: str) -> list[Path]:
    """The MJCF files of a folder. Raises RequestError."""
    try:
        folder = resolve_uri(source)
    except SimulationError as error:
        raise RequestError(str(error), Result.RESULT_NOT_FOUND) from error
    if not folder.is_dir():
        raise RequestError(
            f"source '{source}' is no folder; package://<package>/<folder>, file:// or a path "
            'will do',
            Result.RESULT_NOT_FOUND,
        )
    return sorted(folder.glob('*.xml'))


def _resource(path: Path) -> WorldResource:
    world = WorldResource(name=path.stem)
    world.world_resource.uri = path.resolve().as_uri()
    return world


def _unsupported(reason: str) -> RequestError:
    return RequestError(reason, Result.RESULT_FEATURE_UNSUPPORTED)
