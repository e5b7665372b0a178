# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""A robot of a simulation in lock-step: spawned, controlled, and read by its topics."""

from collections.abc import Callable, Sequence
from contextlib import closing
from pathlib import Path
from typing import Any, TypeAlias

from geometry_msgs.msg import Twist, TwistStamped
from nav_msgs.msg import Odometry
from rclpy.node import Node
from sensor_msgs.msg import JointState
from simulation_interfaces.srv import SpawnEntity

from amr_description.control.ros.client import ManagerClient, SPAWNER_SERVICES
from amr_description.errors import SimulationError
from amr_description.model.controller_files import declared_controllers, manager_of
from amr_description.model.frames import Transform
from amr_description.model.gazebo.bridge import Bridge, bridged, NO_BRIDGE
from amr_description.model.gazebo.translation import translate
from amr_description.model.robot import Robot as Description
from amr_description.ros.log_thread import LoggerLog
from amr_description.ros.messages import fill_pose
from amr_description.simulation.api import namespace_of, RobotApi
from amr_description.simulation.readings import Joint, Motion
from amr_description.simulation.spawn_cost import patience_with
from amr_description.simulation.spawned_controllers import (
    BROADCASTER,
    spawn_declared,
    Topics,
    topics_of,
)
from amr_description.simulation.tracebacks import is_for_the_test
from amr_description.testing.lock_step import LatestMessage, LockStep, TIMEOUT
from amr_description.testing.readings import joints_of, motion_of_entity, motion_of_odometry
from amr_description.testing.sensors import RobotReadings

__tracebackhide__ = is_for_the_test

TopicTypes: TypeAlias = Sequence[tuple[str, Sequence[str]]]
"""Names of topics, and their types."""


class Robot(RobotApi):
    """
    One robot of a simulation: its odometry, its joint states, and the ground truth.

    Every method raises SimulationError, in one line, when the simulator refuses or has ended.
    """

    def __init__(
        self,
        lock_step: LockStep,
        readings: Node,
        name: str,
        namespace: str,
        topics: Topics,
        sensors: RobotReadings,
    ) -> None:
        """Subscribe to the topics; ``readings``: the node of the subscriptions."""
        self.name = name
        """The name of the entity."""
        self.namespace = namespace
        self.command_topic = topics.command
        """Of the controller that drives, or of a plugin of Gazebo; empty: there is none."""
        self._is_stamped = topics.is_stamped
        self._lock_step = lock_step
        self._odometry = _latest(readings, Odometry, topics.odometry)
        self._joints = _latest(readings, JointState, topics.joints)
        self._sensors = sensors

    def twist(self, linear: float, angular: float) -> TwistStamped | Twist:
        """Return a command, m/s and rad/s, of the type that :attr:`command_topic` has."""
        twist = Twist()
        twist.linear.x, twist.angular.z = float(linear), float(angular)
        return TwistStamped(twist=twist) if self._is_stamped else twist

    @property
    def truth(self) -> Motion:
        """How the robot's root link really moves in the world, at this instant."""
        return motion_of_entity(self._lock_step.state(self.name))

    @property
    def odometry(self) -> Motion:
        """The last odometry of the drive, with its own stamp (:attr:`Motion.time`)."""
        return motion_of_odometry(self._newest(self._odometry, 'drive'))

    @property
    def joints(self) -> dict[str, Joint]:
        """The last state of each joint, by name, from the JointStateBroadcaster."""
        return joints_of(self._newest(self._joints, BROADCASTER))

    def silent_topics(self) -> list[str]:
        """Return the topics without a message since :meth:`forget`."""
        return [topic.topic for topic in self._topics if topic.take() is None]

    def forget(self) -> None:
        """Drop the messages so far: time went back."""
        for topic in self._topics:
            topic.forget()

    def close(self) -> None:
        """Remove the subscriptions."""
        for topic in self._topics:
            topic.close()
        self._sensors.close()

    @property
    def _topics(self) -> list[LatestMessage]:
        return [topic for topic in (self._joints, self._odometry) if topic is not None]

    def _newest(self, topic: LatestMessage | None, controller: str) -> Any:
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
    Spawn a robot; return the name of the entity.

    Args:
        lock_step: The simulator.
        description: The URDF.
        pose: Transform from the root link to the world.
        name: Of the entity; empty: that of the URDF.
        namespace: Of the controller manager; empty: what the URDF says, or none.

    Raises:
        SimulationError: The simulator rejects the robot.
    """
    request = SpawnEntity.Request()
    fill_pose(pose, request.initial_pose.pose)
    response = lock_step.ask(
        SpawnEntity,
        timeout=patience_with(description, TIMEOUT),
        name=name,
        entity_namespace=namespace,
        resource_string=description,
        initial_pose=request.initial_pose,
    )
    return response.entity_name


def _latest(readings: Node, message_type: Any, topic: str) -> LatestMessage | None:
    return LatestMessage(readings, message_type, topic) if topic else None


def spawn_controllers(
    lock_step: LockStep,
    description: Description,
    files: Sequence[Path],
    names: Sequence[str] | None,
    namespace: str = '',
    bridge: Bridge = NO_BRIDGE,
) -> Topics:
    """
    Load, configure and activate controllers; return the topics of the active ones.

    Args:
        lock_step: The simulator.
        description: The robot, which names its manager.
        files: The parameter files of the controllers.
        names: The controllers, in order; None: all that the files have types for. One that cannot
            be, or claims what another one has claimed, is then left out or inactive, with a
            warning.
        namespace: Of the controller manager; empty: what the URDF says, or none.
        bridge: What topics of Gazebo are called.

    Raises:
        ControllerError, ParameterError: A controller that is named cannot be spawned.
    """
    inside, manager_name = namespace_of(description, namespace), manager_of(description)[1]
    name = f'{inside.rstrip("/")}/{manager_name}'
    node = lock_step.node
    client = ManagerClient(node, name, timeout=TIMEOUT, silent=5.0, soon=SPAWNER_SERVICES)

    def topic(controller: str, find: Callable[[str, str], TopicTypes], message_type: str) -> str:
        """Return the topic of a type that the node of a controller has."""

        def found() -> list[str]:
            if (controller, inside) not in node.get_node_names_and_namespaces():
                return []
            return [name for name, types in find(controller, inside) if message_type in types]

        return str(lock_step.wait(found, f"the {message_type} of '{controller}'")[0])

    subscribers = node.get_subscriber_names_and_types_by_node
    publishers = node.get_publisher_names_and_types_by_node
    with closing(client) as manager:
        declared = declared_controllers(files, inside, manager_name)
        spawn_declared(LoggerLog(node.get_logger()), manager, declared, names)
        return topics_of(
            manager,
            lambda controller, kind: topic(controller, subscribers, kind),
            lambda controller, kind: topic(controller, publishers, kind),
            bridged(translate(description, files, inside), bridge),
            inside,
        )
