# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
The topics and actions by which pages move the joints of a robot that controllers command.

Publishers and clients are created and destroyed on the ROS thread; publishers are used on the
server's thread.
"""

from collections import deque
from collections.abc import Mapping, Sequence
from contextlib import suppress
import time
from typing import Any

from control_msgs.action import GripperCommand, ParallelGripperCommand
from rclpy.action import ActionClient
from rclpy.duration import Duration
from rclpy.exceptions import InvalidHandle
from rclpy.node import Node
from rclpy.publisher import Publisher
from sensor_msgs.msg import JointState
from std_msgs.msg import Float64MultiArray
from trajectory_msgs.msg import JointTrajectory, JointTrajectoryPoint

from amr_description.errors import ViewerError
from amr_description.text import quote_all
from amr_description.viewer.joint_groups import (
    ControllerJoints,
    GRIPPER,
    GroupTargets,
    PARALLEL_GRIPPER,
    POSITIONS,
    SHORTEST,
    TRAJECTORY,
)

_TYPES = {TRAJECTORY: JointTrajectory, POSITIONS: Float64MultiArray}
_ACTIONS: dict[str, Any] = {GRIPPER: GripperCommand, PARALLEL_GRIPPER: ParallelGripperCommand}


class _Mover:
    """A group of joints, what moves it, and where pages have put it."""

    def __init__(self, node: Node, group: ControllerJoints) -> None:
        self._node = node
        self.group = group
        self.targets = GroupTargets(group)
        self.is_moved = False
        """Whether a page has moved it since it was last held."""
        self._latest_goal: deque[Any] = deque(maxlen=1)
        """One that is not sent yet; a later one takes its place."""
        self._publisher: Publisher | None = None
        self._action: ActionClient | None = None
        if group.message in _ACTIONS:
            self._action = ActionClient(node, _ACTIONS[group.message], group.topic)
        else:
            self._publisher = node.create_publisher(_TYPES[group.message], group.topic, 10)

    def destroy(self) -> None:
        """Destroy publisher and client; on the ROS thread."""
        if self._publisher is not None:
            self._node.destroy_publisher(self._publisher)
        if self._action is not None:
            self._action.destroy()

    def send(self, targets: Sequence[float], duration: float) -> None:
        """
        Command positions, rad or m, of all joints; a trajectory takes ``duration`` s.

        Raises ViewerError: the controller is just going.
        """
        try:
            if self._publisher is not None:
                self._publisher.publish(self._message(targets, duration))
            elif self._action is not None:
                self._send_goal(self._goal(targets))
        except InvalidHandle:  # the ROS thread has destroyed it in the meantime
            raise ViewerError(f'{self.group.controller} is just going') from None

    def _send_goal(self, goal: Any) -> None:
        """
        Send a goal, on the ROS thread.

        An ActionClient takes note of its request after it has sent it, without a lock: sent on
        another thread, the answer can come first, and is then unexpected.
        """
        self._latest_goal.append(goal)  # the tasks of an executor run in any order
        if (executor := self._node.executor) is not None:  # else the node is just going
            executor.create_task(self._send_latest_goal)

    def _send_latest_goal(self) -> None:
        if self._action is not None:
            with suppress(IndexError, InvalidHandle):  # sent by then; destroyed in the meantime
                self._action.send_goal_async(self._latest_goal.pop())

    def _message(
        self, targets: Sequence[float], duration: float
    ) -> JointTrajectory | Float64MultiArray:
        if self.group.message == POSITIONS:
            return Float64MultiArray(data=targets)
        from_start = Duration(seconds=duration).to_msg()
        point = JointTrajectoryPoint(positions=targets, time_from_start=from_start)
        # Without a stamp it begins when it comes.
        return JointTrajectory(joint_names=list(self.group.joints), points=[point])

    def _goal(self, targets: Sequence[float]) -> Any:
        """Return a goal, in place of the one that the controller is after."""
        goal = _ACTIONS[self.group.message].Goal()
        if self.group.message == GRIPPER:
            goal.command.position = targets[0]
        else:
            goal.command = JointState(name=list(self.group.joints[:1]), position=targets[:1])
        return goal


class JointCommands:
    """The groups of joints of one robot."""

    def __init__(self, node: Node, robot: str) -> None:
        self._node = node
        self._robot = robot
        self._movers: tuple[_Mover, ...] = ()

    def set_groups(self, groups: Sequence[ControllerJoints]) -> None:
        """Have publishers and clients for these groups and no others; on the ROS thread."""
        before = {each.group: each for each in self._movers}
        self._movers = tuple(before.get(group) or _Mover(self._node, group) for group in groups)
        for group, each in before.items():
            if group not in groups:
                each.destroy()

    def destroy(self) -> None:
        """Destroy the publishers; on the ROS thread."""
        self.set_groups(())

    def move(
        self,
        asked: Mapping[str, float],
        measured: Mapping[str, float],
        speeds: Mapping[str, float],
    ) -> None:
        """
        Command positions.

        Args:
            asked: Of some joints, rad or m.
            measured: Of all joints, as far as they are known.
            speeds: Limits of joints, rad/s or m/s.

        Raises:
            ViewerError: no active controller takes one of them.
        """
        left = dict(asked)
        for each in self._movers:
            joints = each.group.joints
            mine = {joint: left.pop(joint) for joint in joints if joint in left}
            if mine:
                targets = each.targets.targets(mine, measured, time.monotonic())
                each.send(targets, each.targets.duration(measured, speeds))
                each.is_moved = True
        if left:
            raise ViewerError(
                f'no active controller of {self._robot} takes positions of {quote_all([*left])}; '
                'one with ~/joint_trajectory, ~/commands or ~/gripper_cmd does, for its own joints'
            )

    def hold(self, measured: Mapping[str, float]) -> None:
        """Let the joints that pages have moved stay where they are, rad or m."""
        for each in self._movers:
            joints = each.group.joints
            if each.is_moved and all(joint in measured for joint in joints):
                each.is_moved = False
                each.targets.positions = {}
                targets = each.targets.targets({}, measured, time.monotonic())
                with suppress(ViewerError):  # it is just going: who stops, stops the others too
                    each.send(targets, SHORTEST)
