# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""Wheels whose collision is a mesh, and wheels that nothing drives."""

import math

from fixtures.sim.driving import Lines, ROOT
import pytest
from support.mesh_files import binary_stl, write

from amr_description.model.frames import Transform
from amr_description.sim.spawning import read_description
from amr_description.sim.world import MujocoWorld

TWO_WHEELS = (ROOT / 'test' / 'fixtures' / 'sim' / 'two_wheels.urdf').read_text()
CYLINDER = '<cylinder radius="0.05" length="0.03"/>'


def drum(sides, radius=0.05, width=0.03, shift=0.0):
    """The triangles of a prism about z: a wheel as a designer exports it."""
    ring = [2.0 * math.pi * side / sides for side in range(sides)]
    corners = [
        (radius * math.cos(angle), radius * math.sin(angle), shift + z)
        for z in (-width / 2, width / 2)
        for angle in ring
    ]
    faces = []
    for a in range(sides):
        b = (a + 1) % sides
        faces += [(a, b, sides + b), (a, sides + b, sides + a)]
        faces += [(0, b, a), (sides, sides + a, sides + b)]
    return binary_stl(corners, faces)


def spawned(folder, urdf):
    source = write(folder / 'robot.urdf', urdf)
    world = MujocoWorld('empty', log=Lines())
    return world, world.spawn('robot', read_description(urdf, str(source)), Transform())


@pytest.mark.parametrize('sides', [24, 60])
def test_a_mesh_that_is_round_about_its_axle_rolls_as_a_wheel(tmp_path, sides):
    write(tmp_path / 'wheel.stl', drum(sides, shift=0.01))
    mesh = '<mesh filename="wheel.stl"/>'
    world, robot = spawned(tmp_path, TWO_WHEELS.replace(CYLINDER, mesh))
    assert [(wheel.link, wheel.radius) for wheel in robot.wheels] == [
        ('left_wheel', pytest.approx(0.05)), ('right_wheel', pytest.approx(0.05)),
    ]  # fmt: skip
    geom = world.engine.model.geom('robot/left_wheel/wheel')
    assert geom.size.tolist() == pytest.approx([0.05, 0.05, 0.015])
    assert geom.pos.tolist() == pytest.approx([0.0, 0.0, 0.01])
    wheels = robot.joints(['left', 'right'])
    wheels.command('velocity', [5.0, 5.0])
    world.step(500)
    start, rolled = robot.pose('base_link').translation[0], sum(wheels.positions())
    world.step(500)
    way = robot.pose('base_link').translation[0] - start
    assert way == pytest.approx((sum(wheels.positions()) - rolled) / 2 * 0.05, rel=0.005)


def test_a_mesh_with_corners_is_no_wheel(tmp_path):
    write(tmp_path / 'wheel.stl', drum(5))
    mesh = '<mesh filename="wheel.stl"/>'
    _, robot = spawned(tmp_path, TWO_WHEELS.replace(CYLINDER, mesh))
    assert robot.wheels == ()


def test_a_wheel_that_follows_a_driven_one_is_one_too(tmp_path):
    """Its twin in <ros2_control> has the command of both."""
    left, right = TWO_WHEELS.split('<joint name="right" type="continuous">')
    twin = f'{left}<joint name="right" type="continuous"><mimic joint="left"/>{right}'
    begin = twin.rindex('<joint name="right">')
    end = twin.index('</joint>', begin) + len('</joint>')
    _, robot = spawned(tmp_path, twin[:begin] + twin[end:])
    assert {wheel.link for wheel in robot.wheels} == {'left_wheel', 'right_wheel'}


def without_drive(urdf):
    return urdf[: urdf.index('<ros2_control')] + '</robot>'


def test_a_robot_that_nothing_drives_stands_on_its_wheels(tmp_path):
    world, robot = spawned(tmp_path, without_drive(TWO_WHEELS))
    assert {wheel.link for wheel in robot.wheels} == {'left_wheel', 'right_wheel'}
    world.step(1000)
    assert robot.pose('base_link').translation[2] == pytest.approx(0.1, abs=1e-4)


def test_wheels_that_are_only_read_turn_freely(tmp_path):
    silent = TWO_WHEELS.replace('<command_interface name="velocity"/>', '')
    _, robot = spawned(tmp_path, silent)
    assert {wheel.link for wheel in robot.wheels} == {'left_wheel', 'right_wheel'}


def test_wheels_at_different_heights_are_parts_that_turn(tmp_path):
    lifted = TWO_WHEELS.replace('xyz="0.02 0.17 -0.05"', 'xyz="0.02 0.17 0.05"')
    _, robot = spawned(tmp_path, without_drive(lifted))
    assert robot.wheels == ()
