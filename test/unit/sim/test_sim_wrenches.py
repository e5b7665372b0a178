# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""Wrenches from outside: what forces and torques do to a free ball, and when they end."""

import pytest

from amr_description.errors import SimulationError
from amr_description.model.frames import Transform
from amr_description.sim.entity_state import motion_of
from amr_description.sim.world import MujocoWorld
from amr_description.sim.wrenches import WorldWrench

MASS, INERTIA, STEP, G = 2.0, 0.05, 0.002, 9.81
BALL = """<robot name="ball"><link name="ball"><inertial>
  <origin xyz="{offset} 0 0"/><mass value="2"/>
  <inertia ixx="0.05" ixy="0" ixz="0" iyy="0.05" iyz="0" izz="0.05"/></inertial>
  <collision><geometry><sphere radius="0.1"/></geometry></collision></link></robot>"""
NONE = (0.0, 0.0, 0.0)


def world_with_ball(offset=0.0):
    world = MujocoWorld('empty')
    ball = world.spawn('ball', BALL.format(offset=offset), Transform((0.0, 0.0, 50.0)))
    return world, ball


def motion(world, ball):
    found = motion_of(world.engine, ball)
    return found.linear_velocity, found.angular_velocity


def test_a_push_lasts_one_physics_step():
    world, ball = world_with_ball()
    world.wrenches.push('ball', 'ball', WorldWrench((10.0, 0.0, 0.0), (0.0, 0.0, 1.0)))
    world.step(50)
    linear, angular = motion(world, ball)
    assert linear == pytest.approx((10.0 * STEP / MASS, 0.0, -G * 50 * STEP))
    assert angular == pytest.approx((0.0, 0.0, 1.0 * STEP / INERTIA))
    world.step(50)
    assert motion(world, ball)[0][0] == pytest.approx(10.0 * STEP / MASS)


def test_a_held_wrench_acts_until_it_is_cleared_and_the_latest_counts():
    world, ball = world_with_ball()
    hold = world.wrenches.hold
    hold('ball', 'ball', WorldWrench((99.0, 0.0, 0.0), NONE))
    hold('ball', 'ball', WorldWrench((0.0, 0.0, MASS * G), NONE))
    world.step(500)
    assert motion(world, ball)[0] == pytest.approx(NONE, abs=1e-9)
    world.wrenches.clear('ball', 'ball')
    world.step(10)
    assert motion(world, ball)[0] == pytest.approx((0.0, 0.0, -G * 10 * STEP))


def test_a_held_wrench_of_zeros_ends_the_one_before_and_costs_nothing():
    world, ball = world_with_ball()
    world.wrenches.hold('ball', 'ball', WorldWrench((99.0, 0.0, 0.0), NONE))
    world.wrenches.hold('ball', 'ball', WorldWrench(NONE, NONE))
    assert world.wrenches._lasting == {}
    world.step(10)
    assert motion(world, ball)[0] == pytest.approx((0.0, 0.0, -G * 10 * STEP))


def test_the_force_acts_on_the_origin_of_the_link_not_on_its_centre_of_mass():
    world, ball = world_with_ball(offset=0.2)
    world.wrenches.push('ball', 'ball', WorldWrench((0.0, 5.0, 0.0), NONE))
    world.step(1)
    _, angular = motion(world, ball)
    assert angular == pytest.approx((0.0, 0.0, -0.2 * 5.0 * STEP / INERTIA))


def test_pushes_of_one_step_add_up():
    world, ball = world_with_ball()
    for _ in range(3):
        world.wrenches.push('ball', 'ball', WorldWrench((2.0, 0.0, 0.0), NONE))
    world.step(1)
    assert motion(world, ball)[0][0] == pytest.approx(6.0 * STEP / MASS)


@pytest.mark.parametrize('end', [lambda world: world.reset(), lambda world: spawn_again(world)])
def test_wrenches_end_with_a_reset_and_with_the_robot(end):
    world, _ = world_with_ball()
    world.wrenches.hold('ball', 'ball', WorldWrench((50.0, 0.0, 0.0), NONE))
    world.step(5)
    world.wrenches.push('ball', 'ball', WorldWrench((50.0, 0.0, 0.0), NONE))
    end(world)
    world.step(5)
    assert motion(world, world.robot('ball'))[0][0] == 0.0


def test_a_robot_that_leaves_before_it_was_pushed_holds_nothing_up():
    world, _ = world_with_ball()
    world.wrenches.push('ball', 'ball', WorldWrench((50.0, 0.0, 0.0), NONE))
    world.remove('ball')
    world.step(5)
    assert world.time == round(5 * STEP * 1e9)


def spawn_again(world):
    world.remove('ball')
    world.spawn('ball', BALL.format(offset=0.0), Transform((0.0, 0.0, 50.0)))


def test_without_wrenches_a_world_goes_on_as_if_there_had_never_been_any():
    worlds = []
    for pushes in (False, True):
        world, _ = world_with_ball()
        if pushes:
            world.wrenches.hold('ball', 'ball', WorldWrench(NONE, NONE))
        world.step(20)
        world.wrenches.clear('ball')
        world.step(20)
        worlds.append(world.state())
    assert worlds[0] == worlds[1]


@pytest.mark.parametrize(
    ('robot', 'link', 'text'),
    [('nobody', 'ball', "no robot 'nobody'; there are: ball"), ('ball', 'arm', "no link 'arm'")],
)
def test_what_is_not_there_is_not_pushed(robot, link, text):
    world, _ = world_with_ball()
    with pytest.raises(SimulationError, match=text):
        world.wrenches.push(robot, link, WorldWrench(NONE, NONE))
    assert not world.wrenches
