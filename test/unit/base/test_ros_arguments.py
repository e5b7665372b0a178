# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""ROS arguments as words."""

import pytest

from amr_description.ros_arguments import inherited, other_arguments, ros_arguments


@pytest.mark.parametrize(
    ('line', 'found', 'others'),
    [
        ('', '', ''),
        ('-a --b', '', '-a --b'),
        ('--ros-args -p a:=1', '-p a:=1', ''),
        ('x --ros-args -p a:=1 -- y --ros-args -r b:=c', '-p a:=1 -r b:=c', 'x y'),
        ('x -- y a:=1', '', 'x -- y a:=1'),
    ],
)
def test_what_of_a_command_line_is_for_ros(line, found, others):
    assert ros_arguments(line.split()) == found.split()
    assert other_arguments(line.split()) == others.split()


@pytest.mark.parametrize(
    'identity',
    ['-r __node:=x', '--remap __ns:=/a', '-r __name:=x', '-r amr:__node:=x', '-r amr:__ns:=/a'],
)
def test_name_and_namespace_do_not_go_on(identity):
    words = f'-r /tf:=tf {identity} --log-level debug'.split()
    assert inherited(words) == ['-r', '/tf:=tf', '--log-level', 'debug']


def test_the_description_is_the_managers_alone():
    words = ['-r', 'robot_description:=/urdf', '-p', 'robot_description:=x', '-r', 'a:=b']
    assert inherited(words) == ['-r', 'a:=b']
    remap = ['-r', 'robot_description:=/urdf']
    assert inherited(remap, with_parameters=False) == remap


def test_everything_else_goes_on():
    words = ['-r', 'amr:odom:=/odom', '--disable-rosout-logs', '-p', 'rate:=5']
    words += ['--params-file', 'f.yaml', '--enable-stdout-logs', '-e', '/enclave']
    words += ['--log-config-file', 'log']
    assert inherited(words) == words


def test_parameters_go_on_only_where_they_are_shared():
    parameters = ['-p', 'rate:=5', '--params-file', 'f.yaml', '--param', 'x:=1']
    words = ['-r', 'a:=b', *parameters, '--log-level', 'info']
    assert inherited(words, with_parameters=False) == ['-r', 'a:=b', '--log-level', 'info']
