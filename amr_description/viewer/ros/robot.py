# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""What connects the viewer with one robot or simulator of the graph, made on the ROS thread."""

from collections.abc import Callable, Mapping
from typing import Any

from controller_manager_msgs.msg import ControllerManagerActivity
from geometry_msgs.msg import Twist, TwistStamped
from rclpy.exceptions import InvalidHandle
from rclpy.node import Node
from rclpy.publisher import Publisher
from rclpy.qos import DurabilityPolicy, QoSProfile
from sensor_msgs.msg import JointState
from std_msgs.msg import String
from visualization_msgs.msg import MarkerArray

from amr_description.errors import ViewerError
from amr_description.ros.messages import fill_stamp
from amr_description.viewer.graph import FoundRobot
from amr_description.viewer.protocol import RobotInfo
from amr_description.viewer.ros.description import describe_robot, DescribedRobot
from amr_description.viewer.ros.robot_topics import COMMAND_TYPES, RobotTopics

LATCHED = QoSProfile(depth=1, durability=DurabilityPolicy.TRANSIENT_LOCAL)
_FRAME = 'base_link'


class RobotLink:
    """
    One robot: its description, its moving parts, and the way to command it.

    ``on_change`` is called with the link when its description comes, ``on_activity`` when a state
    of a controller has changed; both on the ROS thread.
    """

    def __init__(
        self,
        node: Node,
        found: FoundRobot,
        on_change: Callable[['RobotLink'], None],
        on_activity: Callable[['RobotLink'], None],
    ) -> None:
        self.found = found
        self.described: DescribedRobot | None = None
        self.topics = RobotTopics(node, found, ())
        self._node = node
        self._on_change = on_change
        self._on_activity = on_activity
        self._description = node.create_subscription(
            String, found.description, lambda message: self.describe(message.data), LATCHED
        )
        self._activity: Any = None
        self._commands: Publisher | None = None
        self._joints: Publisher | None = None
        self._open_commands()
        self._open_joints()
        self._listen_to_activity()

    @property
    def info(self) -> RobotInfo:
        """What pages are told of it."""
        found = self.found
        return RobotInfo(
            id=found.id,
            name=self.described.name if self.described else '',
            command=found.command,
            odometry=found.odometry,
            truth=found.truth,
            wheels=found.wheels,
            joint_states=found.joint_states,
            joint_publisher=found.joint_publisher,
            manager=found.manager,
        )

    def follow(self, found: FoundRobot) -> None:
        """
        Its topics have changed.

        What is published where it was stays: a new publisher loses what it says before others
        know it, such as a stop.
        """
        before, self.found = self.found, found
        self.topics.destroy()  # first: in one process a topic cannot have two types at a time
        if found.command != before.command:
            self._open_commands()
        if found.joint_publisher != before.joint_publisher:
            self._open_joints()
        if found.activity != before.activity:
            self._listen_to_activity()
        self._listen()

    def destroy(self) -> None:
        """It is gone."""
        for publisher in (self._commands, self._joints):
            if publisher is not None:
                self._node.destroy_publisher(publisher)
        self._commands = self._joints = None
        for subscription in (self._description, self._activity):
            if subscription is not None:
                self._node.destroy_subscription(subscription)
        self.topics.destroy()

    def drive(self, linear: float, angular: float, time: int) -> None:
        """Publish a command, m/s and rad/s, stamped ``time`` (ns); on any thread."""
        publisher = self._commands
        if publisher is None:
            raise ViewerError(
                f'nothing hears velocity commands of {self.found.id}; is its drive controller '
                'active?'
            )
        message = publisher.msg_type()
        twist = message
        if isinstance(message, TwistStamped):
            fill_stamp(time, message.header.stamp)
            message.header.frame_id = _FRAME
            twist = message.twist
        assert isinstance(twist, Twist), 'the only other type'
        twist.linear.x, twist.angular.z = linear, angular
        self._publish(publisher, message)

    def set_joints(self, positions: Mapping[str, float], time: int) -> None:
        """Have joint_state_publisher publish these, rad or m; on any thread."""
        publisher = self._joints
        if publisher is None:
            raise ViewerError(
                f'no joint_state_publisher takes positions of {self.found.id}; the joints are '
                'moved by controllers'
            )
        message = JointState(name=list(positions), position=list(positions.values()))
        fill_stamp(time, message.header.stamp)
        self._publish(publisher, message)

    def _publish(self, publisher: Publisher, message: Any) -> None:
        try:
            publisher.publish(message)
        except InvalidHandle:  # the ROS thread has just destroyed it
            raise ViewerError(f'{self.found.id} is just going') from None

    def _open_commands(self) -> None:
        command = self.found.command
        kind, topic = (COMMAND_TYPES[command.message], command.topic) if command else (None, None)
        self._commands = _instead_of(self._commands, self._node, kind, topic)

    def _open_joints(self) -> None:
        node = self.found.joint_publisher
        topic = node and f'{node}/set_joint_positions'
        self._joints = _instead_of(self._joints, self._node, JointState, topic)

    def _listen_to_activity(self) -> None:
        topic = self.found.activity
        if self._activity is not None:
            self._node.destroy_subscription(self._activity)
        self._activity = topic and self._node.create_subscription(
            ControllerManagerActivity, topic, lambda _: self._on_activity(self), LATCHED
        )

    def _listen(self) -> None:
        self.topics.destroy()
        joints = self.described.joints if self.described else ()
        self.topics = RobotTopics(self._node, self.found, joints)

    def describe(self, text: str) -> None:
        """Take a description."""
        if self.described is not None and self.described.message.urdf == text:
            return
        self.described = describe_robot(self.found.id, text)
        self._listen()
        self._on_change(self)


def _instead_of(
    publisher: Publisher | None, node: Node, kind: Any, topic: str | None
) -> Publisher | None:
    """Destroy a publisher, and return the one for this topic, if there is one."""
    if publisher is not None:
        node.destroy_publisher(publisher)
    return node.create_publisher(kind, topic, 10) if topic else None


class WorldLink:
    """The surroundings that a simulator publishes."""

    def __init__(self, node: Node, topic: str, on_world: Callable[[MarkerArray], None]) -> None:
        self.topic = topic
        self._node = node
        self._subscription = node.create_subscription(MarkerArray, topic, on_world, LATCHED)

    def destroy(self) -> None:
        """It is gone."""
        self._node.destroy_subscription(self._subscription)
