# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""Robots and simulators are found by names and types alone."""

import dataclasses

import pytest

from amr_description.viewer.graph import (
    ACTIVITY,
    CLOUD,
    COMPRESSED_IMAGE,
    discover,
    DYNAMIC_JOINT_STATE,
    GOAL,
    GraphNames,
    IMAGE,
    INITIAL_POSE,
    JOINT_STATE,
    LASER_SCAN,
    LIST_CONTROLLERS,
    MARKERS,
    NAVIGATE_FEEDBACK,
    OCCUPANCY_GRID,
    ODOMETRY,
    PATH,
    RANGE,
    robot_of,
    SET_SIMULATION_STATE,
    SPAWN_ENTITY,
    STATISTICS_VALUES,
    STRING,
    TF,
    TWISTS,
)
from amr_description.viewer.navigation import Navigator
from amr_description.viewer.protocol import Command

STAMPED, PLAIN = TWISTS


def robot(place):
    """The names of a simulated robot in a namespace: published, subscribed, services."""
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


def names(*places, published=None, subscribed=None, services=None):
    parts = [published or {}, subscribed or {}, services or {}]
    for place in places:
        parts = [a | b for a, b in zip(parts, robot(place), strict=True)]
    return GraphNames(*parts)


def shown(*published):
    """Topics of sensors, by their robots."""
    there = {topic: [message] for topic, message in published}
    described = {'/robot_description': [STRING], '/r1/robot_description': [STRING]}
    found = discover(GraphNames({**described, **there})).sensors
    return {(each.topic, each.robot, each.kind) for each in found}


def test_sensors_belong_to_the_robot_of_their_namespace():
    assert shown(('/scan', LASER_SCAN), ('/r1/camera/points', CLOUD), ('/r10/sonar', RANGE)) == {
        ('/scan', '/', 'scan'), ('/r1/camera/points', '/r1', 'cloud'), ('/r10/sonar', '/', 'range')
    }  # fmt: skip
    assert discover(GraphNames({'/scan': [LASER_SCAN]})).sensors == ()


def test_the_same_pictures_are_shown_once_the_compressed_ones_if_there_are_any():
    raw, file = ('/c/image', IMAGE), ('/c/image/compressed', COMPRESSED_IMAGE)
    assert shown(raw) == {('/c/image', '/', 'picture')}
    assert shown(raw, file) == shown(file) == {('/c/image/compressed', '/', 'picture')}


def test_depths_are_shown_raw():
    """image_transport offers compressed ones as well, and publishes nothing there."""
    raw = ('/c/depth/image_raw', IMAGE)
    others = [(f'{raw[0]}/{name}', COMPRESSED_IMAGE) for name in ('compressed', 'compressedDepth')]
    assert shown(raw, *others) == {('/c/depth/image_raw', '/', 'picture')}


def test_joint_states_may_have_another_place():
    elsewhere = {'/platform/joint_states': [JOINT_STATE], '/joint_commands': [JOINT_STATE]}
    (found,) = discover(GraphNames({'/robot_description': [STRING], **elsewhere})).robots
    assert found.joint_states == '/platform/joint_states'
    both = {'/robot_description': [STRING], **elsewhere, '/joint_states': [JOINT_STATE]}
    assert discover(GraphNames(both)).robots[0].joint_states == '/joint_states'


@pytest.mark.parametrize('place', ['', '/r1', '/fleet/r1'])
def test_names_in_the_namespace_belong_to_the_robot(place):
    (found,) = discover(names(place)).robots
    assert dataclasses.asdict(found) == {
        'id': place or '/',
        'description': f'{place}/robot_description',
        'is_present': True,
        'command': {'topic': f'{place}/diff_drive_controller/cmd_vel', 'message': STAMPED},
        'odometry': f'{place}/odom',
        'truth': f'{place}/ground_truth/odom',
        'wheels': f'{place}/ground_truth/wheels',
        'joint_states': f'{place}/joint_states',
        'joint_publisher': None,
        'manager': f'{place}/controller_manager',
        'activity': f'{place}/controller_manager/activity',
        'introspection': f'{place}/controller_manager/introspection_data',
        'joint_commands': (),
        'drive_parameters': None,
    }


def test_robots_in_nested_namespaces_keep_their_own_names():
    found = discover(names('', '/r1', '/r1/arm', '/r10')).robots
    assert [each.id for each in found] == ['/', '/r1', '/r1/arm', '/r10']
    assert [each.manager for each in found] == [
        f'{place}/controller_manager' for place in ('', '/r1', '/r1/arm', '/r10')
    ]
    assert [each.odometry for each in found] == [
        f'{place}/odom' for place in ('', '/r1', '/r1/arm', '/r10')
    ]


def test_nothing_is_found_in_nothing():
    found = discover(GraphNames())
    assert (found.robots, found.simulators) == ((), ())


def test_a_description_that_is_only_subscribed_is_no_robot():
    assert discover(names(subscribed={'/robot_description': [STRING]})).robots == ()
    assert discover(names(published={'/robot_description': ['std_msgs/msg/Int8']})).robots == ()


def test_a_robot_may_have_nothing_but_a_description():
    (found,) = discover(names(published={'/robot_description': [STRING]})).robots
    values = dataclasses.asdict(found)
    assert {key for key, value in values.items() if value} == {'id', 'description', 'is_present'}


def test_a_robot_that_the_simulator_does_not_have_is_described_but_not_present():
    simulator = {'/mujoco_sim/set_simulation_state': [SET_SIMULATION_STATE]}
    described = {
        f'{each}/robot_description': [STRING] for each in ('', '/fleet', '/r1')
    }  # '/' was deleted, /fleet has nothing but fixed frames
    static = {'/tf_static': [TF], '/tf': [TF]}
    there = names('/r1', published=described | static, services=simulator)
    present = {each.id: each.is_present for each in discover(there).robots}
    assert present == {'/': False, '/fleet': False, '/r1': True}
    alone = names(published={'/robot_description': [STRING]}, services=simulator)
    assert [each.is_present for each in discover(alone).robots] == [False]
    joints = names(published={'/robot_description': [STRING], '/joint_states': [JOINT_STATE]})
    real = GraphNames(joints.published, {}, simulator)
    assert [each.is_present for each in discover(real).robots] == [True]


@pytest.mark.parametrize(
    ('subscribed', 'expected'),
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
def test_commands_go_to_subscribers_with_the_type_that_they_expect(subscribed, expected):
    published = {'/robot_description': [STRING], '/cmd_vel_out': [STAMPED]}
    (found,) = discover(GraphNames(published, subscribed)).robots
    assert found.command == expected


def test_odometry_is_odom_or_the_shortest_other_name():
    published = {'/robot_description': [STRING], '/ekf/filtered': [ODOMETRY], '/a': [ODOMETRY]}
    (found,) = discover(GraphNames(published)).robots
    assert found.odometry == '/a'
    (found,) = discover(GraphNames(published | {'/odom': [ODOMETRY]})).robots
    assert found.odometry == '/odom'


def test_the_truth_is_no_odometry():
    published = {'/robot_description': [STRING], '/ground_truth/odom': [ODOMETRY]}
    (found,) = discover(GraphNames(published)).robots
    assert (found.odometry, found.truth) == (None, '/ground_truth/odom')


def test_sliders_go_to_the_joint_state_publisher():
    subscribed = {'/jsp/set_joint_positions': [JOINT_STATE], '/joint_states': [JOINT_STATE]}
    (found,) = discover(GraphNames({'/robot_description': [STRING]}, subscribed)).robots
    assert found.joint_publisher == '/jsp'


def test_a_simulator_is_a_node_that_serves_set_simulation_state():
    services = {
        '/mujoco_sim/set_simulation_state': [SET_SIMULATION_STATE],
        '/mujoco_sim/spawn_entity': ['simulation_interfaces/srv/SpawnEntity'],
        '/other/spawn_entity': ['simulation_interfaces/srv/SpawnEntity'],
    }
    (found,) = discover(GraphNames({'/mujoco_sim/world': [MARKERS]}, {}, services)).simulators
    assert (found.id, found.world) == ('/mujoco_sim', '/mujoco_sim/world')
    assert found.services == {
        '/mujoco_sim/set_simulation_state', '/mujoco_sim/spawn_entity'
    }  # fmt: skip
    (found,) = discover(GraphNames({}, {}, services)).simulators
    assert found.world is None
    published = {
        '/mujoco_sim/spawned/b': [SPAWN_ENTITY],
        '/mujoco_sim/spawned/a': [SPAWN_ENTITY],
        '/mujoco_sim/spawned/c': [STRING],
        '/other/spawned/a': [SPAWN_ENTITY],
    }
    (found,) = discover(GraphNames(published, {}, services)).simulators
    assert found.spawned == ('/mujoco_sim/spawned/a', '/mujoco_sim/spawned/b')


@pytest.mark.parametrize(
    ('name', 'expected'),
    [('/odom', '/'), ('/r1/odom', '/r1'), ('/r10/odom', '/'), ('/r1/arm/x', '/r1/arm')],
)
def test_a_name_belongs_to_the_longest_namespace(name, expected):
    assert robot_of(name, ['/', '/r1', '/r1/arm']) == expected
    assert robot_of('/x', ['/r1']) is None


def test_namespaces_with_their_own_tf_are_found():
    topics = ('/tf', '/tf_static', '/r2/tf', '/r1/tf', '/r1/tf_static', '/r3/tf_old')
    found = discover(names(published={each: [TF] for each in topics} | {'/r4/tf': [STRING]}))
    assert found.tf_namespaces == ('/r1', '/r2')


@pytest.mark.parametrize('node', ['/diff_drive_controller', '/r1/mecanum_drive_controller'])
def test_the_time_out_of_commands_is_asked_of_the_controller_that_takes_them(node):
    place = node.rpartition('/')[0]
    topic, service = f'{node}/cmd_vel', f'{node}/get_parameters'
    described = {f'{place}/robot_description': [STRING]}
    services = {service: ['rcl_interfaces/srv/GetParameters']}
    (found,) = discover(GraphNames(described, {topic: [STAMPED]}, services)).robots
    assert found.drive_parameters == service
    (found,) = discover(GraphNames(described, {'/r1/cmd_vel': [STAMPED]}, services)).robots
    assert found.drive_parameters is None


def navigators(*places, published=(), subscribed=None):
    found = names(
        *places,
        published={each: [NAVIGATE_FEEDBACK] for each in published},
        subscribed=subscribed,
    )
    return discover(found).navigators


def test_a_map_of_no_robot_is_for_all_and_a_path_is_its_robots():
    found = discover(
        names(
            '/a', '/b', published={'/map': [OCCUPANCY_GRID], '/a/plan': [PATH], '/scan': [RANGE]}
        )
    )
    assert [(each.topic, each.robot, each.kind) for each in found.sensors] == [
        ('/a/plan', '/a', 'path'),
        ('/map', '', 'map'),
    ]


def test_who_hears_goals_and_poses_navigates_the_robot_of_that_namespace():
    hears = {'/a/goal_pose': [GOAL], '/a/initialpose': [INITIAL_POSE], '/b/other': [GOAL]}
    assert navigators('/a', '/b', subscribed=hears) == (
        Navigator('/a', '/a/goal_pose', None, '/a/initialpose'),
    )
    assert navigators('/a', '/b', subscribed={'/goal_pose': [GOAL]}) == (), 'whose would it be?'


def test_a_robot_that_is_alone_is_navigated_outside_its_namespace_too():
    hears = {'/goal_pose': [GOAL]}
    assert navigators('/a', subscribed=hears) == (Navigator('/a', '/goal_pose', None, None),)
    both = {**hears, '/a/goal_pose': [GOAL]}
    assert navigators('/a', subscribed=both)[0].goal == '/a/goal_pose'


def test_the_action_is_there_as_long_as_its_server_publishes():
    feedback = '/a/navigate_to_pose/_action/feedback'
    assert navigators('/a', published=[feedback]) == (
        Navigator('/a', None, '/a/navigate_to_pose', None),
    )
    others = ['/a/spin/_action/feedback']
    assert navigators('/a', published=others) == ()
