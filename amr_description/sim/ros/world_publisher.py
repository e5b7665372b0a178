# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""Publishes the static geometry of the world, latched, on ``~/world``."""

from rclpy.node import Node
from visualization_msgs.msg import MarkerArray

from amr_description.control.ros.loop_publisher import LoopPublisher
from amr_description.ros.qos import LATCHED
from amr_description.sim.world import MujocoWorld
from amr_description.simulation.topics.world_markers import TOPIC, world_markers


class WorldPublisher:
    """See the module."""

    def __init__(
        self, node: Node, world: MujocoWorld, loop_publisher: LoopPublisher | None = None
    ) -> None:
        """``loop_publisher``: has it recorded with what a run publishes."""
        publisher = node.create_publisher(MarkerArray, TOPIC, LATCHED)
        self._publisher = loop_publisher.recorded(publisher) if loop_publisher else publisher
        self._world = world

    def publish(self) -> None:
        """Publish it now; no robot is in the world."""
        self._publisher.publish(world_markers(self._world.engine))
