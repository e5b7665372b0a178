# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
What the sensors of a robot see at the present instant, for a test in lock-step.

The simulator measures when it is asked (:mod:`amr_description.sim.ros.measure_service`),
so a reading is of the instant at which it is taken, whatever the rate of the sensor, and no time
passes. Only what is asked for is subscribed to, and pictures and clouds no longer than that:
while time passes they are not made.
"""

from collections.abc import Sequence
from typing import Any

import numpy as np
from rclpy.node import Node
from rclpy.qos import QoSProfile
from rclpy.serialization import deserialize_message

from amr_description.clock import NANOSECONDS
from amr_description.model.sensors import WorldSensor
from amr_description.ros.message_types import message_type
from amr_description.ros.messages import nanoseconds
from amr_description.ros.polled_topic import PolledTopic
from amr_description.simulation.readings import Contact, Image, Points, Scan
from amr_description.simulation.sensors import CLOUD, CONTACTS, DEPTH, IMAGE, SCAN, SensorTopics
from amr_description.simulation.tracebacks import is_for_the_test
from amr_description.testing.lock_step import LockStep

__tracebackhide__ = is_for_the_test

_QOS = QoSProfile(depth=10)


class RobotReadings:
    """The sensors of one robot."""

    def __init__(
        self,
        lock_step: LockStep,
        node: Node,
        name: str,
        sensors: Sequence[WorldSensor],
        namespace: str,
    ) -> None:
        """
        Subscribe to nothing yet.

        Args:
            lock_step: The simulator.
            node: Of the subscriptions; in no executor.
            name: Of the robot, for errors.
            sensors: Of its description.
            namespace: Of its topics, absolute.
        """
        self._lock_step = lock_step
        self._node = node
        self._topics = SensorTopics(name, sensors, namespace)
        self._kept: dict[str, PolledTopic[Any]] = {}

    def scan(self, topic: str = '') -> Scan:
        """Return what a lidar sees now; of the only one, or of that with a topic."""
        message = self._read(self._topics.chosen((SCAN,), topic))
        ranges = np.asarray(message.ranges, np.float32)
        return Scan(
            *_header_of(message),
            ranges=ranges,
            angles=message.angle_min + message.angle_increment * np.arange(len(ranges)),
            range_min=message.range_min,
            range_max=message.range_max,
        )

    def image(self, topic: str = '') -> Image:
        """Return the colours that a camera sees now."""
        return self._picture(self._topics.chosen((IMAGE,), topic))

    def depth(self, topic: str = '') -> Image:
        """Return the depths that a camera sees now."""
        return self._picture(self._topics.chosen((DEPTH,), topic))

    def points(self, topic: str = '') -> Points:
        """Return the cloud that a camera or lidar sees now."""
        message = self._read(self._topics.chosen((CLOUD,), topic))
        starts = {field.name: field.offset for field in message.fields}
        layout: Any = {
            'names': ['x', 'y', 'z'],
            'formats': [np.float32] * 3,
            'offsets': [starts[axis] for axis in ('x', 'y', 'z')],
            'itemsize': message.point_step,
        }
        points: Any = np.frombuffer(message.data, np.dtype(layout))
        xyz = np.stack([points[axis] for axis in ('x', 'y', 'z')], axis=-1)
        return Points(*_header_of(message), xyz.reshape(message.height, message.width, 3))

    def contacts(self, topic: str = '') -> list[Contact]:
        """Return what touches a contact sensor now."""
        message = self._read(self._topics.chosen(CONTACTS, topic))
        if hasattr(message, 'states'):  # Gazebo Classic's
            return [Contact(each.collision1_name, each.collision2_name) for each in message.states]
        return [Contact(each.collision1.name, each.collision2.name) for each in message.contacts]

    def close(self) -> None:
        """Remove the subscriptions."""
        while self._kept:
            self._kept.popitem()[1].destroy()

    def _picture(self, topic: str) -> Image:
        message = self._read(topic)
        kind, channels = _ENCODINGS[message.encoding]
        shape = (message.height, message.width, *([channels] if channels > 1 else []))
        pixels = np.frombuffer(message.data, kind).reshape(shape)
        if message.encoding == 'bgr8':
            pixels = pixels[..., ::-1]
        return Image(*_header_of(message), pixels)

    def _read(self, topic: str) -> Any:
        """Have a topic measured; return the message of the present instant."""
        kind = self._topics.kinds[topic].partition(' ')[0]
        message_class = message_type(kind)

        def read(data: bytes) -> Any:
            return deserialize_message(data, message_class)

        if topic not in self._kept:
            self._kept[topic] = PolledTopic(self._node, message_class, topic, read, qos=_QOS)
        subscription, lock_step = self._kept[topic], self._lock_step
        while subscription.take() is not None:
            pass  # of instants before

        def taken() -> Any:
            while (message := subscription.take()) is not None:
                if nanoseconds(message.header.stamp) == lock_step.time:
                    return message
            return None

        lock_step.wait(lambda: topic in lock_step.measure(), f"the simulator to serve '{topic}'")
        message = lock_step.wait(taken, f"a measurement on '{topic}'")
        if kind in (IMAGE, CLOUD):
            self._kept.pop(topic).destroy()
        return message


_ENCODINGS = {
    'rgb8': (np.uint8, 3),
    'bgr8': (np.uint8, 3),
    'mono8': (np.uint8, 1),
    '32FC1': (np.float32, 1),
}


def _header_of(message: Any) -> tuple[float, str]:
    return nanoseconds(message.header.stamp) / NANOSECONDS, message.header.frame_id
