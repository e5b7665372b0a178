# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
The services of ``simulation_interfaces`` for entities: list, state, info and bounds.

Entities are robots. A state is that of the root link in the frame ``world``; all states of a
response are of one instant. Bounds are a box around all geoms as they are now, in the frame of the
root link.

Of ``simulation_interfaces/msg/EntityFilters``, ``filter`` may match any part of a name, as with
``grep -E``; filters by bounds are boxes or spheres, and are compared with the box of an entity.
"""

from collections.abc import Collection, Iterable
import ctypes
from functools import cache
import math
from typing import Self

from geometry_msgs.msg import Vector3
from rclpy.node import Node
from simulation_interfaces.msg import (
    Bounds,
    EntityFilters,
    EntityInfo,
    EntityState,
    Result,
    SimulatorFeatures,
    TagsFilter,
)
from simulation_interfaces.srv import (
    GetEntities,
    GetEntitiesStates,
    GetEntityBounds,
    GetEntityInfo,
    GetEntityState,
    SetEntityInfo,
    SetEntityState,
)

from amr_description.errors import RequestError, SpawnError, UsageError
from amr_description.model.frames import Transform, Vector
from amr_description.ros.messages import (
    fill_pose,
    fill_stamp,
    fill_velocity,
    transform_of,
    vector_of,
)
from amr_description.sim.entity_state import BoundingBox, bounds_of, motion_of, pose_of, set_state
from amr_description.sim.overlap import deepest_overlap, Overlap
from amr_description.sim.ros.entities import Category, Entity, EntityRecord
from amr_description.sim.ros.service_replies import create_services
from amr_description.sim.ros.simulation import Simulation
from amr_description.sim.spawning import checked_pose
from amr_description.sim.wrenches import MOST
from amr_description.simulation.topics.names import WORLD_FRAME

# --- POSIX extended regular expressions ----------------------------------------------------------
#
# Python's ``re`` has another syntax, in which ``[[:digit:]]`` is a set of brackets and letters.
# Therefore the C library is used.

_REG_EXTENDED, _REG_NOSUB = 1, 8
_BUFFER_SIZE = 1024
"""Bytes; a ``regex_t`` has 64 in glibc, 48 in musl; error messages are short."""


@cache
def _libc() -> ctypes.CDLL:
    return ctypes.CDLL(None)


class PosixRegex:
    """A compiled expression; it may match any part of a text, as with ``grep -E``."""

    def __init__(self, expression: str) -> None:
        """Compile an expression. Raises UsageError."""
        self._compiled = None
        compiled = ctypes.create_string_buffer(_BUFFER_SIZE)
        flags = _REG_EXTENDED | _REG_NOSUB
        if '\0' in expression:
            raise UsageError(f'{expression!r} is no regular expression: it holds a NUL character')
        error = _libc().regcomp(compiled, expression.encode(), flags)
        if error:
            reason = ctypes.create_string_buffer(_BUFFER_SIZE)
            _libc().regerror(error, compiled, reason, ctypes.c_size_t(_BUFFER_SIZE))
            raise UsageError(
                f"'{expression}' is no POSIX extended regular expression: {reason.value.decode()}"
            )
        self._compiled = compiled

    def __enter__(self) -> Self:
        return self

    def __exit__(self, *_: object) -> None:
        """Free the memory of the compiled expression."""
        compiled, self._compiled = self._compiled, None
        if compiled is not None:
            _libc().regfree(compiled)

    def is_in(self, text: str) -> bool:
        """Return whether the expression matches any part of a text."""
        none = ctypes.c_size_t(0)
        return _libc().regexec(self._compiled, text.encode(), none, None, 0) == 0


FEATURES = (
    SimulatorFeatures.ENTITY_TAGS,
    SimulatorFeatures.ENTITY_BOUNDS,
    SimulatorFeatures.ENTITY_BOUNDS_BOX,
    SimulatorFeatures.ENTITY_CATEGORIES,
    SimulatorFeatures.ENTITY_STATE_GETTING,
    SimulatorFeatures.ENTITY_STATE_SETTING,
    SimulatorFeatures.ENTITY_INFO_GETTING,
    SimulatorFeatures.ENTITY_INFO_SETTING,
)
"""What these services support."""


class EntityServices:
    """Get and set the states of entities, and their info."""

    def __init__(self, node: Node, simulation: Simulation) -> None:
        self._simulation = simulation
        self._entities = simulation.entities
        self._world = simulation.world
        self._loop_thread = simulation.loop_thread
        create_services(
            node,
            simulation.log,
            (
                (GetEntities, self._get_entities),
                (GetEntitiesStates, self._get_entities_states),
                (GetEntityState, self._get_entity_state),
                (SetEntityState, self._set_entity_state),
                (GetEntityInfo, self._get_entity_info),
                (SetEntityInfo, self._set_entity_info),
                (GetEntityBounds, self._get_entity_bounds),
            ),
        )

    async def _get_entities(
        self, request: GetEntities.Request, response: GetEntities.Response
    ) -> None:
        response.entities = await self._matching(request.filters)

    async def _get_entities_states(
        self, request: GetEntitiesStates.Request, response: GetEntitiesStates.Response
    ) -> None:
        states = await self._states(await self._matching(request.filters))
        response.entities, response.states = list(states), list(states.values())

    async def _get_entity_state(
        self, request: GetEntityState.Request, response: GetEntityState.Response
    ) -> None:
        name = self._entities.find(request.entity).name
        found = list((await self._states([name])).values())
        if not found:
            self._entities.find(name)  # raises: it was removed meanwhile
        response.state = found[0]

    async def _set_entity_state(
        self, request: SetEntityState.Request, response: SetEntityState.Response
    ) -> None:
        """
        Set pose and twist at once; stamp and acceleration are ignored.

        A robot may be put inside something, as in Gazebo: then the message of the result says so.
        """
        name, state = self._entities.find(request.entity).name, request.state
        frame = state.header.frame_id
        if frame not in ('', WORLD_FRAME):
            raise RequestError(
                f"the state is given in the frame '{frame}'; '{WORLD_FRAME}' is known here",
                response.INVALID_POSE,
            )
        try:
            pose = checked_pose(transform_of(state.pose))
        except SpawnError as error:
            raise RequestError(str(error), response.INVALID_POSE) from error
        linear, angular = vector_of(state.twist.linear), vector_of(state.twist.angular)
        if not all(abs(each) <= MOST for each in (*linear, *angular)):
            raise RequestError(
                f'the twist is {linear} m/s, {angular} rad/s; finite numbers are needed, up to '
                f'{MOST:g}',
                Result.RESULT_OPERATION_FAILED,
            )
        world = self._world

        def put() -> Overlap | None:
            world.faults.release(name)
            set_state(world.engine, world.robot(name), pose, linear, angular)
            return deepest_overlap(world.engine, name)

        overlap = await self._loop_thread.submit(put)
        if overlap is not None:
            response.result.error_message = overlap.warning(name)

    async def _get_entity_info(
        self, request: GetEntityInfo.Request, response: GetEntityInfo.Response
    ) -> None:
        info = self._entities.find(request.entity).info
        response.info = EntityInfo(description=info.description, tags=info.tags)
        response.info.category.category = info.category

    async def _set_entity_info(
        self, request: SetEntityInfo.Request, _: SetEntityInfo.Response
    ) -> None:
        entity, info = self._entities.find(request.entity), request.info
        known = {int(category): category for category in Category}
        category = info.category.category
        if category not in known:
            choices = ', '.join(f'{each.name} ({each})' for each in Category)
            raise RequestError(
                f'category {category} is given; there are: {choices}',
                Result.RESULT_OPERATION_FAILED,
            )
        entity.info = EntityRecord(known[category], info.description, tuple(info.tags))

    async def _get_entity_bounds(
        self, request: GetEntityBounds.Request, response: GetEntityBounds.Response
    ) -> None:
        name, world = self._entities.find(request.entity).name, self._world

        def read() -> BoundingBox | None:
            robot = world.robot(name)
            return bounds_of(world.engine, robot, pose_of(robot))

        box = await self._loop_thread.submit(read)
        if box is not None:
            response.bounds.type = Bounds.TYPE_BOX
            response.bounds.points = [_vector3(box.upper), _vector3(box.lower)]

    async def _matching(self, filters: EntityFilters) -> list[str]:
        """Return the names of the entities that match all filters. Raises RequestError."""
        check_bounds(filters.bounds)
        entities: Collection[Entity] = matching(self._entities, filters)
        names = [entity.name for entity in entities]
        if filters.bounds.type == Bounds.TYPE_EMPTY:
            return names
        world = self._world

        def read() -> list[str]:
            return [
                name
                for name in names
                if name in world.names
                and overlaps(
                    bounds_of(world.engine, world.robot(name), Transform()), filters.bounds
                )
            ]

        return await self._loop_thread.submit(read)

    async def _states(self, names: Collection[str]) -> dict[str, EntityState]:
        """Return the states at one instant, of the entities that still exist."""
        world = self._world

        def read() -> dict[str, EntityState]:
            return {name: self._state(name) for name in names if name in world.names}

        return await self._loop_thread.submit(read)

    def _state(self, name: str) -> EntityState:
        """Return the state of an entity; on the control thread."""
        robot = self._world.robot(name)
        motion = motion_of(self._world.engine, robot)
        state = EntityState()
        state.header.frame_id = WORLD_FRAME
        fill_stamp(self._world.time, state.header.stamp)
        fill_pose(pose_of(robot), state.pose)
        fill_velocity(motion.linear_velocity, motion.angular_velocity, state.twist)
        fill_velocity(motion.linear_acceleration, motion.angular_acceleration, state.acceleration)
        return state


def _vector3(values: Vector) -> Vector3:
    x, y, z = values
    return Vector3(x=x, y=y, z=z)


def matching(entities: Iterable[Entity], filters: EntityFilters) -> list[Entity]:
    """
    Return the entities whose name, category and tags match.

    Raises RequestError: ``filter`` is no regular expression.
    """
    categories = [each.category for each in filters.categories]
    try:
        with PosixRegex(filters.filter) as names:
            return [
                entity
                for entity in entities
                if (not filters.filter or names.is_in(entity.name))
                and (not categories or entity.info.category in categories)
                and has_tags(entity.info.tags, filters.tags)
            ]
    except UsageError as error:
        raise RequestError(f'filter: {error}', Result.RESULT_OPERATION_FAILED) from error


def has_tags(tags: Collection[str], wanted: TagsFilter) -> bool:
    """Return whether any or all of the wanted tags are there, by their mode; true without any."""
    if not wanted.tags:
        return True
    found = [tag in tags for tag in wanted.tags]
    return all(found) if wanted.filter_mode == TagsFilter.FILTER_MODE_ALL else any(found)


def check_bounds(bounds: Bounds) -> None:
    """Raise RequestError: the type is not supported, or does not have two points."""
    if bounds.type not in (Bounds.TYPE_EMPTY, Bounds.TYPE_BOX, Bounds.TYPE_SPHERE):
        raise RequestError(
            f'bounds of type {bounds.type} are asked; EMPTY (0), BOX (1) and SPHERE (3) are known',
            Result.RESULT_FEATURE_UNSUPPORTED,
        )
    if bounds.type != Bounds.TYPE_EMPTY and len(bounds.points) != 2:
        raise RequestError(
            f'bounds have {len(bounds.points)} points; two are needed: opposite corners of a box, '
            'or the centre of a sphere and its radius in x',
            Result.RESULT_OPERATION_FAILED,
        )


def overlaps(box: BoundingBox | None, bounds: Bounds) -> bool:
    """Return whether a box in the world and checked ``bounds`` overlap; false without a box."""
    if box is None:
        return False
    first, second = ((point.x, point.y, point.z) for point in bounds.points)
    sides = list(zip(box.lower, box.upper, strict=True))
    if bounds.type == Bounds.TYPE_SPHERE:
        closest = [min(max(c, low), high) for c, (low, high) in zip(first, sides, strict=True)]
        return math.dist(first, closest) <= second[0]
    return all(
        low <= max(a, b) and min(a, b) <= high
        for (low, high), a, b in zip(sides, first, second, strict=True)
    )
