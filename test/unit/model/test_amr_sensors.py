# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""amr with its sensors: the robot of the tutorial, and nothing else but the sensors."""

from dataclasses import replace

import pytest
from support.paths import ROOT

from amr_description.model.description_file import description_at
from amr_description.model.frames import rotate
from amr_description.model.kinematics import link_poses
from amr_description.model.ros2_control_tag import hardware_of
from amr_description.model.urdf import parse


@pytest.fixture(scope='module')
def amr():
    return parse((ROOT / 'urdf/amr.urdf').read_text())


@pytest.fixture(scope='module')
def equipped():
    return parse(description_at(str(ROOT / 'urdf/amr_sensors.urdf.xacro'), warn=pytest.fail))


def mass_of(robot):
    return sum(link.inertial.mass for link in robot.links if link.inertial)


def test_it_is_that_robot_with_links_more(amr, equipped):
    assert equipped.name == amr.name
    assert {link.name for link in amr.links} < {link.name for link in equipped.links}
    lines = {'line': 0}
    joints = {joint.name: replace(joint, **lines) for joint in equipped.joints}
    assert joints.items() >= {each.name: replace(each, **lines) for each in amr.joints}.items()
    wheels, moved = ([each.joints for each in hardware_of(robot)] for robot in (amr, equipped))
    assert [[joint.name for joint in each] for each in wheels] == [
        [joint.name for joint in each] for each in moved
    ]
    added = {joint.type for joint in equipped.joints} - {joint.type for joint in amr.joints}
    assert not added  # what it has more of is fixed
    assert 1.0 < mass_of(equipped) / mass_of(amr) < 1.05


def test_the_lidar_looks_over_the_wheels_and_all_else(equipped):
    poses = link_poses(equipped)
    plane = poses['lidar_link'].translation[2]
    assert plane == pytest.approx(0.25)
    assert poses['wheel_front_left'].translation[2] + 0.1 < plane - 0.04
    assert poses['camera_link'].translation[2] + 0.0125 < plane - 0.04


def test_the_optical_frame_looks_forward(equipped):
    pose = link_poses(equipped)['camera_optical_frame']
    assert rotate(pose.rotation, (0.0, 0.0, 1.0)) == pytest.approx((1.0, 0.0, 0.0), abs=1e-9)
    assert rotate(pose.rotation, (1.0, 0.0, 0.0)) == pytest.approx((0.0, -1.0, 0.0), abs=1e-9)
