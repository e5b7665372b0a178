# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""Which controllers parameter files have types for, in what order they are spawned, and whose."""

import pytest
from support.paths import ROOT

from amr_description.model.controller_files import (
    declared_controllers,
    DeclaredController,
    files_of,
    manager_of,
    spawner_words,
)
from amr_description.model.fixing import fixed_to_world
from amr_description.model.robot import WORLD_LINK
from amr_description.model.urdf import parse

CART = (ROOT / 'test/fixtures/urdf_good/cart.urdf').read_text()
HOST = """<gazebo><plugin filename="x" name="gz_ros2_control::GazeboSimROS2ControlPlugin">{}
</plugin></gazebo></robot>"""
OWN = """\
arm:
  ros__parameters: {type: a/Arm, joints: [one, two]}
states:
  ros__parameters: {type: b/StateBroadcaster}
"""


def hosted(inside):
    return parse(CART.replace('</robot>', HOST.format(inside)))


@pytest.fixture
def declared(tmp_path):
    """Read a file with this content."""

    def read(text, namespace='/', manager='controller_manager'):
        path = tmp_path / 'controllers.yaml'
        path.write_text(text)
        return declared_controllers([path], namespace, manager)

    return read


@pytest.mark.parametrize(
    ('manager', 'namespace'),
    [
        ('controller_manager:', '/'),
        ('/controller_manager:', '/'),
        ('/**/controller_manager:', '/'),
        ('/**/controller_manager:', '/left'),
        ('/**:', '/left'),
        ('left:\n controller_manager:', '/left'),
    ],
)
def test_types_in_the_section_of_the_manager(declared, manager, namespace):
    text = f"""{manager}
    ros__parameters:
      update_rate: 50
      drive: {{type: d/Drive, node_options_args: [-r, "~/odom:=odom"]}}
      arm.type: a/Arm
      states.type: b/JointStateBroadcaster
"""
    found = declared(text, namespace)
    assert [(each.name, each.type, each.file) for each in found] == [
        ('states', 'b/JointStateBroadcaster', None),
        ('drive', 'd/Drive', None),
        ('arm', 'a/Arm', None),
    ]
    assert found[1].remappings == (('~/odom', 'odom'),)
    assert spawner_words(found) == ['states', 'drive', 'arm']


def test_types_in_sections_of_their_own(declared, tmp_path):
    found = declared(OWN)
    file = tmp_path / 'controllers.yaml'
    assert [(each.name, each.file) for each in found] == [('states', file), ('arm', file)]
    assert found[1].parameters['joints'] == ['one', 'two']
    words = '--switch-asap --controller states --param-file F --controller arm --param-file F'
    assert spawner_words(found) == words.replace('F', str(file)).split()


@pytest.mark.parametrize(
    ('text', 'namespace', 'manager'),
    [
        (OWN, '/left', 'controller_manager'),
        ('/**: {ros__parameters: {type: a/Arm}}', '/', 'controller_manager'),
        ('controller_manager: {ros__parameters: {a.type: b/C}}', '/left', 'controller_manager'),
        ('controller_manager: {ros__parameters: {a.type: b/C}}', '/', 'other_manager'),
        ('controller_manager: {ros__parameters: {a.type: 5}}', '/', 'controller_manager'),
        ('controller_manager: {ros__parameters: }', '/', 'controller_manager'),
    ],
)
def test_what_is_for_others_is_left_out(declared, text, namespace, manager):
    assert declared(text, namespace, manager) == []


def test_a_broadcaster_is_known_by_its_type():
    assert DeclaredController('a', 'imu_sensor_broadcaster/IMUSensorBroadcaster').is_broadcaster
    assert not DeclaredController('broadcaster', 'a/Drive').is_broadcaster


def test_the_manager_is_that_of_the_urdf():
    assert manager_of(parse(CART)) == ('/', 'controller_manager')
    inside = '<ros><namespace>left</namespace></ros>'
    inside += '<controller_manager_name>boss</controller_manager_name>'
    assert manager_of(hosted(inside)) == ('/left', 'boss')


def test_the_files_of_a_robot_are_those_that_it_names(tmp_path):
    files = [tmp_path / 'a.yaml', tmp_path / 'b.yaml']
    for file in files:
        file.touch()
    named = ''.join(f'<parameters>{file}</parameters>' for file in (*files, files[0]))
    assert files_of(hosted(f'{named}<parameters>/gone.yaml</parameters>')) == files
    shipped = files_of(parse((ROOT / 'urdf/amr.urdf').read_text()))
    assert [file.name for file in shipped] == ['controllers.yaml']
    assert files_of(parse(CART)) == [], 'those of amr are not for a stranger'


def test_a_robot_is_fixed_by_a_link_world():
    fixed = fixed_to_world(CART)
    robot, before = parse(fixed), parse(CART)
    assert robot.root.name == WORLD_LINK
    assert robot.joint('fixed_to_world').child == before.root.name
    assert [link.line for link in robot.links][:-1] == [link.line for link in before.links]
    assert fixed_to_world(fixed) == fixed
    taken = fixed.replace(f'"{WORLD_LINK}"', '"table"')
    assert parse(fixed_to_world(taken)).joint('fixed_to_world_').child == 'table'
