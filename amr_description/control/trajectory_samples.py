# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
The samples of joint trajectories: plain values, no ROS messages.

Units are SI: rad or m, and their derivatives; N·m or N. Times are integer nanoseconds. What is
made at every update is a named tuple, in half the time of a frozen dataclass.
"""

from dataclasses import dataclass
from typing import NamedTuple


class TrajectoryPoint(NamedTuple):
    """
    A trajectory_msgs/JointTrajectoryPoint without its time: one value a joint, in one order.

    What is empty is not specified.
    """

    positions: tuple[float, ...] = ()
    velocities: tuple[float, ...] = ()
    accelerations: tuple[float, ...] = ()
    effort: tuple[float, ...] = ()


@dataclass(frozen=True, slots=True)
class TrajectorySample:
    """A trajectory_msgs/JointTrajectory."""

    stamp: int
    """When it starts; 0: on arrival."""
    joint_names: tuple[str, ...]
    points: tuple[TrajectoryPoint, ...]
    times: tuple[int, ...]
    """``time_from_start`` of each point."""


@dataclass(frozen=True, slots=True)
class JointTolerance:
    """A control_msgs/JointTolerance: 0: as the parameters have it; −1: none."""

    name: str
    position: float = 0.0
    velocity: float = 0.0
    acceleration: float = 0.0


@dataclass(frozen=True, slots=True)
class FollowTrajectoryGoal:
    """The goal of a control_msgs/FollowJointTrajectory."""

    trajectory: TrajectorySample
    path_tolerance: tuple[JointTolerance, ...] = ()
    goal_tolerance: tuple[JointTolerance, ...] = ()
    goal_time_tolerance: float = 0.0
    """s."""


@dataclass(frozen=True, slots=True)
class FollowTrajectoryResult:
    """Its result."""

    error_code: int = 0
    error_string: str = ''


class FollowTrajectoryFeedback(NamedTuple):
    """Its feedback."""

    stamp: int
    joint_names: tuple[str, ...]
    desired: TrajectoryPoint
    actual: TrajectoryPoint
    error: TrajectoryPoint


class TrajectoryStateSample(NamedTuple):
    """A control_msgs/JointTrajectoryControllerState."""

    stamp: int
    joint_names: tuple[str, ...]
    reference: TrajectoryPoint
    feedback: TrajectoryPoint
    error: TrajectoryPoint
    output: TrajectoryPoint
    speed_scaling_factor: float = 1.0


@dataclass(frozen=True, slots=True)
class SpeedScalingSample:
    """A control_msgs/SpeedScalingFactor."""

    factor: float


@dataclass(frozen=True, slots=True)
class QueryStateRequest:
    """The request of a control_msgs/QueryTrajectoryState."""

    time: int


@dataclass(frozen=True, slots=True)
class QueryStateResponse:
    """Its response; ``message`` is the reason of a failure."""

    success: bool
    message: str = ''
    joint_names: tuple[str, ...] = ()
    point: TrajectoryPoint = TrajectoryPoint()
