# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""``urdf:=`` without ``controllers:=``, and a fleet with the parameter file of a single robot."""

import pytest
from support.paths import ROOT

from amr_description.bringup.arguments import declared, resolve
from amr_description.bringup.stacks.fleet import fleet
from amr_description.bringup.stacks.hardware import mock
from amr_description.bringup.stacks.simulation import simulation
from amr_description.errors import ResourceError, UsageError

CART = (ROOT / 'test/fixtures/urdf_good/cart.urdf').read_text()
PLUGIN = """\
<gazebo>
  <plugin filename="gz_ros2_control-system" name="gz_ros2_control::GazeboSimROS2ControlPlugin">
    <parameters>{}</parameters>
  </plugin>
</gazebo>
</robot>"""
YAML = """\
# The parameters of one robot.
controller_manager:
  ros__parameters:
    diff_drive_controller: {type: diff_drive_controller/DiffDriveController}
"""


@pytest.fixture
def share(tmp_path, monkeypatch):
    """The share folder of an installed package ``cart_description``, with a parameter file."""
    package = 'cart_description'
    marker = tmp_path / 'share/ament_index/resource_index/packages' / package
    marker.parent.mkdir(parents=True)
    marker.touch()
    share = tmp_path / 'share' / package
    (share / 'config').mkdir(parents=True)
    (share / 'config/cart.yaml').write_text(YAML)
    monkeypatch.setenv('AMENT_PREFIX_PATH', str(tmp_path), prepend=':')
    return share


def stack(function, **given):
    return function(**resolve(declared(function), given))


def urdf(share, *parameters):
    path = share / 'cart.urdf'
    text = CART
    for each in parameters:
        text = text.replace('</robot>', PLUGIN.format(each))
    path.write_text(text)
    return str(path)


def controllers_of(made):
    sim = next(node for node in made.nodes if node.executable == 'mujoco_sim')
    return sim.parameters[0]['controllers']


@pytest.mark.parametrize(
    'written',
    [
        '{share}/config/cart.yaml',
        'package://cart_description/config/cart.yaml',
        '$(find cart_description)/config/cart.yaml',
        '$(find-pkg-share cart_description)/config/cart.yaml',
    ],
)
def test_the_file_that_the_urdf_names_is_used(share, written):
    robot = urdf(share, written.format(share=share))
    assert controllers_of(stack(simulation, urdf=robot)) == str(share / 'config/cart.yaml')
    manager = stack(mock, urdf=robot).nodes[0]
    assert manager.parameters[0] == share / 'config/cart.yaml'


def test_what_is_given_prevails(share):
    other = share / 'other.yaml'
    other.write_text(YAML)
    robot = urdf(share, f'{share}/config/cart.yaml')
    assert controllers_of(stack(simulation, urdf=robot, controllers=str(other))) == str(other)


def test_a_robot_with_the_wheels_of_amr_has_its_controllers(share):
    path = share / 'mine.urdf'
    path.write_text((ROOT / 'urdf/amr.urdf').read_text())
    shipped = controllers_of(stack(simulation))
    assert shipped.endswith('config/controllers.yaml')
    assert controllers_of(stack(simulation, urdf=str(path))) == shipped


@pytest.mark.parametrize('named', [[], ['/gone/cart.yaml'], ['$(find gone)/cart.yaml']])
@pytest.mark.parametrize('function', [mock, fleet])
def test_another_robot_has_to_be_given_one(share, function, named):
    robot = urdf(share, *named)
    with pytest.raises(UsageError) as caught:
        stack(function, urdf=robot)
    said = str(caught.value)
    assert said.startswith(f'urdf:={robot}: ')
    assert said.endswith('give controllers:=FILE')
    if named:
        assert f'the file that it names in <parameters> is not there: {named[0]}; ' in said
    else:
        foreign = 'has the controllers of amr, and this robot has no joint joint_wheel_front_left'
        assert f'config/controllers.yaml {foreign}; ' in said


@pytest.mark.parametrize('named', [[], ['/gone/cart.yaml']])
def test_in_the_simulation_it_comes_up_without_controllers(share, named):
    robot = urdf(share, *named)
    made = stack(simulation, urdf=robot)
    assert [node.executable for node in made.nodes] == [
        'mujoco_sim', 'robot_state_publisher', 'create', 'viewer',
    ]  # fmt: skip
    why = 'it names no parameter file'
    if named:
        why = 'a file that it names in <parameters> is not there: "/gone/cart.yaml"'
    note = f'urdf:={robot}: {why}; no controller is spawned: give controllers:=FILE'
    assert ('WARNING', note) in made.notes
    assert controllers_of(made) == ''


def test_several_files_that_the_urdf_names_are_all_read(share):
    other = share / 'config/more.yaml'
    other.write_text('lift: {ros__parameters: {type: position_controllers/Lift}}')
    made = stack(simulation, urdf=urdf(share, share / 'config/cart.yaml', other))
    assert controllers_of(made) == '', 'the simulator reads what the URDF names'
    (spawner,) = (node for node in made.nodes if node.executable == 'spawner')
    assert list(spawner.arguments) == [
        '--switch-asap',
        *('--controller', 'diff_drive_controller'),
        *('--controller', 'lift', '--param-file', str(other)),
        '--continue-on-error',
    ]


def test_a_fleet_with_the_file_of_one_robot_is_told_what_to_write(share):
    file = share / 'config/cart.yaml'
    with pytest.raises(UsageError) as caught:
        stack(fleet, urdf=urdf(share), controllers=str(file))
    assert str(caught.value) == (
        f'{file}:2: the section controller_manager is not for /robot1/controller_manager; write '
        '/**/controller_manager: there, and /**/ before the names of the controllers, for robots '
        'in any namespace'
    )
    file.write_text(YAML.replace('controller_manager:', '/**/controller_manager:'))
    assert controllers_of(stack(fleet, urdf=urdf(share), controllers=str(file))) == str(file)


def test_a_file_that_is_not_there_is_one_line_with_its_argument(share):
    path = share / 'config/cart.yam'
    with pytest.raises(ResourceError, match=r'^controllers:=.*/cart.yam: no such file: /.*; did'):
        stack(simulation, urdf=urdf(share), controllers=str(path))


def test_mock_hardware_and_a_fleet_have_the_controllers_of_the_file(share):
    file = share / 'config/cart.yaml'
    file.write_text(
        YAML.replace('controller_manager:', '/**/controller_manager:').replace(
            'diff_drive_controller: {', 'base: {'
        )
    )
    given = {'urdf': urdf(share), 'controllers': str(file)}
    for function, namespaces in ((mock, [None]), (fleet, ['robot1', 'robot2', 'robot3'])):
        made = stack(function, **given)
        found = [node for node in made.nodes if node.executable == 'spawner']
        assert [node.namespace for node in found] == namespaces
        assert all(list(node.arguments) == ['base', '--continue-on-error'] for node in found)
        topic = f'/{namespaces[0]}/base/cmd_vel' if namespaces[0] else '/base/cmd_vel'
        assert f'-r /cmd_vel:={topic}\n' in made.next_steps
    create = next(node for node in made.nodes if node.executable == 'create')
    assert '-z' not in create.arguments
