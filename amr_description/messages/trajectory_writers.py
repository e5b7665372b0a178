# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
Samples of joint trajectories → messages of ROS.

``fill_…`` writes into a message; one that is published at every update is filled many times.
"""

from array import array
from typing import Any

from amr_description.control.trajectory_samples import (
    FollowTrajectoryFeedback,
    FollowTrajectoryResult,
    QueryStateResponse,
    TrajectoryPoint,
    TrajectoryStateSample,
)
from amr_description.messages.parts import fill_stamp


def fill_follow_feedback(sample: FollowTrajectoryFeedback, message: Any) -> None:
    """Write stamp, names and the three states."""
    fill_stamp(sample.stamp, message.header.stamp)
    message.joint_names = sample.joint_names
    _fill_point(sample.desired, message.desired)
    _fill_point(sample.actual, message.actual)
    _fill_point(sample.error, message.error)


def fill_follow_result(sample: FollowTrajectoryResult, message: Any) -> None:
    """Write code and text."""
    message.error_code = sample.error_code
    message.error_string = sample.error_string


def fill_trajectory_state(sample: TrajectoryStateSample, message: Any) -> None:
    """Write the four states and, when they have changed, the names."""
    fill_stamp(sample.stamp, message.header.stamp)
    if message.joint_names is not sample.joint_names:
        message.joint_names = sample.joint_names
    _fill_point(sample.reference, message.reference)
    _fill_point(sample.feedback, message.feedback)
    _fill_point(sample.error, message.error)
    _fill_point(sample.output, message.output)
    message.speed_scaling_factor = sample.speed_scaling_factor


def fill_query_response(sample: QueryStateResponse, message: Any) -> None:
    """Write all of it."""
    message.success = sample.success
    message.message = sample.message
    message.name = sample.joint_names
    message.position = array('d', sample.point.positions)
    message.velocity = array('d', sample.point.velocities)
    message.acceleration = array('d', sample.point.accelerations)


def _fill_point(point: TrajectoryPoint, message: Any) -> None:
    message.positions = array('d', point.positions)
    message.velocities = array('d', point.velocities)
    message.accelerations = array('d', point.accelerations)
    message.effort = array('d', point.effort)


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
