# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""A robot in a simulation that stands still: spawned, controlled, and found by its topics."""

from collections.abc import Sequence
from dataclasses import dataclass

from controller_manager_msgs.srv import ListControllers
from rclpy.node import Node
from simulation_interfaces.srv import SpawnEntity

from amr_description.model.frames import Transform
from amr_description.nodes.converters import fill_pose
from amr_description.nodes.manager_client import ManagerClient
from amr_description.nodes.spawner import Spawner
from amr_description.nodes.spawner_arguments import parse
from amr_description.testing.lock_step import LockStep, PATIENCE

DRIVE = 'DiffDriveController'
"""How the types of drives end whose topics are looked for."""


@dataclass(frozen=True)
class DriveTopics:
    """Of the drive that is active, whatever they are remapped to."""

    command: str
    """geometry_msgs/msg/TwistStamped."""
    odometry: str
    """nav_msgs/msg/Odometry."""


def spawn(lock_step: LockStep, description: str, pose: Transform) -> str:
    """Put the robot into the world; return its name. Raises SimulationError."""
    request = SpawnEntity.Request(resource_string=description)
    fill_pose(pose, request.initial_pose.pose)
    response = lock_step.ask(
        SpawnEntity, resource_string=description, initial_pose=request.initial_pose
    )
    return response.entity_name


def spawn_controllers(lock_step: LockStep, names: Sequence[str] | None) -> DriveTopics | None:
    """
    Load, configure and activate controllers, in order; None: all that the manager has a type for.

    Return the topics of the first drive among them. Raises ControllerError, ParameterError.
    """
    manager = ManagerClient(lock_step.node, 'controller_manager', timeout=PATIENCE, silent=5.0)
    wanted = manager.typed_controllers() if names is None else [*names]
    if wanted:
        Spawner(lock_step.node, manager, parse(wanted)).spawn()
    for controller in manager.look(ListControllers).controller:
        if controller.type.endswith(DRIVE) and controller.state == 'active':
            return _topics_of(lock_step, controller.name)
    return None


def _topics_of(lock_step: LockStep, name: str) -> DriveTopics:
    node, wait = lock_step.node, lock_step.wait
    wait(lambda: _is_known(node, name), f"the node '{name}'")

    def commands() -> list[str]:
        found = node.get_subscriber_names_and_types_by_node(name, '/')
        return [topic for topic, types in found if 'geometry_msgs/msg/TwistStamped' in types]

    def odometry() -> list[str]:
        found = node.get_publisher_names_and_types_by_node(name, '/')
        return [topic for topic, types in found if 'nav_msgs/msg/Odometry' in types]

    return DriveTopics(
        command=wait(commands, f"the commands of '{name}'")[0],
        odometry=wait(odometry, f"the odometry of '{name}'")[0],
    )


def _is_known(node: Node, name: str) -> bool:
    return (name, '/') in node.get_node_names_and_namespaces()
