# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""The QoS profiles that several nodes share; do not change one, copy it."""

from rclpy.qos import DurabilityPolicy, QoSProfile, ReliabilityPolicy

LATCHED = QoSProfile(depth=1, durability=DurabilityPolicy.TRANSIENT_LOCAL)
"""Who subscribes later gets the last message, as of ``robot_description``."""

TF_STATIC = QoSProfile(depth=100, durability=DurabilityPolicy.TRANSIENT_LOCAL)
"""To subscribe to ``/tf_static``: every publisher's last message."""

CLOCK = QoSProfile(depth=1, reliability=ReliabilityPolicy.BEST_EFFORT)
"""To subscribe to ``/clock``, as rclpy's time source does."""

SERVICE_CLIENT = QoSProfile(depth=500)
"""
Of a client of a service that others call, too: it receives the answers to all of them, and rmw
leaves those to others out only when they are taken. With the usual depth of 10, ten of them push
its own out while its process waits for a processor, and its request has no answer for ever.
"""
