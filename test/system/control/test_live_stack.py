# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
The running stack, seen from outside, against a recording of the C++ one on Jazzy.

What differs stands in the tables of this file, with its reason; anything else fails.
"""

from collections import Counter
import json
import re

import pytest
import rclpy
from rclpy.node import Node
from support.paths import TESTS
from support.ros_processes import PATIENCE
from support.running_stack import Graph, running_stack

from amr_description.ros.service_calls import wait_until

LIVE = json.loads((TESTS / 'fixtures' / 'control' / 'live_stack.json').read_text())

TOPICS_BEYOND = {
    # The lock of drives, docs/controllers.md.
    '/emergency_stop': {
        'type': 'std_msgs/msg/Bool',
        'pub': [],
        'sub': [['diff_drive_controller', 'RELIABLE', 'VOLATILE']],
    }
}
TOPICS_THAT_DIFFER = {
    # Each rclcpp node hears of changes to its own use_sim_time by this topic, and so gets those of
    # every other node, too. rclpy has a callback for it: nothing is heard, and nothing is missed.
    '/parameter_events': {'sub': []},
}

PARAMETERS_BEYOND = {
    # Off by default; described in docs and in the table of the controller.
    'diff_drive_controller': {'enable_cmd_vel_unstamped', 'preserve_curvature'},
}

VALUES_OF_THE_RUN = {'params_file', 'robot_description'}
"""Parameters whose values are paths and texts of one run."""

LINES_THAT_DIFFER = {
    # Only where Linux allows it.
    'Successful set up FIFO RT scheduling policy with priority 50.',
}


class Seen:
    """All that was seen of the running stack."""

    def __init__(self, graph, log):
        self.nodes, self.topics, self.services = graph.nodes(), graph.topics(), graph.services()
        self.parameters = {node: graph.parameters(node) for node in LIVE['parameters']}
        self.log = log


@pytest.fixture(scope='module')
def seen(tmp_path_factory):
    rclpy.init(args=[])
    node = Node('observer')
    graph = Graph(node)
    try:
        with running_stack(tmp_path_factory.mktemp('stack'), LIVE['urdf']) as log:

            def settled():
                # Discovery takes its time: what has come is seen later, and what has gone too;
                # after 20 s, its lease, where the datagram that says so is lost.
                names = {name.rpartition('/')[2] for name in LIVE['nodes']}
                topics = graph.topics()
                ends = {end[0] for t in topics.values() for end in (*t['pub'], *t['sub'])}
                return (
                    graph.nodes() == sorted(LIVE['nodes'])
                    and graph.services().keys() == LIVE['services'].keys()
                    and topics.keys() >= LIVE['topics'].keys()
                    and ends == names
                ) or None

            wait_until(node, settled, timeout=PATIENCE)
            seen = Seen(graph, log)
    finally:
        node.destroy_node()
        rclpy.try_shutdown()
    return seen


def test_the_nodes_are_the_same(seen):
    assert seen.nodes == sorted(LIVE['nodes'])


def test_topics_have_the_same_ends_with_the_same_qos(seen):
    live = LIVE['topics'].items()
    expected = {name: topic | TOPICS_THAT_DIFFER.get(name, {}) for name, topic in live}
    assert seen.topics == expected | TOPICS_BEYOND


def test_the_services_are_the_same(seen):
    assert seen.services == LIVE['services']


@pytest.mark.parametrize('node', LIVE['parameters'])
def test_parameters_have_the_same_types_defaults_and_rights(seen, node):
    table, with_bounds = seen.parameters[node]
    expected = LIVE['parameters'][node]
    assert table.keys() - expected.keys() == PARAMETERS_BEYOND.get(node, set())
    for name, (kind, value, read_only) in expected.items():
        if name.rpartition('.')[2] in VALUES_OF_THE_RUN:
            value = table[name][1]
        assert (name, table[name]) == (name, [kind, value, read_only])
    assert with_bounds == []


def test_the_manager_says_what_the_original_says_in_that_order(seen):
    said = list(_texts(seen.log.read_text().splitlines()))
    live = [text for text in _texts(LIVE['log']) if text not in LINES_THAT_DIFFER]
    assert Counter(live) - Counter(said) == Counter()
    # Before the description comes, and at the end, several are said at once.
    begin = live.index('Received robot description from topic.')
    end = live.index('Shutdown request received....')
    rest = iter(said)
    for text in live[begin:end]:
        assert text in rest, text  # the iterator goes on from there


def _texts(lines):
    """What manager and resource manager say; paths, which differ, are left out."""
    for line in lines:
        said = re.match(r'\[\w+\] \[[\w.]+\] \[(controller|resource)_manager\]: (.*)', line)
        if said:
            yield re.sub(r'--params-file \S+', '--params-file PATH', said[2]).rstrip()
