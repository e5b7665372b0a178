# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
What a test reads of a robot, in SI units and without ROS.

Messages → readings.
"""

from dataclasses import dataclass
import math
from typing import Any

from amr_description.clock import NANOSECONDS
from amr_description.model.frames import conjugate, rotate, rpy_from_quaternion, Transform, Vector
from amr_description.ros.messages import transform_of, vector_of


@dataclass(frozen=True, slots=True)
class Motion:
    """Where a robot is and how it moves: in truth, or as its odometry says."""

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
    """A joint as /joint_states has it; rad and N·m for what turns, m and N for what slides."""

    position: float
    velocity: float
    effort: float


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
