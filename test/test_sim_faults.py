# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""Faults of the physics are told once, in one line, and nothing is written to the folder."""

import math

from fixtures.sim.driving import AMR, Lines
import pytest

from amr_description.model.frames import Transform
from amr_description.sim.world import MujocoWorld

BESIDE = Transform((0.0, 3.0, 0.0))
COLLISION = '<collision>', '</collision>'


@pytest.fixture
def log():
    return Lines()


@pytest.fixture
def world(log, tmp_path, monkeypatch):
    """Two robots, in an empty working folder that must be empty afterwards."""
    monkeypatch.chdir(tmp_path)
    world = MujocoWorld('empty', log=log)
    world.spawn('other', AMR, BESIDE)
    world.spawn('amr', AMR)
    yield world
    assert list(tmp_path.iterdir()) == []


def break_wheel(world, quantity, value):
    """Put ``value`` where the physics has the front left wheel of 'amr'."""
    data = world.engine.data
    joint = data.joint('amr/joint_wheel_front_left')
    getattr(joint, quantity)[0] = value


@pytest.mark.parametrize(
    'quantity, value, word',
    [
        ('qvel', math.nan, 'velocity'),
        ('qvel', 1e12, 'velocity'),
        ('qpos', math.inf, 'position'),
    ],
)
def test_lost_state_names_robot_and_joint_once(world, log, quantity, value, word):
    world.step(10)
    assert log.lines == []
    break_wheel(world, quantity, value)
    for _ in range(20):
        world.step(5)
    assert len(log.lines) == 1
    assert (
        f"ERROR robot 'amr': joint 'joint_wheel_front_left': the {word} is not finite" in log.text
    )
    assert 'the state is lost until a reset' in log.text


def test_time_goes_on_and_a_reset_heals(world, log):
    break_wheel(world, 'qvel', math.nan)
    world.step(100)
    assert world.time == 200_000_000
    world.reset()
    world.step(500)
    robot = world.robot('amr')
    assert robot.pose('base_footprint').translation == pytest.approx((0, 0, 0), abs=1e-4)
    assert len(log.lines) == 1
    break_wheel(world, 'qvel', math.nan)
    world.step(5)
    assert len(log.lines) == 2


def test_robot_without_collision_falls_and_is_named_once(log):
    head, rest = AMR.split('<collision>', 1)
    bare = head + ''.join(part.split('</collision>', 1)[-1] for part in rest.split('<collision>'))
    assert 'collision>' not in bare
    world = MujocoWorld('empty', log=log)
    world.spawn('ghost', bare)
    world.spawn('amr', AMR, BESIDE)
    for _ in range(100):
        world.step(5)
    assert "ERROR robot 'ghost' is below the ground: its root is at z = -" in log.text
    assert log.text.count('below the ground') == 1
    world.reset()
    world.step(500)
    assert log.text.count('below the ground') == 2
