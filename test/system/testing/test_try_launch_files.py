# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""``try_launch_files``: what drives, comes up, dies or is refused is a row with its reason."""

import json
import os
import subprocess
import sys

from fixtures.launch_files.packages import VERDICTS, write_demos
import pytest
from support.running_programs import Program

from amr_description.testing.trial.launch_command import index_of_sources, launch_files, table
from amr_description.testing.trial.launch_trial import (
    judge_launch,
    LaunchFinding,
    LaunchLog,
    LaunchVerdict,
)

FILE = """
from ament_index_python.packages import get_package_share_directory
from launch import LaunchDescription
from launch.actions import ExecuteProcess, LogInfo
from launch_ros.actions import Node

def generate_launch_description():
    return LaunchDescription([{}])
"""
DRIVES = """ExecuteProcess(cmd=['gz', 'sim', '-r', '-s', 'empty.sdf']),
        Node(package='rplidar_ros', executable='rplidar_node'),
        Node(package='robot_state_publisher', executable='robot_state_publisher',
             parameters=[{'robot_description': open(
                 get_package_share_directory('toy_robot') + '/toy.urdf').read()}]),
        Node(package='ros_gz_sim', executable='create', arguments=['-topic', 'robot_description'])
"""
TOY = """<robot name="toy">
  <link name="base"><inertial><mass value="2"/>
    <inertia ixx="0.02" ixy="0" ixz="0" iyy="0.02" iyz="0" izz="0.02"/></inertial>
    <collision><geometry><box size="0.3 0.2 0.05"/></geometry></collision></link>
  <gazebo><plugin filename="libgazebo_ros_planar_move.so" name="move"/></gazebo>
</robot>
"""


@pytest.fixture
def folder(tmp_path):
    """A source package with launch files of all kinds."""
    launch = tmp_path / 'toy_robot' / 'launch'
    launch.mkdir(parents=True)
    (launch.parent / 'package.xml').write_text('<package><name>toy_robot</name></package>')
    (launch.parent / 'toy.urdf').write_text(TOY)
    (launch.parent / 'stretched.py').write_text('def stretched(): ...')
    files = {
        'dies': "ExecuteProcess(cmd=['sh', '-c', 'echo ValueError: no such port; exit 3'])",
        'drives': DRIVES,
        'nothing': "LogInfo(msg='a line')",
        'refused': "Node(package='nope', executable='a')",
        'up': "Node(package='demo_nodes_py', executable='listener')",
    }
    for name, entities in files.items():
        (launch / f'{name}.launch.py').write_text(FILE.replace('{}', entities, 1))
    return tmp_path


def test_each_file_is_a_row_with_its_verdict(folder):
    report = folder / 'report.json'
    module = 'amr_description.testing.trial.launch_command'
    with Program(sys.executable, '-m', module, str(folder), '--json', str(report)) as program:
        assert program.end() == 1, 'not all come up'
    found = {
        each['file'].split('/')[-1].split('.')[0]: each for each in json.loads(report.read_text())
    }
    assert {name: each['verdict'] for name, each in found.items()} == {
        'dies': 'does not come up',
        'drives': 'drives',
        'nothing': 'starts nothing',
        'refused': 'refused',
        'up': 'comes up',
    }
    assert found['dies']['reason'].endswith('ValueError: no such port')
    assert found['drives']['reason'] == 'by /cmd_vel'
    (left_out,) = found['drives']['left_out']
    assert left_out.startswith('rplidar_ros rplidar_node is left out: ')
    assert "package 'nope' not found" in found['refused']['reason']
    assert program.output.rstrip().endswith(
        '5 tried: 1 drive; 1 come up; 1 starts nothing; 1 does not come up; 1 refused'
    )


@pytest.mark.long
@pytest.mark.parametrize('hardware', VERDICTS)
def test_launch_files_of_the_field_come_up(tmp_path, monkeypatch, hardware):
    monkeypatch.setenv('DEMO_HARDWARE', hardware)
    monkeypatch.chdir(tmp_path)
    expected = VERDICTS[hardware]
    report = tmp_path / 'report.json'
    arguments = [word for name in expected for word in ('--only', f'/{name}.launch.')]
    write_demos(tmp_path / 'demos')
    module = 'amr_description.testing.trial.launch_command'
    command = [sys.executable, '-m', module, str(tmp_path), '--json', str(report), *arguments]
    tried = subprocess.run(command, capture_output=True, text=True, timeout=600)
    assert tried.returncode == 0, tried.stdout
    found = json.loads(report.read_text())
    names = [each['file'].split('/')[-1].split('.')[0] for each in found]
    assert dict(zip(names, (each['verdict'] for each in found), strict=True)) == expected


def test_nothing_to_try_is_one_line(tmp_path):
    module = 'amr_description.testing.trial.launch_command'
    with Program(sys.executable, '-m', module, str(tmp_path)) as program:
        assert program.end() == 2
    assert 'try_launch_files: there is no launch file below' in program.output


def said(*lines):
    log = LaunchLog()
    for line in lines:
        log.take(f'{line}\n')
    return log


@pytest.mark.parametrize(
    ('lines', 'exit_code', 'verdict', 'reason'),
    [
        (['[INFO] [launch]: ready in 0.3 s: drive with'], None, LaunchVerdict.COMES_UP, ''),
        (['[INFO] [launch]: nothing is started: no', '[INFO] [launch]: ready in 0.0 s'], 0,
         LaunchVerdict.NOTHING, ''),
        (['ros2 launch: my.launch.py:3: no'], 1, LaunchVerdict.REFUSED, 'my.launch.py:3: no'),
        (['[WARNING] [launch]: never gets ready: needs that a-1 ended'], None,
         LaunchVerdict.FAILS, 'never gets ready: needs that a-1 ended'),
        (['[a-1] [FATAL] [12.5] [a]: no type', '[INFO] [launch]: ready in 1.0 s',
          "[ERROR] [a-1]: process has died [pid 7, exit code 1, cmd 'a']."], None,
         LaunchVerdict.FAILS, 'a-1: no type'),
        (["[ERROR] [a-1]: process has died [pid 7, exit code -11, cmd 'a']."], None,
         LaunchVerdict.FAILS, 'a-1: it died with exit code -11'),
        (['[INFO] [launch]: 5.4 s: x-1 waits until the service /y is there (5 s)'], None,
         LaunchVerdict.FAILS, 'x-1 waits until the service /y is there (5 s)'),
        ([], None, LaunchVerdict.FAILS, 'it was not ready within 60 s'),
    ],
)  # fmt: skip
def test_a_verdict_has_the_reason_that_was_said(lines, exit_code, verdict, reason):
    assert judge_launch(said(*lines), exit_code, 60.0) == (verdict, reason)


def test_files_are_named_below_their_folder_and_alone(folder):
    assert 'toy_robot/launch/up.launch.py' in launch_files([folder])
    file = folder / 'toy_robot/launch/up.launch.py'
    assert launch_files([file]) == {'up.launch.py': file}
    (other := folder / 'other/launch').mkdir(parents=True)
    (other / 'up.launch.py').write_text(file.read_text())
    names = launch_files([folder / 'toy_robot', folder / 'other'])
    assert {'toy_robot/launch/up.launch.py', 'other/launch/up.launch.py'} <= {*names}


def test_source_packages_are_found_without_a_build(folder, tmp_path):
    (prefix := tmp_path / 'prefix').mkdir()
    index_of_sources([folder / 'toy_robot/launch/up.launch.py', folder], prefix)
    assert (prefix / 'share/toy_robot/toy.urdf').read_text() == TOY
    assert [path.name for path in prefix.rglob('packages/*')] == ['toy_robot']


def test_scripts_that_cmake_would_install_are_found_as_well(tmp_path):
    (package := tmp_path / 'mine').mkdir()
    (package / 'package.xml').write_text('<package><name>mine</name></package>')
    (package / 'run.py').write_text('#!/usr/bin/env python3')
    (package / 'CMakeLists.txt').write_text(
        'install(PROGRAMS\n  run.py\n  gone.py\n  DESTINATION lib/${PROJECT_NAME})\n'
        '# install(PROGRAMS package.xml DESTINATION lib/mine)\n'
    )
    (prefix := tmp_path / 'prefix').mkdir()
    index_of_sources([package], prefix)
    (program,) = (prefix / 'lib/mine').iterdir()
    assert program.name == 'run.py'
    assert os.access(program, os.X_OK)


def test_what_is_left_out_stands_below_its_row():
    found = [LaunchFinding('a', LaunchVerdict.COMES_UP, '', 3.0, ['joy_linux is left out: x'])]
    assert table(found).splitlines() == [
        'a  comes up             3 s', '    joy_linux is left out: x', '1 tried: 1 come up',
    ]  # fmt: skip
    assert 'left out' not in table(found, details=False)
