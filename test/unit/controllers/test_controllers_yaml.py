# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""config/controllers.yaml agrees with urdf/amr.urdf."""

import pytest
from support.paths import ROOT
import yaml

from amr_description.model import urdf
from amr_description.model.ros2_control_tag import hardware_of


@pytest.fixture(scope='module')
def robot():
    return urdf.load(ROOT / 'urdf/amr.urdf')


def load(path):
    """Return the parameters of the manager and of the drive controller."""
    nodes = yaml.safe_load((ROOT / path).read_text())
    tables = {name.removeprefix('/**/'): each['ros__parameters'] for name, each in nodes.items()}
    return [tables[name] for name in ('controller_manager', 'diff_drive_controller')]


@pytest.fixture(scope='module')
def drive():
    return load('config/controllers.yaml')[1]


def test_geometry_is_that_of_the_description(robot, drive):
    """The tutorial: wheel_separation and wheel_radius must match the URDF exactly."""
    sides = {'left': drive['left_wheel_names'], 'right': drive['right_wheel_names']}
    y = {
        side: {robot.joint(name).origin.translation[1] for name in names}
        for side, names in sides.items()
    }
    half = drive['wheel_separation'] / 2
    assert y == {'left': {half}, 'right': {-half}}
    for name in (*sides['left'], *sides['right']):
        wheel = robot.link(robot.joint(name).child)
        assert wheel.collisions[0].geometry.radius == drive['wheel_radius']


def test_wheels_are_those_that_take_a_velocity(robot, drive):
    (hardware,) = hardware_of(robot)
    commanded = {joint.name for joint in hardware.joints if joint.command_interfaces}
    assert {*drive['left_wheel_names'], *drive['right_wheel_names']} == commanded


def test_base_frame_is_the_root_of_the_description(robot, drive):
    """Else a frame has two parents in TF."""
    assert drive['base_frame_id'] == robot.root.name


def test_multiplier_is_near_that_of_a_robot_that_scrubs(robot, drive):
    """A Coulomb skid-steer turns b² / (a² + b²) of its wheels' turn (wheels at ±a, ±b)."""
    a, b, _ = (abs(part) for part in robot.joint('joint_wheel_front_left').origin.translation)
    assert drive['wheel_separation_multiplier'] == pytest.approx((a * a + b * b) / b**2, rel=0.05)


def test_serves_every_namespace():
    nodes = yaml.safe_load((ROOT / 'config/controllers.yaml').read_text())
    assert list(nodes) == ['/**/controller_manager', '/**/diff_drive_controller']


def test_departs_from_the_tutorial_where_it_must_and_nowhere_else():
    manager, drive = load('config/controllers.yaml')
    their_manager, their_drive = load('test/fixtures/tutorial/controllers.yaml')
    remap = manager['diff_drive_controller'].pop('node_options_args')
    assert remap == ['-r', '~/odom:=odom']
    # The simulator sets it for all of its nodes; without it the file serves a real robot too.
    assert their_manager.pop('use_sim_time') is True
    assert manager == their_manager
    assert drive.pop('wheel_separation_multiplier') > 1.0
    assert (drive.pop('base_frame_id'), their_drive.pop('base_frame_id')) == (
        'base_footprint',
        'base_link',
    )
    # Nothing is known of what wheels cannot measure; the tutorial's zeros say that all is exact.
    for name in ('pose_covariance_diagonal', 'twist_covariance_diagonal'):
        assert min(drive.pop(name)) > 0.0
    assert drive == their_drive
