# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""What a test reads of a robot, from messages."""

import math
from typing import Any

from amr_description.clock import NANOSECONDS
from amr_description.model.frames import conjugate, rotate
from amr_description.ros.messages import nanoseconds, transform_of, vector_of
from amr_description.simulation.readings import Joint, Joints, Motion


def motion_of_entity(state: Any) -> Motion:
    """Read a simulation_interfaces/msg/EntityState, whose twist is in the axes of the world."""
    pose = transform_of(state.pose)
    back = conjugate(pose.rotation)
    return Motion(
        time=nanoseconds(state.header.stamp) / NANOSECONDS,
        pose=pose,
        linear=rotate(back, vector_of(state.twist.linear)),
        angular=rotate(back, vector_of(state.twist.angular)),
    )


def motion_of_odometry(message: Any) -> Motion:
    """Read a nav_msgs/msg/Odometry, whose twist is in the robot's own axes."""
    return Motion(
        time=nanoseconds(message.header.stamp) / NANOSECONDS,
        pose=transform_of(message.pose.pose),
        linear=vector_of(message.twist.twist.linear),
        angular=vector_of(message.twist.twist.angular),
    )


def joints_of(message: Any) -> Joints:
    """Read a sensor_msgs/msg/JointState: joint → state; NaN for missing values."""
    columns = (message.position, message.velocity, message.effort)
    padded = ([*column] or [math.nan] * len(message.name) for column in columns)
    rows = zip(message.name, *padded, strict=True)
    return Joints({name: Joint(*values) for name, *values in rows})
