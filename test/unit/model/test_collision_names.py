# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""What Gazebo calls the collisions of a URDF, and which of them a sensor names."""

import pytest

from amr_description.model.collision_names import find_collisions, gazebo_name
from amr_description.model.urdf import parse

SHAPE = '<geometry><sphere radius="0.1"/></geometry>'
ROBOT = parse(
    f"""<robot name="r">
    <link name="base"><collision>{SHAPE}</collision><collision name="hood">{
        SHAPE
    }</collision></link>
    <link name="bumper"><collision>{SHAPE}</collision></link>
    <link name="sides"><collision name="left">{SHAPE}</collision>
      <collision name="right">{SHAPE}</collision></link><link name="frame"/>
    {
        ''.join(
            f'''<joint name="{name}" type="fixed"><parent link="base"/>
    <child link="{name}"/></joint>'''
            for name in ('bumper', 'sides', 'frame')
        )
    }</robot>""",
    'r.urdf',
)


@pytest.mark.parametrize(
    ('names', 'keys'),
    [
        ([], [('base', 0), ('base', 1)]),
        (['hood'], [('base', 1)]),
        (['base_collision'], [('base', 0)]),
        (['hood_collision_1'], [('base', 1)]),
        (['base_fixed_joint_lump__bumper_collision_2'], [('bumper', 0)]),
        (['base_fixed_joint_lump__right_collision_3', 'hood'], [('sides', 1), ('base', 1)]),
        (['left', 'left_collision'], [('sides', 0)]),
    ],
)
def test_collisions_are_found_by_the_names_of_the_urdf_and_of_gazebo(names, keys):
    assert find_collisions(ROBOT, 'base', names) == (tuple(keys), ())


def test_what_is_not_there_is_told():
    assert find_collisions(ROBOT, 'base', ['hat', 'hood']) == ((('base', 1),), ('hat',))
    assert find_collisions(ROBOT, 'frame', []) == ((), ())


def test_gazebo_calls_a_collision_by_its_name_or_its_link():
    base, sides = ROBOT.link('base'), ROBOT.link('sides')
    assert [gazebo_name(base, number) for number in (0, 1)] == [
        'base_collision',
        'hood_collision_1',
    ]
    assert gazebo_name(sides, 0) == 'left_collision'
    # Each finds itself.
    assert find_collisions(ROBOT, 'base', ['base_collision', 'hood_collision_1'])[0] == (
        ('base', 0),
        ('base', 1),
    )
