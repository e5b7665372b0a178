# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""The node of an action server, where the clock of the node is set at every cycle."""

from typing import Any

from rclpy.clock import ROSClock
from rclpy.node import Node

from amr_description.ros.rclpy_internals import manual_clock


class StandingClockNode:
    """
    A node for an action server, with a clock that stands between its goals.

    rcl wakes the executor whenever a clock of an action server is set: for that of a simulated
    robot 100 times a second, which costs 4 % of a core. Goals are stamped with the node's time all
    the same; results are dropped by the clock of the goals that follow.
    """

    def __init__(self, node: Node) -> None:
        """``node`` has the action; its clock may be set at every cycle."""
        self._node = node
        self._clock = manual_clock()
        self.set_time()

    def set_time(self) -> None:
        """Take over the node's time."""
        self._clock.set_ros_time_override(self._node.get_clock().now())

    def get_clock(self) -> ROSClock:
        """Return the clock that stands."""
        return self._clock

    def __getattr__(self, name: str) -> Any:
        """Return all else of the node."""
        return getattr(self._node, name)
