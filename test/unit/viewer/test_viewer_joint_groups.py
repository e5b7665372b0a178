# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""Which joints a page can move, by what topic, and where the others of a group stay."""

import pytest

from amr_description.errors import ViewerError
from amr_description.viewer.graph import discover, GraphNames, STRING
from amr_description.viewer.joint_groups import (
    ControllerJoints,
    GroupTargets,
    joint_groups,
    MEMORY,
    PARALLEL_GRIPPER,
    POSITIONS,
    TRAJECTORY,
    with_moves,
)
from amr_description.viewer.protocol import Command, ControllerInfo, Controllers

ARM = Command('/r1/arm/joint_trajectory', TRAJECTORY)
GRIPPER = Command('/r1/gripper/commands', POSITIONS)
HAND = Command('/r1/hand/gripper_cmd', PARALLEL_GRIPPER)


def controller(name, *claims, state='active'):
    return ControllerInfo(name, 'any/Type', state, claims)


def test_topics_that_move_joints_are_found_by_name_and_type():
    subscribed = {
        ARM.topic: [TRAJECTORY],
        GRIPPER.topic: [POSITIONS],
        '/r1/lights': [POSITIONS],
        '/r1/arm/commands': [TRAJECTORY],
    }
    services = {
        '/r1/hand/gripper_cmd/_action/send_goal': [f'{PARALLEL_GRIPPER}_SendGoal'],
        '/r1/hand/gripper_cmd/_action/get_result': [f'{PARALLEL_GRIPPER}_GetResult'],
        '/r1/hand/wave/_action/send_goal': [f'{PARALLEL_GRIPPER}_SendGoal'],
    }
    names = GraphNames({'/r1/robot_description': [STRING]}, subscribed, services)
    (found,) = discover(names).robots
    assert found.joint_commands == (ARM, GRIPPER, HAND)


def test_groups_are_the_joints_of_active_controllers_in_their_order():
    found = joint_groups(
        [
            controller('arm', 'b/position', 'a/position', 'b/velocity', 'a/velocity'),
            controller('gripper', 'pid/finger/position'),
            controller('other', 'c/position'),
        ],
        [ARM, GRIPPER],
    )
    assert found == (
        ControllerJoints('arm', ARM.topic, TRAJECTORY, ('b', 'a')),
        ControllerJoints('gripper', GRIPPER.topic, POSITIONS, ('finger',)),
    )
    listed = Controllers('/r1', (controller('arm', 'x/position'), controller('c')), ())
    assert [each.moves for each in with_moves(listed, found).controllers] == [('b', 'a'), ()]


@pytest.mark.parametrize(
    'listed',
    [
        controller('gripper', 'finger/position', state='inactive'),
        controller('gripper', 'finger/velocity'),
        controller('gripper', 'finger/position', 'finger/effort'),
        controller('gripper'),
    ],
)
def test_what_is_no_position_of_an_active_controller_is_not_moved(listed):
    assert joint_groups([listed], [GRIPPER]) == ()


def test_a_trajectory_may_be_followed_by_speed_or_effort():
    listed = [controller('arm', 'a/effort'), controller('hand', 'b/effort', 'b/max_effort')]
    assert [each.joints for each in joint_groups(listed, [ARM, HAND])] == [('a',), ('b',)]


def test_joints_that_are_not_asked_stay_and_do_not_creep():
    targets = GroupTargets(ControllerJoints('arm', ARM.topic, TRAJECTORY, ('a', 'b')))
    assert targets.targets({'a': 0.5}, {'a': 0.0, 'b': 1.0}, 100.0) == [0.5, 1.0]
    assert targets.targets({'a': 0.6}, {'a': 0.4, 'b': 0.9}, 101.0) == [0.6, 1.0]
    late = 101.0 + MEMORY + 0.1
    assert targets.targets({'b': 0.2}, {'a': 0.7, 'b': 0.9}, late) == [0.7, 0.2]


def test_a_joint_of_which_nothing_is_known_is_named():
    targets = GroupTargets(ControllerJoints('arm', ARM.topic, TRAJECTORY, ('a', 'b')))
    with pytest.raises(ViewerError, match="arm takes the positions of all its joints.*'b'"):
        targets.targets({'a': 0.5}, {}, 0.0)
    assert targets.targets({'a': 0.5, 'b': 0.1}, {}, 0.0) == [0.5, 0.1]


def test_a_trajectory_is_no_faster_than_the_slowest_joint():
    targets = GroupTargets(ControllerJoints('arm', ARM.topic, TRAJECTORY, ('a', 'b')))
    targets.targets({'a': 1.0, 'b': 0.1}, {}, 0.0)
    measured = {'a': 0.0, 'b': 0.0}
    assert targets.duration(measured, {}) == pytest.approx(1.0)
    assert targets.duration(measured, {'a': 5.0, 'b': 0.05}) == pytest.approx(2.0)
    assert targets.duration({'a': 1.0, 'b': 0.1}, {}) == pytest.approx(0.1)
