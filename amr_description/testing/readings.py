# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
What a test reads of a robot, in SI units, and how it is made of messages.
"""

from dataclasses import dataclass
import math
from typing import Any

from amr_description.clock import NANOSECONDS
from amr_description.model.frames import conjugate, rotate, rpy_from_quaternion, Transform, Vector
from amr_description.ros.messages import nanoseconds, transform_of, vector_of


@dataclass(frozen=True, slots=True)
class Motion:
    """Pose and velocity of a robot: ground truth, or its odometry."""

    time: float
    """s, simulated."""
    pose: Transform
    """From the robot's base to the world, or to the frame of odometry."""
    linear: Vector
    """m/s, in the robot's own axes: forward, left, up."""
    angular: Vector
    """rad/s, about the same axes."""

    @property
    def x(self) -> float:
        """m."""
        return self.pose.translation[0]

    @property
    def y(self) -> float:
        """m."""
        return self.pose.translation[1]

    @property
    def z(self) -> float:
        """m."""
        return self.pose.translation[2]

    @property
    def roll(self) -> float:
        """rad, about x."""
        return rpy_from_quaternion(self.pose.rotation)[0]

    @property
    def pitch(self) -> float:
        """rad, about y."""
        return rpy_from_quaternion(self.pose.rotation)[1]

    @property
    def yaw(self) -> float:
        """rad, about z, from -π to π."""
        return rpy_from_quaternion(self.pose.rotation)[2]


@dataclass(frozen=True, slots=True)
class Joint:
    """The state of a joint: rad, rad/s and N·m, or m, m/s and N."""

    position: float
    velocity: float
    effort: float


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


def joints_of(message: Any) -> dict[str, Joint]:
    """Read a sensor_msgs/msg/JointState: joint → state; NaN for missing values."""
    columns = (message.position, message.velocity, message.effort)
    padded = ([*column] or [math.nan] * len(message.name) for column in columns)
    rows = zip(message.name, *padded, strict=True)
    return {name: Joint(*values) for name, *values in rows}
