# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""What of a ROS graph is a robot, and which of its topics mean what."""

import dataclasses

import pytest

from amr_description.viewer.graph import (
    ACTIVITY,
    discover,
    DYNAMIC_JOINT_STATE,
    JOINT_STATE,
    LIST_CONTROLLERS,
    MARKERS,
    Names,
    ODOMETRY,
    owner,
    SET_SIMULATION_STATE,
    STATISTICS_VALUES,
    STRING,
    TF,
    TWISTS,
)
from amr_description.viewer.protocol import Command

STAMPED, PLAIN = TWISTS


def robot(place):
    """The names of a simulated robot in a namespace: published, heard, services."""
    return (
        {
            f'{place}/robot_description': [STRING],
            f'{place}/joint_states': [JOINT_STATE],
            f'{place}/odom': [ODOMETRY],
            f'{place}/ground_truth/odom': [ODOMETRY],
            f'{place}/ground_truth/wheels': [DYNAMIC_JOINT_STATE],
            f'{place}/controller_manager/activity': [ACTIVITY],
            f'{place}/controller_manager/introspection_data/values': [STATISTICS_VALUES],
        },
        {f'{place}/diff_drive_controller/cmd_vel': [STAMPED]},
        {f'{place}/controller_manager/list_controllers': [LIST_CONTROLLERS]},
    )


def names(*places, published=None, heard=None, services=None):
    parts = [published or {}, heard or {}, services or {}]
    for place in places:
        parts = [a | b for a, b in zip(parts, robot(place), strict=True)]
    return Names(*parts)


@pytest.mark.parametrize('place', ['', '/r1', '/fleet/r1'])
def test_a_robot_has_what_lies_in_its_namespace(place):
    (found,) = discover(names(place)).robots
    assert dataclasses.asdict(found) == {
        'id': place or '/',
        'description': f'{place}/robot_description',
        'command': {'topic': f'{place}/diff_drive_controller/cmd_vel', 'message': STAMPED},
        'odometry': f'{place}/odom',
        'truth': f'{place}/ground_truth/odom',
        'wheels': f'{place}/ground_truth/wheels',
        'joint_states': f'{place}/joint_states',
        'joint_publisher': None,
        'manager': f'{place}/controller_manager',
        'activity': f'{place}/controller_manager/activity',
        'introspection': f'{place}/controller_manager/introspection_data',
    }


def test_several_robots_keep_what_is_theirs():
    found = discover(names('', '/r1', '/r1/arm', '/r10')).robots
    assert [each.id for each in found] == ['/', '/r1', '/r1/arm', '/r10']
    assert [each.manager for each in found] == [
        f'{place}/controller_manager' for place in ('', '/r1', '/r1/arm', '/r10')
    ]
    assert [each.odometry for each in found] == [
        f'{place}/odom' for place in ('', '/r1', '/r1/arm', '/r10')
    ]


def test_a_robot_described_otherwise_is_there_as_long_as_its_truth():
    there = {'/r1/ground_truth/odom': [ODOMETRY], '/r1/odom': [ODOMETRY]}
    (found,) = discover(Names(there), ['/r1', '/r2']).robots
    assert (found.id, found.truth, found.odometry) == ('/r1', '/r1/ground_truth/odom', '/r1/odom')
    assert discover(Names({'/r1/odom': [ODOMETRY]}), ['/r1']).robots == ()
    assert discover(Names(there)).robots == ()


def test_nothing_is_found_in_nothing():
    found = discover(Names())
    assert (found.robots, found.simulators) == ((), ())


def test_a_description_that_is_only_heard_is_no_robot():
    assert discover(names(heard={'/robot_description': [STRING]})).robots == ()
    assert discover(names(published={'/robot_description': ['std_msgs/msg/Int8']})).robots == ()


def test_a_robot_may_have_nothing_but_a_description():
    (found,) = discover(names(published={'/robot_description': [STRING]})).robots
    values = dataclasses.asdict(found)
    assert {key for key, value in values.items() if value} == {'id', 'description'}


@pytest.mark.parametrize(
    ('heard', 'expected'),
    [
        ({'/cmd_vel': [PLAIN]}, Command('/cmd_vel', PLAIN)),
        ({'/cmd_vel': [PLAIN, STAMPED]}, Command('/cmd_vel', STAMPED)),
        ({'/cmd_vel': [PLAIN], '/base/cmd_vel': [STAMPED]}, Command('/base/cmd_vel', STAMPED)),
        ({'/a/cmd_vel': [PLAIN], '/cmd_vel': [PLAIN]}, Command('/cmd_vel', PLAIN)),
        ({'/velocity': [STAMPED], '/cmd_vel': [PLAIN]}, Command('/cmd_vel', PLAIN)),
        ({'/velocity': [PLAIN]}, Command('/velocity', PLAIN)),
        ({'/cmd_vel': ['std_msgs/msg/Empty']}, None),
        ({}, None),
    ],
)
def test_commands_go_where_they_are_heard_as_they_are_wanted(heard, expected):
    published = {'/robot_description': [STRING], '/cmd_vel_out': [STAMPED]}
    (found,) = discover(Names(published, heard)).robots
    assert found.command == expected


def test_odometry_is_odom_or_whatever_else_there_is():
    published = {'/robot_description': [STRING], '/ekf/filtered': [ODOMETRY], '/a': [ODOMETRY]}
    (found,) = discover(Names(published)).robots
    assert found.odometry == '/a'
    (found,) = discover(Names(published | {'/odom': [ODOMETRY]})).robots
    assert found.odometry == '/odom'


def test_the_truth_is_no_odometry():
    published = {'/robot_description': [STRING], '/ground_truth/odom': [ODOMETRY]}
    (found,) = discover(Names(published)).robots
    assert (found.odometry, found.truth) == (None, '/ground_truth/odom')


def test_sliders_go_to_the_joint_state_publisher():
    heard = {'/jsp/set_joint_positions': [JOINT_STATE], '/joint_states': [JOINT_STATE]}
    (found,) = discover(Names({'/robot_description': [STRING]}, heard)).robots
    assert found.joint_publisher == '/jsp'


def test_a_simulator_is_who_serves_its_state():
    services = {
        '/mujoco_sim/set_simulation_state': [SET_SIMULATION_STATE],
        '/mujoco_sim/spawn_entity': ['simulation_interfaces/srv/SpawnEntity'],
        '/other/spawn_entity': ['simulation_interfaces/srv/SpawnEntity'],
    }
    (found,) = discover(Names({'/mujoco_sim/world': [MARKERS]}, {}, services)).simulators
    assert (found.id, found.world) == ('/mujoco_sim', '/mujoco_sim/world')
    assert found.services == {
        '/mujoco_sim/set_simulation_state', '/mujoco_sim/spawn_entity'
    }  # fmt: skip
    (found,) = discover(Names({}, {}, services)).simulators
    assert found.world is None


@pytest.mark.parametrize(
    ('name', 'expected'),
    [('/odom', '/'), ('/r1/odom', '/r1'), ('/r10/odom', '/'), ('/r1/arm/x', '/r1/arm')],
)
def test_a_name_is_owned_by_the_deepest_namespace(name, expected):
    assert owner(name, ['/', '/r1', '/r1/arm']) == expected
    assert owner('/x', ['/r1']) is None


def test_namespaces_with_a_tf_of_their_own_are_told():
    topics = ('/tf', '/tf_static', '/r2/tf', '/r1/tf', '/r1/tf_static', '/r3/tf_old')
    found = discover(names(published={each: [TF] for each in topics} | {'/r4/tf': [STRING]}))
    assert found.trees == ('/r1', '/r2')
