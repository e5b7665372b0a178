# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
Samples of joint trajectories ↔ ROS messages.

``fill_…`` writes into a message; one that is published at every update is filled many times.
"""

from array import array
from typing import Any

from builtin_interfaces.msg import Duration
from control_msgs.action import FollowJointTrajectory
from control_msgs.msg import (
    JointTolerance as JointToleranceMessage,
    JointTrajectoryControllerState,
    SpeedScalingFactor,
)
from control_msgs.srv import QueryTrajectoryState
from trajectory_msgs.msg import JointTrajectory, JointTrajectoryPoint

from amr_description.clock import NANOSECONDS
from amr_description.control.trajectory_samples import (
    FollowTrajectoryFeedback,
    FollowTrajectoryGoal,
    FollowTrajectoryResult,
    JointTolerance,
    QueryStateRequest,
    QueryStateResponse,
    SpeedScalingSample,
    TrajectoryPoint,
    TrajectorySample,
    TrajectoryStateSample,
)
from amr_description.ros.messages import fill_stamp, nanoseconds


def trajectory_sample(message: JointTrajectory) -> TrajectorySample:
    """Keep all of it but the frame."""
    return TrajectorySample(
        nanoseconds(message.header.stamp),
        tuple(message.joint_names),
        tuple(map(_point, message.points)),
        tuple(_duration(point.time_from_start) for point in message.points),
    )


def follow_goal(message: FollowJointTrajectory.Goal) -> FollowTrajectoryGoal:
    """Keep what is about single joints; multi-DOF joints are not followed, as in the original."""
    return FollowTrajectoryGoal(
        trajectory_sample(message.trajectory),
        tuple(map(_tolerance, message.path_tolerance)),
        tuple(map(_tolerance, message.goal_tolerance)),
        _duration(message.goal_time_tolerance) / NANOSECONDS,
    )


def fill_follow_feedback(
    sample: FollowTrajectoryFeedback, message: FollowJointTrajectory.Feedback
) -> None:
    """Write stamp, names and the three states."""
    fill_stamp(sample.stamp, message.header.stamp)
    message.joint_names = sample.joint_names
    _fill_point(sample.desired, message.desired)
    _fill_point(sample.actual, message.actual)
    _fill_point(sample.error, message.error)


def fill_follow_result(
    sample: FollowTrajectoryResult, message: FollowJointTrajectory.Result
) -> None:
    """Write code and text."""
    message.error_code = sample.error_code
    message.error_string = sample.error_string


def fill_trajectory_state(
    sample: TrajectoryStateSample, message: JointTrajectoryControllerState
) -> None:
    """Write the four states and, when they have changed, the names."""
    fill_stamp(sample.stamp, message.header.stamp)
    if message.joint_names is not sample.joint_names:
        message.joint_names = sample.joint_names
    _fill_point(sample.reference, message.reference)
    _fill_point(sample.feedback, message.feedback)
    _fill_point(sample.error, message.error)
    _fill_point(sample.output, message.output)
    message.speed_scaling_factor = sample.speed_scaling_factor


def speed_scaling(message: SpeedScalingFactor) -> SpeedScalingSample:
    """Keep the factor."""
    return SpeedScalingSample(message.factor)


def query_request(message: QueryTrajectoryState.Request) -> QueryStateRequest:
    """Keep the time."""
    return QueryStateRequest(nanoseconds(message.time))


def fill_query_response(
    sample: QueryStateResponse, message: QueryTrajectoryState.Response
) -> None:
    """Write all of it."""
    message.success = sample.success
    message.message = sample.message
    message.name = sample.joint_names
    message.position = array('d', sample.point.positions)
    message.velocity = array('d', sample.point.velocities)
    message.acceleration = array('d', sample.point.accelerations)


def _point(message: JointTrajectoryPoint) -> TrajectoryPoint:
    return TrajectoryPoint(
        tuple(message.positions),
        tuple(message.velocities),
        tuple(message.accelerations),
        tuple(message.effort),
    )


def _fill_point(point: TrajectoryPoint, message: JointTrajectoryPoint) -> None:
    message.positions = array('d', point.positions)
    message.velocities = array('d', point.velocities)
    message.accelerations = array('d', point.accelerations)
    message.effort = array('d', point.effort)


def _duration(duration: Duration) -> int:
    """Return ns."""
    return duration.sec * NANOSECONDS + duration.nanosec


def _tolerance(message: JointToleranceMessage) -> JointTolerance:
    return JointTolerance(message.name, message.position, message.velocity, message.acceleration)


READERS: dict[tuple[type | None, str], Any] = {
    (TrajectorySample, 'trajectory_msgs/msg/JointTrajectory'): trajectory_sample,
    (SpeedScalingSample, 'control_msgs/msg/SpeedScalingFactor'): speed_scaling,
    (FollowTrajectoryGoal, 'control_msgs/action/FollowJointTrajectory_Goal'): follow_goal,
    (QueryStateRequest, 'control_msgs/srv/QueryTrajectoryState_Request'): query_request,
}
"""(type of sample, type of message) → converter, as in ``converters.py``."""

WRITERS: dict[tuple[type | None, str], Any] = {
    (
        TrajectoryStateSample,
        'control_msgs/msg/JointTrajectoryControllerState',
    ): fill_trajectory_state,
    (
        FollowTrajectoryFeedback,
        'control_msgs/action/FollowJointTrajectory_Feedback',
    ): fill_follow_feedback,
    (
        FollowTrajectoryResult,
        'control_msgs/action/FollowJointTrajectory_Result',
    ): fill_follow_result,
    (
        QueryStateResponse,
        'control_msgs/srv/QueryTrajectoryState_Response',
    ): fill_query_response,
}
"""Likewise."""
