# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""Which entity of a world a robot is, and which robots of a world nobody describes."""

from fixtures.sim.driving import AMR
import pytest

from amr_description.viewer.entities import entity_of, SpawnedEntity, undescribed

BOX = '<robot name="amr"><link name="box"/></robot>'
MOVED = AMR.replace('name="amr"', 'name="other"', 1)
"""The same robot, its text another one: it is from a file with other paths."""


def spawned(*places, urdf=AMR):
    return [SpawnedEntity(name, namespace, urdf) for name, namespace in places]


@pytest.mark.parametrize(
    ('names', 'robot', 'expected'),
    [
        ([('amr', '/'), ('robot1', '/robot1')], '/robot1', 'robot1'),
        ([('amr', '/'), ('robot1', '/robot1')], '/', 'amr'),
        ([('robot1', '/robot2'), ('robot2', '/robot1')], '/robot1', 'robot2'),  # as Spawn may have
        ([('robot1', '/'), ('amr', '/robot1')], '/', 'robot1'),
        ([('amr', '/robot1')], '/', None),  # no other one moves in its place
        ([('amr', '/'), ('amr_1', '/')], '/', None),  # which of them is drawn, nobody knows
        ([], '/', None),
    ],
)
def test_an_entity_is_the_robot_of_its_namespace_whatever_the_names(names, robot, expected):
    assert entity_of(robot, AMR, spawned(*names)) == expected


def test_what_lies_about_in_a_robots_namespace_is_not_the_robot():
    world = [*spawned(('box', '/'), urdf=BOX), *spawned(('amr', '/'))]
    assert entity_of('/', AMR, world) == 'amr'
    assert entity_of('/', BOX, world) == 'box'
    assert entity_of('/', AMR, world[:1]) is None


def test_a_description_may_come_by_another_way():
    assert MOVED != AMR
    assert entity_of('/', MOVED, spawned(('amr', '/'))) == 'amr'
    both = [*spawned(('one', '/')), *spawned(('two', '/'), urdf=MOVED)]
    assert [entity_of('/', each, both) for each in (AMR, MOVED)] == ['one', 'two']


@pytest.mark.parametrize('urdf', [None, '', '<robot', '<robot name="a"/>'])
def test_a_robot_without_a_sound_description_is_none(urdf):
    assert entity_of('/', urdf, spawned(('amr', '/'))) is None


def test_a_robot_that_nobody_describes_is_found_by_its_namespace():
    world = spawned(('amr', '/'), ('two', '/robot2'), ('three', '/robot3'))
    found = undescribed(world, {'/robot3'})
    assert {name: each.name for name, each in found.items()} == {'/': 'amr', '/robot2': 'two'}


def test_what_cannot_be_told_apart_or_is_no_robot_is_not_described():
    boxes = spawned(('box', '/'), urdf=BOX)
    assert undescribed(boxes, ()) == {}
    assert list(undescribed([*boxes, *spawned(('amr', '/'))], ())) == ['/']
    assert list(undescribed(spawned(('crate', '/crate'), urdf=BOX), ())) == ['/crate']
    assert undescribed(spawned(('a', '/'), ('b', '/')), ()) == {}
