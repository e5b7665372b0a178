# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""Messages → readings."""

import math
from typing import Any

from amr_description.control.interfaces import NANOSECONDS
from amr_description.model.frames import conjugate, rotate
from amr_description.nodes.converters import transform_of, vector_of
from amr_description.testing.readings import Joint, Motion


def nanoseconds(stamp: Any) -> int:
    """A builtin_interfaces/msg/Time, ns."""
    return stamp.sec * NANOSECONDS + stamp.nanosec


def motion_of_entity(state: Any) -> Motion:
    """A simulation_interfaces/msg/EntityState, whose twist is in the axes of the world."""
    pose = transform_of(state.pose)
    back = conjugate(pose.rotation)
    return Motion(
        time=nanoseconds(state.header.stamp) / NANOSECONDS,
        pose=pose,
        linear=rotate(back, vector_of(state.twist.linear)),
        angular=rotate(back, vector_of(state.twist.angular)),
    )


def motion_of_odometry(message: Any) -> Motion:
    """A nav_msgs/msg/Odometry, whose twist is in the robot's own axes."""
    return Motion(
        time=nanoseconds(message.header.stamp) / NANOSECONDS,
        pose=transform_of(message.pose.pose),
        linear=vector_of(message.twist.twist.linear),
        angular=vector_of(message.twist.twist.angular),
    )


def joints_of(message: Any) -> dict[str, Joint]:
    """A sensor_msgs/msg/JointState by names; NaN for what it leaves out."""
    columns = (message.position, message.velocity, message.effort)
    padded = ([*column] or [math.nan] * len(message.name) for column in columns)
    rows = zip(message.name, *padded, strict=True)
    return {name: Joint(*values) for name, *values in rows}
