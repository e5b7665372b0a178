# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""A robot in a simulation that stands still: spawned, controlled, and found by its topics."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass

from controller_manager_msgs.srv import ListControllers
from simulation_interfaces.srv import SpawnEntity

from amr_description.model.frames import Transform
from amr_description.nodes.converters import fill_pose
from amr_description.nodes.manager_client import ManagerClient
from amr_description.nodes.spawner import Spawner
from amr_description.nodes.spawner_arguments import parse
from amr_description.testing.lock_step import LockStep, PATIENCE

DRIVE = 'DiffDriveController'
"""How the types of drives end whose topics are looked for."""


_BROADCASTER = 'JointStateBroadcaster'

type Found = Sequence[tuple[str, Sequence[str]]]
"""Names of topics, and their types."""


@dataclass(frozen=True)
class Topics:
    """Of the active controllers, whatever they are remapped to; empty: there is none."""

    command: str = ''
    """geometry_msgs/msg/TwistStamped, of the first drive."""
    odometry: str = ''
    """nav_msgs/msg/Odometry, of the same."""
    joints: str = ''
    """sensor_msgs/msg/JointState."""


def spawn(lock_step: LockStep, description: str, pose: Transform) -> str:
    """Put the robot into the world; return its name. Raises SimulationError."""
    request = SpawnEntity.Request(resource_string=description)
    fill_pose(pose, request.initial_pose.pose)
    response = lock_step.ask(
        SpawnEntity, resource_string=description, initial_pose=request.initial_pose
    )
    return response.entity_name


def spawn_controllers(lock_step: LockStep, names: Sequence[str] | None) -> Topics:
    """
    Load, configure and activate controllers, in order; None: all that the manager has a type for.

    Return the topics of those that are active then. Raises ControllerError, ParameterError.
    """
    manager = ManagerClient(lock_step.node, 'controller_manager', timeout=PATIENCE, silent=5.0)
    wanted = manager.typed_controllers() if names is None else [*names]
    if wanted:
        Spawner(lock_step.node, manager, parse(wanted)).spawn()
    listed = manager.look(ListControllers).controller
    active = [(each.type, each.name) for each in listed if each.state == 'active']
    drive = next((name for kind, name in active if kind.endswith(DRIVE)), None)
    broadcaster = next((name for kind, name in active if kind.endswith(_BROADCASTER)), None)
    node = lock_step.node

    def topic(owner: str | None, find: Callable[[str, str], Found], message_type: str) -> str:
        """The one that a node has of a type."""
        if owner is None:
            return ''

        def found() -> list[str]:
            if (owner, '/') not in node.get_node_names_and_namespaces():
                return []
            return [name for name, types in find(owner, '/') if message_type in types]

        return lock_step.wait(found, f"the {message_type} of '{owner}'")[0]

    publishers = node.get_publisher_names_and_types_by_node
    subscribers = node.get_subscriber_names_and_types_by_node
    return Topics(
        command=topic(drive, subscribers, 'geometry_msgs/msg/TwistStamped'),
        odometry=topic(drive, publishers, 'nav_msgs/msg/Odometry'),
        joints=topic(broadcaster, publishers, 'sensor_msgs/msg/JointState'),
    )
