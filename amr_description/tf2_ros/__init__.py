# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
``tf2_ros`` by another name, for nodes in Python where the original is not installed.

Such a node changes its import, nothing else::

    import amr_description.tf2_ros as tf2_ros

    self.tf_buffer = tf2_ros.Buffer()
    self.tf_listener = tf2_ros.TransformListener(self.tf_buffer, self)
    ...
    try:
        transform = self.tf_buffer.lookup_transform('odom', 'base_link', rclpy.time.Time())
    except tf2_ros.TransformException as error:
        self.get_logger().info(f'Could not transform: {error}')

Left out are the buffer as an action server with its client, and the conversion of points and
poses that tf2_geometry_msgs registers (``Buffer.transform``).
"""

from amr_description.errors import (
    ConnectivityException,
    ExtrapolationException,
    InvalidArgumentException,
    LookupException,
    TransformException,
)
from amr_description.tf2_ros.broadcaster import StaticTransformBroadcaster, TransformBroadcaster
from amr_description.tf2_ros.buffer import Buffer
from amr_description.tf2_ros.listener import TransformListener

__all__ = [
    'Buffer',
    'ConnectivityException',
    'ExtrapolationException',
    'InvalidArgumentException',
    'LookupException',
    'StaticTransformBroadcaster',
    'TransformBroadcaster',
    'TransformException',
    'TransformListener',
]
