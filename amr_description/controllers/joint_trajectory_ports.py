# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""The topics, the service and the action of a joint trajectory controller."""

from collections.abc import Callable
from dataclasses import replace

from amr_description.control.contracts import (
    Action,
    ActionPort,
    Input,
    Output,
    Port,
    Qos,
    Service,
    ServicePort,
)
from amr_description.control.trajectory_samples import (
    FollowTrajectoryFeedback,
    FollowTrajectoryGoal,
    FollowTrajectoryResult,
    QueryStateRequest,
    QueryStateResponse,
    SpeedScalingSample,
    TrajectorySample,
    TrajectoryStateSample,
)

_TOPIC = Port('~/joint_trajectory', 'trajectory_msgs/msg/JointTrajectory', sample=TrajectorySample)
_SCALING = Port(
    '~/speed_scaling_input',
    'control_msgs/msg/SpeedScalingFactor',
    qos=Qos(durability='transient_local'),
    sample=SpeedScalingSample,
)
_STATE = Port(
    '~/controller_state',
    'control_msgs/msg/JointTrajectoryControllerState',
    sample=TrajectoryStateSample,
)
_QUERY = ServicePort(
    '~/query_state',
    'control_msgs/srv/QueryTrajectoryState',
    QueryStateRequest,
    QueryStateResponse,
)
_ACTION = ActionPort(
    '~/follow_joint_trajectory',
    'control_msgs/action/FollowJointTrajectory',
    FollowTrajectoryGoal,
    FollowTrajectoryFeedback,
    FollowTrajectoryResult,
)


class TrajectoryPorts:
    """Declares them, with the names and types of joint_trajectory_controller 4.x."""

    def __init__(
        self,
        rate: float,
        check_trajectory: Callable[[TrajectorySample, int], str],
        check_goal: Callable[[FollowTrajectoryGoal, int], str],
        answer: Callable[[QueryStateRequest], QueryStateResponse],
    ) -> None:
        """
        Make the ports.

        Args:
            rate: of the action, Hz.
            check_trajectory: of :class:`Input`.
            check_goal: of :class:`Action`.
            answer: of :class:`Service`.
        """
        self.topic: Input[TrajectorySample] = Input(_TOPIC, check=check_trajectory)
        self.scaling: Input[SpeedScalingSample] = Input(_SCALING)
        self.state: Output[TrajectoryStateSample] = Output(_STATE)
        self.query: Service[QueryStateRequest, QueryStateResponse] = Service(_QUERY, answer)
        self.action: Action[
            FollowTrajectoryGoal, FollowTrajectoryFeedback, FollowTrajectoryResult
        ] = Action(replace(_ACTION, rate=rate), check_goal)
