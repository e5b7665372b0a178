# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
``tf2_ros`` in Python, for nodes that run where the original is not installed.

In the environment of ``scripts/setup`` such a node imports it under its name::

    import tf2_ros

    self.tf_buffer = tf2_ros.Buffer()
    self.tf_listener = tf2_ros.TransformListener(self.tf_buffer, self)
    ...
    try:
        transform = self.tf_buffer.lookup_transform('odom', 'base_link', rclpy.time.Time())
    except tf2_ros.TransformException as error:
        self.get_logger().info(f'Could not transform: {error}')

``tf2_geometry_msgs``, ``tf2_sensor_msgs`` and ``tf2_py`` are here, too, under their own names.

======================= ===========================================================================
module                  what it holds
======================= ===========================================================================
``time_cache.py``       the poses of one frame over the last seconds, interpolated; no ROS
``frame_graph.py``      the trees of frames, and their descriptions as text; no ROS
``buffer_core.py``      what is known of all frames: lookups and their errors; no ROS
``buffer.py``           ``Buffer``: the core with the interface of tf2_ros, for threads
``buffer_interface.py`` ``Buffer.transform``, by what packages register
``buffer_client.py``    ``BufferClient``: the buffer of another node, by an action
``buffer_server.py``    ``BufferServer``: its side of that
``geometry.py``         ``tf2_geometry_msgs``
``clouds.py``           ``tf2_sensor_msgs``
``core.py``             ``tf2_py``
``listener.py``         ``TransformListener``: from topics into a buffer
``broadcaster.py``      ``TransformBroadcaster``, ``StaticTransformBroadcaster``
``statistics.py``       rates and delays, for ``tf2_monitor``; no ROS
``tools.py``            what the command-line programs of tf2 share
======================= ===========================================================================
"""

from amr_description.errors import (
    ConnectivityException,
    ExtrapolationException,
    InvalidArgumentException,
    LookupException,
    NotImplementedException,
    TimeoutException,
    TransformException,
    TypeException,
)
from amr_description.tf2_ros.broadcaster import StaticTransformBroadcaster, TransformBroadcaster
from amr_description.tf2_ros.buffer import Buffer
from amr_description.tf2_ros.buffer_client import BufferClient
from amr_description.tf2_ros.buffer_interface import (
    BufferInterface,
    convert,
    ConvertRegistration,
    Stamped,
    TransformRegistration,
)
from amr_description.tf2_ros.buffer_server import BufferServer
from amr_description.tf2_ros.listener import TransformListener

__all__ = [
    'Buffer',
    'BufferClient',
    'BufferInterface',
    'BufferServer',
    'ConnectivityException',
    'ConvertRegistration',
    'ExtrapolationException',
    'InvalidArgumentException',
    'LookupException',
    'NotImplementedException',
    'Stamped',
    'StaticTransformBroadcaster',
    'TimeoutException',
    'TransformBroadcaster',
    'TransformException',
    'TransformListener',
    'TransformRegistration',
    'TypeException',
    'convert',
]
