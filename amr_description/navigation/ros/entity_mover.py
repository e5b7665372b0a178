# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""Puts a robot somewhere else in its simulator, by the services of ``simulation_interfaces``."""

from collections.abc import Callable, Sequence
from typing import Any

from rclpy.client import Client
from rclpy.clock import Clock
from rclpy.clock_type import ClockType
from rclpy.node import Node
from simulation_interfaces.msg import EntityCategory, Result
from simulation_interfaces.srv import GetEntities, SetEntityState

from amr_description.model.frames import Transform
from amr_description.navigation.ros.localizer import listed
from amr_description.ros.messages import fill_pose
from amr_description.ros.service_calls import ServiceReadiness

_LOOK_PERIOD = 1.0
"""s"""


class EntityMover:
    """Asks the simulator; what it refuses is one warning."""

    def __init__(self, node: Node, simulator: str, entity: str) -> None:
        """
        Make the clients.

        Args:
            node: Has them.
            simulator: Full name of the simulator's node.
            entity: Name of the robot in the simulator; empty: the only robot, or the one that has
                the name of the node's namespace.
        """
        self._logger = node.get_logger()
        self._entity = entity
        self._namespace = node.get_namespace().rpartition('/')[2]
        name = simulator.rstrip('/')
        self._entities = node.create_client(GetEntities, f'{name}/get_entities')
        self._set_state = node.create_client(SetEntityState, f'{name}/set_entity_state')
        clients = self._entities, self._set_state
        self._ready = {client: ServiceReadiness(node, client) for client in clients}
        node.create_timer(_LOOK_PERIOD, self._look, clock=Clock(clock_type=ClockType.STEADY_TIME))

    def _look(self) -> None:
        """Look for the simulator before it is needed: it may have been started anew."""
        for is_ready in self._ready.values():
            is_ready()

    def move(self, pose: Transform) -> None:
        """Have the robot stand with its root link at a pose of the world; return at once."""
        for client, is_ready in self._ready.items():
            if not is_ready():
                self._logger.warning(
                    f'the robot stays where it is: no simulator serves {client.service_name}. '
                    "The parameter 'simulator' names its node; with set_entity_state:=false the "
                    'map is shifted instead'
                )
                return
        if self._entity:
            self._send(self._entity, pose)
            return
        request = GetEntities.Request()
        request.filters.categories = [EntityCategory(category=EntityCategory.CATEGORY_ROBOT)]
        self._call(self._entities, request, lambda found: self._choose(found.entities, pose))

    def _choose(self, names: Sequence[str], pose: Transform) -> None:
        if len(names) == 1:
            self._send(names[0], pose)
        elif self._namespace in names:
            self._send(self._namespace, pose)
        else:
            self._logger.warning(
                f'the robot stays where it is: the robots of the simulator are {listed(names)}; '
                "the parameter 'entity' says which one is meant"
            )

    def _send(self, entity: str, pose: Transform) -> None:
        request = SetEntityState.Request(entity=entity)
        fill_pose(pose, request.state.pose)
        self._call(self._set_state, request, lambda _: None)

    def _call(self, client: Client, request: Any, then: Callable[[Any], None]) -> None:
        def answered(future: Any) -> None:
            response = future.result()
            if response.result.result == Result.RESULT_OK:
                then(response)
            else:
                self._logger.warning(
                    f'the robot stays where it is: {client.service_name} answers: '
                    f'{response.result.error_message}'
                )

        client.call_async(request).add_done_callback(answered)
