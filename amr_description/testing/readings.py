# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""What a test reads of a robot, in SI units and without ROS."""

from dataclasses import dataclass

from amr_description.model.frames import rpy_from_quaternion, Transform, Vector


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
