# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""A robot as one thing: its motion against the laws of a thrown body, its box, its placing."""

import math

from fixtures.sim.driving import AMR, ROOT
import pytest

from amr_description.errors import SimulationError
from amr_description.model.frames import quaternion_from_rpy, Transform
from amr_description.sim.entity_state import bounds_of, motion_of, pose_of, set_state
from amr_description.sim.world import MujocoWorld

G = 9.81
ARM = (ROOT / 'test' / 'fixtures' / 'urdf' / 'arm.urdf').read_text()
BALL = """<robot name="ball"><link name="ball">
  <inertial><mass value="1"/><inertia ixx="0.004" iyy="0.004" izz="0.004" ixy="0" ixz="0" iyz="0"/>
  </inertial>
  <collision><geometry><sphere radius="0.1"/></geometry></collision></link></robot>"""


@pytest.fixture
def world():
    return MujocoWorld('empty')


def test_a_thrown_ball_follows_its_parabola_and_turns_on(world):
    ball = world.spawn('ball', BALL, Transform((0.0, 0.0, 1.0)))
    turned = Transform((1.0, 2.0, 5.0), quaternion_from_rpy(0.3, -0.7, 2.0))
    velocity, spin = (1.0, -2.0, 3.0), (0.5, 4.0, -1.0)
    set_state(world.engine, ball, turned, velocity, spin)
    motion = motion_of(world.engine, ball)
    assert motion.linear_velocity == pytest.approx(velocity)
    assert motion.angular_velocity == pytest.approx(spin)
    assert pose_of(ball).rotation == pytest.approx(turned.rotation)
    world.step(250)
    motion = motion_of(world.engine, ball)
    assert motion.linear_velocity == pytest.approx((1.0, -2.0, 3.0 - G * 0.5), abs=1e-6)
    assert motion.angular_velocity == pytest.approx(spin, abs=1e-6)
    assert motion.linear_acceleration == pytest.approx((0.0, 0.0, -G), abs=1e-6)
    assert motion.angular_acceleration == pytest.approx((0.0, 0.0, 0.0), abs=1e-6)
    x, y, z = pose_of(ball).translation
    # The integrator's height is off by half a step's fall.
    assert (x, y, z) == pytest.approx((1.5, 1.0, 5.0 + 1.5 - G / 8), abs=0.01)


def test_at_rest_on_the_ground_nothing_accelerates(world):
    robot = world.spawn('amr', AMR, Transform((0.0, 0.0, 0.05)))
    world.step(1000)
    motion = motion_of(world.engine, robot)
    for vector in (motion.linear_velocity, motion.angular_velocity, motion.linear_acceleration):
        assert vector == pytest.approx((0.0, 0.0, 0.0), abs=1e-3)


def test_the_box_of_a_ball_is_its_diameter_in_any_frame(world):
    ball = world.spawn('ball', BALL, Transform((3.0, 0.0, 1.0)))
    in_world = bounds_of(world.engine, ball, Transform())
    assert in_world.lower == pytest.approx((2.9, -0.1, 0.9))
    assert in_world.upper == pytest.approx((3.1, 0.1, 1.1))
    own = bounds_of(world.engine, ball, pose_of(ball))
    assert own.lower == pytest.approx((-0.1, -0.1, -0.1))


def test_the_box_turns_with_the_frame_and_holds_the_robot(world):
    robot = world.spawn('amr', AMR, Transform((0.0, 0.0, 0.05)))
    before = bounds_of(world.engine, robot, pose_of(robot))
    quarter = Transform((5.0, -1.0, 0.05), quaternion_from_rpy(0.0, 0.0, math.pi / 2))
    set_state(world.engine, robot, quarter, (0.0, 0.0, 0.0), (0.0, 0.0, 0.0))
    after = bounds_of(world.engine, robot, pose_of(robot))
    assert after.lower == pytest.approx(before.lower, abs=1e-9)
    assert after.upper == pytest.approx(before.upper, abs=1e-9)
    in_world = bounds_of(world.engine, robot, Transform())
    assert in_world.upper[1] + 1.0 == pytest.approx(before.upper[0])
    assert in_world.lower[0] - 5.0 == pytest.approx(-before.upper[1])


def test_another_robot_counts_for_nothing(world):
    ball = world.spawn('ball', BALL, Transform((3.0, 0.0, 1.0)))
    alone = bounds_of(world.engine, ball, Transform())
    world.spawn('ball_2', BALL, Transform((9.0, 0.0, 1.0)))
    assert bounds_of(world.engine, ball, Transform()) == alone


def test_a_robot_without_shapes_has_no_box(world):
    bare = world.spawn('bare', BALL.replace('collision', 'gazebo'))
    assert bounds_of(world.engine, bare, Transform()) is None


def test_a_fixed_robot_rests_and_is_not_put_elsewhere(world):
    arm = world.spawn('arm', ARM)
    world.step(10)
    assert pose_of(arm) == Transform()
    assert motion_of(world.engine, arm).linear_acceleration == pytest.approx((0, 0, 0))
    with pytest.raises(SimulationError, match="'arm' stands fixed in the world: its root link is"):
        set_state(world.engine, arm, Transform(), (0.0, 0.0, 0.0), (0.0, 0.0, 0.0))


def test_time_may_be_set_and_the_rest_goes_on(world):
    ball = world.spawn('ball', BALL, Transform((0.0, 0.0, 5.0)))
    world.step(50)
    before = pose_of(ball)
    world.time = 0
    assert (world.time, pose_of(ball)) == (0, before)
    world.step(50)
    assert world.time == 100_000_000
    assert pose_of(ball).translation[2] < before.translation[2]
