# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
What moves of one robot: its topics, read into a state when the page's server asks for one.

Made and destroyed on the ROS thread, read on the server's.
"""

from collections.abc import Callable, Sequence
from typing import Any

from control_msgs.msg import DynamicJointState
from geometry_msgs.msg import Twist, TwistStamped
from nav_msgs.msg import Odometry
import numpy as np
from rclpy.node import Node
from sensor_msgs.msg import JointState

from amr_description.nodes.polled_topic import PolledTopic
from amr_description.viewer.discovery import FoundRobot, TWISTS
from amr_description.viewer.protocol import RobotLayout
from amr_description.viewer.states import RobotFloats

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
            'odometry': lambda message, floats: _write_motion(message, floats.odometry),
            'truth': lambda message, floats: _write_motion(message, floats.truth),
            'wheels': self._write_wheels,
            'command': _write_command,
        }
        command = found.command
        topics = {
            'joint_states': (JointState, found.joint_states),
            'odometry': (Odometry, found.odometry),
            'truth': (Odometry, found.truth),
            'wheels': (DynamicJointState, found.wheels),
            'command': (COMMAND_TYPES[command.message], command.topic)
            if command
            else (None, None),
        }
        self._topics = {
            part: PolledTopic(node, message_type, topic)
            for part, (message_type, topic) in topics.items()
            if topic is not None
        }

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
        if 'wheels' in new and tuple(self._latest['wheels'].joint_names) != self.layout.wheels:
            wheels = tuple(self._latest['wheels'].joint_names)
            self.layout = RobotLayout(self.layout.id, self.layout.joints, wheels)
        return new

    def write(self, floats: RobotFloats, parts: Sequence[str] | None = None) -> None:
        """Write these parts, or all, as they were last heard."""
        for part in self._latest if parts is None else parts:
            self._writers[part](self._latest[part], floats)

    def _write_joints(self, message: JointState, floats: RobotFloats) -> None:
        for values, target in (
            (message.position, floats.positions),
            (message.velocity, floats.velocities),
        ):
            for name, value in zip(message.name, values, strict=False):  # one may be left empty
                index = self._joints.get(name)
                if index is not None:
                    target[index] = value

    def _write_wheels(self, message: DynamicJointState, floats: RobotFloats) -> None:
        for index, interfaces in enumerate(message.interface_values):
            values = dict(zip(interfaces.interface_names, interfaces.values, strict=False))
            floats.wheels[index] = [values.get(name, np.nan) for name in _WHEEL_VALUES]


def _write_motion(message: Odometry, floats: np.ndarray) -> None:
    pose, twist = message.pose.pose, message.twist.twist
    p, q = pose.position, pose.orientation
    floats[:] = (p.x, p.y, p.z, q.x, q.y, q.z, q.w, twist.linear.x, twist.angular.z)


def _write_command(message: Any, floats: RobotFloats) -> None:
    twist = getattr(message, 'twist', message)
    floats.command[:] = (twist.linear.x, twist.angular.z)
