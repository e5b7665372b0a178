# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""A start that fails ends with the finding of the doctor that explains it."""

import os

from fixtures.bringup.running import Bringup, STACKS
from geometry_msgs.msg import Twist
import rclpy
from rclpy.node import Node

from amr_description.ros.runtime import ros


def failed(folder, **variables):
    """The last lines of a stack that waits in vain for a topic while its talker runs."""
    prefixes = f'{folder}/prefix:{os.environ["AMENT_PREFIX_PATH"]}'
    arguments = (str(STACKS / 'deaf.py'), 'timeout:=2')
    with Bringup(folder, *arguments, AMENT_PREFIX_PATH=prefixes, **variables) as bringup:
        assert bringup.end() == 124
        assert bringup.left() == []
        return bringup.output.splitlines()[-5:]


def test_a_variable_that_hides_all_nodes_is_named_last(tmp_path):
    stopped, what, _, fix, see = failed(tmp_path, ROS_AUTOMATIC_DISCOVERY_RANGE='OFF')
    assert stopped.startswith('[ERROR] [launch]: stopped because step-2 waited 2 s in vain')
    finds = '[ERROR] [launch]: ros2 doctor finds: '
    assert what == f'{finds}ROS_AUTOMATIC_DISCOVERY_RANGE is OFF'
    assert fix == '    fix: export ROS_AUTOMATIC_DISCOVERY_RANGE=LOCALHOST'
    assert see == '    see: docs/api/doctor.md#discovery_range'


def test_a_fault_of_the_graph_is_named_last(tmp_path):
    with ros([]):
        node = Node('deaf')
        node.create_subscription(Twist, '/topic', print, 10)
        stopped, what, *_, see = failed(tmp_path)
        node.destroy_node()
    assert not rclpy.ok()
    assert 'stopped because step-2 waited 2 s in vain' in stopped
    assert '/deaf' in what
    assert see == '    see: docs/api/doctor.md#mismatched_types'
