# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
How a robot is held at rest: by its lock, and by a zero for every command of others.

The lock is the topic ``emergency_stop`` (``std_msgs/msg/Bool``) in the robot's namespace, as
``twist_mux`` and many real robots have one; the controllers of this package subscribe to it.

Made and destroyed on the ROS thread.
"""

from collections.abc import Callable
from contextlib import suppress
from typing import Any

from rclpy.exceptions import InvalidHandle
from rclpy.node import Node
from rclpy.qos import DurabilityPolicy, QoSProfile, ReliabilityPolicy
from rclpy.subscription import Subscription
from std_msgs.msg import Bool

from amr_description.viewer.graph import FoundRobot
from amr_description.viewer.ros.robot_topics import COMMAND_TYPES

LOCK = 'emergency_stop'
_REPEATED = QoSProfile(
    depth=1,
    reliability=ReliabilityPolicy.RELIABLE,
    durability=DurabilityPolicy.TRANSIENT_LOCAL,
)
_EVERY = 2
"""The lock is published once in this many calls of :meth:`Lock.hold`: 10 times per second."""


def lock_topic(robot: str) -> str:
    """Return the topic of the lock of a robot, by its id."""
    return f'{robot.rstrip("/")}/{LOCK}'


class Lock:
    """The lock of one robot."""

    def __init__(self, node: Node, robot: str) -> None:
        self._node = node
        self._publisher = node.create_publisher(Bool, lock_topic(robot), _REPEATED)
        self._calls: int | None = None
        """Since it was engaged; None: it is not."""

    def hold(self) -> None:
        """Engage it, or keep it engaged: for locks with a time-out, and for late subscribers."""
        calls, self._calls = self._calls or 0, (self._calls or 0) + 1
        if calls % _EVERY == 0:
            self._publish(True)

    def release(self) -> None:
        """Release it, if it is engaged."""
        if self._calls is not None:
            self._calls = None
            self._publish(False)

    def destroy(self) -> None:
        """Publish nothing more; who has the lock engaged keeps it."""
        self._node.destroy_publisher(self._publisher)

    def _publish(self, value: bool) -> None:
        with suppress(InvalidHandle):  # the ROS thread has destroyed it in the meantime
            self._publisher.publish(Bool(data=value))


class CommandAnswer:
    """
    Calls back at once for each command that would move the robot.

    The executor serves it: a poll would leave the command in force for a cycle of its controller.
    """

    def __init__(self, node: Node, found: FoundRobot, answer: Callable[[], None]) -> None:
        self._node = node
        self._answer = answer
        self._subscription: Subscription | None = None
        if found.command is not None:
            self._subscription = node.create_subscription(
                COMMAND_TYPES[found.command.message],
                found.command.topic,
                self._on_command,
                QoSProfile(depth=10, reliability=ReliabilityPolicy.BEST_EFFORT),
            )

    def destroy(self) -> None:
        """Answer no more."""
        if self._subscription is not None:
            self._node.destroy_subscription(self._subscription)
            self._subscription = None

    def _on_command(self, message: Any) -> None:
        twist = getattr(message, 'twist', message)
        if any((twist.linear.x, twist.linear.y, twist.angular.z)):
            self._answer()
