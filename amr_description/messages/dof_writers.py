# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
Samples of controllers of degrees of freedom, and of grippers → messages of ROS.

``fill_…`` writes into a message that is created once and published many times.
"""

from collections.abc import Callable
from typing import Any

from amr_description.clock import NANOSECONDS
from amr_description.control.dof_samples import (
    DofStatesSample,
    GripperState,
    PidStateSample,
    SetBoolResponse,
)
from amr_description.messages.parts import fill_stamp
from amr_description.messages.plain import message_like


def fill_dof_states(sample: DofStatesSample, message: Any) -> None:
    """Write the state of each degree of freedom."""
    fill_stamp(sample.stamp, message.header.stamp)
    message.dof_states = [
        message_like(
            message,
            'control_msgs/msg/SingleDOFState',
            name=state.name,
            reference=state.reference,
            feedback=state.feedback,
            feedback_dot=state.feedback_rate,
            error=state.error,
            error_dot=state.error_rate,
            time_step=state.time_step,
            output=state.output,
        )
        for state in sample.states
    ]


def fill_pid_state(sample: PidStateSample, message: Any) -> None:
    """Write what is inside of a PID."""
    fill_stamp(sample.stamp, message.header.stamp)
    seconds, rest = divmod(sample.time_step, NANOSECONDS)
    message.timestep.sec, message.timestep.nanosec = seconds, rest
    message.error_dot = sample.error_rate
    for name in ('error', 'p_error', 'i_error', 'd_error', 'p_term', 'i_term', 'd_term'):
        setattr(message, name, getattr(sample, name))
    message.i_max, message.i_min, message.output = sample.i_max, sample.i_min, sample.output


def fill_switch_response(sample: SetBoolResponse, message: Any) -> None:
    """Write the answer."""
    message.success, message.message = sample.success, sample.message


def fill_gripper_state(sample: GripperState, message: Any) -> None:
    """Write a result, or feedback, of GripperCommand."""
    message.position, message.effort = sample.position, sample.effort
    message.stalled, message.reached_goal = sample.stalled, sample.reached_goal


def fill_parallel_gripper_feedback(sample: GripperState, message: Any) -> None:
    """Write the feedback of ParallelGripperCommand."""
    message.state.name = [sample.joint]
    message.state.position, message.state.effort = [sample.position], [sample.effort]


def fill_parallel_gripper_result(sample: GripperState, message: Any) -> None:
    """Write the result of ParallelGripperCommand."""
    fill_parallel_gripper_feedback(sample, message)
    message.stalled, message.reached_goal = sample.stalled, sample.reached_goal


_GRIPPER = 'control_msgs/action/GripperCommand'
_PARALLEL = 'control_msgs/action/ParallelGripperCommand'
WRITERS: dict[tuple[type | None, str], Callable[[Any, Any], None]] = {
    (DofStatesSample, 'control_msgs/msg/MultiDOFStateStamped'): fill_dof_states,
    (GripperState, f'{_GRIPPER}_Feedback'): fill_gripper_state,
    (GripperState, f'{_GRIPPER}_Result'): fill_gripper_state,
    (GripperState, f'{_PARALLEL}_Feedback'): fill_parallel_gripper_feedback,
    (GripperState, f'{_PARALLEL}_Result'): fill_parallel_gripper_result,
    (PidStateSample, 'control_msgs/msg/PidState'): fill_pid_state,
    (SetBoolResponse, 'std_srvs/srv/SetBool_Response'): fill_switch_response,
}
"""Functions that write a sample into a message, likewise."""
