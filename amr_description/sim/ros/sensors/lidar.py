# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""The topics of a lidar: LaserScan."""

from collections.abc import Callable
from typing import Any

from rclpy.qos import QoSProfile
from sensor_msgs.msg import LaserScan

from amr_description.clock import NANOSECONDS
from amr_description.control.ros.encoders import Encoder
from amr_description.control.ros.loop_publisher import LoopTopic
from amr_description.model.sensors import Lidar
from amr_description.ros.cdr_template import template_of
from amr_description.ros.messages import fill_stamp, numbers
from amr_description.sim.lidar import Scan, scan_angles, SimulatedLidar
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
        kinds = ((lidar.scan_topic, LaserScan, scan_encoder(lidar, frame)),)
        self._topics = tuple(
            self._topic(context.topic(name, lidar.mount), kind, encode)
            for name, kind, encode in kinds
            if name
        )

    def _topic(self, name: str, kind: Any, encode: Encoder) -> LoopTopic:
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


def scan_encoder(lidar: Lidar, frame: str) -> Callable[[Scan], Any]:
    """
    Return what makes the bytes of LaserScans, or else messages.

    All rays are of the same instant: ``time_increment`` and ``scan_time`` are 0, as in gz.

    Args:
        lidar: The sensor.
        frame: Of the messages.
    """
    message = LaserScan()
    message.header.frame_id = frame
    message.angle_min, message.angle_max, message.angle_increment = scan_angles(lidar.horizontal)
    message.range_min, message.range_max = lidar.range_min, lidar.range_max
    count = lidar.horizontal.samples
    message.ranges = message.intensities = numbers('f', bytes(4 * count))
    arrays = ('ranges', 'intensities')
    template = template_of(message, ('header.stamp', *arrays), blocks=arrays)
    pack = template.pack
    begin, geometry, size, end = template.constants

    def encode(scan: Scan) -> bytes:
        ring = scan.middle_ring
        seconds, nanoseconds = divmod(scan.time, NANOSECONDS)
        return pack(
            begin, seconds, nanoseconds,
            geometry, scan.ranges[ring].tobytes(), size, scan.intensities[ring].tobytes(), end,
        )  # fmt: skip

    def fill(scan: Scan) -> LaserScan:
        ring = scan.middle_ring
        fill_stamp(scan.time, message.header.stamp)
        message.ranges = numbers('f', scan.ranges[ring].tobytes())
        message.intensities = numbers('f', scan.intensities[ring].tobytes())
        return message

    # The stamp is that of the message.
    packed = pack(begin, 0, 0, geometry, bytes(4 * count), size, bytes(4 * count), end)
    return encode if template.has_made(packed, message) else fill
