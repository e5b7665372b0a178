# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""Without ROS: services and actions of controllers, and where frames are."""

import math

import pytest
from support.paths import ROOT

from amr_description import Simulation
from amr_description.control.contracts import GoalStatus
from amr_description.control.trajectory_samples import QueryStateRequest
from amr_description.errors import AmrError, SimulationError
from amr_description.model.frames import Transform

URDF = ROOT / 'urdf' / 'amr.urdf'
ARM = ROOT / 'test' / 'fixtures' / 'urdf' / 'arm.urdf'
CONTROLLERS = """
controller_manager:
  ros__parameters:
    update_rate: 100
    joint_state_broadcaster: {type: joint_state_broadcaster/JointStateBroadcaster}
    arm: {type: joint_trajectory_controller/JointTrajectoryController}
    counter: {type: support.port_controller/Counter}
arm:
  ros__parameters:
    joints: [shoulder]
    command_interfaces: [position]
    state_interfaces: [position]
"""
FOLLOW = '/arm/follow_joint_trajectory'


@pytest.fixture(scope='module')
def shared(tmp_path_factory):
    controllers = tmp_path_factory.mktemp('arm') / 'arm.yaml'
    controllers.write_text(CONTROLLERS)
    with Simulation(ARM, controllers) as sim:
        yield sim


@pytest.fixture
def sim(shared):
    shared.reset()
    return shared


def goal_at(angle, seconds=1):
    return {
        'trajectory': {
            'joint_names': ['shoulder'],
            'points': [{'positions': [angle], 'time_from_start': {'sec': seconds}}],
        }
    }


def test_an_arm_follows_a_trajectory_and_says_how_far_it_is(sim):
    goal = sim.send_goal(FOLLOW, goal_at(0.5))
    sim.run(0.5)
    assert goal.is_live
    (desired,) = goal.feedback.desired.positions
    assert 0.1 < desired < 0.4
    sim.run(1.0)
    status, result = goal.outcome
    assert (status, result.error_code) == (GoalStatus.SUCCEEDED, 0)
    assert sim.joints['shoulder'].position == pytest.approx(0.5, abs=0.02)


def test_a_goal_is_canceled_when_it_is_asked_to_end(sim):
    goal = sim.send_goal(FOLLOW, goal_at(0.5, seconds=5))
    sim.run(0.5)
    goal.is_cancel_requested = True
    sim.run(0.1)
    assert goal.outcome[0] is GoalStatus.CANCELED


def test_a_goal_that_is_replaced_or_whose_controller_ends_has_an_end(sim):
    first, second = sim.send_goal(FOLLOW, goal_at(0.5)), sim.send_goal(FOLLOW, goal_at(0.2))
    sim.run(0.1)
    assert first.outcome[0] is GoalStatus.CANCELED
    assert second.is_live
    assert sim.robot.manager.switch(deactivate=['arm']) is None
    try:
        assert not second.is_live
        with pytest.raises(SimulationError, match='is rejected: .*Controller is not running'):
            sim.send_goal(FOLLOW, goal_at(0.5))
    finally:
        assert sim.robot.manager.switch(activate=['arm']) is None


def test_a_goal_that_is_rejected_says_why(sim):
    with pytest.raises(SimulationError, match='rejected: .*elbow'):
        sim.send_goal(FOLLOW, {'trajectory': {'joint_names': ['elbow'], 'points': [{}]}})
    assert 'elbow' in sim.log
    with pytest.raises(AmrError, match="no attribute 'trajectories'"):
        sim.send_goal(FOLLOW, {'trajectories': {}})


def test_a_service_answers_a_dict_as_it_answers_a_sample(sim):
    sim.send_goal(FOLLOW, goal_at(0.5))
    sim.run(0.5)
    time = sim.time
    answers = [
        sim.call('/arm/query_state', request)
        for request in ({'time': {'nanosec': 500_000_000}}, QueryStateRequest(500_000_000))
    ]
    assert answers[0] == answers[1]
    assert answers[0].success
    assert answers[0].joint_names == ('shoulder',)
    assert 0.1 < answers[0].point.positions[0] < 0.4
    assert sim.time == time


def test_those_of_a_controller_of_the_user_are_served_too(sim):
    goal = sim.send_goal('counter/count', {'command': {'position': 20}})
    sim.run(0.1)
    assert goal.feedback == pytest.approx(10, abs=1)
    assert sim.call('counter/switch', {'data': True}) == (True, f'at {goal.feedback}')
    sim.run(0.2)
    assert goal.outcome == (GoalStatus.SUCCEEDED, 20)
    with pytest.raises(SimulationError, match="Could not answer 'counter/switch': .*no switching"):
        sim.call('counter/switch', {'data': False})
    assert 'no switching off' in sim.log


@pytest.mark.parametrize(
    ('ask', 'words'),
    [
        (
            lambda sim: sim.call('/arm/query'),
            "no controller has the service '/arm/query'; there are: /arm/query_state, "
            '/counter/switch',
        ),
        (
            lambda sim: sim.send_goal('/arm/query_state'),
            "no controller has the action '/arm/query_state'; there are: "
            '/arm/follow_joint_trajectory, /counter/count',
        ),
    ],
)
def test_what_nobody_serves_is_said_with_what_there_is(sim, ask, words):
    with pytest.raises(SimulationError) as error:
        ask(sim)
    assert str(error.value) == words


def test_frames_are_where_odometry_and_links_are():
    with Simulation(URDF) as sim:
        sim.drive(0.4, 0.3, seconds=1)
        odometry, place = sim.odometry, sim.transform('odom', 'base_footprint')
        assert place.translation[:2] == pytest.approx((odometry.x, odometry.y), abs=0.02)
        wheel = 'wheel_front_left'
        base = sim.transform('base_footprint', wheel)
        assert sim.transform('odom', wheel).translation == pytest.approx(
            (place @ base).translation
        )
        there_and_back = sim.transform(wheel, 'odom') @ sim.transform('odom', wheel)
        assert there_and_back.translation == pytest.approx((0.0, 0.0, 0.0), abs=1e-12)
        before = sim.transform('base_footprint', wheel).rotation
        sim.drive(0.4, 0.0, seconds=0.3, stop=False)
        after = sim.transform('base_footprint', wheel).rotation
        assert math.dist(before, after) > 0.1
        assert sim.transform(wheel, wheel) == Transform()
        with pytest.raises(SimulationError, match="there is no frame 'map'; there are: base_"):
            sim.transform('map', wheel)


def test_frames_of_a_fleet_have_the_names_of_their_robots():
    poses = {'a': Transform(), 'b': Transform((0.0, 2.0, 0.0))}
    with Simulation(URDF, robots=poses) as sim:
        sim.drive_all({'a': (0.4, 0.0), 'b': (-0.4, 0.0)}, seconds=1)
        x = [
            sim.robots[name].transform(f'{name}/odom', f'{name}/base_footprint').translation[0]
            for name in poses
        ]
        assert x == pytest.approx([0.4, -0.4], abs=0.03)
