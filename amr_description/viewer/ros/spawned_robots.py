# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
The descriptions and transforms of robots in a simulator's world that nobody else describes.

A simulator has a robot's joints, not its TF: that comes of a robot_state_publisher in the robot's
namespace, which whoever spawns a robot starts, as launch files do. The viewer has one for each
robot that a page spawned, and for those that are in a world without one, as their launch file, or
the viewer before, has ended: until the robot is deleted, somebody else describes it, or the viewer
ends.
"""

from collections.abc import Callable, Collection, Iterable

from rclpy.executors import Executor
from rclpy.node import Node

from amr_description.errors import AmrError
from amr_description.viewer.entities import SpawnedEntity, undescribed
from amr_description.viewer.graph import FoundRobot

PATIENCE = 2.0
"""s in which a launch file starts the node that describes a robot, or that node is found."""


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
        self._missing: dict[str, float] = {}
        """Since when nobody describes a robot, s."""

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

    def look(
        self, spawned: Collection[SpawnedEntity], robots: Iterable[FoundRobot], now: float
    ) -> None:
        """
        Describe the robots of a world that nobody has described for some time, and no others.

        Args:
            spawned: The entities of all simulators.
            robots: Of the graph: those that are described.
            now: s of a monotonic clock.
        """
        self.retain([name for name, node in self._nodes.items() if not _is_also_described(node)])
        missing = undescribed(spawned, {*self._nodes, *(each.id for each in robots)})
        self._missing = {each: self._missing.get(each, now) for each in missing}
        for robot, since in self._missing.items():
            if now - since >= PATIENCE:
                self.add(robot, missing[robot].urdf)

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


def _is_also_described(node: Node) -> bool:
    """Return whether somebody else publishes what a node of ours does."""
    return node.count_publishers(node.resolve_topic_name('robot_description')) > 1
