# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""What ``<gazebo reference="…">`` says of links and joints, in the forms that robots have."""

import pytest

from amr_description.model.gazebo.physics import gazebo_physics_of, GazeboJoint, GazeboLink
from amr_description.model.urdf import parse

ROBOT = """<robot name="r"><link name="a"/><link name="b"/>
<joint name="j" type="continuous"><parent link="a"/><child link="b"/></joint>
{}
</robot>"""


def read(*blocks):
    return gazebo_physics_of(parse(ROBOT.format(''.join(blocks)), 'r.urdf'))


def link(inside, name='a'):
    return read(f'<gazebo reference="{name}">{inside}</gazebo>').links.get(name)


@pytest.mark.parametrize(
    'inside',
    [
        '<mu1>0.3</mu1>',
        '<mu1> 0.3 </mu1>',
        '<mu1 value="0.3"/>',
        '<mu>0.3</mu>',
        '<mu1>0.9</mu1><mu1>0.3</mu1>',
        '<collision><surface><friction><ode><mu>0.3</mu></ode></friction></surface></collision>',
    ],
)
def test_friction_in_all_its_forms(inside):
    assert link(inside) == GazeboLink(mu1=0.3)


def test_friction_of_a_roller():
    found = link('<mu1>1</mu1><mu2 value="0"/><fdir1>1 -1 0</fdir1>')
    assert (found.mu1, found.mu2, found.direction) == (1.0, 0.0, (1.0, -1.0, 0.0))
    inside = '<mu>1</mu><mu2>0</mu2><fdir1 xmlns:gz="g" gz:expressed_in="b">1 1 0</fdir1>'
    nested = f'<collision><surface><friction><ode>{inside}</ode></friction></surface></collision>'
    assert link(nested) == GazeboLink(1.0, 0.0, (1.0, 1.0, 0.0), 'b')


@pytest.mark.parametrize(
    'inside, self_collides, has_gravity',
    [
        ('<selfCollide>true</selfCollide>', True, True),
        ('<self_collide value="1"/>', True, True),
        ('<gravity>false</gravity>', False, False),
        ('<turnGravityOff>true</turnGravityOff>', False, False),
        ('<turnGravityOff>false</turnGravityOff>', False, True),
    ],
)
def test_self_collision_and_gravity(inside, self_collides, has_gravity):
    found = link(inside)
    assert (found.self_collides, found.has_gravity) == (self_collides, has_gravity)


def test_several_blocks_of_a_link_add_up():
    blocks = [
        f'<gazebo reference="a">{each}</gazebo>' for each in ('<mu1>1</mu1>', '<mu2>2</mu2>')
    ]
    assert read(*blocks).links == {'a': GazeboLink(mu1=1.0, mu2=2.0)}


def test_the_spring_of_a_joint():
    inside = '<springStiffness>450</springStiffness><springReference value="0.03"/>'
    found = read(f'<gazebo reference="j"><provideFeedback>1</provideFeedback>{inside}</gazebo>')
    assert found.joints == {'j': GazeboJoint(450.0, 0.03)}
    assert (found.solver, found.unknown) == ('', '')


def test_self_collision_of_the_whole_robot():
    assert read('<gazebo><self_collide>true</self_collide></gazebo>').self_collides
    assert not read('<gazebo><mu1>1</mu1></gazebo>').links


def test_a_value_that_is_none_is_one_line():
    found = read('<gazebo reference="a">\n<mu1>smooth</mu1><mu2>-1</mu2></gazebo>')
    assert found.links == {}
    smooth, negative = found.faults
    assert smooth == (
        'r.urdf:4: <mu1> of link "a" is "smooth"; a number from 0 on is needed, and it is left out'
    )
    assert '<mu2> of link "a" is "-1"' in negative


def test_what_is_for_the_solver_and_what_is_not_known_is_a_line_each():
    physics = '<kp>1e6</kp><kd>1</kd><minDepth>0</minDepth>'
    blocks = (f'<gazebo reference="{each}">{physics}<glow>1</glow></gazebo>' for each in 'ab')
    found = read(*blocks)
    assert found.solver.startswith('r.urdf: <kd> (2), <kp> (2), <minDepth> (2) of <gazebo> set')
    assert found.unknown == ('r.urdf: <glow> (2) of <gazebo> are not known here, and are left out')


def test_colours_and_blocks_of_nothing_say_nothing():
    found = read(
        '<gazebo reference="a"><material>Gazebo/Red</material></gazebo>',
        '<gazebo reference="nobody"><mu1>x</mu1><glow/></gazebo>',
    )
    assert (found.faults, found.solver, found.unknown) == ((), '', '')


def test_wheels_that_slip_in_proportion_to_the_force_are_known():
    surface = '<surface><friction><ode><slip1>{}</slip1></ode></friction></surface>'
    ode = f'<collision>{surface}</collision>'
    told = read(f'<gazebo reference="a">{ode.format(0.035)}</gazebo>')
    assert (told.slipping, told.unknown) == ({'a'}, '')
    assert not read(f'<gazebo reference="a">{ode.format(0)}</gazebo>').slipping


@pytest.mark.parametrize(
    ('plugin', 'wheel'),
    [
        (
            '<plugin filename="x" name="gz::sim::systems::WheelSlip">',
            '<wheel link_name="{}"><slip_compliance_lateral>{}</slip_compliance_lateral></wheel>',
        ),
        (
            '<plugin filename="libgazebo_ros_wheel_slip.so" name="slip">',
            '<wheel link_name="{}" lateral_slip_compliance="{}"/>',
        ),
    ],
    ids=['Gazebo', 'Classic'],
)
def test_wheels_of_the_plugin_wheel_slip_are_among_them(plugin, wheel):
    wheels = wheel.format('a', 1.0) + wheel.format('b', 0)
    assert read(f'<gazebo>{plugin}{wheels}</plugin></gazebo>').slipping == {'a'}
