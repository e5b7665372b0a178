# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
The descriptions and transforms of robots that pages have spawned.

A simulator has a robot's joints, not its TF: that comes of a robot_state_publisher in the robot's
namespace, which whoever spawns a robot starts, as launch files do. The viewer has one for each
robot that a page spawned, until the robot is deleted or the viewer ends.
"""

from collections.abc import Callable, Collection, Iterable

from rclpy.executors import Executor
from rclpy.node import Node

from amr_description.errors import AmrError
from amr_description.viewer.graph import FoundRobot


class SpawnedRobots:
    """
    The nodes, by the ids of their robots; on the ROS thread.

    Args:
        executor: spins the nodes.
        publish: returns a node for a namespace and a description. Raises AmrError.
        log_error: logs a line.
    """

    def __init__(
        self,
        executor: Executor,
        publish: Callable[[str, str], Node],
        log_error: Callable[[str], object],
    ) -> None:
        self._executor = executor
        self._publish = publish
        self._log_error = log_error
        self._nodes: dict[str, Node] = {}
        self._present: set[str] = set()
        """Those that were found in the graph: they can be deleted."""

    def add(self, robot: str, urdf: str) -> None:
        """Publish a description, unless it is done already."""
        if robot in self._nodes:
            return
        try:
            node = self._publish(robot, urdf)
        except AmrError as error:
            self._log_error(f'{robot} has no robot_state_publisher: {error}')
            return
        self._nodes[robot] = node
        self._executor.add_node(node)

    def forget_deleted(self, robots: Iterable[FoundRobot]) -> None:
        """End the nodes of robots that were in the graph and are not any more."""
        present = {each.id for each in robots if each.is_present}
        deleted = self._present - present
        self._present = present
        self.retain([each for each in self._nodes if each not in deleted])

    def retain(self, robots: Collection[str]) -> None:
        """End the nodes of all other robots."""
        for robot in [each for each in self._nodes if each not in robots]:
            node = self._nodes.pop(robot)
            self._executor.remove_node(node)
            node.destroy_node()
