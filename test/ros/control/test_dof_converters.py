# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""PID controllers and grippers: their samples as messages, and goals as samples."""

from control_msgs.action import GripperCommand, ParallelGripperCommand
from control_msgs.msg import MultiDOFCommand, MultiDOFStateStamped, PidState
import pytest
from rclpy.serialization import deserialize_message, serialize_message
from std_srvs.srv import SetBool
from support.control_fakes import FakeLog

from amr_description.control.contracts import ControllerContext, Port
from amr_description.control.dof_samples import (
    DofCommandSample,
    DofState,
    DofStatesSample,
    GripperGoal,
    GripperState,
    PidStateSample,
    SetBoolRequest,
    SetBoolResponse,
)
from amr_description.controllers import CONTROLLERS
from amr_description.messages import readers, writers
from amr_description.parameters import build

STAMP = 3_000_000_007
STATE = GripperState('finger', 0.5, 2.0, stalled=True, reached_goal=False)


def arrive(sample, message, kind):
    writers.writer_of(Port('it', kind, sample=type(sample)))(sample, message)
    return deserialize_message(serialize_message(message), type(message))


def test_states_of_degrees_of_freedom():
    states = (DofState('a', 1.0, 2.0, 3.0, 4.0, 5.0, 6.0, 7.0),)
    message = arrive(
        DofStatesSample(STAMP, states),
        MultiDOFStateStamped(),
        'control_msgs/msg/MultiDOFStateStamped',
    )
    (state,) = message.dof_states
    assert (message.header.stamp.sec, state.name, state.reference, state.feedback) == (
        3,
        'a',
        1,
        2,
    )
    assert (state.feedback_dot, state.error, state.error_dot) == (3.0, 4.0, 5.0)
    assert (state.time_step, state.output) == (6.0, 7.0)


def test_what_is_inside_of_a_pid():
    sample = PidStateSample(STAMP, 2 * STAMP, *map(float, range(11)))
    message = arrive(sample, PidState(), 'control_msgs/msg/PidState')
    assert (message.timestep.sec, message.timestep.nanosec) == (6, 14)
    assert (message.error, message.error_dot, message.p_error, message.d_error) == (0, 1, 2, 4)
    assert (message.p_term, message.i_term, message.d_term) == (5.0, 6.0, 7.0)
    assert (message.i_max, message.i_min, message.output) == (8.0, 9.0, 10.0)


def test_commands_and_switches():
    port = Port('it', 'control_msgs/msg/MultiDOFCommand', sample=DofCommandSample)
    message = MultiDOFCommand(dof_names=['a'], values=[1.0], values_dot=[2.0])
    assert readers.reader_of(port)(message) == DofCommandSample(('a',), (1.0,), (2.0,))
    port = Port('it', 'std_srvs/srv/SetBool_Request', sample=SetBoolRequest)
    assert readers.reader_of(port)(SetBool.Request(data=True)) == SetBoolRequest(True)
    answer = arrive(
        SetBoolResponse(True, 'on'), SetBool.Response(), 'std_srvs/srv/SetBool_Response'
    )
    assert (answer.success, answer.message) == (True, 'on')


@pytest.mark.parametrize(
    ('kind', 'expected'),
    [
        ('position_controllers', GripperGoal((0.5,), (), (2.0,))),
        ('effort_controllers', GripperGoal((0.5,), (), (2.0,))),
        ('parallel_gripper_action_controller', GripperGoal((0.5,), (0.25,), (2.0,))),
    ],
)
def test_goals_and_results_of_grippers(kind, expected):
    found = CONTROLLERS.find(f'{kind}/GripperActionController')
    controller = found(ControllerContext('it', FakeLog()))
    controller.configure(build(found.parameters_type, {'joint': 'finger'}))
    port = controller.actions()[0].port
    is_parallel = kind.startswith('parallel')
    action = ParallelGripperCommand if is_parallel else GripperCommand
    goal = action.Goal()
    if is_parallel:
        goal.command.position, goal.command.velocity = [0.5], [0.25]
        goal.command.effort = [2.0]
    else:
        goal.command.position, goal.command.max_effort = 0.5, 2.0
    read = readers.reader_of(Port('it', f'{port.action}_Goal', sample=port.goal))
    assert read(goal) == expected
    for part in ('Feedback', 'Result'):
        message = arrive(STATE, getattr(action, part)(), f'{port.action}_{part}')
        state = message.state if is_parallel else message
        position, effort = (0.5, 2.0) if not is_parallel else ([0.5], [2.0])
        found_values = (state.position, state.effort)
        assert tuple(map(list, found_values) if is_parallel else found_values) == (
            position,
            effort,
        )
        if part == 'Result' or not is_parallel:
            assert (message.stalled, message.reached_goal) == (True, False)
