# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
Another world around the robots that are there.

A simulator that loads a world removes all entities, and stands still then. So the robots are
spawned again where they were spawned before, under the same names, with the same active
controllers, and time goes on if it did.
"""

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass

from amr_description.errors import AmrError, ViewerError
from amr_description.viewer.entities import SpawnedEntity
from amr_description.viewer.protocol import RobotInfo
from amr_description.viewer.requests import LoadWorld, Play
from amr_description.viewer.ros.service_clients import (
    activate_controllers,
    active_controllers,
    ServiceClients,
    SimulatorClient,
)
from amr_description.viewer.ros.setting_up import manager_of
from amr_description.viewer.ros.threads import ServedRobot


@dataclass(frozen=True, slots=True)
class Resident:
    """A robot of the world: its entity, its namespace, its URDF and its controller manager."""

    entity: str
    namespace: str
    urdf: str
    manager: str | None


def residents_of(
    simulator: str,
    spawned: Iterable[SpawnedEntity],
    robots: Iterable[RobotInfo],
    connections: Mapping[str, ServedRobot],
) -> list[Resident]:
    """
    Return what is spawned again in another world of a simulator.

    Args:
        simulator: Its id.
        spawned: What it says to have spawned.
        robots: Those of the graph, of which some are known to be entities.
        connections: With them, by their ids.
    """
    # What has just come is not known in the graph yet: then its manager is that of its namespace.
    found = {
        each.name: Resident(each.name, each.namespace, each.urdf, _manager_of(each))
        for each in spawned
    }
    for robot in robots:
        entity, connection = robot.entity, connections.get(robot.id)
        if entity is None or entity.simulator != simulator or connection is None:
            continue
        if connection.described is not None:
            urdf, manager = connection.described.message.urdf, connection.found.manager
            found[entity.name] = Resident(entity.name, robot.id, urdf, manager)
    return [*found.values()]


def _manager_of(spawned: SpawnedEntity) -> str | None:
    try:
        return manager_of(spawned.namespace, spawned.urdf)
    except AmrError:
        return None  # it is spawned by other means than a URDF


async def change_world(
    services: ServiceClients,
    simulator: SimulatorClient,
    residents: Sequence[Resident],
    request: LoadWorld,
) -> str:
    """Load a world; return one line about it and its robots. Raises ViewerError."""
    poses = await simulator.spawn_poses()
    controllers = {
        each.manager: await active_controllers(services, each.manager)
        for each in residents
        if each.manager is not None
    }
    was_playing = simulator.state == 'playing'
    done = await simulator.load_world(request)
    staying = [each for each in residents if each.entity in poses]
    troubles = []
    for each in [*staying]:
        try:
            pose = poses[each.entity]
            await simulator.spawn(each.entity, each.namespace, each.urdf, pose)
        except ViewerError as error:
            staying.remove(each)
            troubles.append(str(error))
    kind = 'play' if was_playing else 'pause'
    await simulator.play(Play(kind, request.id, request.simulator))
    for each in staying:
        if each.manager is not None:
            try:
                await activate_controllers(services, each.manager, controllers[each.manager])
            except ViewerError as error:
                troubles.append(f"'{each.entity}' has no active controllers: {error}")
    names = ', '.join(f"'{each.entity}'" for each in staying) or 'no robot'
    return '; '.join([f'{done}, with {names}', *troubles])
