# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""The topics of a lidar or range finder: LaserScan, PointCloud2, Range."""

from collections.abc import Callable
from typing import Any

from rclpy.qos import QoSProfile
from sensor_msgs.msg import LaserScan, PointCloud2, Range

from amr_description.control.ros.loop_publisher import LoopTopic
from amr_description.model.sensors import Lidar
from amr_description.sim.lidar import SimulatedLidar
from amr_description.sim.ros.sensors.lidar_messages import (
    points_encoder,
    range_encoder,
    scan_encoder,
    ScanEncoder,
)
from amr_description.sim.ros.sensors.topics import SensorContext, SensorTopics

QOS = QoSProfile(depth=10)
"""Reliable: who subscribes best effort, as SensorDataQoS does, is served as well."""


class LidarTopics(SensorTopics):
    """The topics of one lidar."""

    def __init__(self, lidar: Lidar, context: SensorContext) -> None:
        """
        Create the topics.

        Args:
            lidar: The sensor.
            context: What it is given.

        Raises:
            SimulationError: The robot has no such link.
        """
        self._context = context
        self._lidar = SimulatedLidar(lidar, context.robot)
        frame = context.frame(lidar.mount.frame or lidar.mount.link)
        kinds: tuple[tuple[str, Any, Callable[[Lidar, str], ScanEncoder]], ...] = (
            (lidar.scan_topic, LaserScan, scan_encoder),
            (lidar.points_topic, PointCloud2, points_encoder),
            (lidar.range_topic, Range, range_encoder),
        )
        self._topics = tuple(
            self._topic(context.topic(name, lidar.mount), kind, encoder_of(lidar, frame))
            for name, kind, encoder_of in kinds
            if name
        )

    def _topic(self, name: str, kind: Any, encode: ScanEncoder) -> LoopTopic:
        publisher = self._context.node.create_publisher(kind, name, QOS)
        return self._context.loop_publisher.topic(publisher, encode)

    @property
    def is_heard(self) -> bool:
        """Whether anybody subscribes to one of them; nothing is measured else."""
        return any(topic.is_heard for topic in self._topics)

    def measure(self, time: int) -> None:
        """Measure, and publish; ``time``: of this cycle, ns."""
        scene = self._context.world.ray_scene()
        scan = self._lidar.measure(self._lidar.view(time, scene), scene)
        for topic in self._topics:
            topic.send(scan)

    def destroy(self) -> None:
        """Remove the topics; nothing is published after that."""
        for topic in self._topics:
            self._context.node.destroy_publisher(topic.publisher)
