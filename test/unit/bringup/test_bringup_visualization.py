# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""When the page is served, and RViz where it is installed."""

from pathlib import Path
import re

import pytest
from support.paths import ROOT
import yaml

from amr_description.ament_index import path_of
from amr_description.bringup.arguments import declared, resolve
from amr_description.bringup.controller_files import URDF
from amr_description.bringup.description import nodes_of
from amr_description.bringup.scheduler import Scheduler
from amr_description.bringup.stacks.display import display, how_to_move, movable_joint
from amr_description.bringup.stacks.hardware import mock
from amr_description.bringup.stacks.simulation import simulation
from amr_description.model.origins import with_file

SENSORS = ROOT / 'urdf/amr_sensors.urdf.xacro'
PACKAGES = 'share/ament_index/resource_index/packages'


@pytest.fixture(autouse=True)
def prefix(tmp_path, monkeypatch):
    """An install folder with the files of the source tree, and no RViz."""
    (tmp_path / PACKAGES).mkdir(parents=True)
    (tmp_path / PACKAGES / 'amr_description').touch()
    share = tmp_path / 'share/amr_description'
    share.mkdir(parents=True)
    for folder in ('urdf', 'config'):
        (share / folder).symlink_to(ROOT / folder)
    monkeypatch.setenv('AMENT_PREFIX_PATH', str(tmp_path))
    return tmp_path


def made(function, **given):
    return function(**resolve(declared(function), given))


def executables(stack):
    return [node.executable for node in nodes_of(stack.nodes)]


def test_the_page_comes_when_the_robot_can_be_driven():
    for function in (simulation, mock):
        stack = made(function)
        (page,) = [node for node in stack.nodes if node.executable == 'viewer']
        assert page.start_when == stack.ready_when
        assert not page.required


@pytest.mark.parametrize('function', [simulation, mock, display])
def test_no_page_where_it_is_not_wanted(function):
    assert 'viewer' in executables(made(function))
    assert 'viewer' not in executables(made(function, viewer='false'))


def test_display_follows_its_file_unless_it_shall_not():
    (watcher,) = (
        node
        for node in nodes_of(made(display, urdf=str(SENSORS), xacro_args='name:="a b"').nodes)
        if node.executable == 'description_watcher'
    )
    assert [*map(str, watcher.arguments)] == [str(SENSORS), 'name:=a b']
    assert not watcher.required
    assert 'description_watcher' not in executables(made(display, reload='false'))


def test_display_shows_the_robot_and_moves_its_joints():
    stack = made(display)
    scheduler = Scheduler(stack)
    at_once = ['robot_state_publisher', 'joint_state_publisher', 'description_watcher']
    for wave in (at_once, ['viewer']):
        startable = scheduler.startable()
        assert [node.executable for node in startable] == wave
        for node in startable:
            scheduler.on_start(node)
    assert scheduler.ready
    path = path_of(URDF)
    assert path.read_text() == (ROOT / 'urdf/amr.urdf').read_text()
    assert stack.nodes[0].parameters == [
        {'robot_description': with_file(path.read_text(), str(path))}
    ]


@pytest.mark.parametrize(
    ('joints', 'name'),
    [
        ('<joint name="a" type="fixed"/><joint name="b" type="continuous"/>', 'b'),
        ('<joint type="prismatic" name="c"><mimic joint="d"/></joint>', ''),
        ('<joint name="e" type="revolute">', ''),
    ],
)
def test_the_next_step_moves_a_joint_of_this_robot(joints, name):
    assert movable_joint(f'<robot name="r">{joints}</robot>') == name
    said = how_to_move(name)
    assert (f'JointState "{{name: [{name}], position: [0.5]}}"\n' in said) == bool(name)
    assert said.endswith('\nCtrl-C stops all.')
    assert '[joint_wheel_front_left]' in made(display).next_steps


def test_rviz_is_started_with_our_configuration_where_it_is_installed(prefix):
    assert 'rviz2' not in executables(made(display))
    (prefix / PACKAGES / 'rviz2').touch()
    (rviz,) = [node for node in made(display).nodes if node.executable == 'rviz2']
    assert rviz.package == 'rviz2'
    option, file = rviz.arguments
    assert option == '-d'
    assert Path(file).is_file()
    assert not rviz.required


@pytest.mark.parametrize('file', sorted((ROOT / 'config/rviz').iterdir()), ids=lambda p: p.name)
def test_what_rviz_shows_is_there(file):
    shown = yaml.safe_load(file.read_text())['Visualization Manager']
    displays = {display['Class']: display for display in shown['Displays']}
    model = displays['rviz_default_plugins/RobotModel']
    assert model['Description Topic']['Value'] == '/robot_description'
    assert model['Description Topic']['Durability Policy'] == 'Transient Local'
    frames = {'odom', *(line.split('"')[1] for line in link_lines())}
    assert shown['Global Options']['Fixed Frame'] in frames
    assert shown['Views']['Current']['Target Frame'] in {*frames, '<Fixed Frame>'}


@pytest.mark.parametrize('file', sorted((ROOT / 'config/rviz').iterdir()), ids=lambda p: p.name)
def test_rviz_asks_for_the_sensors_of_our_robot_and_of_none_that_is_expensive(file):
    shown = yaml.safe_load(file.read_text())['Visualization Manager']
    kinds = {'LaserScan', 'PointCloud2', 'Image', 'Camera'}
    displays = [each for each in shown['Displays'] if each['Class'].split('/')[1] in kinds]
    assert {each['Class'].split('/')[1] for each in displays} == kinds
    lidar, camera = re.findall(
        r'<topic>(scan|camera)</topic>', (ROOT / 'urdf/amr_sensors.urdf.xacro').read_text()
    )
    topics = {f'/{camera}/{name}' for name in ('image', 'depth_image', 'points')}
    assert {each['Topic']['Value'] for each in displays} == {f'/{lidar}', *topics}
    assert {each['Name'] for each in displays if each['Enabled']} == {'LaserScan'}
    # Sensors of real robots are published by best effort.
    assert {each['Topic']['Reliability Policy'] for each in displays} == {'Best Effort'}


def link_lines():
    text = (ROOT / 'urdf/amr.urdf').read_text()
    return [line for line in text.splitlines() if line.strip().startswith('<link ')]
