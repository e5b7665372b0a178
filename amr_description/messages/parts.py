# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""Parts of messages, of rclpy or plain ones: stamps, poses, velocities."""

from typing import Any

from amr_description.clock import NANOSECONDS
from amr_description.model.frames import Transform, Vector


def fill_stamp(time: int, stamp: Any) -> None:
    """Write integer nanoseconds into a stamp."""
    stamp.sec, stamp.nanosec = divmod(time, NANOSECONDS)


def fill_pose(transform: Transform, pose: Any) -> None:
    """Write a pose: the transform from the thing to its frame of reference."""
    position, orientation = pose.position, pose.orientation
    position.x, position.y, position.z = transform.translation
    orientation.x, orientation.y, orientation.z, orientation.w = transform.rotation


def fill_velocity(linear: Vector, angular: Vector, twist: Any) -> None:
    """Write a velocity, m/s and rad/s, or an acceleration, m/s² and rad/s²."""
    twist.linear.x, twist.linear.y, twist.linear.z = linear
    twist.angular.x, twist.angular.y, twist.angular.z = angular
