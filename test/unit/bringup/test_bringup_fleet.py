# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""The stack ``fleet``: several robots, the order of starts, and the parameters."""

from itertools import combinations
import math

from hypothesis import given, strategies as st
import pytest
from support.paths import ROOT

from amr_description.bringup.arguments import declared, resolve
from amr_description.bringup.scheduler import Scheduler
from amr_description.bringup.stacks.fleet import fleet, grid
from amr_description.errors import AmrError
from amr_description.model.shapes import horizontal_reach
from amr_description.model.urdf import load, parse

FILES = {
    'urdf': str(ROOT / 'urdf/amr.urdf'),
    'controllers': str(ROOT / 'config/controllers.yaml'),
}


def stack(**arguments):
    return fleet(**resolve(declared(fleet), FILES | arguments))


def of(nodes, executable):
    return [node for node in nodes if node.executable == executable]


def poses(nodes):
    """Name → (x, y), as the create of each says it."""
    words = [list(node.arguments) for node in of(nodes, 'create')]
    return {
        each[each.index('-name') + 1]: tuple(each[each.index(axis) + 1] for axis in ('-x', '-y'))
        for each in words
    }


def test_every_robot_has_nodes_of_its_own_in_its_namespace():
    nodes = stack(robots='3').nodes
    names = ['robot1', 'robot2', 'robot3']
    publishers = of(nodes, 'robot_state_publisher')[1:]
    assert [node.namespace for node in publishers] == names
    assert [node.parameters[0]['frame_prefix'] for node in publishers] == [f'{n}/' for n in names]
    for executable in ('create', 'spawner'):
        assert [node.namespace for node in of(nodes, executable)] == names
    assert list(poses(nodes)) == names
    assert len(of(nodes, 'mujoco_sim')) == 1


def test_it_is_recorded_to_a_new_folder(tmp_path):
    (simulator,) = of(stack(record=str(tmp_path / 'bag')).nodes, 'mujoco_sim')
    assert simulator.parameters[0]['record'] == str(tmp_path / 'bag')
    with pytest.raises(AmrError, match='^record:=.*: it is there already; another name will do'):
        stack(record=str(tmp_path))


def test_each_waits_for_its_own_robot_only():
    made = stack(robots='2')
    scheduler = Scheduler(made)
    for node in scheduler.startable():
        scheduler.on_start(node)
    first, second = of(made.nodes, 'create')
    for create, namespace in ((second, 'robot2'), (first, 'robot1')):
        scheduler.on_exit(create, 0)
        (spawner,) = scheduler.startable()
        assert spawner.namespace == namespace
        scheduler.on_start(spawner)
    one, other = of(made.nodes, 'spawner')
    scheduler.on_exit(other, 0)
    assert not scheduler.ready
    scheduler.on_exit(one, 0)
    assert scheduler.ready


@pytest.mark.parametrize('count', [1, 2, 3, 10, 20])
def test_no_two_robots_touch_however_they_turn(count):
    places = poses(stack(robots=str(count)).nodes)
    reach = horizontal_reach(load(ROOT / 'urdf/amr.urdf'))
    assert len(places) == count
    for one, other in combinations(places.values(), 2):
        assert math.dist(one, other) > 2.0 * reach


def test_the_odometry_of_each_robot_begins_where_it_is_spawned():
    nodes = stack(robots='4', spacing='3').nodes
    (of_all, *_) = of(nodes, 'robot_state_publisher')
    fixed = parse(of_all.parameters[0]['robot_description'], 'fleet')
    assert fixed.root.name == 'world'
    assert {joint.child: joint.origin.translation for joint in fixed.joints} == {
        f'{name}/odom': (x, y, 0.0) for name, (x, y) in poses(nodes).items()
    }


def test_the_next_steps_name_two_robots():
    text = stack(robots='3').next_steps
    assert '-r /cmd_vel:=/robot1/diff_drive_controller/cmd_vel' in text
    assert '/robot3/diff_drive_controller/cmd_vel geometry_msgs/msg/TwistStamped' in text


@pytest.mark.parametrize(
    ('given', 'text'),
    [
        ({'robots': '0'}, 'robots:=0: a fleet has 1 robot or more'),
        ({'rtf': '-1'}, 'rtf:=-1.0: a real-time factor is 0'),
        ({'spacing': '-1'}, 'spacing:=-1.0: a distance is 0'),
        ({'spacing': '0.5'}, r'spacing:=0.5: the robots would touch; they need more than \d'),
        ({'urdf': 'no.urdf'}, 'urdf:=no.urdf: no such file: /'),
    ],
)
def test_bad_arguments_are_reported_before_anything_starts(given, text):
    with pytest.raises(AmrError, match=text):
        stack(**given)


@given(st.integers(1, 60), st.floats(0.1, 10.0))
def test_positions_keep_their_distance_and_are_centred_on_the_origin(count, spacing):
    positions = list(grid(count, spacing))
    assert len(positions) == count
    for one, other in combinations(positions, 2):
        assert math.dist(one, other) >= spacing * (1.0 - 1e-9)
    for axis in range(2):
        along = [position[axis] for position in positions]
        assert min(along) == pytest.approx(-max(along))
        assert max(along) <= spacing * math.sqrt(count) / 2.0
