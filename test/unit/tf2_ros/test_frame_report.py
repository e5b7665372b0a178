# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""The frames of a buffer as text: tf2's list and YAML, the tree, the graph."""

import pytest
import yaml

from amr_description.clock import NANOSECONDS
from amr_description.tf2_ros.frame_graph import (
    as_dot,
    as_tree,
    average_rate,
    FrameRecord,
    frames_as_string,
    frames_as_yaml,
    tree_order,
)

START = 1_638_875_729 * NANOSECONDS


def moving(name, parent, samples=5, length=2 * NANOSECONDS):
    return FrameRecord(name, parent, '/ekf', False, samples, START + length, START)


def static(name, parent):
    return FrameRecord(name, parent, '/robot_state_publisher', True, 1, 0, 0)


ROBOT = [moving('odom', 'map'), static('laser', 'base'), moving('base', 'odom')]


def test_the_list_is_that_of_tf2():
    assert frames_as_string(ROBOT[:2]) == (
        'Frame odom exists with parent map.\nFrame laser exists with parent base.\n'
    )


def test_the_yaml_is_that_of_tf2():
    assert frames_as_yaml([moving('turtle1', 'world', 314, 5 * NANOSECONDS)]) == (
        'turtle1: \n'
        "  parent: 'world'\n"
        "  broadcaster: '/ekf'\n"
        '  rate: 62.800\n'
        '  most_recent_transform: 1638875734.000000\n'
        '  oldest_transform: 1638875729.000000\n'
        '  buffer_length: 5.000\n'
    )
    assert frames_as_yaml([]) == '[]'


def test_the_yaml_can_be_read_and_has_the_delay():
    read = yaml.safe_load(frames_as_yaml(ROBOT, START + 3 * NANOSECONDS))
    assert list(read) == ['odom', 'laser', 'base']
    assert read['odom']['transform_delay'] == 1.0
    assert read['laser'] | {'transform_delay': 0} == {
        'parent': 'base',
        'broadcaster': '/robot_state_publisher',
        'rate': 10000.0,
        'most_recent_transform': 0.0,
        'oldest_transform': 0.0,
        'buffer_length': 0.0,
        'transform_delay': 0,
    }


def test_five_samples_in_two_seconds_are_two_a_second():
    assert average_rate(moving('a', 'b')) == pytest.approx(2.0)
    assert average_rate(moving('a', 'b', 1, 0)) == 0.0


def test_the_tree_is_indented():
    arm = [static('arm', 'base'), static('hand', 'arm')]
    assert as_tree([*ROBOT, *arm, static('cup', 'table')]).splitlines() == [
        'map',
        '└── odom: 2.000 Hz, /ekf',
        '    └── base: 2.000 Hz, /ekf',
        '        ├── arm: static, /robot_state_publisher',
        '        │   └── hand: static, /robot_state_publisher',
        '        └── laser: static, /robot_state_publisher',
        'table',
        '└── cup: static, /robot_state_publisher',
    ]
    assert as_tree([]) == ''


def test_a_loop_is_cut_and_marked():
    loop = [static('a', 'b'), static('b', 'a'), static('below', 'b')]
    assert [(name, depth) for name, _, depth in tree_order(loop)] == [
        ('a', 0),
        ('b', 1),
        ('below', 2),
    ]
    assert as_tree(loop).startswith('a (in a loop, below b): static')


def test_a_long_chain_is_no_matter():
    chain = [static(f'{number}', f'{number - 1}') for number in range(1, 5000)]
    assert tree_order(chain)[-1][0::2] == ('4999', 4999)


def test_the_graph_has_an_edge_for_each_frame_and_quotes_names():
    dot = as_dot([*ROBOT, static('a "b" \\', 'base')], START)
    assert '"map" -> "odom"[label=" Broadcaster: /ekf\\nAverage rate: 2.000\\n' in dot
    assert 'Most recent transform: 1638875731.000000\\nOldest transform: 1638875729' in dot
    assert '"base" -> "laser"[label=" Broadcaster: /robot_state_publisher\\nStatic\\n"];' in dot
    assert '"base" -> "a \\"b\\" \\\\"[' in dot
    assert '"Recorded at time: 1638875729.000000"[ shape=plaintext ] ;\n}->"map";' in dot
    assert dot.count('{') == dot.count('}') == 2
    assert as_dot([], 0) == 'digraph G { "No tf data received" }\n'
