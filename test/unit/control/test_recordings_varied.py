# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
The recordings again, with one thing changed that must not matter, or whose effect is known:
feedback, rates, limits, chains, and controllers and hardware that come and go in mid-run.
"""

from dataclasses import replace
from itertools import pairwise

import pytest
from support.control_fakes import (
    FakeController,
    FakeLog,
    LEFT,
    load_trace,
    MS,
    RIGHT,
    start,
    TRACES,
)
from support.replaying import mock_wheels, PERIOD, Replay, URDF

from amr_description.control.interfaces import LifecycleState
from amr_description.control.resource_manager import ResourceManager
from amr_description.control.switching import Strictness
from amr_description.hardware.mock_system import MockSystem

SECOND = 1000 * MS


def pose_at(replay, stamp):
    sample = replay.odometry[stamp]
    return sample.x, sample.y, sample.heading


def stamps_of(replay):
    return [row[0] for row in replay.trace['odom']]


def check_wheels_and_joints(replay, begin=0, end=2**63):
    """The same bits as recorded, at every instant of the interval."""
    for stamp, left, right in replay.trace['wheel_commands']:
        if begin <= stamp <= end:
            assert replay.wheels[stamp] == dict.fromkeys(LEFT, left) | dict.fromkeys(RIGHT, right)
    joint_states = replay.joint_states
    for stamp, positions, velocities in replay.trace['joint_states']:
        if begin <= stamp <= end:
            sample = joint_states[stamp]
            assert (list(sample.position), list(sample.velocity)) == (positions, velocities)


# --- what must not matter ------------------------------------------------------------------------


@pytest.mark.parametrize('name', TRACES)
def test_velocity_feedback_gives_the_same_pose(name):
    replay = Replay(name, position_feedback=False).run()
    check_wheels_and_joints(replay)
    for stamp, x, y, *_ in replay.trace['odom']:
        assert pose_at(replay, stamp)[:2] == pytest.approx((x, y), abs=1e-12)


@pytest.mark.parametrize('name', TRACES)
def test_open_loop_gives_the_pose_one_cycle_before_the_wheels(name):
    replay = Replay(name, open_loop=True).run()
    check_wheels_and_joints(replay)
    for stamp, x, y, *_ in replay.trace['odom'][1:]:
        assert pose_at(replay, stamp - PERIOD)[:2] == pytest.approx((x, y), abs=1e-12)


@pytest.mark.parametrize('name', TRACES)
def test_radius_multipliers_are_as_good_as_the_radius(name):
    halves = {'wheel_radius': 0.2, 'left_wheel_radius_multiplier': 0.5}
    replay = Replay(name, **halves, right_wheel_radius_multiplier=0.5).run()
    check_wheels_and_joints(replay)


def limited_wheels(bound):
    """The mock under ``enforce_command_limits``, each wheel bounded by ``bound`` rad/s."""
    info = mock_wheels().info
    joints = tuple(
        replace(
            joint,
            command_interfaces=tuple(
                replace(command, min=-bound, max=bound) for command in joint.command_interfaces
            ),
        )
        for joint in info.joints
    )
    resources = ResourceManager(FakeLog(), URDF, enforce_command_limits=True)
    resources.add(MockSystem(replace(info, joints=joints), FakeLog()))
    resources.start_components()
    return resources


@pytest.mark.parametrize('name', TRACES)
def test_limits_that_are_never_met_change_no_bit(name):
    check_wheels_and_joints(Replay(name, limited_wheels(1000.0)).run())


@pytest.mark.parametrize('name', TRACES)
def test_limits_that_are_met_hold_and_odometry_goes_by_the_wheels(name):
    bound = 1.5
    replay = Replay(name, limited_wheels(bound)).run()
    for stamp, left, right in replay.trace['wheel_commands']:
        expected = {j: min(max(left, -bound), bound) for j in LEFT}
        expected |= {j: min(max(right, -bound), bound) for j in RIGHT}
        assert replay.wheels[stamp] == expected
    joint_states = replay.joint_states.values()
    assert max(abs(v) for sample in joint_states for v in sample.velocity) == bound
    twists = [sample.linear for sample in replay.odometry.values()]
    assert max(map(abs, twists)) <= bound * 0.1 + 1e-9


@pytest.mark.parametrize('name', TRACES)
def test_another_controller_that_comes_and_goes_does_not_matter(name):
    replay = Replay(name)
    start(replay.manager, FakeController('bystander', states=['joint_wheel_back_left/position']))
    for step in range(8):
        replay.run(until=replay.begin + step * SECOND // 3)
        names = [['bystander'], []]
        replay.manager.switch(
            names[step % 2 == 0], names[step % 2 != 0], Strictness.STRICT, replay.time
        )
    check_wheels_and_joints(replay.run())


class Upstream(FakeController):
    """Commands, in chained mode, what the recorded drive was commanded, at each instant."""

    def __init__(self, trace):
        references = [f'diff_drive/{axis}/velocity' for axis in ('linear', 'angular')]
        super().__init__('upstream', commands=references)
        self.twists = {stamp: (linear, angular) for stamp, linear, angular in trace['cmd_out']}

    def update(self, time, period):
        for handle, value in zip(self.handles, self.twists.get(time, (0.0, 0.0)), strict=True):
            handle.value = value


@pytest.mark.parametrize('name', [name for name in TRACES if name != 'limit_jerk'])
def test_a_chain_drives_as_the_topic_does(name):
    """The recorded limited commands, given as references, act in the same cycle."""
    replay = Replay(name)
    start(replay.manager, Upstream(load_trace(name)), time=replay.time)
    check_wheels_and_joints(replay.run())


# --- what is interrupted -------------------------------------------------------------------------

MIDDLE = 1 * SECOND
"""ns after the beginning of a trace: the arc is being driven, 0.005 m and 0.005 rad a cycle."""
PAUSE = SECOND // 2
ONE_CYCLE = 0.006
"""m or rad: the motion that was under way when it was interrupted may still be counted."""


def interrupted(action):
    """The recorded arc, up to its middle, where ``action`` is done between two cycles."""
    replay = Replay('arc_0p5_0p5')
    replay.run(until=replay.begin + MIDDLE)
    action(replay)
    return replay


def stop(replay):
    replay.manager.switch([], ['diff_drive'], Strictness.STRICT, replay.time)


def go_on(replay):
    replay.manager.switch(['diff_drive'], [], Strictness.STRICT, replay.time)


def test_a_stopped_drive_stands_and_its_pose_survives():
    replay = interrupted(stop)
    at, before = replay.time, pose_at(replay, replay.time - PERIOD)
    replay.run(until=at + PAUSE)
    check_wheels_and_joints(replay, end=at - PERIOD)
    stamps = [stamp for stamp in replay.joint_states if stamp >= at]
    assert {v for stamp in stamps for v in replay.joint_states[stamp].velocity} == {0.0}
    assert len({replay.joint_states[stamp].position for stamp in stamps}) == 1
    assert {v for s, wheels in replay.wheels.items() if s >= at for v in wheels.values()} == {0.0}
    assert max(replay.odometry) < at
    go_on(replay)
    again = replay.time
    replay.run(until=again + SECOND)
    first = min(stamp for stamp in replay.odometry if stamp >= again)
    assert pose_at(replay, first) == pytest.approx(before, abs=ONE_CYCLE)
    turned = [pose_at(replay, stamp)[2] for stamp in replay.odometry if stamp >= first]
    assert turned == sorted(turned)
    assert turned[-1] > turned[0] + 0.3


def test_after_a_pause_odometry_comes_at_every_cycle_until_it_has_caught_up():
    """As the C++ stack: its gate counts on from where it was."""
    replay = Replay('arc_0p5_0p5', publish_rate=50.0)
    replay.run(until=replay.begin + MIDDLE)
    stop(replay)
    replay.run(until=replay.time + PAUSE)
    go_on(replay)
    again = replay.time
    replay.run()
    stamps = sorted(stamp for stamp in replay.odometry if stamp >= again)
    gaps = [other - one for one, other in pairwise(stamps)]
    late = gaps.index(2 * PERIOD)
    assert set(gaps[:late]) == {PERIOD}
    assert set(gaps[late:]) == {2 * PERIOD}
    assert late == pytest.approx(PAUSE / PERIOD, abs=10)


def test_a_restart_in_one_request_begins_again_where_the_robot_is():
    replay = interrupted(
        lambda r: r.manager.switch(['diff_drive'], ['diff_drive'], Strictness.STRICT, r.time)
    )
    at, before = replay.time, pose_at(replay, replay.time - PERIOD)
    assert set(replay.wheels[at - PERIOD].values()) != {0.0}
    replay.run()
    assert set(replay.joint_states[at].velocity) == {0.0}, 'it waits for a command of its new life'
    first = min(stamp for stamp in replay.odometry if stamp >= at)
    assert pose_at(replay, first) == pytest.approx(before, abs=ONE_CYCLE)
    for one, other in pairwise(sorted(replay.odometry)):
        assert pose_at(replay, other) == pytest.approx(pose_at(replay, one), abs=ONE_CYCLE)
    last = replay.trace['wheel_commands'][-1][0]
    _, left, right = replay.trace['wheel_commands'][-1]
    assert set(replay.wheels[last].values()) == {left, right}


@pytest.mark.parametrize(
    'state', [LifecycleState.INACTIVE, LifecycleState.UNCONFIGURED], ids=lambda s: s.label
)
def test_hardware_taken_away_and_given_back(state):
    def take_away(replay):
        replay.manager.set_component_state('AmrSystem', state, replay.time)

    replay = interrupted(take_away)
    assert 'diff_drive' not in replay.manager.snapshot.active_controllers
    at = replay.time
    replay.run(until=at + PAUSE)
    samples = [sample for stamp, sample in replay.joint_states.items() if stamp >= at]
    assert {velocity for sample in samples for velocity in sample.velocity} <= {0.0}
    replay.manager.set_component_state('AmrSystem', LifecycleState.ACTIVE, replay.time)
    names = {'diff_drive', 'joint_states'} - set(replay.manager.snapshot.active_controllers)
    replay.manager.switch(sorted(names), [], Strictness.STRICT, replay.time)
    before = max(replay.odometry)
    replay.run()
    after = min(stamp for stamp in replay.odometry if stamp > before)
    assert pose_at(replay, after) == pytest.approx(pose_at(replay, before), abs=ONE_CYCLE)
    last = replay.trace['wheel_commands'][-1]
    assert set(replay.wheels[last[0]].values()) == set(last[1:])
