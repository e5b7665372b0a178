# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
The topics by which pages move the joints of a robot that controllers command.

Publishers are created and destroyed on the ROS thread, and used on the server's thread.
"""

from collections.abc import Mapping, Sequence
from contextlib import suppress
import time

from rclpy.duration import Duration
from rclpy.exceptions import InvalidHandle
from rclpy.node import Node
from rclpy.publisher import Publisher
from std_msgs.msg import Float64MultiArray
from trajectory_msgs.msg import JointTrajectory, JointTrajectoryPoint

from amr_description.errors import ViewerError
from amr_description.text import quote_all
from amr_description.viewer.joint_groups import (
    GroupTargets,
    JointGroup,
    POSITIONS,
    SHORTEST,
    TRAJECTORY,
)

_TYPES = {TRAJECTORY: JointTrajectory, POSITIONS: Float64MultiArray}


class _Commanded:
    """A group of joints, its publisher, and where pages have put them."""

    def __init__(self, node: Node, group: JointGroup) -> None:
        self.targets = GroupTargets(group)
        self.publisher: Publisher = node.create_publisher(_TYPES[group.message], group.topic, 10)
        self.is_moved = False
        """Whether a page has moved it since it was last held."""


class JointCommands:
    """The groups of joints of one robot."""

    def __init__(self, node: Node, robot: str) -> None:
        self._node = node
        self._robot = robot
        self._commanded: tuple[_Commanded, ...] = ()

    def set_groups(self, groups: Sequence[JointGroup]) -> None:
        """Have publishers for these groups and no others; on the ROS thread."""
        before = {each.targets.group: each for each in self._commanded}
        self._commanded = tuple(
            before.get(group) or _Commanded(self._node, group) for group in groups
        )
        for group, each in before.items():
            if group not in groups:
                self._node.destroy_publisher(each.publisher)

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
        for each in self._commanded:
            joints = each.targets.group.joints
            mine = {joint: left.pop(joint) for joint in joints if joint in left}
            if mine:
                targets = each.targets.targets(mine, measured, time.monotonic())
                self._publish(each, targets, each.targets.duration(measured, speeds))
                each.is_moved = True
        if left:
            raise ViewerError(
                f'no active controller of {self._robot} takes positions of {quote_all([*left])}; '
                'one with a topic ~/joint_trajectory or ~/commands does, for its own joints'
            )

    def hold(self, measured: Mapping[str, float]) -> None:
        """Let the joints that pages have moved stay where they are, rad or m."""
        for each in self._commanded:
            joints = each.targets.group.joints
            if each.is_moved and all(joint in measured for joint in joints):
                each.is_moved = False
                each.targets.positions = {}
                targets = each.targets.targets({}, measured, time.monotonic())
                with suppress(ViewerError):  # it is just going: who stops, stops the others too
                    self._publish(each, targets, SHORTEST)

    def _publish(self, each: _Commanded, targets: Sequence[float], duration: float) -> None:
        group = each.targets.group
        message: JointTrajectory | Float64MultiArray = Float64MultiArray(data=targets)
        if group.message == TRAJECTORY:
            from_start = Duration(seconds=duration).to_msg()
            point = JointTrajectoryPoint(positions=targets, time_from_start=from_start)
            # Without a stamp it begins when it comes.
            message = JointTrajectory(joint_names=list(group.joints), points=[point])
        try:
            each.publisher.publish(message)
        except InvalidHandle:  # the ROS thread has destroyed it in the meantime
            raise ViewerError(f'{group.controller} is just going') from None
