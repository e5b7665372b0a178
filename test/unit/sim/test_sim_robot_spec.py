# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""What MuJoCo does not take as a URDF writes it, or says in its own way."""

import math
import warnings

from fixtures.sim.driving import AMR, Lines
import pytest

from amr_description.model.frames import Transform
from amr_description.sim.world import MujocoWorld
from amr_description.sim.world_file import WorldSettings

GRAVITY = 9.81
SOLID = (
    '<inertial><mass value="1"/>'
    '<inertia ixx="0.1" iyy="0.1" izz="0.1" ixy="0" ixz="0" iyz="0"/></inertial>'
)


def robot(inside, joint_type, root='base'):
    """A root, a link ``a`` that hangs on it and a link ``b`` on that."""
    return f"""<robot name="r"><link name="{root}"/><link name="a">{SOLID}</link>
      <link name="b">{SOLID}</link>
      <joint name="root_joint" type="fixed"><parent link="{root}"/><child link="a"/></joint>
      <joint name="j" type="{joint_type}"><origin xyz="1 0 0.5"/><parent link="a"/>
        <child link="b"/>{inside}</joint></robot>"""


@pytest.mark.parametrize('root', ['base', 'world'])
def test_a_floating_link_below_another_falls_by_itself(root):
    world = MujocoWorld('empty')
    view = world.spawn('r', robot('', 'floating', root), Transform((0.0, 0.0, 3.0)))
    assert view.pose('b').translation == pytest.approx((1.0, 0.0, 3.5))
    world.step(250)
    fallen = GRAVITY * 0.002**2 * 250 * 251 / 2
    stands = root == 'world'
    expected = 3.5 - fallen
    assert view.pose('b').translation == pytest.approx((1.0, 0.0, expected), abs=1e-9)
    assert view.pose('a').translation[2] == pytest.approx(3.0 - (0 if stands else fallen))


def test_a_floating_link_keeps_its_spin_and_goes_straight_on():
    world = MujocoWorld('empty', settings=WorldSettings(gravity=0.0))
    view = world.spawn('r', robot('', 'floating', 'world'), Transform((0.0, 0.0, 3.0)))
    data = world.engine.data
    data.joint('r/j/ball').qvel[:] = 0.0, 0.0, 2.0
    data.joint('r/j/y').qvel[:] = 0.3
    world.step(500)
    linear, angular = view.velocity('b')
    assert angular == pytest.approx((0.0, 0.0, 2.0), abs=1e-9)
    assert math.hypot(*linear) == pytest.approx(0.3, abs=1e-9)
    place = view.pose('b')
    assert place.translation == pytest.approx((1.0, 0.3, 3.5), abs=1e-9)


@pytest.mark.parametrize('place', [0.0, 0.3])
def test_a_joint_whose_limits_are_equal_stays_there(place, capfd):
    limit = f'<axis xyz="0 1 0"/><limit lower="{place}" upper="{place}" effort="9" velocity="1"/>'
    log = Lines()
    world = MujocoWorld('empty', log=log)
    view = world.spawn('r', robot(limit, 'revolute', 'world'), Transform((0.0, 0.0, 3.0)))
    world.step(1000)
    assert view.joints(['j']).positions() == pytest.approx([place], abs=2e-3)
    assert 'joint "j" cannot move' in log.text
    assert capfd.readouterr() == ('', '')


def test_a_warning_of_the_compiler_is_one_line_of_log(tmp_path):
    path = tmp_path / 'old.xml'
    path.write_text(
        '<mujoco><compiler settotalmass="3"/><worldbody><geom type="plane" size="0 0 1"/>'
        '<body pos="0 5 1"><freejoint/><geom size="0.1"/></body></worldbody></mujoco>'
    )
    log = Lines()
    with warnings.catch_warnings():
        warnings.simplefilter('error')
        world = MujocoWorld(str(path), log=log)
        (line,) = log.text.splitlines()
        assert line.startswith(f"WARN world '{path}': MuJoCo: compiler attribute 'settotalmass'")
        world.spawn('amr', AMR)
    assert log.text.splitlines() == [line]


LEGS = """<robot name="stool"><link name="seat"><inertial><mass value="2"/>
<inertia ixx="0.02" iyy="0.02" izz="0.02" ixy="0" ixz="0" iyz="0"/></inertial></link>{}</robot>"""
LEG = """<link name="leg{n}"><inertial><origin xyz="0 0 -0.15"/><mass value="0.2"/>
<inertia ixx="0.0015" iyy="0.0015" izz="0.0001" ixy="0" ixz="0" iyz="0"/></inertial>
<collision><origin xyz="0 0 -0.3"/><geometry><sphere radius="0.02"/></geometry></collision></link>
<joint name="hip{n}" type="revolute"><parent link="seat"/><child link="leg{n}"/>
<origin xyz="{x} {y} 0"/><axis xyz="0 1 0"/>
<limit lower="-1" upper="1" effort="{effort}" velocity="10"/></joint>"""


@pytest.mark.parametrize(('effort', 'stands'), [(20, True), (0, False)])
def test_a_robot_with_legs_that_nobody_commands_stands_on_its_motors(effort, stands):
    corners = [(x, y) for x in (-0.2, 0.2) for y in (-0.2, 0.2)]
    legs = (LEG.format(n=n, x=x, y=y, effort=effort) for n, (x, y) in enumerate(corners))
    world = MujocoWorld('empty')
    push = Transform.from_xyz_rpy((0.0, 0.0, 0.0), (0.0, 0.1, 0.0))
    stool = world.spawn('stool', LEGS.format(''.join(legs)), push, lift=True)
    world.step(1500)
    assert (stool.pose('seat').translation[2] > 0.3) is stands


def test_limits_in_the_wrong_order_and_numbers_too_many_are_spawned_as_taken():
    """MuJoCo itself refuses both."""
    world = MujocoWorld('empty')
    inside = '<limit lower="0.5" upper="-0.2" effort="1" velocity="1"/><axis xyz="0 0 1 0"/>'
    text = robot(inside, 'revolute', 'world')
    colour = '<material name="m"><color rgba="0.1 0.1 0.1 0 1"/></material>'
    visual = f'<visual><geometry><sphere radius="0.1"/></geometry>{colour}</visual>'
    text = text.replace(SOLID, SOLID + visual, 1)
    world.spawn('r', text, Transform((0.0, 0.0, 3.0)))
    assert world.engine.model.joint('r/j').range == pytest.approx((-0.2, 0.5))


def test_a_joint_that_mimics_nothing_is_spawned_free():
    world = MujocoWorld('empty')
    inside = '<mimic joint="nobody"/>'
    world.spawn('r', robot(inside, 'continuous', 'world'), Transform((0.0, 0.0, 3.0)))
    assert world.engine.model.neq == 0


def test_a_robot_that_touches_nothing_is_said_to_fall():
    lines = Lines()
    world = MujocoWorld('empty', log=lines)
    world.spawn('r', robot('', 'continuous'), Transform((0.0, 0.0, 3.0)))
    (line,) = [text for _, text in lines.lines if 'falls' in text]
    assert line.endswith('give its links a <collision>, or fix it to the world (fixed:=true)')
    lines.lines.clear()
    world.spawn('fixed', robot('', 'continuous', 'world'), Transform((0.0, 9.0, 3.0)))
    touching = robot('', 'continuous').replace(
        SOLID, f'{SOLID}<collision><geometry><sphere radius="0.1"/></geometry></collision>', 1
    )
    world.spawn('touching', touching, Transform((0.0, 18.0, 3.0)))
    assert not [text for _, text in lines.lines if 'falls' in text]
