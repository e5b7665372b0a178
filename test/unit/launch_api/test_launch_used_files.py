# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""The files of a launch: which are used is said, and which copy of them is newer."""

import os
import re

from fixtures.launch_files.packages import (
    first_in_the_index,
    install_package,
    parameters,
    stack_of,
)
import pytest

from amr_description.bringup.command_line import process_specs
from amr_description.bringup.main import listing
from amr_description.errors import BringupError

URDF = """<robot name="r"><link name="base_link"/>
<gazebo><plugin name="p" filename="libgz_ros2_control-system.so">
<parameters>{}</parameters></plugin></gazebo></robot>
"""
LAUNCH = """
from launch import LaunchDescription
from launch.actions import ExecuteProcess
from launch.substitutions import Command
from launch_ros.actions import Node

def generate_launch_description():
    with open('{share}/urdf/robot.urdf') as file:
        text = file.read()
    return LaunchDescription([
        ExecuteProcess(cmd=['gz', 'sim', '-r', '-s', 'empty.sdf']),
        Node(package='robot_state_publisher', executable='robot_state_publisher',
             parameters=[{{'robot_description': text}}]),
        Node(package='toys', executable='a', parameters=['{share}/config/a.yaml',
             {{'x': Command('cat {share}/urdf/other.xacro')}}]),
    ])
"""


@pytest.fixture
def workspace(tmp_path):
    """A workspace with the package ``toys``, built without links: (its source, its share)."""
    named = '/absolute/path/to/config/controllers.yaml'
    files = {
        'package.xml': '<package><name>toys</name></package>',
        'urdf/robot.urdf': URDF.format(named),
        'urdf/other.xacro': 'text\n',
        'config/a.yaml': '{}\n',
        'config/controllers.yaml': '/**: {ros__parameters: {a: 1}}\n',
    }
    share = tmp_path / 'install/toys/share/toys'
    files['launch/my.launch.py'] = LAUNCH.format(share=share)
    install_package(tmp_path / 'install/toys', 'toys', 'a', **files)
    source = tmp_path / 'src/toys'
    for name, text in files.items():
        path = source / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text)
    (tmp_path / 'build/toys').mkdir(parents=True)
    with first_in_the_index(tmp_path / 'install/toys'):
        yield source, share


def notes(stack, level):
    return [text for each, text in stack.notes if each == level]


def test_all_files_of_packages_that_are_read_are_named_once(workspace):
    _, share = workspace
    stack = stack_of(share / 'launch/my.launch.py')
    used = [text.split()[1] for text in notes(stack, 'INFO') if text.startswith('using ')]
    names = ['launch/my.launch.py', 'urdf/robot.urdf', 'config/a.yaml', 'urdf/other.xacro']
    assert sorted(used) == sorted(f'{share}/{name}' for name in names)


@pytest.mark.parametrize(
    'name', ['launch/my.launch.py', 'urdf/robot.urdf', 'config/a.yaml', 'urdf/other.xacro']
)
def test_a_source_that_was_edited_and_not_built_is_said(workspace, name):
    source, share = workspace
    edited = source / name
    edited.write_text(edited.read_text() + '\n')
    later = (share / name).stat().st_mtime + 5
    os.utime(edited, (later, later))
    (text,) = [
        text for text in notes(stack_of(share / 'launch/my.launch.py'), 'WARNING')
        if 'its source' in text
    ]  # fmt: skip
    assert text.startswith(f'{share / name} (sha256 ')
    assert f'its source, {edited} (sha256 ' in text
    assert 'newer), is not the same; run scripts/setup, or colcon build' in text


@pytest.mark.parametrize(
    ('name', 'action'),
    [
        ('launch/new.launch.py', 'IncludeLaunchDescription("{path}")'),
        ('config/new.yaml', 'Node(package="toys", executable="a", parameters=["{path}"])'),
        ('urdf/new.xacro', 'LogInfo(msg=[Command("xacro {path}")])'),
    ],
)
def test_a_file_that_is_in_the_source_alone_is_named_there(workspace, name, action):
    source, share = workspace
    launch_file = share / 'launch/other.launch.py'
    launch_file.write_text(
        'from launch import LaunchDescription\n'
        'from launch.actions import IncludeLaunchDescription, LogInfo\n'
        'from launch.substitutions import Command\n'
        'from launch_ros.actions import Node\n'
        'def generate_launch_description():\n'
        f'    return LaunchDescription([{action.format(path=share / name)}])\n'
    )
    (source / name).write_text('')
    hint = f'; {source / name} is not installed: colcon build, if setup.py or CMakeLists.txt'
    with pytest.raises(BringupError, match=re.escape(hint)):
        process_specs(stack_of(launch_file), share)


def test_a_placeholder_is_the_file_of_that_name_in_the_package(workspace):
    _, share = workspace
    file = share / 'config/controllers.yaml'
    stack = stack_of(share / 'launch/my.launch.py')
    assert f'controllers: {file}' in parameters(stack, 'mujoco_sim-1')
    (text,) = notes(stack, 'WARNING')
    assert text == (
        "the description names a parameter file that is not there, '/absolute/path/to/config/"
        f"controllers.yaml'; {file} is used in its place"
    )
    process_specs(stack, share)  # it can be started


def test_long_texts_are_printed_shortened(workspace):
    _, share = workspace
    urdf = share / 'urdf/robot.urdf'
    urdf.write_text(urdf.read_text() + '<!--' + ' ruler' * 500 + '-->')
    stack = stack_of(share / 'launch/my.launch.py')
    printed = listing(stack, process_specs(stack, share))
    assert ' ruler' not in printed
    assert 'robot_description: ' in printed
    assert f'... {len(urdf.read_text()):,} characters' in printed
    assert ' ruler' in parameters(stack, 'robot_state_publisher-2')


def test_a_file_that_is_there_is_used(workspace):
    _, share = workspace
    (share / 'urdf/robot.urdf').write_text(URDF.format(share / 'config/a.yaml'))
    stack = stack_of(share / 'launch/my.launch.py')
    assert 'controllers' not in parameters(stack, 'mujoco_sim-1')
    assert not [text for text in notes(stack, 'WARNING') if 'in its place' in text]
