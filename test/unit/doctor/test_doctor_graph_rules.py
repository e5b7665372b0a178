# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""Rules about nodes, topics, types and QoS: graphs that have the fault, and ones that have not."""

import pytest
from support.doctor_graphs import (
    COMMANDS,
    DRIVE,
    end,
    graph,
    node,
    NODES,
    ODOM,
    robot,
    SCAN,
    STRING,
    topic,
)

from amr_description.clock import NANOSECONDS
from amr_description.doctor.findings import Severity
from amr_description.doctor.observations.graph import ObservedQos, STAMPED_TWIST, TWIST
from amr_description.doctor.rules import clock, commands, graph as rules
from amr_description.doctor.rules.topic_names import distance, is_near

RULES = (*rules.RULES, *clock.RULES, *commands.RULES)
BEST_EFFORT = ObservedQos(is_reliable=False)
LATCHED = ObservedQos(is_transient_local=True)


def found(seen):
    return [finding for rule in RULES for finding in rule(seen)]


def only(seen):
    (finding,) = found(seen)
    return finding


FAULTS = {
    'duplicate_node_names': (
        graph(nodes=[*NODES, node('/slam', process=7), node('/slam', process=42)]),
        '3 nodes are named /slam, in the processes 7 and 42',
        'kill -INT 42',
    ),
    'duplicate_node_names in one process': (
        graph(nodes=[*NODES, node('/ekf', process=7), node('/ekf', process=7)]),
        '2 nodes are named /ekf',
        'start one with --ros-args -r __node:=ekf_2',
    ),
    'duplicate_node_names of two machines': (
        graph(nodes=[*NODES, node('/slam', host='0f2b')]),
        '2 nodes are named /slam, on 2 machines',
        'export ROS_DOMAIN_ID=',
    ),
    'frozen_nodes': (
        graph(nodes=[*NODES, node('/ekf', process=7, is_stopped=True, is_silent=True)]),
        'the process 7 of /ekf is stopped',
        'kill -CONT 7',
    ),
    'frozen_nodes by a callback': (
        graph(nodes=[*NODES, node('/ekf', process=7, is_silent=True)]),
        '/ekf does not answer its parameter services, and its process 7 does nothing',
        'kill -INT 7',
    ),
    'mismatched_types': (
        graph(topic(COMMANDS, [end('/teleop', TWIST)], [end(DRIVE, STAMPED_TWIST)])),
        f'/teleop publishes Twist on {COMMANDS}, but {DRIVE} subscribes to TwistStamped',
        f'-p stamped:=true, Nav2 enable_stamped_cmd_vel: true, ros2 topic pub -r 10 {COMMANDS} '
        "geometry_msgs/msg/TwistStamped '{twist: {linear: {x: 0.2}}}'",
    ),
    'mismatched_types for a robot of Twist': (
        graph(topic('/cmd_vel', [end('/nav', STAMPED_TWIST)], [end('/base', TWIST)])),
        '/nav publishes TwistStamped on /cmd_vel, but /base subscribes to Twist',
        "ros2 topic pub -r 10 /cmd_vel geometry_msgs/msg/Twist '{linear: {x: 0.2}}'",
    ),
    'mismatched_types of one publisher of two': (
        graph(topic('/odom', [end(DRIVE, ODOM), '/other'], [end('/slam', ODOM)])),
        '/other publishes String on /odom, but /slam subscribes to Odometry',
        f'use {ODOM} in /other',
    ),
    'mismatched_definitions': (
        graph(topic('/x', [end('/a', type_hash='R1')], [end('/b', type_hash='R2')])),
        f'{STRING} on /x is of one definition in /a, and of another in /b',
        'colcon build --packages-up-to std_msgs',
    ),
    'incompatible_qos': (
        graph(topic('/scan', [end('/lidar', SCAN, qos=BEST_EFFORT)], [end('/slam', SCAN)])),
        '/lidar offers reliability BEST_EFFORT on /scan, /slam requests RELIABLE',
        'subscribe with BEST_EFFORT, or publish with RELIABLE',
    ),
    'incompatible_qos durability': (
        graph(topic('/map', ['/slam'], [end('/amcl', qos=LATCHED)])),
        '/slam offers durability VOLATILE on /map, /amcl requests TRANSIENT_LOCAL',
        'publish with TRANSIENT_LOCAL',
    ),
    'incompatible_qos deadline': (
        graph(topic('/x', ['/a'], [end('/b', qos=ObservedQos(deadline=NANOSECONDS // 2))])),
        '/a offers deadline infinite on /x, /b requests 0.5 s',
        'subscribe with no deadline, or publish with a deadline of 0.5 s or less',
    ),
    'incompatible_qos liveliness': (
        graph(topic('/x', ['/a'], [end('/b', qos=ObservedQos(is_manual=True))])),
        '/a offers liveliness AUTOMATIC on /x, /b requests MANUAL_BY_TOPIC',
        'subscribe with AUTOMATIC',
    ),
    'incompatible_qos lease': (
        graph(
            topic(
                '/x',
                [end('/a', qos=ObservedQos(lease=2 * NANOSECONDS))],
                [end('/b', qos=ObservedQos(lease=NANOSECONDS))],
            )
        ),
        '/a offers liveliness_lease_duration 2 s on /x, /b requests 1 s',
        'subscribe with a liveliness_lease_duration of 2 s',
    ),
    'misnamed_topics': (
        graph(topic('/cmd_vel', [end('/_ros2cli_7', STAMPED_TWIST)])),
        f'ros2 (/_ros2cli_7) publishes /cmd_vel, which nobody subscribes to; {DRIVE} subscribes',
        f'-r /cmd_vel:={COMMANDS}',
    ),
    'misnamed_topics and another type': (
        graph(topic('/cmd_vel', [end('/nav', TWIST)])),
        '/nav publishes /cmd_vel',
        '; and publish TwistStamped, not Twist',
    ),
    'misnamed_topics by a letter': (
        graph(topic('/scna', [end('/lidar', SCAN)]), topic('/scan', [], [end('/slam', SCAN)])),
        '/lidar publishes /scna',
        '-r /scna:=/scan',
    ),
    'unstamped_commands': (
        graph(topic(f'{DRIVE}/cmd_vel_unstamped', [end('/teleop', TWIST)])),
        f'/teleop publishes on {DRIVE}/cmd_vel_unstamped, which nobody subscribes to',
        f'-p stamped:=true -r cmd_vel:={COMMANDS}), or set enable_cmd_vel_unstamped: true',
    ),
}


@pytest.mark.parametrize('fault', FAULTS)
def test_a_fault_is_found_and_nothing_else(fault):
    seen, what, fix = FAULTS[fault]
    finding = only(robot(graph=seen))
    assert finding.rule == fault.split()[0]
    assert what in finding.what
    assert fix in finding.fix


def test_a_healthy_graph():
    assert found(robot()) == []


HEALTHY = {
    'hidden nodes of one name': graph(nodes=[*NODES, node('/_x'), node('/_x')]),
    'a node that follows both types': graph(
        topic('/cmd_vel', [end('/nav', TWIST)], [end('/mux', TWIST), end('/mux', STAMPED_TWIST)])
    ),
    'one that publishes both': graph(
        topic('/cmd_vel', [end('/a', TWIST), end('/a', STAMPED_TWIST)], [end('/b', TWIST)])
    ),
    'a hash that is not known': graph(
        topic('/x', [end('/a', type_hash='R1')], [end('/humble', type_hash='')])
    ),
    'more than is requested': graph(
        topic(
            '/x',
            [
                end(
                    '/a',
                    qos=ObservedQos(is_transient_local=True, is_manual=True, deadline=1, lease=1),
                )
            ],
            [end('/b', qos=ObservedQos(is_reliable=False, deadline=2, lease=2))],
        )
    ),
    'what one node publishes and subscribes to itself': graph(
        topic('/x', ['/a'], [end('/a', qos=LATCHED)])
    ),
    'robots of other numbers': graph(
        topic('/robot1/odom', [end('/robot1/drive', ODOM)]),
        topic('/robot2/odom', [], [end('/robot2/nav', ODOM)]),
    ),
    'sides of a robot': graph(
        topic('/left/scan', [end('/a', SCAN)]), topic('/right/scan', [], [end('/b', SCAN)])
    ),
    'near names of other types': graph(
        topic('/scan_', [end('/a', STRING)]), topic('/scam', [], [end('/b', SCAN)])
    ),
    'an empty name of Humble': graph(topic('/base/cmd_vel_unstamped', [end('/teleop', TWIST)])),
}


@pytest.mark.parametrize('case', HEALTHY)
def test_what_looks_like_a_fault_and_is_none(case):
    assert found(robot(graph=HEALTHY[case])) == []


def test_qos_is_a_warning_where_another_publisher_serves_the_subscription():
    publishers = [end('/lidar', SCAN, qos=BEST_EFFORT), end('/other', SCAN)]
    finding = only(robot(graph=graph(topic('/scan', publishers, [end('/slam', SCAN)]))))
    assert finding.severity is Severity.WARNING
    finding = only(robot(graph=graph(topic('/scan', publishers[:1], [end('/slam', SCAN)]))))
    assert finding.severity is Severity.ERROR


@pytest.mark.parametrize(
    ('one', 'other', 'letters'),
    [('scan', 'scna', 1), ('scan', 'scans', 1), ('scan', 'scan', 0), ('odom', 'odometry', 4)],
)
def test_distance(one, other, letters):
    assert distance(one, other) == distance(other, one) == letters


@pytest.mark.parametrize(
    ('one', 'other', 'expected'),
    [
        ('/cmd_vel', '/robot1/cmd_vel', True),
        ('/joint_state', '/joint_states', True),
        ('/robot1/scan', '/robot/scan', False),
        ('/robot1/scan', '/robot1/scna', True),
        ('/a/scan', '/b/scan', False),
        ('/cmd_vel', '/cmd_vel_nav', False),
        ('/a/scna', '/b/scan', False),
        ('/local_costmap/costmap', '/global_costmap/costmap', False),
    ],
)
def test_names_that_are_near(one, other, expected):
    assert is_near(one, other) is is_near(other, one) is expected


def test_no_signal_ends_two_nodes_of_one_process():
    seen, *_ = FAULTS['duplicate_node_names in one process']
    assert 'kill' not in only(robot(graph=seen)).fix
