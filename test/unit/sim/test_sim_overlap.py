# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""A robot that would be spawned inside something is rejected, with the height to spawn at."""

import re

from fixtures.sim.arm import ARM
from fixtures.sim.driving import AMR, LEFT, RIGHT
import pytest

from amr_description.errors import SpawnError
from amr_description.model.frames import Transform
from amr_description.sim.entity_state import set_state
from amr_description.sim.overlap import deepest_overlap, TOLERANCE
from amr_description.sim.spawning import SpawnCode
from amr_description.sim.world import MujocoWorld

# Boxes 0.2 m and 0.02 m high, a ramp of 20 degrees, and a carton that could be pushed.
THINGS = """
<mujoco><worldbody>
  <geom name="ground" type="plane" size="0 0 1"/>
  <geom name="table" type="box" size="1 1 0.1" pos="5 0 0.1"/>
  <geom name="ramp" type="box" size="2 1 0.5" pos="0 5 0" euler="0 -20 0"/>
  <body name="carton" pos="0 -5 0.3">
    <freejoint/><geom type="box" size="0.3 0.3 0.3" mass="2"/>
  </body>
</worldbody></mujoco>
"""
FIST = '<collision><geometry><sphere radius="0.1"/></geometry></collision>'
"""At the end of the lower link of the arm, whose shoulder is 1 m above the origin."""


def at(x, y, z):
    return Transform((x, y, z))


@pytest.fixture
def things(tmp_path):
    path = tmp_path / 'things.xml'
    path.write_text(THINGS)
    return str(path)


@pytest.fixture
def world(things):
    return MujocoWorld(things)


@pytest.mark.parametrize(
    'place, other, depth',
    [
        (at(0, 0, -0.1), "'ground' of the world", 0.1),
        (at(0, 0, -3.0), "'ground' of the world", 3.0),
        (at(5, 0, 0.15), "'table' of the world", 0.05),
        (at(0, 5, 0.4), "'ramp' of the world", None),
        (at(0, -5.2, 0.0), "'carton' of the world", None),
    ],
)
def test_inside_the_world(world, place, other, depth):
    with pytest.raises(SpawnError, match=re.escape(f'spawned inside {other}')) as refusal:
        world.spawn('amr', AMR, place)
    assert refusal.value.code == SpawnCode.INVALID_POSE
    told = str(refusal.value)
    if depth is not None:
        assert f'is {depth:.3f} m deep in it' in told
    # What it says will do, does; and half of it does not.
    lift = float(re.search(r'raise z by (\d+\.\d+) m', told)[1])
    x, y, z = place.translation
    with pytest.raises(SpawnError, match='spawned inside'):
        world.spawn('amr', AMR, at(x, y, z + lift / 2))
    world.spawn('amr', AMR, at(x, y, z + lift))
    assert world.names == ('amr',)


def test_inside_another_robot_names_both_links(world):
    world.spawn('first', AMR)
    with pytest.raises(SpawnError, match="link '.*' of robot 'first': its link '.*' is 0") as told:
        world.spawn('second', AMR, at(0.3, 0.0, 0.0))
    assert 'raise z' not in str(told.value) and 'spawn it elsewhere' in str(told.value)
    assert world.names == ('first',)
    world.spawn('second', AMR, at(1.0, 0.0, 0.0))


def test_a_refusal_leaves_the_others_as_they_are(world, things):
    alone = MujocoWorld(things)
    for each in (world, alone):
        robot = each.spawn('amr', AMR)
        robot.joints([*LEFT, *RIGHT]).command('velocity', [5.0, 5.0, 3.0, 3.0])
        each.step(50)
    with pytest.raises(SpawnError, match='spawned inside'):
        world.spawn('other', AMR, at(0.1, 0.0, 0.0))
    for each in (world, alone):
        each.step(50)
    assert world.time == alone.time
    seen, expected = (each.robot('amr').pose('base_footprint') for each in (world, alone))
    assert seen == expected


@pytest.mark.parametrize('depth, is_taken', [(0.9 * TOLERANCE, True), (1.1 * TOLERANCE, False)])
def test_a_small_overlap_is_accepted(world, depth, is_taken):
    if is_taken:
        world.spawn('amr', AMR, at(0.0, 0.0, -depth))
        return
    with pytest.raises(SpawnError, match='deep in it; raise z by 0.002 m, or spawn it elsewhere'):
        world.spawn('amr', AMR, at(0.0, 0.0, -depth))


def test_a_standing_robot_whose_hand_is_in_the_ground(world):
    armed = ARM.replace('<link name="fore">', f'<link name="fore">{FIST}')
    pose = Transform.from_xyz_rpy((0.0, 0.0, -1.0), (0.0, 0.0, 0.0))
    with pytest.raises(SpawnError, match="its link 'fore' is 0.100 m deep in it; raise z by 0.1"):
        world.spawn('arm', armed, pose)
    world.spawn('arm', armed, at(0.0, 0.0, -0.9))


def test_a_base_that_stands_fixed_may_go_into_the_ground(world):
    foot = '<link name="base"><collision><geometry><box size="1 1 1"/></geometry></collision>'
    buried = ARM.replace('<link name="base"/>', f'{foot}</link>')
    world.spawn('arm', buried, at(0.0, 0.0, -0.9))


@pytest.mark.parametrize(
    ('place', 'height'), [(at(0, 0, -0.1), 0.0), (at(5, 0, 0.15), 0.2), (at(-2, 0, 0.3), 0.3)]
)
def test_a_robot_that_may_be_lifted_stands_on_what_it_was_in(things, place, height):
    said = []
    world = MujocoWorld(things, log=lambda severity, text, **_: said.append(text))
    robot = world.spawn('amr', AMR, place, lift=True)
    assert robot.pose('base_footprint').translation[2] == pytest.approx(height, abs=TOLERANCE)
    lifted = height - place.translation[2]
    assert said == (
        []
        if lifted < TOLERANCE
        else [f"'amr' is lifted by {lifted:.3f} m: {said[0].partition(': ')[2]}"]
    )
    world.step(5)
    world.reset()
    assert robot.pose('base_footprint').translation[2] == pytest.approx(height, abs=TOLERANCE)


def test_a_robot_that_is_put_inside_something_is_told_so(world):
    robot = world.spawn('amr', AMR)
    set_state(world.engine, robot, at(5, 0, 0.15), (0, 0, 0), (0, 0, 0))
    found = deepest_overlap(world.engine, 'amr')
    assert found.warning('amr') == (
        f"'amr' was put inside 'table' of the world: its link '{found.link}' is 0.050 m deep in "
        'it, and will be thrown out'
    )
    set_state(world.engine, robot, at(2, 0, 0), (0, 0, 0), (0, 0, 0))
    assert deepest_overlap(world.engine, 'amr') is None


def test_no_robot_is_lifted_out_of_another(world):
    world.spawn('one', AMR)
    with pytest.raises(SpawnError, match='spawned inside link .* of robot .*; spawn it elsewhere'):
        world.spawn('two', AMR, lift=True)


@pytest.mark.parametrize(
    ('root', 'place', 'height'),
    [
        (0.059, at(0, 0, 0), -0.059),  # m; the root link below the wheels
        (0.0015, at(0, 0, 0), 0.0),  # as it is accepted inside something
        (0.059, at(0, 0, 0.01), 0.01),  # a height that is asked for
        (1.5, at(0, 0, 0), 0.0),  # that flies
        (0.7, at(0, -5.2, 0), -0.1),  # onto the carton, which is 0.6 m high
    ],
)
def test_a_robot_without_a_height_is_put_onto_what_is_below_it(things, root, place, height):
    said = []
    world = MujocoWorld(things, log=lambda severity, text, **_: said.append(text))
    raised = (
        '<robot name="raised"><link name="root"/><joint name="lift" type="fixed">'
        f'<parent link="root"/><child link="box"/><origin xyz="0 0 {root + 0.1}"/></joint>'
        '<link name="box"><inertial><mass value="1"/>'
        '<inertia ixx="0.01" iyy="0.01" izz="0.01" ixy="0" ixz="0" iyz="0"/></inertial>'
        '<collision><geometry><box size="0.2 0.2 0.2"/></geometry></collision></link></robot>'
    )
    robot = world.spawn('raised', raised, place, lift=True)
    lowest = robot.pose('root').translation[2]
    assert lowest == pytest.approx(height, abs=1e-5)
    lowered = place.translation[2] - lowest
    expected = [f"'raised' is put {lowered:.3f} m lower, where it stands: at z = 0 it would drop"]
    assert said == (expected if lowered > TOLERANCE else [])
    world.reset()
    assert robot.pose('root').translation[2] == lowest


def test_a_robot_that_is_put_elsewhere_keeps_its_meshes_and_leaves_the_others(world, things):
    """Bit by bit as one that was spawned at that height; what moves goes on as it did."""
    alone = MujocoWorld(things)
    for each, height in ((world, -0.1), (alone, 0.0)):
        first = each.spawn('first', AMR, at(2.0, 2.0, 0.0))
        first.joints([*LEFT, *RIGHT]).command('velocity', [5.0, 5.0, 3.0, 3.0])
        each.step(50)
        each.spawn('second', AMR, at(0.0, 0.0, height), lift=True)
    lifted = world.robot('second').pose('base_footprint').translation[2]
    assert lifted == pytest.approx(0.0, abs=TOLERANCE)
    assert world.robot('second').spawn_pose.translation[2] == lifted
    for each in (world, alone):
        each.step(50)
    first, expected = (each.robot('first').pose('base_footprint') for each in (world, alone))
    assert first == expected
