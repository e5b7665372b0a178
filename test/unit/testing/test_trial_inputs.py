# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""Which descriptions of a folder are tried, and which parameter file belongs to each."""

from pathlib import Path

import pytest
import yaml

from amr_description.errors import UsageError
from amr_description.testing.trial.command import given_to
from amr_description.testing.trial.inputs import (
    descriptions,
    parameters_of,
    prefixes,
    replaced_copy,
    robot_names,
)

ROBOT = '<robot name="cart"/>'
MANAGER = 'controller_manager: {ros__parameters: {drive: {type: a/B}}}\n'
CONTROLLED = """<robot name="arm"><ros2_control name="a" type="system">
  <hardware><plugin>makers_arm/Driver</plugin></hardware>
  <joint name="elbow"><command_interface name="position"/></joint>
  <joint name="roller"><command_interface name="velocity"/></joint>
</ros2_control></robot>"""


def write(path, text):
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_text(text)
    return path


@pytest.fixture
def prefix(tmp_path, monkeypatch):
    """An install prefix with the package ``makers_arm``."""
    folder = tmp_path / 'install'
    write(folder / 'share/ament_index/resource_index/packages/makers_arm', '')
    monkeypatch.setenv('AMENT_PREFIX_PATH', str(folder))
    return folder


def find(tmp_path, text, robot='arm', given=()):
    file = write(tmp_path / 'in' / 'arm.urdf', text)
    return parameters_of(file, text, robot, tmp_path, given)


def test_of_a_folder_the_robots_are_tried_and_not_their_macros(tmp_path):
    robots = [write(tmp_path / name, ROBOT) for name in ('a.urdf', 'b.urdf.xacro')]
    write(tmp_path / 'wheel.xacro', '<robot xmlns:xacro="http://www.ros.org/wiki/xacro"/>')
    write(tmp_path / 'notes.txt', ROBOT)
    assert descriptions([tmp_path, robots[0]]) == robots
    assert robot_names(robots) == ['a', 'b']


def test_two_robots_of_one_name_are_told_apart(tmp_path):
    paths = [tmp_path / 'a' / 'robot.urdf', tmp_path / 'b' / 'robot.urdf']
    assert robot_names(paths) == list(map(str, paths))


@pytest.mark.parametrize('name', ['', 'missing.urdf'])
def test_nothing_to_try_is_said(tmp_path, name):
    with pytest.raises(UsageError, match=r'holds no robot description|is not there'):
        descriptions([tmp_path / name])


def test_a_folder_with_packages_is_an_install_prefix(prefix, tmp_path):
    assert prefixes([prefix, prefix / 'robot.urdf', tmp_path]) == [prefix]


def test_a_copy_has_what_lies_beside_the_original(tmp_path):
    file = write(tmp_path / 'in' / 'a.urdf', '<robot name="@NAME@"/>')
    write(tmp_path / 'in' / 'meshes' / 'wheel.stl', 'solid')
    folder = tmp_path / 'copy'
    folder.mkdir()
    assert replaced_copy(file, folder, {'@OTHER@': 'x'}) == file
    copy = replaced_copy(file, folder, {'@NAME@': 'cart'})
    assert copy.read_text() == ROBOT
    assert (copy.parent / 'meshes' / 'wheel.stl').read_text() == 'solid'


def test_the_command_line_comes_first_then_the_file_of_the_same_name(tmp_path):
    mine, other, every = (write(tmp_path / f'{n}.yaml', MANAGER) for n in ('m', 'o', 'e'))
    given = (f'arm={mine}', f'leg={other}')
    assert find(tmp_path, ROBOT, given=given).files == (mine,)
    assert find(tmp_path, ROBOT, given=(*given, str(every))).told == (mine,)
    assert find(tmp_path, ROBOT, 'cart', (*given, str(every))).files == (every,)
    beside = write(tmp_path / 'in' / 'arm.yaml', MANAGER)
    assert find(tmp_path, ROBOT).files == (beside,)
    with pytest.raises(UsageError, match='is not there'):
        find(tmp_path, ROBOT, given=['arm=missing.yaml'])


def test_what_the_description_names_is_left_to_the_simulator(tmp_path):
    file = write(tmp_path / 'c.yaml', MANAGER)
    found = find(tmp_path, f'<robot><parameters>{file}</parameters></robot>')
    assert (found.files, found.told) == ((file,), None)


def test_else_the_one_file_of_a_package_that_the_description_speaks_of(prefix, tmp_path):
    config = prefix / 'share' / 'makers_arm' / 'config'
    write(config / 'joystick.yaml', 'joy: {ros__parameters: {rate: 10}}\n')
    file = write(config / 'arm.yaml', MANAGER)
    assert find(tmp_path, CONTROLLED).told == (file,)
    others = f'{MANAGER}drive: {{ros__parameters: {{type: c/D}}}}\nx:\n  ros__parameters:\n'
    for shape in ('    joints: [wrist, knee]\n', '    joints:\n    - wrist\n    - knee\n'):
        write(config / 'second.yaml', others + shape)  # another robot's
        assert find(tmp_path, CONTROLLED).told == (file,)
    for names in ('joints: [wrist, elbow]', 'left_wheel_names: [pid/elbow]', 'dof_names: [elbow]'):
        write(config / 'second.yaml', f'{others}    {names}\n')
        assert find(tmp_path, CONTROLLED).by == 'this program'


@pytest.mark.usefixtures('prefix')
def test_else_parameters_are_made_for_the_joints_with_position_commands(tmp_path):
    found = find(tmp_path, CONTROLLED)
    content = yaml.safe_load(Path(found.files[0]).read_text())
    names = [name for name, value in content['/**/controller_manager']['ros__parameters'].items()]
    assert names == ['update_rate', 'joint_state_broadcaster', 'trial_trajectory_controller']
    own = content['/**/trial_trajectory_controller']['ros__parameters']
    assert own['joints'] == ['elbow']
    assert find(tmp_path, ROBOT).files == ()


def test_arguments_of_xacro_are_of_all_robots_or_of_one():
    given = ['use_sim:=true name:=a', 'arm=dof:=7', 'cart=wheels:=4 hand:=x=y']
    assert given_to('arm', given) == ['dof:=7']
    assert given_to('cart', given) == ['wheels:=4 hand:=x=y']
    assert given_to('other', given) == ['use_sim:=true name:=a']


def test_a_robot_may_have_several_files(tmp_path):
    files = [write(tmp_path / f'{name}.yaml', MANAGER) for name in 'ab']
    found = find(tmp_path, CONTROLLED, given=[f'arm={file}' for file in files])
    assert found.told == tuple(files)
