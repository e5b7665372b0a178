# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""What touches a robot, against Newton's laws."""

from fixtures.sim.driving import AMR
import pytest

from amr_description.model.frames import Transform
from amr_description.sim.contacts import ContactReader
from amr_description.sim.world import MujocoWorld

MASS, GRAVITY, PUSH = 10.0, 9.81, 80.0
WORLD = """<mujoco><worldbody>
    <geom name="floor" type="plane" size="20 20 1" friction="0.5"/>
    <body name="shelf" pos="2 0 0.5"><geom name="board" type="box" size="0.1 5 0.5"/></body>
    </worldbody></mujoco>"""
ROBOT = """<robot name="r"><link name="base">
      <inertial><mass value="10"/>
      <inertia ixx="1" iyy="1" izz="1" ixy="0" ixz="0" iyz="0"/></inertial>
      <visual><geometry><box size="9 0.4 0.2"/></geometry></visual>
      <collision><geometry><box size="0.6 0.4 0.2"/></geometry></collision>
      <collision name="mast"><origin xyz="0 0 0.3"/><geometry><box size="0.1 0.1 0.4"/></geometry>
      </collision></link>
    <link name="bumper"><visual><geometry><box size="0.02 0.4 0.1"/></geometry></visual>
      <collision><geometry><box size="0.02 0.4 0.1"/></geometry></collision></link>
    <joint name="front" type="fixed"><origin xyz="0.31 0 0"/>
      <parent link="base"/><child link="bumper"/></joint></robot>"""
"""Its visual is longer than it is, and touches nothing."""
BASE, BUMPER = [('base', 0)], [('bumper', 0)]


@pytest.fixture
def world(tmp_path):
    path = tmp_path / 'world.xml'
    path.write_text(WORLD)
    return MujocoWorld(str(path))


def spawn(world, name='r', x=0.0, y=0.0):
    return world.spawn(name, ROBOT, Transform((x, y, 0.1)))


def push(world, name, force):
    world.engine.data.xfrc_applied[world.engine.model.body(f'{name}/base').id][0] = force


def total(contacts):
    points = [point for contact in contacts for point in contact.points]
    return tuple(sum(point.force[axis] for point in points) for axis in range(3))


def test_the_ground_carries_the_weight_of_a_robot_that_rests(world):
    robot = spawn(world)
    world.step(500)
    (contact,) = ContactReader(world, robot, BASE).read()
    assert (contact.own, contact.other) == ('r::base::base_collision', 'floor::link::collision')
    assert total([contact]) == pytest.approx((0.0, 0.0, MASS * GRAVITY), rel=1e-3, abs=0.1)
    for point in contact.points:
        assert point.normal == pytest.approx((0.0, 0.0, 1.0))
        assert point.position[2] == pytest.approx(0.0, abs=1e-3)
        assert 0.0 <= point.depth < 1e-3
    assert ContactReader(world, robot, [*BUMPER, ('base', 1)]).read() == ()


def test_a_bumper_feels_what_it_is_pushed_against_and_nothing_before(world):
    robot = spawn(world, x=1.2)
    bumper, base = ContactReader(world, robot, BUMPER), ContactReader(world, robot, BASE)
    world.step(200)
    push(world, 'r', PUSH)
    felt = []
    for _ in range(1000):
        world.step()
        gap = 1.9 - (robot.pose('bumper').translation[0] + 0.01)
        felt.append(bool(bumper.read()))
        assert gap < 1e-3 or not felt[-1]
    (contact,) = bumper.read()
    assert not felt[0]
    assert (contact.own, contact.other) == ('r::bumper::bumper_collision', 'shelf::shelf::board')
    assert all(point.normal == pytest.approx((-1.0, 0.0, 0.0)) for point in contact.points)
    # It stands: all forces together are none.
    x, _, _ = (a + b for a, b in zip(total([contact]), total(base.read()), strict=True))
    assert x == pytest.approx(-PUSH, rel=1e-2)


def test_action_is_reaction_between_two_robots_also_after_others_have_come_and_gone(world):
    first = spawn(world, 'a', x=-0.1)
    mine = ContactReader(world, first, BUMPER)
    spawn(world, 'other', y=2.0)
    second = spawn(world, 'b', x=0.53)
    its = ContactReader(world, second, BASE)
    push(world, 'a', PUSH)
    world.step(500)
    world.remove('other')
    world.step(100)
    (contact,) = mine.read()
    assert (contact.own, contact.other) == (
        'a::bumper::bumper_collision',
        'b::base::base_collision',
    )
    (reaction,) = [each for each in its.read() if each.other == contact.own]
    assert total([contact]) == pytest.approx([-force for force in total([reaction])])
    assert (contact.own_id, contact.other_id) == (reaction.other_id, reaction.own_id)


def test_wheels_keep_their_collisions():
    world = MujocoWorld()
    robot = world.spawn('amr', AMR, Transform((0.0, 0.0, 0.2)))
    world.step(1000)
    wheels = [wheel.link for wheel in robot.wheels]
    loads = [total(ContactReader(world, robot, [(link, 0)]).read())[2] for link in wheels]
    assert loads == pytest.approx([7.0 * GRAVITY / 4] * 4, rel=1e-2)
