# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""A robot in a simulation that stands still: spawned, controlled, and found by its topics."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass
import math
from typing import Any

from controller_manager_msgs.srv import ListControllers
from nav_msgs.msg import Odometry
from rclpy.node import Node
from sensor_msgs.msg import JointState
from simulation_interfaces.srv import SpawnEntity

from amr_description.control.ros.client import ManagerClient
from amr_description.control.ros.spawner import Spawner
from amr_description.control.ros.spawner_arguments import parse
from amr_description.errors import SimulationError
from amr_description.model.frames import Transform
from amr_description.ros.messages import fill_pose
from amr_description.testing.lock_step import Latest, LockStep, PATIENCE
from amr_description.testing.readings import (
    Joint,
    joints_of,
    Motion,
    motion_of_entity,
    motion_of_odometry,
)

DRIVE = 'DiffDriveController'
"""How the types of drives end whose topics are looked for."""
_BROADCASTER = 'JointStateBroadcaster'
_STILL = 1e-3
"""m/s and rad/s: slower is taken for standing."""

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


class Robot:
    """
    One robot of a simulation: what it says, and where it really is.

    Every method raises SimulationError, in one line, when the simulator refuses or has ended.
    """

    def __init__(
        self, lock_step: LockStep, readings: Node, name: str, namespace: str, topics: Topics
    ) -> None:
        """``readings``: a node that is in no executor."""
        self.name = name
        """As the simulator knows it."""
        self.namespace = namespace
        self.command_topic = topics.command
        """Of the drive; empty: there is none."""
        self._lock_step = lock_step
        self._odometry = _latest(readings, Odometry, topics.odometry)
        self._joints = _latest(readings, JointState, topics.joints)

    @property
    def truth(self) -> Motion:
        """How the robot's root link really moves in the world, at this instant."""
        return motion_of_entity(self._lock_step.state(self.name))

    @property
    def odometry(self) -> Motion:
        """What the drive's odometry said last, by its own stamp (:attr:`Motion.time`)."""
        return motion_of_odometry(self._newest(self._odometry, DRIVE))

    @property
    def joints(self) -> dict[str, Joint]:
        """What the JointStateBroadcaster said last, by the names of the joints."""
        return joints_of(self._newest(self._joints, _BROADCASTER))

    @property
    def moves(self) -> bool:
        """Whether it does more than stand."""
        truth = self.truth
        return math.hypot(*truth.linear) > _STILL or math.hypot(*truth.angular) > _STILL

    def unheard(self) -> list[str]:
        """Return the topics from which nothing has come since :meth:`forget`."""
        return [topic.topic for topic in self._topics if topic.take() is None]

    def forget(self) -> None:
        """Drop what has come: time went back."""
        for topic in self._topics:
            topic.forget()

    def close(self) -> None:
        """Listen no more."""
        for topic in self._topics:
            topic.close()

    @property
    def _topics(self) -> list[Latest]:
        return [topic for topic in (self._joints, self._odometry) if topic is not None]

    def _newest(self, topic: Latest | None, controller: str) -> Any:
        if topic is None:
            raise SimulationError(f"'{self.name}' began without an active {controller}")
        if not self._lock_step.time:
            raise SimulationError(
                f'nothing is on {topic.topic} at time 0; let time pass: step(), run() or drive()'
            )
        found = topic.take()
        return found or self._lock_step.wait(topic.take, f"a message on '{topic.topic}'", 5.0)


def spawn(
    lock_step: LockStep, description: str, pose: Transform, name: str = '', namespace: str = ''
) -> str:
    """
    Put a robot into the world; return its name, that of the URDF by default. SimulationError.
    """
    request = SpawnEntity.Request()
    fill_pose(pose, request.initial_pose.pose)
    response = lock_step.ask(
        SpawnEntity,
        name=name,
        entity_namespace=namespace,
        resource_string=description,
        initial_pose=request.initial_pose,
    )
    return response.entity_name


def _latest(readings: Node, message_type: Any, topic: str) -> Latest | None:
    return Latest(readings, message_type, topic) if topic else None


def spawn_controllers(
    lock_step: LockStep, names: Sequence[str] | None, namespace: str = ''
) -> Topics:
    """
    Load, configure and activate controllers, in order; None: all that the manager has a type for.

    Return the topics of those that are active then. Raises ControllerError, ParameterError.
    """
    inside = f'/{namespace.strip("/")}'
    manager = ManagerClient(
        lock_step.node,
        f'{inside.rstrip("/")}/controller_manager',
        timeout=PATIENCE,
        silent=5.0,
    )
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
            if (owner, inside) not in node.get_node_names_and_namespaces():
                return []
            return [name for name, types in find(owner, inside) if message_type in types]

        return lock_step.wait(found, f"the {message_type} of '{owner}'")[0]

    publishers = node.get_publisher_names_and_types_by_node
    subscribers = node.get_subscriber_names_and_types_by_node
    return Topics(
        command=topic(drive, subscribers, 'geometry_msgs/msg/TwistStamped'),
        odometry=topic(drive, publishers, 'nav_msgs/msg/Odometry'),
        joints=topic(broadcaster, publishers, 'sensor_msgs/msg/JointState'),
    )
