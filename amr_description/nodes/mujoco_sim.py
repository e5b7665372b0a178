# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
``mujoco_sim``: the simulator, in Gazebo's place.

It owns ``/clock``, takes robots in through ``~/spawn_entity`` (simulation_interfaces) and runs
their controller managers. ``~/get_entity_state`` tells where a robot truly is.
"""

from collections.abc import Sequence
import sys

from rclpy.callback_groups import ReentrantCallbackGroup
from rclpy.exceptions import InvalidNamespaceException
from rclpy.executors import SingleThreadedExecutor
from rclpy.node import Node
from rclpy.validate_namespace import validate_namespace
from simulation_interfaces.msg import Result
from simulation_interfaces.srv import GetEntityState, SpawnEntity

from amr_description.control.foreign_errors import describe
from amr_description.errors import DescriptionError, SimulationError, SpawnError
from amr_description.model.frames import rotate
from amr_description.nodes.converters import (
    fill_pose,
    fill_stamp,
    fill_velocity,
    transform_of,
)
from amr_description.nodes.ground_truth import WORLD_FRAME
from amr_description.nodes.node_log import log_error
from amr_description.nodes.node_parameters import declare
from amr_description.nodes.ros_arguments import inherited, ros_arguments
from amr_description.nodes.runtime import argument_errors, program, ros, spin
from amr_description.nodes.simulation import Simulation, SimulationParameters
from amr_description.sim.resources import description_at
from amr_description.sim.spawning import read_description, SpawnCode


class MujocoSim:
    """The node and its services."""

    def __init__(self, executor: SingleThreadedExecutor, args: Sequence[str]) -> None:
        """Make the node and the world. Raises SimulationError, ParameterError."""
        self.node = Node('mujoco_sim')
        try:
            parameters = declare(self.node, SimulationParameters)
            going_on = inherited(ros_arguments(args), with_parameters=False)
            self.simulation = Simulation(self.node, executor, parameters, going_on)
        except Exception:
            self.node.destroy_node()
            raise
        group = ReentrantCallbackGroup()
        for service_type, name, callback in (
            (SpawnEntity, '~/spawn_entity', self._spawn_entity),
            (GetEntityState, '~/get_entity_state', self._get_entity_state),
        ):
            self.node.create_service(service_type, name, callback, callback_group=group)
        factor = parameters.real_time_factor
        self.node.get_logger().info(
            f"World '{parameters.world}', "
            + (f'real-time factor {factor:g}' if factor else 'as fast as possible')
            + f'; waiting for robots on {self.node.get_name()}/spawn_entity'
        )

    def close(self) -> None:
        """End the simulation and remove all nodes."""
        self.simulation.close()
        self.node.destroy_node()

    async def _spawn_entity(
        self, request: SpawnEntity.Request, response: SpawnEntity.Response
    ) -> SpawnEntity.Response:
        try:
            response.entity_name = await self._spawn(request)
            response.result.result = Result.RESULT_OK
            self.node.get_logger().info(f"Spawned '{response.entity_name}'")
        except Exception as error:  # a stranger's component may raise anything; others go on
            code = error.code if isinstance(error, SpawnError) else SpawnCode.OPERATION_FAILED
            _refuse(response.result, code, error)
            log_error(self.simulation.log, error)
        return response

    async def _spawn(self, request: SpawnEntity.Request) -> str:
        text = request.resource_string or self._read(request.uri)
        source = request.uri or request.name or 'robot_description'
        robot = read_description(text, source, self.simulation.log)
        name = request.name or robot.name
        frame = request.initial_pose.header.frame_id
        if frame not in ('', WORLD_FRAME):
            raise SpawnError(
                f"the initial pose is given in the frame '{frame}'; '{WORLD_FRAME}' is known here",
                SpawnCode.INVALID_POSE,
            )
        pose = transform_of(request.initial_pose.pose)
        return await self.simulation.spawn(
            name,
            robot,
            pose,
            _checked_namespace(request.entity_namespace),
            allow_renaming=request.allow_renaming,
        )

    def _read(self, uri: str) -> str:
        """Read the resource of a request. Raises SpawnError."""
        if not uri:
            raise SpawnError(
                'neither resource_string nor uri is given; one of them holds the URDF',
                SpawnCode.NO_RESOURCE,
            )
        try:
            return description_at(uri, warn=self.node.get_logger().warning)
        except (DescriptionError, SimulationError) as error:
            raise SpawnError(f"uri '{uri}': {error}", SpawnCode.NO_RESOURCE) from error

    async def _get_entity_state(
        self, request: GetEntityState.Request, response: GetEntityState.Response
    ) -> GetEntityState.Response:
        world = self.simulation.world

        def look() -> tuple:
            view = world.robot(request.entity)
            root = view.description.root.name
            return world.time, view.pose(root), view.velocity(root)

        try:
            time, pose, (linear, angular) = await self.simulation.owner.submit(look)
        except SimulationError as error:
            _refuse(response.result, SpawnCode.NOT_FOUND, error)
            return response
        state = response.state
        state.header.frame_id = WORLD_FRAME
        fill_stamp(time, state.header.stamp)
        fill_pose(pose, state.pose)
        fill_velocity(rotate(pose.rotation, linear), rotate(pose.rotation, angular), state.twist)
        response.result.result = Result.RESULT_OK
        return response


def _checked_namespace(namespace: str) -> str:
    """Return the namespace, absolute. Raises SpawnError."""
    absolute = f'/{namespace.removeprefix("/")}'
    try:
        validate_namespace(absolute)
    except InvalidNamespaceException as error:
        raise SpawnError(
            f"the entity's namespace is '{namespace}', which ROS does not allow: "
            f'{" ".join(str(error).split())}',
            SpawnCode.NAMESPACE_INVALID,
        ) from error
    return absolute


def _refuse(result: Result, code: int, error: Exception) -> None:
    result.result = code
    result.error_message = ' '.join(describe(error).split())


def simulate(args: list[str] | None) -> int:
    """Run until asked to stop; 1 when the owner's thread failed."""
    with ros(args) as stop:
        executor = SingleThreadedExecutor()
        with argument_errors():
            sim = MujocoSim(executor, sys.argv[1:] if args is None else args)
        owner = sim.simulation.owner
        executor.add_node(sim.node)
        is_stopping = False

        def wake() -> None:
            nonlocal is_stopping
            is_stopping = True
            executor.wake()

        try:
            with stop.on_stop(wake):
                sim.simulation.start()
                spin(executor, lambda: is_stopping or owner.failed)
        finally:
            sim.close()
            executor.shutdown()
    return 1 if owner.failed else 0


def main(args: list[str] | None = None) -> int:
    """Run the executable; return its exit code."""
    return program(lambda: simulate(args), stopped=0)


if __name__ == '__main__':
    sys.exit(main())
