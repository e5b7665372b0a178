# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""Odd and right robots: no false alarm, and four readers agree on what they are."""

from lxml import etree
import pytest
from support.paths import ROOT

from amr_description.cli import check_urdf
from amr_description.log import null_log
from amr_description.model import urdf
from amr_description.sim.drop_test import drop_test
from amr_description.sim.robot_spec import build_robot

FIXTURES = ROOT / 'test/fixtures'
GOOD = [*sorted((FIXTURES / 'urdf_good').glob('*.urdf')), ROOT / 'urdf/amr.urdf']
XACRO = ROOT / 'urdf/amr_sensors.urdf.xacro'
READABLE = [*GOOD, FIXTURES / 'urdf/arm.urdf', FIXTURES / 'tutorial/amr.urdf']


def named(paths):
    return pytest.mark.parametrize('path', paths, ids=[f'{p.parent.name}/{p.stem}' for p in paths])


@named([*GOOD, XACRO])
def test_a_good_robot_has_no_findings(path, capsys):
    assert check_urdf.main([str(path), '--strict']) == 0
    assert capsys.readouterr().err == ''


@named(READABLE)
def test_lxml_finds_the_same_links_joints_and_masses(path):
    robot, xml = urdf.load(path), etree.parse(path).getroot()
    links = {link.get('name'): link for link in xml.iterchildren('link')}
    assert [link.name for link in robot.links] == list(links)
    for link in robot.links:
        masses = [float(mass.get('value')) for mass in links[link.name].iterfind('inertial/mass')]
        assert masses == ([link.inertial.mass] if link.inertial else [])
    assert [(j.name, j.type, j.parent, j.child) for j in robot.joints] == [
        (j.get('name'), j.get('type'), j.find('parent').get('link'), j.find('child').get('link'))
        for j in xml.iterchildren('joint')
    ]


@named(READABLE)
def test_yourdfpy_finds_the_same_links_joints_and_masses(path):
    import yourdfpy

    robot = urdf.load(path)
    theirs = yourdfpy.URDF.load(path, build_scene_graph=False, load_meshes=False).robot
    assert [(link.name, link.inertial and link.inertial.mass) for link in robot.links] == [
        (link.name, link.inertial and link.inertial.mass) for link in theirs.links
    ]
    assert [(j.name, j.type, j.parent, j.child) for j in robot.joints] == [
        (j.name, j.type, j.parent, j.child) for j in theirs.joints
    ]


@named(READABLE)
def test_mujoco_finds_the_same_links_joints_and_masses(path):
    robot = urdf.load(path)
    model = build_robot(robot, null_log).spec.compile()
    bodies = {model.body(i).name: model.body(i) for i in range(model.nbody)}
    # Slip clutches of the simulator stand beside the links and joints.
    names = {name for name in bodies if not name.endswith('/rotor')}
    assert names - {'world'} == {link.name for link in robot.links} - {'world'}
    for link in robot.links:
        if link.inertial is not None:
            assert float(bodies[link.name].mass[0]) == pytest.approx(link.inertial.mass)
    joints = {model.joint(i).name.partition('_TX')[0] for i in range(model.njnt)}
    moving = {joint.name for joint in robot.joints if joint.is_moving}
    assert moving <= joints
    for joint in robot.joints:
        parent = model.body(bodies[joint.child].parentid[0]).name
        assert parent == joint.parent


@named(GOOD)
def test_a_good_robot_passes_the_drop(path):
    report = drop_test(urdf.load(path))
    assert report.failures == ()
    assert report.stands_fixed == (report.rest_time is None)
