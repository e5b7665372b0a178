# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""The services of ``simulation_interfaces`` that spawn, delete and list entities."""

from pathlib import Path
from urllib.parse import parse_qsl

from geometry_msgs.msg import PoseStamped
from rclpy.node import Node
from simulation_interfaces.msg import Result, SimulatorFeatures, Spawnable, SpawnResult
from simulation_interfaces.srv import (
    DeleteEntity,
    GetSpawnables,
    SpawnEntities,
    SpawnEntity,
)

from amr_description.ament_index import OWN_PACKAGE
from amr_description.entry import python_command
from amr_description.errors import (
    DescriptionError,
    LimitError,
    RequestError,
    ResourceError,
    SimulationError,
    SpawnError,
)
from amr_description.limited_child import Ended, Limits, run_limited
from amr_description.log import Severity
from amr_description.model.description_file import (
    description_at,
    split_uri,
    takes_arguments,
)
from amr_description.model.mesh_paths import with_absolute_paths
from amr_description.plugin_errors import log_error
from amr_description.ros.messages import transform_of
from amr_description.ros.runtime import run_in_thread
from amr_description.sim.ros.service_replies import create_services, fill_error
from amr_description.sim.ros.simulation import Simulation
from amr_description.sim.ros.source_folders import folder_of
from amr_description.sim.spawning import SpawnCode
from amr_description.simulation.topics.names import WORLD_FRAME
from amr_description.trusted_files import distrust, distrust_argument

FEATURES = (
    SimulatorFeatures.SPAWNING,
    SimulatorFeatures.DELETING,
    SimulatorFeatures.SPAWNING_RESOURCE_STRING,
    SimulatorFeatures.SPAWNABLES,
    SimulatorFeatures.SPAWNING_ENTITIES,
)
"""What these services support."""

SPAWN_FORMATS = ('urdf', 'xacro')
"""Formats of descriptions that can be spawned; xacro files by uri only."""

_SOURCES = (f'package://{OWN_PACKAGE}/urdf',)
_SUFFIXES = ('.urdf', '.xacro')
_LIMITS = Limits(seconds=10, memory=2 * 2**30, wall=60.0)
"""Of the expansion of a xacro file; large robots take one or two seconds."""
_EXPAND = python_command(
    'from amr_description.trusted_files import guard_reads; guard_reads(); '
    'from amr_description.model.description_file import main; sys.exit(main(sys.argv[1:]))'
)


class SpawnServices:
    """``~/spawn_entity``, ``~/spawn_entities``, ``~/delete_entity`` and ``~/get_spawnables``."""

    def __init__(self, node: Node, simulation: Simulation) -> None:
        self._node = node
        self._simulation = simulation
        create_services(
            node,
            simulation.log,
            (
                (SpawnEntity, self._spawn_entity),
                (SpawnEntities, self._spawn_entities),
                (DeleteEntity, self._delete_entity),
                (GetSpawnables, self._get_spawnables),
            ),
        )

    async def _spawn_entity(
        self, request: SpawnEntity.Request, response: SpawnEntity.Response
    ) -> None:
        # With both, the text was made from the file: create expands xacro itself.
        uri = '' if request.resource_string else request.uri
        source = request.uri or request.name or 'robot_description'
        try:
            text = request.resource_string or await self._read(uri)
            response.entity_name = await self._spawn(request, text, source)
        except Exception as error:
            log_error(self._simulation.log, error)
            raise

    async def _spawn_entities(
        self, request: SpawnEntities.Request, response: SpawnEntities.Response
    ) -> None:
        """Spawn one after the other, whether or not one fails."""
        for each in request.spawn_requests:
            spawned = SpawnResult()
            resource = each.entity_resource
            source = resource.uri or each.name or 'robot_description'
            try:
                text = resource.resource_string
                if resource.uri:
                    text = await self._read(resource.uri)
                spawned.entity_name = await self._spawn(each, text, source)
                spawned.result.result = Result.RESULT_OK
            except Exception as error:  # a third-party component may raise anything
                log_error(self._simulation.log, error)
                fill_error(spawned.result, error)
            response.results.append(spawned)
        failed = sum(each.result.result != Result.RESULT_OK for each in response.results)
        if failed:
            raise RequestError(
                f'{failed} of {len(response.results)} entities were not spawned; see results',
                response.ENTITIES_SPAWN_FAILED,
            )

    async def _delete_entity(
        self, request: DeleteEntity.Request, _: DeleteEntity.Response
    ) -> None:
        await self._simulation.entities.remove(request.entity)
        self._simulation.log(Severity.INFO, f"Removed '{request.entity}'")

    async def _get_spawnables(
        self, request: GetSpawnables.Request, response: GetSpawnables.Response
    ) -> None:
        """List the URDF and xacro files of folders, by default that of this package."""
        for source in request.sources or _SOURCES:
            folder = folder_of(source)
            response.spawnables += [
                Spawnable(uri=f'{source.rstrip("/")}/{path.name}', description=path.stem)
                for path in sorted(folder.iterdir())
                if path.suffix in _SUFFIXES
            ]

    async def _spawn(self, request: SpawnEntity.Request, text: str, source: str) -> str:
        """Spawn an entity; return its name. Raises SpawnError, or whatever a component raises."""
        robot = self._simulation.engine.read(text, source, request.entity_namespace)
        _check_frame(request.initial_pose)
        name = await self._simulation.entities.spawn(
            request.name,
            robot,
            transform_of(request.initial_pose.pose),
            request.entity_namespace,
            allow_renaming=request.allow_renaming,
        )
        self._simulation.log(Severity.INFO, f"Spawned '{name}'")
        return name

    async def _read(self, uri: str) -> str:
        """Read the resource of a request, aside if it is a program. Raises SpawnError."""
        if not uri:
            raise SpawnError(
                'neither resource_string nor uri is given; one of them holds the URDF',
                SpawnCode.NO_RESOURCE,
            )
        try:
            path, query = split_uri(uri)
            if reason := distrust(path):
                raise DescriptionError(f'{path} {reason}')
            if not takes_arguments(uri):
                return description_at(uri, warn=self._node.get_logger().warning)
            return await self._expanded(path, query)
        except (DescriptionError, ResourceError, SimulationError) as error:
            raise SpawnError(f"uri '{uri}': {error}", SpawnCode.NO_RESOURCE) from error

    async def _expanded(self, path: Path, query: str) -> str:
        """Return what a xacro file expands to, in a child. Raises DescriptionError."""
        given = parse_qsl(query, keep_blank_values=True)
        for name, value in given:
            if reason := distrust_argument(name, value):
                raise DescriptionError(reason)
        words = [*_EXPAND, str(path), *(f'{name}:={value}' for name, value in given)]
        found: list[Ended | LimitError | OSError] = []

        def run() -> None:
            try:
                found.append(run_limited(words, _LIMITS))
            except (LimitError, OSError) as error:
                found.append(error)

        assert self._node.executor is not None, 'it serves this request'
        await run_in_thread(run, self._node.executor, f'xacro {path.name}')
        ended = found[0]
        if isinstance(ended, LimitError):
            raise DescriptionError(f'xacro: {ended}; does an expression of it end?') from ended
        if isinstance(ended, OSError):
            raise DescriptionError(f'xacro: {ended}') from ended
        lines = ended.log.splitlines()
        if ended.code:
            raise DescriptionError(lines[-1] if lines else f'exit code {ended.code}')
        for line in lines:
            self._node.get_logger().warning(line.removeprefix('warning: '))
        return with_absolute_paths(ended.text, path.parent)


def _check_frame(pose: PoseStamped) -> None:
    frame = pose.header.frame_id
    if frame not in ('', WORLD_FRAME):
        raise SpawnError(
            f"the initial pose is given in the frame '{frame}'; '{WORLD_FRAME}' is known here",
            SpawnCode.INVALID_POSE,
        )
