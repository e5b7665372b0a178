# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
Make Fast DDS find the others at once.

A new participant announces itself to every possible port of this host, one after the other, and
only then starts to listen (Fast DDS 2.14.5, ``ROS_AUTOMATIC_DISCOVERY_RANGE=LOCALHOST``; also
with shared memory on SUBNET). Who is there already answers within half a millisecond, which is
too early, and does not repeat the answer before its own next announcement: up to 3 s later. Half
of the processes started beside a running stack see nothing of it for 1 to 3 s.

A throughput limit, however high, has Fast DDS announce from a thread of its own; then it listens
first. Measured with 12 processes each: found after 0.03 to 0.4 s, before after 0.04 to 2.9 s.

This module imports no rclpy.
"""

import os
from pathlib import Path

PROFILE = Path(__file__).with_suffix('.xml')
"""The limit by itself; the profiles of ``transport.py`` have it too."""

_SUPER_CLIENT = 'ROS_SUPER_CLIENT'


def use_whole_graph() -> None:
    """
    Have the participant of this process, and those of its children, learn of the whole graph
    through a discovery server too, which otherwise shows a node only the topics that it uses.

    A search by type (``create``'s for the simulator) would never end, and ``ros2 topic list`` find
    nothing. Without ``ROS_DISCOVERY_SERVER`` it changes nothing; nor where a user has decided.
    """
    os.environ.setdefault(_SUPER_CLIENT, 'TRUE')
