# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""The physics of robots that Gazebo's plugins drive: wheels, and a body that is moved."""

import math

from fixtures.sim.driving import Lines
from fixtures.sim.plugin_robot import cart, classic_drive, gz_drive, plugin, RADIUS
import pytest

from amr_description.clock import NANOSECONDS
from amr_description.errors import SimulationError
from amr_description.hardware.simulated_base import SimulatedBase
from amr_description.model.frames import Transform
from amr_description.sim.world import MujocoWorld

PLANAR = plugin('libgazebo_ros_planar_move.so', 'planar')


def spawned(urdf):
    world = MujocoWorld('empty')
    robot = world.spawn('cart', urdf, Transform((0.0, 0.0, 0.001)))
    world.advance(NANOSECONDS // 2)
    return world, robot


def test_the_wheels_of_a_plugin_drive():
    world, robot = spawned(cart(gz_drive()))
    robot.joints(['left_joint', 'right_joint']).command('velocity', [4.0, 4.0])
    start = robot.pose('base_link').translation
    world.advance(2 * NANOSECONDS)
    assert robot.pose('base_link').translation[0] - start[0] == pytest.approx(
        4.0 * RADIUS * 2.0, rel=0.02
    )


def test_a_torque_that_is_too_low_does_not_turn_them():
    world, robot = spawned(cart(classic_drive('<max_wheel_torque>1e-6</max_wheel_torque>')))
    robot.joints(['left_joint', 'right_joint']).command('velocity', [4.0, 4.0])
    world.advance(NANOSECONDS)
    assert robot.pose('base_link').translation[0] < 0.01


def base_of(robot):
    info = robot.description.plugin_hardware[-1]
    base = SimulatedBase(info, Lines(), robot)
    base.configure()
    base.activate()
    return base


def test_a_body_moves_as_commanded_whatever_its_wheels_do():
    world, robot = spawned(cart(PLANAR))
    base = base_of(robot)
    for command, value in zip(base.command_interfaces(), (0.3, 0.4, math.pi / 4), strict=True):
        command.value = value
    base.write(0, 0)
    world.advance(NANOSECONDS)
    (x, y, _), (_, _, turn) = robot.velocity('base_link')
    assert (x, y) == pytest.approx((0.3, 0.4), abs=2e-3)
    assert turn == pytest.approx(math.pi / 4, rel=1e-3)
    base.deactivate()
    world.advance(NANOSECONDS // 2)
    assert robot.velocity('base_link')[0] == pytest.approx((0.0, 0.0, 0.0), abs=1e-4)


def test_the_truth_of_a_link_is_read():
    _, robot = spawned(cart(PLANAR))
    base = base_of(robot)
    base.read(0, 0)
    values = [state.value for state in base.state_interfaces()]
    pose = robot.pose('base_link')
    assert values[:7] == [*pose.translation, *pose.rotation]


def test_a_body_that_nothing_moves_is_not_moved():
    _, robot = spawned(cart(gz_drive()))
    with pytest.raises(SimulationError, match="robot 'cart': its base cannot be moved"):
        robot.move_base(0.1, 0.0, 0.0)
