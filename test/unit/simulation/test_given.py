# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""What a simulation is given: arguments of xacro, a fixed root, several parameter files."""

from fixtures.sim.arm import ARM
from fixtures.sim.plugin_robot import cart, classic_drive
import pytest

from amr_description import Simulation
from amr_description.bringup.stacks.controllers import plan_controllers
from amr_description.errors import AmrError, UsageError
from amr_description.model.frames import Transform
from amr_description.model.urdf import parse
from amr_description.parameter_files import given_files
from amr_description.simulation.given import GivenDescription

XACRO = """<robot name="r" xmlns:xacro="http://www.ros.org/wiki/xacro">
<xacro:arg name="links" default="1"/><xacro:arg name="hand" default="false"/>
<link name="a$(arg links)"/><xacro:if value="$(arg hand)"><link name="hand"/>
<joint name="j" type="fixed"><parent link="a$(arg links)"/><child link="hand"/></joint></xacro:if>
</robot>"""
TYPES = """controller_manager:
  ros__parameters:
    joint_state_broadcaster: {type: joint_state_broadcaster/JointStateBroadcaster}
    arm: {type: forward_command_controller/ForwardCommandController}
"""
OWN = """arm:
  ros__parameters: {joints: [shoulder, elbow], interface_name: position}
"""


@pytest.fixture
def files(tmp_path):
    """Two parameter files: the types, and the parameters of one controller."""
    for name, text in (('types.yaml', TYPES), ('own.yaml', OWN)):
        (tmp_path / name).write_text(text)
    return tmp_path / 'types.yaml', tmp_path / 'own.yaml'


def links(tmp_path, arguments, *, fixed=False):
    path = tmp_path / 'r.urdf.xacro'
    path.write_text(XACRO)
    text = GivenDescription(str(path), arguments, fixed).text(pytest.fail)
    return [each.name for each in parse(text).links]


@pytest.mark.parametrize('arguments', ['links:=7 hand:=true', {'links': 7, 'hand': True}])
def test_arguments_of_xacro_are_words_or_a_dict(tmp_path, arguments):
    assert links(tmp_path, arguments) == ['a7', 'hand']
    assert links(tmp_path, '') == ['a1']


def test_a_robot_is_fixed_to_the_world(tmp_path):
    assert links(tmp_path, '', fixed=True) == ['a1', 'world']


def test_arguments_are_for_a_xacro_file_alone(tmp_path):
    with pytest.raises(UsageError, match='for xacro files, not for a text'):
        GivenDescription('<robot/>', 'a:=1').text(pytest.fail)
    path = tmp_path / 'r.urdf'
    path.write_text('<robot name="r"><link name="a"/></robot>')
    with pytest.raises(AmrError, match='takes no arguments'):
        GivenDescription(str(path), {'a': 1}).text(pytest.fail)
    with pytest.raises(UsageError, match='No closing quotation'):
        links(tmp_path, "links:='1")


def test_files_are_one_several_or_names_between_commas(files):
    both = [*files]
    assert given_files(files) == both
    assert given_files(','.join(map(str, files))) == both
    assert given_files(str(files[0])) == both[:1]
    assert given_files(None) == []
    strange = files[0].with_name('a,b.yaml')
    strange.write_text('{}')
    assert given_files(strange) == [strange]


def test_a_controller_has_its_type_in_one_file_and_its_parameters_in_another(files):
    with Simulation(ARM, files) as sim:
        sim.send('/arm/commands', {'data': [0.2, -0.1]})
        sim.run(2.0)
        assert sim.joints['shoulder'].position == pytest.approx(0.2, abs=0.02)


def test_the_launch_takes_several_files(files):
    joined = ','.join(map(str, files))
    plan = plan_controllers('arm.urdf', ARM, joined)
    assert plan.names == ('joint_state_broadcaster', 'arm')
    assert plan.declared[1].parameters['interface_name'] == 'position'
    assert plan.parameter == joined


def cart_with_both():
    """Return a cart whose wheels a plugin and ``<ros2_control>`` could have."""
    wheels = ''.join(
        f'<joint name="{side}_joint"><command_interface name="velocity"/>'
        '<state_interface name="position"/><state_interface name="velocity"/></joint>'
        for side in ('left', 'right')
    )
    block = '<ros2_control name="own" type="system"><hardware><plugin>'
    block += f'gz_ros2_control/GazeboSimSystem</plugin></hardware>{wheels}</ros2_control>'
    return cart(classic_drive()).replace('</robot>', f'{block}</robot>')


def test_a_drive_plugin_beside_ros2_control_moves_the_robot():
    with Simulation(cart_with_both()) as sim:
        sim.send('/cmd_vel', {'linear': {'x': 0.3}})
        sim.run(3.0)
        assert sim.truth.x == pytest.approx(0.9, rel=0.05)


def test_a_robot_is_read_in_the_namespace_that_it_is_spawned_in(tmp_path):
    file = tmp_path / 'b.yaml'
    file.write_text("""/b/controller_manager:
  ros__parameters:
    drive: {type: diff_drive_controller/DiffDriveController}
/b/drive:
  ros__parameters:
    left_wheel_names: [left_joint]
    right_wheel_names: [right_joint]
    wheel_separation: 0.4
    wheel_radius: 0.1
""")
    apart = {'a': Transform(), 'b': Transform((0.0, 3.0, 0.0))}
    with Simulation(cart_with_both(), file, robots=apart) as sim:
        limits = {
            name: sim.world.robot(name).description.joint('left_joint').limit for name in apart
        }
        # The plugin's torque; b's controller claims the wheels, and the plugin has none of them.
        assert limits['a'].effort == 5.0
        assert limits['b'] is None
        sim.send('/a/cmd_vel', {'linear': {'x': 0.3}})
        sim.run(2.0)
        assert sim.robots['a'].truth.x == pytest.approx(0.6, rel=0.1)
