# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""Grippers: goals that are reached, stall, are cancelled and replaced, and what is commanded."""

import math

import pytest
from support.controller_bench import ControllerBench

from amr_description.control.contracts import Goal, GoalStatus
from amr_description.control.dof_samples import GripperGoal, GripperState
from amr_description.errors import ControllerError

PARALLEL = 'parallel_gripper_action_controller/GripperActionController'
POSITION = 'position_controllers/GripperActionController'
EFFORT = 'effort_controllers/GripperActionController'
KINDS = (PARALLEL, POSITION, EFFORT)


class Bench(ControllerBench):
    """A gripper at 0.02 that goes where ``move`` says, activated; 100 Hz."""

    def __init__(self, kind, **values):
        super().__init__(kind, **{'joint': 'finger'} | values)
        self.activate()
        self.measured = {state.interface: state for state in self.states}
        self.measured['position'].value = 0.02
        (self.action,) = self.controller.actions()
        self.action.open()

    def goal(self, position, velocity=(), effort=(5.0,)):
        goal = Goal(GripperGoal((position,), velocity, effort))
        assert self.action.check(goal.request, 0) == ''
        assert self.action.put(goal)
        return goal

    def run(self, count=1, position=None, velocity=0.0):
        if position is not None:
            self.measured['position'].value = position
        if 'velocity' in self.measured:
            self.measured['velocity'].value = velocity
        self.update(count)
        return {handle.name: handle.value for handle in self.commands}


@pytest.mark.parametrize('kind', KINDS)
def test_a_goal_succeeds_within_the_tolerance(kind):
    bench = Bench(kind, goal_tolerance=0.005)
    goal = bench.goal(0.04)
    bench.run(position=0.03, velocity=0.5)
    assert goal.is_live
    assert goal.feedback.position == 0.03
    bench.run(position=0.034)
    assert goal.is_live
    bench.run(position=0.036)
    status, state = goal.outcome
    assert status is GoalStatus.SUCCEEDED
    assert (state.joint, state.position) == ('finger', 0.036)
    assert (state.reached_goal, state.stalled) == (True, False)
    assert bench.run(position=0.036).keys() == {handle.name for handle in bench.commands}


@pytest.mark.parametrize('kind', KINDS)
@pytest.mark.parametrize(
    ('allows', 'status'), [(False, GoalStatus.ABORTED), (True, GoalStatus.SUCCEEDED)]
)
def test_a_gripper_that_does_not_move_has_stalled_after_the_timeout(kind, allows, status):
    bench = Bench(kind, allow_stalling=allows, stall_timeout=0.2)
    goal = bench.goal(0.0)
    bench.run(30, position=0.02, velocity=0.01)  # it still moves
    bench.run(20, velocity=0.0009)
    assert goal.is_live
    bench.run()
    assert goal.outcome[0] is status
    state = goal.outcome[1]
    assert (state.position, state.reached_goal, state.stalled) == (0.02, False, True)


@pytest.mark.parametrize('kind', [PARALLEL, POSITION])
def test_a_cancelled_gripper_holds_where_it_is(kind):
    bench = Bench(kind)
    assert bench.run()['finger/position'] == 0.02
    goal = bench.goal(0.08)
    assert bench.run(position=0.03, velocity=0.1)['finger/position'] == 0.08
    goal.is_cancel_requested = True
    assert bench.run(position=0.04, velocity=0.1)['finger/position'] == 0.04
    assert goal.outcome == (GoalStatus.CANCELED, None)
    assert bench.run(position=0.05)['finger/position'] == 0.04


def test_a_newer_goal_cancels_the_one_before():
    bench = Bench(PARALLEL)
    first, second = bench.goal(0.08), bench.goal(0.06)
    assert bench.run()['finger/position'] == 0.06
    assert first.outcome == (GoalStatus.CANCELED, None)
    third = bench.goal(0.07)
    assert bench.run()['finger/position'] == 0.07
    assert second.outcome[0] is GoalStatus.CANCELED
    bench.controller.reset(0)
    assert third.outcome[0] is GoalStatus.ABORTED
    assert bench.run(position=0.01)['finger/position'] == 0.01


def test_a_parallel_gripper_commands_its_limits_too():
    bench = Bench(
        PARALLEL,
        max_effort_interface='finger/set_gripper_max_effort',
        max_velocity_interface='finger/set_gripper_max_velocity',
        max_effort=12.0,
    )
    expected = {
        'finger/position': 0.02,
        'finger/set_gripper_max_effort': 12.0,
        'finger/set_gripper_max_velocity': 0.1,
    }
    assert bench.run() == expected
    bench.goal(0.05, velocity=(0.3,), effort=())
    expected |= {'finger/position': 0.05, 'finger/set_gripper_max_velocity': 0.3}
    assert bench.run() == expected


def test_without_a_velocity_state_the_positions_say_whether_it_moves():
    bench = Bench(PARALLEL, state_interfaces=['position', 'effort'], stall_timeout=0.1)
    goal = bench.goal(0.0)
    bench.measured['effort'].value = 3.0
    for step in range(30):
        bench.run(position=0.02 + 0.001 * step)
    assert goal.is_live
    bench.run(11)
    assert goal.outcome == (GoalStatus.ABORTED, GripperState('finger', 0.049, 3.0, True, False))
    with pytest.raises(ControllerError, match='Expected 1 position state interface'):
        Bench(PARALLEL, state_interfaces=['velocity'])


def test_an_effort_gripper_pushes_with_a_limited_effort():
    bench = Bench(EFFORT, gains__finger__p=100.0, gains__finger__d=1.0, max_effort=0.5)
    assert bench.run(position=0.02) == {'finger/effort': 0.0}
    assert bench.run(position=0.1) == {'finger/effort': -0.5}
    goal = bench.goal(0.06, effort=(2.0,))
    assert bench.run(position=0.05, velocity=0.5)['finger/effort'] == pytest.approx(1.0 - 0.5)
    assert bench.run(position=0.0, velocity=0.0)['finger/effort'] == 2.0
    bench.run(position=0.06)
    assert goal.outcome[1].reached_goal
    bench.controller.deactivate(0)
    assert {handle.name: handle.value for handle in bench.commands}['finger/effort'] == 0.0


@pytest.mark.parametrize(
    ('request_', 'text'),
    [
        (GripperGoal((), (), ()), 'wrong number of position values, expects 1, got 0'),
        (GripperGoal((0.1, 0.2), (), ()), 'wrong number of position values, expects 1, got 2'),
        (GripperGoal((math.nan,), (), ()), 'a value that is not finite'),
        (GripperGoal((0.1,), (), (math.inf,)), 'a value that is not finite'),
    ],
)
def test_goals_that_mean_nothing_are_rejected(request_, text):
    assert text in Bench(PARALLEL).action.check(request_, 0)
