# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""Springs, gravity and self-collision of a URDF made for Gazebo, in the simulator."""

from fixtures.sim.driving import Lines
import pytest

from amr_description.model.frames import Transform
from amr_description.sim.world import MujocoWorld

BALL = """<inertial><mass value="2"/>
<inertia ixx="0.01" ixy="0" ixz="0" iyy="0.01" iyz="0" izz="0.01"/></inertial>
<collision><geometry><sphere radius="{}"/></geometry></collision>"""
LIFTS = """<robot name="r">
<link name="world"/><link name="a">{ball}</link><link name="b">{ball}</link>
<joint name="lift_a" type="prismatic"><parent link="world"/><child link="a"/><origin xyz="0 0 1"/>
<axis xyz="0 0 1"/><limit lower="-1" upper="1" effort="100" velocity="10"/>
<dynamics damping="20"/></joint>
<joint name="lift_b" type="prismatic"><parent link="world"/><child link="b"/>
<origin xyz="0 0 {height}"/>
<axis xyz="0 0 1"/><limit lower="-1" upper="1" effort="100" velocity="10"/>
<dynamics damping="20"/></joint>
{blocks}</robot>"""


def heights(blocks, height=2.0, radius=0.1, log=None):
    """Let both balls go; return how high they are after 4 s."""
    world = MujocoWorld('empty', log=log or Lines())
    urdf = LIFTS.format(ball=BALL.format(radius), height=height, blocks=blocks)
    robot = world.spawn('r', urdf, Transform())
    world.step(2000)
    return tuple(robot.pose(link).translation[2] for link in 'ab')


def block(reference, inside):
    return f'<gazebo reference="{reference}">{inside}</gazebo>'


def test_a_spring_holds_a_weight_at_its_closed_form():
    """Stiffness (q - reference) = -m g."""
    spring = '<springStiffness>100</springStiffness><springReference>0.1</springReference>'
    above, _ = heights(block('lift_a', spring))
    assert above == pytest.approx(1.0 + 0.1 - 2 * 9.81 / 100, abs=1e-3)


def test_a_link_without_gravity_stays_where_it_is():
    floating, fallen = heights(block('a', '<gravity>0</gravity>'))
    assert floating == pytest.approx(1.0, abs=1e-6)
    assert fallen < 1.01


def test_links_that_both_say_so_touch_each_other():
    collide = '<selfCollide>true</selfCollide>'
    held = block('a', f'<gravity>false</gravity>{collide}')
    spring = block('lift_a', '<springStiffness>1e5</springStiffness>')
    _, through = heights(held + spring, height=1.5)
    assert through == pytest.approx(0.5, abs=0.02)  # its own limit, 1 m below
    _, on_top = heights(held + spring + block('b', collide), height=1.5)
    assert on_top == pytest.approx(1.2, abs=0.01)


def test_links_that_are_in_each_other_at_the_start_never_touch_and_that_is_told():
    log = Lines()
    collide = '<selfCollide>true</selfCollide>'
    held = block('a', f'<gravity>false</gravity>{collide}') + block('b', collide)
    held += block('lift_a', '<springStiffness>1e5</springStiffness>')
    _, through = heights(held, height=1.1, log=log)
    assert through == pytest.approx(0.1, abs=0.02)
    assert 'do not touch: "a and b"' in log.text
