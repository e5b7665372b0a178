# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
The connections of the viewer with one robot, and with the world of one simulator.

They are created and destroyed on the ROS thread. The server's thread has of a connection what a
:class:`~amr_description.viewer.ros.threads.ServedRobot` has: it publishes commands.
"""

from collections.abc import Callable, Mapping, Set as AbstractSet
from contextlib import suppress
from typing import Any

from controller_manager_msgs.msg import ControllerManagerActivity
from geometry_msgs.msg import Twist, TwistStamped
from rclpy.duration import Duration
from rclpy.exceptions import InvalidHandle
from rclpy.node import Node
from rclpy.publisher import Publisher
from rclpy.topic_endpoint_info import TopicEndpointInfo
from sensor_msgs.msg import JointState
from std_msgs.msg import String
from visualization_msgs.msg import MarkerArray

from amr_description.errors import AmrError, ViewerError
from amr_description.ros.messages import fill_stamp
from amr_description.ros.qos import LATCHED
from amr_description.viewer.backend import Hold
from amr_description.viewer.description import describe_robot, DescribedRobot
from amr_description.viewer.graph import FoundRobot
from amr_description.viewer.protocol import Commanders, RobotInfo
from amr_description.viewer.requests import Part
from amr_description.viewer.ros.joint_commands import JointCommands
from amr_description.viewer.ros.robot_topics import COMMAND_TYPES, RobotTopics
from amr_description.viewer.ros.stopping import CommandAnswer, Lock, lock_topic

_COMMAND_FRAME = 'base_link'
_ACK_TIMEOUT = Duration(seconds=0.5)
"""For the last command, a stop, to arrive before its publisher is gone."""


class RobotConnection:
    """
    One robot: its description, the topics of what moves, and the publishers of commands.

    Args:
        node: of the viewer.
        found: the robot's topics and nodes.
        on_description: called on the ROS thread when the description was received or changed.
        on_activity: called on the ROS thread when the state of a controller has changed.
    """

    def __init__(
        self,
        node: Node,
        found: FoundRobot,
        on_description: Callable[['RobotConnection'], None],
        on_activity: Callable[['RobotConnection'], None],
    ) -> None:
        self.found = found
        self.described: DescribedRobot | None = None
        self._watched: AbstractSet[Part] = frozenset()
        self.topics = RobotTopics(node, found, ())
        self._node = node
        self._on_description = on_description
        self._on_activity = on_activity
        self._description = node.create_subscription(
            String, found.description, lambda message: self.set_description(message.data), LATCHED
        )
        self._activity: Any = None
        self._commands: Publisher | None = None
        self._joints: Publisher | None = None
        self.commands = JointCommands(node, found.id)
        """The joints that controllers let pages move."""
        self.commanders: tuple[str, ...] = ()
        """The other nodes with a publisher on the command topic."""
        self.drives: frozenset[str] = frozenset()
        """The nodes that take the commands."""
        self.deactivated: tuple[str, ...] = ()
        """The controllers that were deactivated to stop it; of the server's thread."""
        self.timeout: float | None = None
        """s after which its controller takes a command for outdated; None: not known."""
        self._lock = Lock(node, found.id)
        self._answer: CommandAnswer | None = None
        self.is_locked = False
        """Whether what drives it has subscribed to its lock."""
        self._needs_zeros = True
        self._is_held = False
        self._held_at = 0
        """ROS time of the last call of :meth:`hold`, ns: commands of others come in between."""
        self._advertise_commands()
        self._advertise_joints()
        self._subscribe_activity()
        self.look()

    @property
    def info(self) -> RobotInfo:
        """The robot as in the graph message."""
        found = self.found
        return RobotInfo(
            id=found.id,
            name=self.described.name if self.described else '',
            present=found.is_present,
            command=found.command,
            odometry=found.odometry,
            truth=found.truth,
            wheels=found.wheels,
            joint_states=found.joint_states,
            joint_publisher=found.joint_publisher,
            manager=found.manager,
        )

    def set_description(self, text: str) -> None:
        """Read a description, unless it is the present one."""
        if self.described is not None and self.described.message.urdf == text:
            return
        self.described = describe_robot(self.found.id, text)
        self._subscribe_topics()
        self._on_description(self)

    def watch(self, parts: AbstractSet[Part]) -> None:
        """Subscribe, of what is collected on demand, to these parts, and no others."""
        self._watched = parts
        self.topics.watch(parts)

    def update(self, found: FoundRobot) -> None:
        """
        Follow a change of the robot's topics.

        A publisher whose topic has not changed is kept: what a new one publishes before it is
        matched with its subscribers is lost, and that could be a stop.
        """
        before, self.found = self.found, found
        self.topics.destroy()  # first: in one process a topic can only have one type
        if found.command != before.command:
            self._advertise_commands()
            self.timeout = None
            self._end_answer()
        if found.joint_publisher != before.joint_publisher:
            self._advertise_joints()
        if found.activity != before.activity:
            self._subscribe_activity()
        self._subscribe_topics()
        self.look()
        self.answer(self._is_held)

    def look(self) -> None:
        """Look at who is at the other ends of its topics; on the ROS thread, now and then."""
        node, command = self._node, self.found.command
        topic = None if command is None else command.topic
        publishers = [] if topic is None else node.get_publishers_info_by_topic(topic)
        subscribers = [] if topic is None else node.get_subscriptions_info_by_topic(topic)
        locked = node.get_subscriptions_info_by_topic(lock_topic(self.found.id))
        own = node.get_fully_qualified_name()
        self.commanders = tuple(sorted({_full_name(each) for each in publishers} - {own}))
        self.drives = frozenset(map(_full_name, subscribers)) - {own}
        # A recorder subscribes to every topic; a lock is one of who drives, or of a multiplexer.
        ends = self.drives | {*self.commanders}
        self.is_locked = any(_full_name(each) in ends for each in locked)
        topics = self.topics
        dead = {
            part
            for part, name in (
                ('odometry', self.found.odometry),
                ('truth', self.found.truth),
                ('joint_states', self.found.joint_states),
            )
            if name is not None and not node.count_publishers(name)
        }
        if not self.commanders and self.timeout != 0.0:
            dead.add('command')
        topics.unpublished = frozenset(dead)

    def answer(self, is_held: bool) -> None:
        """Answer each command of others with a zero, or do so no more; on the ROS thread."""
        self._is_held = is_held
        if not is_held:
            self._end_answer()
        elif self._answer is None:
            self._answer = CommandAnswer(self._node, self.found, self._on_command)

    def set_timeout(self, timeout: float) -> None:
        """Have commands expire after this many s, 0: never; on any thread."""
        self.timeout = timeout
        if self.topics.command is not None:
            self.topics.command.timeout = timeout

    def hold(self, time: int, now: float) -> Hold:
        """
        Hold the robot at rest: to be called again and again.

        Args:
            time: ROS time, ns.
            now: s of a monotonic clock.
        """
        self._held_at = time
        self._lock.hold()
        motion = self.topics.motion(now)
        is_still = motion is not None and motion < 1.0
        self._needs_zeros = not (self.is_locked and is_still)
        if self._needs_zeros and self._commands is not None:
            self._command_zero(time)
        return Hold(motion, self.is_locked, (), self.deactivated)

    def commanded_by(self, now: float) -> Commanders:
        """
        Return who else commands it, with a rate in whole Hz: this is sent on changes.

        ``now`` is the time of a monotonic clock, s.
        """
        command = self.topics.command
        rate = 0.0 if command is None else command.rate(now)
        return Commanders(self.found.id, self.commanders, _whole(rate))

    def hold_joints(self) -> None:
        """Stop the joints that pages have moved by controllers."""
        self.commands.hold(self.topics.positions())

    def release(self) -> None:
        """Hold it no more."""
        self._lock.release()

    def _on_command(self) -> None:
        if self._needs_zeros:
            self._command_zero(self._held_at)

    def _command_zero(self, time: int) -> None:
        with suppress(AmrError):  # it is just going
            self.drive(0.0, 0.0, 0.0, time)

    def _end_answer(self) -> None:
        if self._answer is not None:
            self._answer.destroy()
            self._answer = None

    def destroy(self) -> None:
        """Destroy all publishers and subscriptions."""
        for publisher in (self._commands, self._joints):
            if publisher is not None:
                _destroy_publisher(self._node, publisher)
        self._commands = self._joints = None
        self.commands.destroy()
        self._lock.destroy()
        self._end_answer()
        for subscription in (self._description, self._activity):
            if subscription is not None:
                self._node.destroy_subscription(subscription)
        self.topics.destroy()

    def drive(self, linear: float, angular: float, sideways: float, time: int) -> None:
        """Publish a command, m/s, rad/s and m/s, stamped ``time`` (ns). Raises ViewerError."""
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
            message.header.frame_id = _COMMAND_FRAME
            twist = message.twist
        assert isinstance(twist, Twist), 'the only other type'
        twist.linear.x, twist.linear.y, twist.angular.z = linear, sideways, angular
        if self.topics.command is not None:
            self.topics.command.sent((linear, angular, sideways))
        self._publish(publisher, message)

    def set_joints(self, positions: Mapping[str, float], time: int) -> None:
        """
        Send positions (rad or m) to joint_state_publisher, else to controllers.

        Raises ViewerError: neither takes them.
        """
        publisher = self._joints
        if publisher is None:
            speeds = self.described.speeds if self.described else {}
            self.commands.move(positions, self.topics.positions(), speeds)
            return
        message = JointState(name=list(positions), position=list(positions.values()))
        fill_stamp(time, message.header.stamp)
        self._publish(publisher, message)

    def _publish(self, publisher: Publisher, message: Any) -> None:
        try:
            publisher.publish(message)
        except InvalidHandle:  # the ROS thread has destroyed it in the meantime
            raise ViewerError(f'{self.found.id} is just going') from None

    def _advertise_commands(self) -> None:
        command = self.found.command
        message_type = COMMAND_TYPES[command.message] if command else None
        topic = command.topic if command else None
        self._commands = _replace_publisher(self._commands, self._node, message_type, topic)

    def _advertise_joints(self) -> None:
        node = self.found.joint_publisher
        topic = node and f'{node}/set_joint_positions'
        self._joints = _replace_publisher(self._joints, self._node, JointState, topic)

    def _subscribe_activity(self) -> None:
        topic = self.found.activity
        if self._activity is not None:
            self._node.destroy_subscription(self._activity)
        self._activity = topic and self._node.create_subscription(
            ControllerManagerActivity, topic, lambda _: self._on_activity(self), LATCHED
        )

    def _subscribe_topics(self) -> None:
        before = self.topics
        before.destroy()
        joints = self.described.joints if self.described else ()
        self.topics = RobotTopics(self._node, self.found, joints)
        self.topics.keep_joint_states(before)
        self.topics.watch(self._watched)
        if self.timeout is not None:
            self.set_timeout(self.timeout)


def still_held(connection: RobotConnection) -> str:
    """Return what to say of a robot that STOP still holds when this node ends."""
    robot, found = connection.found.id, []
    if connection.is_locked:
        release = f'ros2 topic pub -1 {lock_topic(robot)} std_msgs/msg/Bool "{{data: false}}"'
        found.append(f'its lock holds until: {release}')
    if connection.deactivated:
        found.append(f'inactive: {", ".join(connection.deactivated)}')
    return f'STOP still holds {robot}: {"; ".join(found)}'


def _whole(rate: float) -> float:
    """Return a rate as pages show it, Hz; one below that of a second is 1: somebody is there."""
    return float(max(round(rate), 1)) if rate else 0.0


def _full_name(info: TopicEndpointInfo) -> str:
    return f'{info.node_namespace.rstrip("/")}/{info.node_name}'


def _destroy_publisher(node: Node, publisher: Publisher) -> None:
    publisher.wait_for_all_acked(_ACK_TIMEOUT)
    node.destroy_publisher(publisher)


def _replace_publisher(
    publisher: Publisher | None, node: Node, message_type: Any, topic: str | None
) -> Publisher | None:
    """Destroy a publisher; return a new one for ``topic``, None without a topic."""
    if publisher is not None:
        _destroy_publisher(node, publisher)
    return node.create_publisher(message_type, topic, 10) if topic else None


class WorldSubscription:
    """The subscription to the markers of a simulator's world."""

    def __init__(self, node: Node, topic: str, on_world: Callable[[MarkerArray], None]) -> None:
        self.topic = topic
        self._node = node
        self._subscription = node.create_subscription(MarkerArray, topic, on_world, LATCHED)

    def destroy(self) -> None:
        """Unsubscribe."""
        self._node.destroy_subscription(self._subscription)
