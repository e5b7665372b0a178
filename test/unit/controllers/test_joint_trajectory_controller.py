# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
The joint trajectory controller over joints without physics, update by update.

What its parameters may be: ``test_joint_trajectory_parameters.py``.
"""

import math

from hypothesis import given, strategies as st
import pytest
from support.trajectory_arm import Arm, outcome, PERIOD, trajectory

from amr_description.clock import NANOSECONDS as S
from amr_description.control.contracts import GoalStatus
from amr_description.control.trajectory_samples import (
    JointTolerance,
    QueryStateRequest,
    SpeedScalingSample,
    TrajectoryPoint,
)
from amr_description.log import Severity
from amr_description.model.urdf import parse

URDF = """
<robot name="arm"><link name="base"/><link name="upper"/><link name="lower"/>
<joint name="a" type="continuous"><parent link="base"/><child link="upper"/></joint>
<joint name="b" type="revolute"><parent link="upper"/><child link="lower"/>
<limit lower="-9" upper="9" effort="1" velocity="9"/></joint></robot>
"""


def test_it_holds_where_the_joints_are_after_activation():
    arm = Arm(positions=(1.0, 2.0)).activate()
    assert arm.run(0.05) == [[1.0, 2.0]] * 5


def test_it_holds_the_last_command_where_there_is_one():
    arm = Arm(positions=(1.0, 2.0))
    for handle in arm.commands:
        handle.value = 0.5
    arm.is_following = False
    assert arm.activate().run(0.02) == [[0.5, 0.5]] * 2
    arm = Arm(positions=(1.0, 2.0), set_last_command_interface_value_as_state_on_activation=False)
    for handle in arm.commands:
        handle.value = 0.5
    assert arm.activate().run(0.01) == [[1.0, 2.0]]


def test_it_holds_as_soon_as_positions_are_known():
    arm = Arm(positions=(math.nan, math.nan)).activate()
    assert all(math.isnan(value) for row in arm.run(0.02) for value in row)
    arm.place(1.0, 2.0)
    assert arm.run(0.02) == [[1.0, 2.0]] * 2


def test_a_goal_is_followed_and_reached():
    arm = Arm().activate()
    arm.run()
    goal = arm.send((1.0, -2.0), times=[1.0])
    commands = arm.run(0.99)
    assert commands[49] == pytest.approx([0.5, -1.0])  # commanded one period ahead
    assert goal.is_live
    assert goal.feedback.joint_names == ('a', 'b')
    assert goal.feedback.desired.positions == pytest.approx((0.98, -1.96))
    assert goal.feedback.error.positions == pytest.approx((0.0, 0.0), abs=1e-12)
    arm.run(0.02)
    assert outcome(goal) == (GoalStatus.SUCCEEDED, 0, 'Goal successfully reached!')
    assert 'Goal reached, success!' in arm.log.texts()
    assert arm.run(0.5)[-1] == pytest.approx([1.0, -2.0])


def test_what_pushes_a_joint_away_after_its_goal_is_no_fault():
    arm = Arm(constraints__b__goal=0.1, constraints__goal_time=0.2).activate()
    arm.run()
    goal = arm.send((1.0, -2.0), times=[0.5])
    arm.run(0.6)
    assert outcome(goal)[0] == GoalStatus.SUCCEEDED
    arm.is_following = False
    arm.place(1.0, -1.0)
    logged = len(arm.log.texts())
    assert arm.run(0.5)[-1] == pytest.approx([1.0, -2.0])
    assert arm.log.texts()[logged:] == []


def test_the_topic_is_followed_and_a_wrong_one_refused_by_its_check():
    arm = Arm().activate()
    topic = arm.controller.inputs()[0]
    assert topic.check(trajectory((1.0, 1.0), names=('a', 'x')), 0) == (
        "Incoming joint x doesn't match the controller's joints."
    )
    topic.put(trajectory((1.0, 1.0)))
    assert arm.run(1.1)[-1] == pytest.approx([1.0, 1.0])


@given(st.lists(st.integers(1, 60), min_size=1, max_size=4), st.booleans())
def test_no_replacement_makes_the_command_jump(moments, from_desired):
    arm = Arm(interpolate_from_desired_state=from_desired).activate()
    commands = arm.run()
    for k, moment in enumerate(moments):
        arm.send(TrajectoryPoint(((-1.0) ** k, k / 4.0), (0.0, 0.0)), times=[0.5])
        commands += arm.run(moment / 100.0)
    steps = [
        abs(after - before)
        for one, two in zip(commands, commands[1:], strict=False)
        for before, after in zip(one, two, strict=True)
    ]
    # The greatest speed of a cubic over 2 rad in 0.5 s from rest is 1.5 times its mean; one that
    # goes back from full speed is at most that much faster again.
    assert max(steps) < 0.01 * 2.0 * 1.5 * 2.0 / 0.5


def test_a_desired_state_is_left_without_a_step_in_position_or_velocity():
    arm = Arm(interpolate_from_desired_state=True).activate()
    arm.run()
    arm.is_following = False  # the measured state stays at zero
    arm.send(TrajectoryPoint((2.0, 0.0), (0.0, 0.0)), times=[2.0])
    before = [row[0] for row in arm.run(1.0)]
    arm.send(TrajectoryPoint((0.0, 0.0), (0.0, 0.0)), times=[1.0])
    after = [row[0] for row in arm.run(0.1)]
    positions = before[-3:] + after[:3]
    speeds = [(two - one) / 0.01 for one, two in zip(positions, positions[1:], strict=False)]
    assert all(abs(two - one) < 0.15 for one, two in zip(speeds, speeds[1:], strict=False))
    assert arm.sent[-1].feedback.positions == (0.0, 0.0)


def test_a_newer_goal_cancels_the_older_one():
    arm = Arm().activate()
    older, newest = arm.send((1.0, 1.0)), None
    arm.run(0.1)
    middle, newest = arm.send((2.0, 2.0)), arm.send((3.0, 3.0))
    arm.run(1.5)
    text = 'Current goal cancelled due to new incoming action.'
    assert outcome(older) == outcome(middle) == (GoalStatus.CANCELED, -1, text)
    assert newest.outcome[0] is GoalStatus.SUCCEEDED


def test_a_canceled_goal_holds_where_the_joints_are():
    arm = Arm().activate()
    goal = arm.send((1.0, 1.0))
    arm.run(0.5)
    goal.is_cancel_requested = True
    commands = arm.run(0.2)
    assert outcome(goal) == (GoalStatus.CANCELED, 0, '')
    assert commands[0] == commands[-1] == pytest.approx([0.5, 0.5], abs=0.011)


def test_a_canceled_goal_may_come_to_rest_by_a_deceleration():
    arm = Arm(
        constraints__decelerate_on_cancel=True,
        constraints__a__max_deceleration_on_cancel=2.0,
        constraints__b__max_deceleration_on_cancel=4.0,
    ).activate()
    goal = arm.send((5.0, 5.0), times=[5.0])
    arm.run(1.0)
    goal.is_cancel_requested = True
    begin = arm.values()
    arm.place(*begin, velocities=(1.0, 1.0))
    end = arm.run(1.0)[-1]
    # v² / (2·a) beyond the state at the cancel
    assert end == pytest.approx([begin[0] + 0.25, begin[1] + 0.125], abs=1e-6)


@pytest.mark.parametrize(
    ('parameters', 'text'),
    [
        (
            {'state_interfaces': ('position',)},
            "'constraints.decelerate_on_cancel' needs the 'velocity' state interface; holding "
            'position on cancel instead',
        ),
        (
            {'constraints__a__max_deceleration_on_cancel': 1.0},
            "'constraints.b.max_deceleration_on_cancel' is not set; holding position on cancel "
            'instead',
        ),
    ],
)
def test_a_deceleration_that_is_not_possible_is_named(parameters, text):
    arm = Arm(constraints__decelerate_on_cancel=True, **parameters)
    assert text in arm.log.texts(Severity.WARN)


def test_a_joint_that_stays_behind_aborts_the_goal_with_its_name():
    arm = Arm(constraints__b__trajectory=0.1).activate()
    arm.is_following = False
    goal = arm.send((0.0, 1.0))
    arm.run(0.2)
    status, code, text = outcome(goal)
    assert (status, code) == (GoalStatus.ABORTED, -4)
    assert text == (
        'Aborted due to path tolerance violation; b: position error 0.110000, tolerance 0.100000'
    )
    assert 'Aborted due to state tolerance violation' in arm.log.texts(Severity.WARN)
    assert (
        'State tolerances failed for joint 1 (b): Position Error: 0.110000, Position Tolerance: '
        '0.100000'
    ) in arm.log.texts(Severity.ERROR)
    assert arm.run(0.5)[-1] == [0.0, 0.0]


def test_without_a_goal_a_violated_tolerance_holds():
    arm = Arm(constraints__b__trajectory=0.1).activate()
    arm.is_following = False
    arm.controller.inputs()[0].put(trajectory((0.0, 1.0)))
    arm.run(0.5)
    assert 'Holding position due to state tolerance violation' in arm.log.texts(Severity.ERROR)
    assert arm.values() == [0.0, 0.0]


def test_a_goal_that_takes_too_long_is_aborted():
    arm = Arm(constraints__a__goal=0.01, constraints__goal_time=0.5).activate()
    arm.is_following = False
    goal = arm.send((1.0, 0.0), times=[1.0])
    arm.run(1.4)
    assert goal.is_live
    arm.run(0.2)
    assert outcome(goal) == (
        GoalStatus.ABORTED,
        -5,
        'Aborted due to goal_time_tolerance exceeding by 0.510000 seconds; a: position error '
        '1.000000, tolerance 0.010000',
    )
    logged = len(arm.log.texts())
    arm.place(0.5, 0.0)  # it holds; what pushes it is no fault of anything
    arm.run(0.6)
    assert arm.log.texts()[logged:] == []


def test_the_tolerances_of_a_goal_hold_for_it_alone():
    arm = Arm(constraints__b__trajectory=0.1).activate()
    arm.is_following = False
    goal = arm.send((0.0, 1.0), path_tolerance=(JointTolerance('b', -1.0),))
    arm.run(1.1)
    assert goal.outcome[0] is GoalStatus.SUCCEEDED
    arm.controller.inputs()[0].put(trajectory((0.0, -1.0)))
    arm.run(0.5)
    assert 'Holding position due to state tolerance violation' in arm.log.texts(Severity.ERROR)


def test_tolerances_with_a_mistake_are_named():
    arm = Arm().activate()
    arm.send((0.0, 1.0), goal_tolerance=(JointTolerance('x', 1.0),))
    arm.run()
    assert (
        "Goal tolerance specified for unknown joint 'x'. Using default tolerances."
    ) in arm.log.texts(Severity.WARN)


def test_a_joint_still_moving_at_its_goal_is_waited_for():
    arm = Arm(
        command_interfaces=('position', 'velocity'), constraints__stopped_velocity_tolerance=0.1
    ).activate()
    goal = arm.send((1.0, 1.0))
    arm.run(1.0)
    arm.place(1.0, 1.0, velocities=(0.2, 0.0))
    arm.is_following = False
    arm.run(0.5)
    assert goal.is_live
    arm.place(1.0, 1.0, velocities=(0.1, 0.0))
    arm.run(0.02)
    assert goal.outcome[0] is GoalStatus.SUCCEEDED


def test_a_command_times_out_behind_its_end():
    arm = Arm(cmd_timeout=0.5, constraints__a__goal=0.01).activate()
    arm.is_following = False
    goal = arm.send((1.0, 0.0))
    arm.run(1.4)
    assert arm.values() == [1.0, 0.0]
    arm.run(0.2)
    assert arm.values() == [0.0, 0.0]
    status, code, text = outcome(goal)
    assert (status, code) == (GoalStatus.ABORTED, -5)
    assert text.startswith('Aborted due to command timeout; a: ')


def test_a_timeout_within_the_goal_time_is_ignored_with_a_warning():
    arm = Arm(cmd_timeout=0.5, constraints__goal_time=1.0).activate()
    assert (
        'Command timeout must be higher than goal_time tolerance (0.500000 vs. 1.000000)'
    ) in arm.log.texts(Severity.WARN)


def test_a_deactivation_aborts_the_goals_and_stops_what_moves():
    arm = Arm(command_interfaces=('position', 'velocity')).activate()
    goal = arm.send((1.0, 1.0))
    arm.run(0.5)
    waiting = arm.send((2.0, 2.0))
    positions = arm.values()
    arm.controller.deactivate(arm.time)
    text = 'Current goal cancelled during deactivate transition.'
    assert outcome(goal) == outcome(waiting) == (GoalStatus.ABORTED, -1, text)
    assert arm.values('velocity') == [0.0, 0.0]
    assert arm.values() == positions


def test_joints_that_a_goal_lacks_stay():
    arm = Arm(allow_partial_joints_goal=True, positions=(0.3, 0.7)).activate()
    arm.run()
    goal = arm.send(TrajectoryPoint((2.0,), (0.0,)), names=('b',))
    assert arm.run(1.1)[-1] == pytest.approx([0.3, 2.0])
    assert goal.outcome[0] is GoalStatus.SUCCEEDED


def test_a_goal_may_name_the_joints_in_another_order():
    arm = Arm().activate()
    arm.send((1.0, 2.0), names=('b', 'a'))
    assert arm.run(1.1)[-1] == pytest.approx([2.0, 1.0])


def test_joints_that_are_not_commanded_are_measured():
    arm = Arm(command_joints=('b',), constraints__a__trajectory=0.1).activate()
    arm.is_following = False
    goal = arm.send((1.0, 1.0))
    commands = arm.run(0.05)
    assert [len(row) for row in commands] == [1] * 5
    assert arm.sent[-1].output.positions[1] == commands[-1][0]
    assert math.isnan(arm.sent[-1].output.positions[0])
    arm.run(0.2)
    assert goal.outcome[1].error_code == -4


def test_a_continuous_joint_takes_the_shortest_way_and_a_revolute_one_does_not():
    robot = parse(URDF)
    arm = Arm(robot, positions=(3.0, 3.0), constraints__a__goal=0.05).activate()
    arm.run()
    goal = arm.send((-3.0, -3.0))
    begin = arm.run(0.02)[-1]
    assert begin[0] == pytest.approx(3.0, abs=0.01)
    assert begin[1] == pytest.approx(2.9, abs=0.05)
    assert arm.sent[-1].reference.positions[0] == pytest.approx(3.0 - math.tau, abs=0.01)
    arm.is_following = False
    arm.place(-3.0 + 3 * math.tau, -3.0)  # turns later, but in the same place
    arm.run(1.1)
    assert goal.outcome[0] is GoalStatus.SUCCEEDED


@given(
    st.lists(st.tuples(st.floats(-9.0, 9.0), st.integers(5, 150)), min_size=1, max_size=4),
    st.booleans(),
)
def test_a_continuous_joint_is_never_commanded_back_by_a_turn(goals, from_desired):
    arm = Arm(parse(URDF), interpolate_from_desired_state=from_desired).activate()
    commands = arm.run()
    for angle, moment in goals:
        arm.send((angle, 0.0))
        commands += arm.run(moment / 100.0)
    steps = [abs(two[0] - one[0]) for one, two in zip(commands, commands[1:], strict=False)]
    assert max(steps) < math.pi * 0.02 + 1e-6  # half a turn in 1 s, at most two periods of it
    arm.run(1.0)
    assert math.remainder(arm.values()[0] - goals[-1][0], math.tau) == pytest.approx(0.0, abs=1e-6)


def test_velocity_alone_is_commanded_by_a_pid_with_feed_forward():
    arm = Arm(
        command_interfaces=('velocity',),
        gains__a__p=10.0,
        gains__a__ff_velocity_scale=1.0,
        gains__b__p=5.0,
    ).activate()
    arm.send((1.0, 1.0))
    commands = arm.run(0.5)
    # Nothing moves: the position error is what is desired now.
    assert commands[-1] == pytest.approx([1.0 + 10.0 * 0.49, 5.0 * 0.49])


def test_effort_alone_is_commanded_by_a_pid_over_the_desired_effort():
    arm = Arm(
        command_interfaces=('effort',), gains__a__p=100.0, gains__b__d=3.0, gains__a__i=1.0
    ).activate()
    arm.send(TrajectoryPoint((0.0, 1.0), effort=(7.0, 0.0)))
    commands = arm.run(0.5)
    assert commands[-1][0] == pytest.approx(7.0 * 0.5)
    assert commands[-1][1] == pytest.approx(3.0 * 1.0)


def test_velocities_and_accelerations_are_commanded_as_they_are():
    arm = Arm(
        command_interfaces=('position', 'velocity', 'acceleration'),
        state_interfaces=('position', 'velocity', 'acceleration'),
    ).activate()
    arm.send(TrajectoryPoint((1.0, 0.0), (0.0, 0.0), (0.0, 0.0)))
    arm.run(0.5)
    # The middle of a quintic between two rests: 15/8 of the mean speed, no acceleration.
    assert arm.values('velocity') == pytest.approx([1.875, 0.0], abs=0.05)
    assert arm.values('acceleration') == pytest.approx([0.0, 0.0], abs=0.7)


def test_trajectories_pass_more_slowly_with_a_speed_scaling():
    arm = Arm(speed_scaling__initial_scaling_factor=0.5).activate()
    goal = arm.send((1.0, 1.0))
    arm.run(1.0)
    assert arm.sent[-1].reference.positions == pytest.approx((0.495, 0.495))
    assert arm.sent[-1].speed_scaling_factor == 0.5
    arm.controller.inputs()[1].put(SpeedScalingSample(-1.0))
    arm.controller.inputs()[1].put(SpeedScalingSample(0.0))
    arm.run(0.5)
    held = arm.sent[-1].reference.positions
    arm.run(0.5)
    assert arm.sent[-1].reference.positions == held
    assert 'New scaling factor will be 0.000000' in arm.log.texts()
    assert 'Scaling factor has to be greater or equal to 0.0 - Ignoring input!' in arm.log.texts(
        Severity.WARN
    )
    assert goal.is_live


def test_the_hardware_may_scale_the_speed():
    arm = Arm(
        speed_scaling__state_interface='robot/scaling',
        speed_scaling__command_interface='robot/scaling',
    )
    arm.states[-1].value = 0.25
    arm.activate().send((1.0, 1.0))
    arm.run(1.0)
    assert arm.sent[-1].reference.positions == pytest.approx((0.2475, 0.2475))
    assert arm.commands[-1].value == 0.25


def test_the_state_is_sent_at_every_update():
    arm = Arm().activate()
    arm.send((1.0, 1.0))
    arm.run(0.5)
    assert len(arm.sent) == 50
    state = arm.sent[-1]
    assert state.stamp == arm.time - PERIOD
    assert state.reference.positions == pytest.approx((0.49, 0.49))
    assert state.reference.velocities == pytest.approx((1.0, 1.0))
    assert state.output.positions == pytest.approx((0.5, 0.5))
    assert state.output.velocities == ()
    assert state.error.velocities == (0.0, 0.0)


def test_the_state_at_a_time_is_answered():
    arm = Arm()
    answer = arm.controller.services()[0].answer
    assert answer(QueryStateRequest(0)).message == (
        "Can't sample trajectory. Controller is not active."
    )
    arm.activate().send((1.0, 1.0))
    arm.run(0.5)
    response = answer(QueryStateRequest(5 * S + S // 4))
    assert response.success
    assert response.joint_names == ('a', 'b')
    assert response.point.positions == pytest.approx((0.25, 0.25))
    late = answer(QueryStateRequest(9 * S))
    assert not late.success
    assert late.message == 'Requested sample time precedes the current trajectory end time.'
    assert late.point.positions == (1.0, 1.0)
    assert answer(QueryStateRequest(0)).message == (
        'Requested sample time is earlier than the current trajectory start time.'
    )
    assert arm.run(0.1)[-1] == pytest.approx([0.6, 0.6])  # undisturbed


def test_a_reset_aborts_the_goal_and_holds_where_the_joints_are():
    arm = Arm().activate()
    goal = arm.send((1.0, 1.0))
    arm.run(0.5)
    arm.controller.reset(0)
    arm.time = 0
    arm.place(0.1, 0.2)
    assert arm.run(0.05) == [[0.1, 0.2]] * 5
    assert outcome(goal)[:2] == (GoalStatus.ABORTED, -1)


def test_a_jump_of_the_clock_leaves_the_motion_as_it_is():
    arm = Arm().activate()
    arm.send((1.0, 1.0))
    arm.run(0.5)
    arm.time -= 3 * S
    arm.controller.set_clock(arm.time - PERIOD)
    assert arm.run(0.1)[-1] == pytest.approx([0.6, 0.6])


def test_it_survives_a_reset_and_a_jump_while_inactive():
    arm = Arm()
    arm.controller.reset(0)
    arm.controller.set_clock(0)
    arm.controller.deactivate(0)
