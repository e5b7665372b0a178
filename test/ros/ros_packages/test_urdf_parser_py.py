# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""``urdf_parser_py`` by its own name: descriptions read, asked, changed and written."""

import pytest
from support.paths import ROOT
from urdf_parser_py.urdf import Box, Inertia, Joint, Link, ParseError, Pose, Robot, URDF, Visual

TEXT = """<?xml version="1.0"?>
<robot name="arm"><!-- small -->
  <material name="red"><color rgba="1 0 0 1"/></material>
  <link name="base">
    <visual>
      <origin xyz="0 0 0.5"/>
      <geometry><cylinder radius="0.1" length="1"/></geometry>
      <material name="red"/>
    </visual>
    <visual><geometry><mesh filename="package://arm/a.stl" scale="1 1 2"/></geometry></visual>
    <inertial>
      <mass value="2.5"/>
      <inertia ixx="1" ixy="0" ixz="0" iyy="2" iyz="0" izz="3"/>
    </inertial>
  </link>
  <link name="upper"/>
  <link name="tool"/>
  <joint name="shoulder" type="revolute">
    <parent link="base"/><child link="upper"/>
    <axis xyz="0 1 0"/>
    <limit effort="10" velocity="2" upper="1.5"/>
    <mimic joint="other" multiplier="-1"/>
  </joint>
  <joint name="flange" type="fixed"><parent link="upper"/><child link="tool"/></joint>
  <gazebo reference="base"><mu1>0.3</mu1></gazebo>
</robot>
"""


@pytest.fixture
def robot():
    return URDF.from_xml_string(TEXT)


def test_a_description_is_read(robot):
    base, shoulder = robot.link_map['base'], robot.joint_map['shoulder']
    assert (robot.name, robot.get_root(), [link.name for link in robot.links]) == (
        'arm',
        'base',
        ['base', 'upper', 'tool'],
    )
    assert base.visual.origin == Pose([0.0, 0.0, 0.5], [0.0, 0.0, 0.0])
    assert (base.visuals[0].geometry.length, base.visuals[1].geometry.scale) == (1.0, [1, 1, 2])
    assert base.inertial.inertia.to_matrix() == [[1, 0, 0], [0, 2, 0], [0, 0, 3]]
    assert (base.inertial.mass, base.collision, base.visual.material.name) == (2.5, None, 'red')
    assert (shoulder.joint_type, shoulder.axis, shoulder.origin) == ('revolute', [0, 1, 0], None)
    assert (shoulder.limit.lower, shoulder.limit.upper) == (0.0, 1.5)
    assert (shoulder.mimic.joint, shoulder.mimic.multiplier) == ('other', -1.0)


def test_chains_lead_from_link_to_link(robot):
    assert robot.get_chain('base', 'tool') == ['base', 'shoulder', 'upper', 'flange', 'tool']
    assert robot.get_chain('base', 'tool', links=False, fixed=False) == ['shoulder']
    assert robot.parent_map['tool'] == ('flange', 'upper')
    assert robot.child_map == {'base': [('shoulder', 'upper')], 'upper': [('flange', 'tool')]}
    with pytest.raises(KeyError):
        robot.get_chain('tool', 'base')


def test_what_is_written_is_read_again_as_it_was(robot):
    again = Robot.from_xml_string(robot.to_xml_string())
    for name in ('links', 'joints', 'materials'):
        assert getattr(again, name) == getattr(robot, name)
    assert [each.findtext('mu1') for each in again.gazebos] == ['0.3']


def test_the_description_of_this_package_goes_round():
    robot = Robot.from_xml_file(ROOT / 'urdf' / 'amr.urdf')
    again = Robot.from_xml_string(robot.to_xml_string().encode())
    assert (again.links, again.joints) == (robot.links, robot.joints)
    assert len(again.ros2_controls) == len(robot.ros2_controls) == 1


def test_a_robot_is_made_by_a_program():
    robot = Robot(name='box')
    robot.add_link(Link(name='a', visuals=[Visual(geometry=Box([1.0, 2.0, 3.0]))]))
    robot.add_link(Link(name='b'))
    robot.add_joint(Joint('ab', 'a', 'b', joint_type='fixed', origin=Pose([0, 0, 1], [0, 0, 0])))
    again = Robot.from_xml_string(robot.to_xml_string())
    assert again.link_map['a'].visual.geometry.size == [1.0, 2.0, 3.0]
    assert again.get_chain('a', 'b') == ['a', 'ab', 'b']
    assert Inertia(izz=1.0).izz == 1.0
    with pytest.raises(TypeError, match="Box has no 'length'"):
        Box(length=3.0)


@pytest.mark.parametrize(
    ('old', 'new', 'why'),
    [
        (
            'type="revolute"',
            'type="hinge"',
            r"/robot\[@name='arm'\]/joint.*type='hinge': it takes",
        ),
        ('<mass value="2.5"/>', '', 'inertial: mass is missing'),
        ('radius="0.1"', 'radius="wide"', "radius='wide' is no number"),
        ('radius="0.1" ', '', 'cylinder: radius is missing'),
        ('<cylinder radius="0.1" length="1"/>', '', 'geometry: it takes one of box'),
        ('xyz="0 0 0.5"', 'xyz="0 0"', 'xyz takes three numbers'),
        ('</robot>', '', 'no XML'),
        ('name="arm"', 'name="arm" version="2.0"', "version='2.0': it takes 1.0"),
    ],
)
def test_what_is_wrong_is_said_with_its_place(old, new, why):
    with pytest.raises(ParseError, match=why):
        Robot.from_xml_string(TEXT.replace(old, new))


def test_a_robot_has_one_root(robot):
    robot.add_link(Link(name='alone'))
    with pytest.raises(ParseError, match=r"one root, and not \['base', 'alone'\]"):
        robot.get_root()
