# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""``--help`` of the executables: each prints its usage, and starts nothing."""

import sys

from fixtures.cli.commands import shell
import pytest
from support.paths import EXECUTABLES
from support.ros_processes import run

NODES = {
    'joint_state_publisher': 'source_list  string_array, empty',
    'joy_node': 'autorepeat_rate  double, 20.0 Hz\n',
    'listener': '',
    'mujoco_sim': 'real_time_factor  double, 1.0\n',
    'robot_state_publisher': 'publish_frequency  double, 20.0 Hz\n',
    'ros2_control_node': 'update_rate  integer, 100 Hz\n',
    'scan_localizer': 'initial_pose.yaw  double, 0.0 rad\n',
    'talker': '',
    'teleop_twist_joy': 'scale_linear_turbo.x  double, 1.0 m/s\n',
    'truth_localizer': 'update_duration  double, 0.01 s\n',
    'viewer': 'port  integer, 8080\n      Port to listen on, or the next one that is free',
}
"""What takes ROS arguments only, or a description: and a line of its help."""
OTHERS = EXECUTABLES.keys() - {*NODES, 'bringup', 'replay', 'trials', 'xacro'}
# replay, trials: test_replay.py, test_trials_in_processes.py


@pytest.mark.parametrize('option', ['-h', '--help'])
@pytest.mark.parametrize('name', NODES)
def test_a_node_prints_its_parameters(name, option):
    result = run(name, option, '--ros-args', '-p', 'x:=1')
    assert result.returncode == 0, result.stderr
    assert result.stdout.startswith(f'usage: {name} [-h] ')
    assert NODES[name] in result.stdout
    assert result.stderr == ''


def test_a_reader_that_goes_away_is_no_fault(tmp_path):
    command = f'{sys.executable} -m amr_description.nodes.viewer --help'
    result = shell(f'{command} | true; echo ${{PIPESTATUS[0]}}', tmp_path)
    assert (result.stdout, result.stderr) == ('0\n', '')


@pytest.mark.parametrize('name', sorted(OTHERS))
def test_every_other_executable_prints_its_usage(name):
    result = run(name, '--help')
    assert result.returncode == 0, result.stderr
    assert 'usage:' in result.stdout.lower()
