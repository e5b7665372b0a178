# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
What moves of one robot: its topics, read into a state when the page's server asks for one.

Made and destroyed on the ROS thread, read on the server's.
"""

from collections.abc import Callable, Iterator, Sequence
import math
from typing import Any

from control_msgs.msg import DynamicJointState
from geometry_msgs.msg import Twist, TwistStamped
from nav_msgs.msg import Odometry
from rclpy.node import Node
from sensor_msgs.msg import JointState

from amr_description.nodes.cdr import (
    InterfaceValues,
    JointValues,
    read_dynamic_joint_state,
    read_joint_state,
    read_odometry,
    read_twist,
    read_twist_stamped,
)
from amr_description.nodes.polled_topic import PolledTopic
from amr_description.nodes.viewer_introspection import CommandedVelocities
from amr_description.viewer.discovery import FoundRobot, TWISTS
from amr_description.viewer.protocol import RobotLayout
from amr_description.viewer.states import Floats, RobotFloats

COMMAND_TYPES = dict(zip(TWISTS, (TwistStamped, Twist), strict=True))
_WHEEL_VALUES = ('contact', 'normal_force', 'slip_along', 'slip_across')


class RobotTopics:
    """The moving part of a robot; ``joints``: those of its description."""

    def __init__(self, node: Node, found: FoundRobot, joints: Sequence[str]) -> None:
        self.found = found
        self._joints = {name: index for index, name in enumerate(joints)}
        self.layout = RobotLayout(found.id, tuple(joints), ())
        """What there is to tell; it changes when the wheels are heard of."""
        self._latest: dict[str, Any] = {}
        self._writers: dict[str, Callable[[Any, RobotFloats], None]] = {
            'joint_states': self._write_joints,
            'commanded': lambda values, floats: _copy(values, floats.commanded),
            'odometry': lambda motion, floats: _copy(motion, floats.odometry),
            'truth': lambda motion, floats: _copy(motion, floats.truth),
            'wheels': _write_wheels,
            'command': lambda command, floats: _copy(command, floats.command),
        }
        self._topics: dict[str, PolledTopic[Any] | CommandedVelocities] = {
            part: PolledTopic(node, message_type, topic, read)
            for part, message_type, topic, read in _sources(found)
            if topic is not None
        }
        if found.introspection is not None:
            self._topics['commanded'] = CommandedVelocities(node, found.introspection, joints)

    def destroy(self) -> None:
        """Listen no more."""
        for topic in self._topics.values():
            topic.destroy()

    def take(self) -> list[str]:
        """Look at the topics; return which of the parts have something new."""
        new = []
        for part, topic in self._topics.items():
            message = topic.take()
            if message is not None:
                self._latest[part] = message
                new.append(part)
        if 'wheels' in new and tuple(self._latest['wheels'].names) != self.layout.wheels:
            wheels = tuple(self._latest['wheels'].names)
            self.layout = RobotLayout(self.layout.id, self.layout.joints, wheels)
        return new

    def write(self, floats: RobotFloats, parts: Sequence[str] | None = None) -> None:
        """Write these parts, or all, as they were last heard."""
        for part in self._latest if parts is None else parts:
            self._writers[part](self._latest[part], floats)

    def _write_joints(self, message: JointValues, floats: RobotFloats) -> None:
        for values, target in (
            (message.positions, floats.positions),
            (message.velocities, floats.velocities),
        ):
            for name, value in zip(message.names, values, strict=False):  # one may be left empty
                index = self._joints.get(name)
                if index is not None:
                    target[index] = value


def _sources(found: FoundRobot) -> Iterator[tuple[str, Any, str | None, Callable[[bytes], Any]]]:
    """Yield part, message type, topic, and how a message is read."""
    yield 'joint_states', JointState, found.joint_states, read_joint_state
    yield 'odometry', Odometry, found.odometry, read_odometry
    yield 'truth', Odometry, found.truth, read_odometry
    yield 'wheels', DynamicJointState, found.wheels, read_dynamic_joint_state
    if found.command is not None:
        message_type = COMMAND_TYPES[found.command.message]
        read = read_twist if message_type is Twist else read_twist_stamped
        yield 'command', message_type, found.command.topic, read


def _write_wheels(message: InterfaceValues, floats: RobotFloats) -> None:
    for index, values in enumerate(message.values[: len(floats.wheels)]):
        floats.wheels[index] = [values.get(name, math.nan) for name in _WHEEL_VALUES]


def _copy(values: tuple[float, ...], floats: Floats) -> None:
    floats[:] = values
