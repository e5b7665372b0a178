# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""Worlds by name and by path."""

from fixtures.sim.driving import AMR, ROOT
import pytest

from amr_description.ament_index import package_share, resolve_uri, shipped_worlds
from amr_description.errors import DescriptionError, ResourceError, SimulationError
from amr_description.model.description_file import description_at
from amr_description.model.frames import Transform
from amr_description.model.origins import with_file
from amr_description.sim.world import MujocoWorld
from amr_description.sim.world_file import load_world

WHEELS = [f'joint_wheel_{end}_{side}' for end in ('front', 'back') for side in ('left', 'right')]


@pytest.fixture
def source_tree(monkeypatch):
    """No ROS environment: the package is used right from its repository."""
    monkeypatch.delenv('AMENT_PREFIX_PATH', raising=False)


def write(path, body):
    path.write_text(f'<mujoco>{body}</mujoco>')
    return str(path)


def test_every_shipped_world_loads(source_tree):
    worlds = shipped_worlds()
    assert 'empty' in worlds
    for name in worlds:
        MujocoWorld(name).step(10)


def test_options_that_a_world_sets_are_kept(tmp_path):
    path = write(tmp_path / 'moon.xml', '<option gravity="0 0 -1.62" impratio="7"/>')
    option = load_world(path).option
    assert list(option.gravity) == [0, 0, -1.62]
    assert option.impratio == 7
    # What it leaves out is ours.
    assert option.cone == load_world('empty').option.cone != 0


def test_friction_of_the_ground_is_that_of_the_world(tmp_path):
    # v = 0.5 m/s is lost over v² / (2 µ g), at least.
    ground = '<worldbody><geom type="plane" size="0 0 1" friction="0.1"/></worldbody>'
    world = MujocoWorld(write(tmp_path / 'ice.xml', ground))
    robot = world.spawn('amr', AMR)
    wheels = robot.joints(WHEELS)
    wheels.command('velocity', [5.0] * 4)
    world.step(1500)
    before = robot.pose('base_footprint').translation[0]
    wheels.command('velocity', [0.0] * 4)
    world.step(1000)
    braking = robot.pose('base_footprint').translation[0] - before
    assert braking == pytest.approx(0.5**2 / (2 * 0.1 * 9.81), rel=0.15)


@pytest.mark.parametrize(
    'surface',
    [
        '<geom type="box" size="5 5 0.5" pos="0 0 -0.5"/>',
        '<body pos="0 0 -0.5"><geom type="box" size="5 5 0.5"/></body>',
        '<geom type="plane" size="0 0 1"/>',
    ],
)
def test_wheels_drive_on_every_static_surface(tmp_path, surface):
    world = MujocoWorld(write(tmp_path / 'w.xml', f'<worldbody>{surface}</worldbody>'))
    robot = world.spawn('amr', AMR, Transform((0.0, 0.0, 0.01)))
    robot.joints(WHEELS).command('velocity', [-5.0, 5.0] * 2)
    world.step(1500)
    assert robot.pose('base_footprint').translation == pytest.approx((0, 0, 0), abs=1e-3)
    _, (_, _, yaw_rate) = robot.velocity('base_footprint')
    # As on the plane: 5 rad/s · 0.1 m / 0.15 m of wheels, times Coulomb's 0.36.
    assert yaw_rate == pytest.approx(5.0 * 0.1 / 0.15 * 0.36, rel=0.03)


@pytest.mark.parametrize(
    'body, frictions',
    [
        ('<worldbody><geom size="1"/><geom size="1" friction="1"/></worldbody>', [0.5, 1.0]),
        (
            '<default><default class="own"><geom friction="1"/></default></default>'
            '<worldbody><geom size="1" class="own"/><geom size="1"/></worldbody>',
            [1.0, 0.5],
        ),
        (
            '<default class="main"><geom friction="1 0.1"/></default>'
            '<worldbody><geom size="1"/></worldbody>',
            [1.0],
        ),
        (
            '<include file="part.xml"/><worldbody><geom size="1" friction="0.9"/></worldbody>',
            [0.5, 1.0, 0.9],
        ),
    ],
    ids=['geom', 'class', 'default', 'include'],
)
def test_only_geoms_without_a_friction_get_the_default(tmp_path, body, frictions):
    write(
        tmp_path / 'part.xml',
        '<worldbody><geom size="2"/><geom size="3" friction="1"/></worldbody>',
    )
    spec = load_world(write(tmp_path / 'world.xml', body))
    assert [geom.friction[0] for geom in spec.geoms] == frictions


GROUND = '<geom type="plane" size="0 0 1"/>'
BALL = '<body pos="3 0 1"><freejoint/><geom type="sphere" size="0.1"/></body>'
DOOR = """<body pos="4 0 0.5"><joint name="hinge"/><geom type="box" size="0.5 0.02 0.4"/></body>"""


@pytest.mark.parametrize(
    'body',
    [
        f'<worldbody>{GROUND}{BALL}</worldbody>'
        '<keyframe><key name="up" qpos="3 0 2 1 0 0 0"/></keyframe>',
        f'<worldbody>{GROUND}{DOOR}</worldbody>'
        '<actuator><position joint="hinge"/></actuator><sensor><jointpos joint="hinge"/></sensor>',
        f'<include file="part.xml"/><worldbody>{GROUND}</worldbody>',
        '<asset><mesh name="tile" file="tile.obj"/></asset>'
        '<worldbody><geom type="mesh" mesh="tile"/></worldbody>',
        '<asset><hfield name="flat" nrow="9" ncol="9" size="4 4 0.1 0.1"/></asset>'
        '<worldbody><geom type="hfield" hfield="flat"/></worldbody>',
        # What the world says about its own joints and shapes is not said about a robot's.
        '<compiler angle="radian"/><default><joint damping="100"/><geom contype="0"/></default>'
        '<worldbody><geom type="plane" size="0 0 1" contype="1"/></worldbody>',
    ],
    ids=['keyframe', 'mechanism', 'include', 'mesh', 'height field', 'defaults'],
)
def test_any_mjcf_is_driven_on(tmp_path, body):
    write(
        tmp_path / 'part.xml', '<worldbody><geom type="box" size="1 1 1" pos="0 9 0"/></worldbody>'
    )
    corners = [(x, y, z) for z in (0, -1) for y in (-4, 4) for x in (-4, 4)]
    vertices = ''.join(f'v {x} {y} {z}\n' for x, y, z in corners)
    (tmp_path / 'tile.obj').write_text(f'{vertices}f 1 2 4\nf 1 4 3\nf 5 6 8\nf 5 8 7\n')
    world = MujocoWorld(write(tmp_path / 'world.xml', body))
    robots = [
        world.spawn(name, AMR, Transform((0.0, y, 0.01))) for name, y in (('a', 0), ('b', 2))
    ]
    for _ in range(2):
        for robot in robots:
            robot.joints(WHEELS).command('velocity', [-5.0, 5.0] * 2)
        world.step(1500)
        for robot in robots:
            _, (_, _, yaw_rate) = robot.velocity('base_footprint')
            assert yaw_rate == pytest.approx(5.0 * 0.1 / 0.15 * 0.36, rel=0.03)
        world.reset()
    world.remove('a')
    world.step(10)


@pytest.mark.parametrize(
    'text, fault',
    [
        ('<mujoco><worldbody><geom type="ball"/></worldbody></mujoco>', "invalid keyword: 'ball'"),
        ('<mujoco><worldbody>', 'XML'),
        ('<mujoco><worldbody><body><freejoint/></body></worldbody></mujoco>', 'mass and inertia'),
    ],
)
def test_broken_world_is_one_line(tmp_path, text, fault):
    path = tmp_path / 'broken.xml'
    path.write_text(text)
    with pytest.raises(SimulationError, match=fault) as refusal:
        MujocoWorld(str(path))
    assert str(path) in str(refusal.value)
    assert '\n' not in str(refusal.value)


def test_an_unknown_world_is_reported_with_the_shipped_ones(source_tree):
    with pytest.raises(SimulationError, match="world 'emty': neither .* shipped are: .*empty"):
        MujocoWorld('emty')


def test_uris(source_tree, tmp_path):
    assert package_share('amr_description') == ROOT
    assert resolve_uri('package://amr_description/urdf/amr.urdf') == ROOT / 'urdf' / 'amr.urdf'
    assert str(resolve_uri('file:///a%20b/c.stl')) == '/a b/c.stl'
    assert resolve_uri('meshes/c.stl', tmp_path) == tmp_path / 'meshes' / 'c.stl'
    assert str(resolve_uri('/meshes/c.stl', tmp_path)) == '/meshes/c.stl'
    with pytest.raises(ResourceError, match="scheme 'robot' is not known"):
        resolve_uri('robot://sun')
    with pytest.raises(ResourceError, match="RESOURCE_PATH has it, and there is no package 'sun'"):
        resolve_uri('model://sun/a.stl')


def test_the_description_at_a_uri_is_expanded_with_its_arguments(source_tree, tmp_path):
    said = []
    path = tmp_path / 'cart.urdf.xacro'
    namespace = 'xmlns:xacro="http://www.ros.org/wiki/xacro"'
    body = '<xacro:arg name="x" default="1"/><xacro:arg name="y" default="2"/>'
    body += '<link name="$(arg x) $(arg y)"/>'
    path.write_text(f'<robot name="cart" {namespace}>{body}</robot>')
    assert '"1 2"' in description_at(f'file://{path}', warn=said.append)
    assert '"a b 3"' in description_at(f'file://{path}?x=a%20b&y=3', warn=said.append)
    assert '" 4"' in description_at(f'{path}?x=&y=3', {'y': '4'}, warn=said.append)
    assert said == []
    text = description_at('package://amr_description/urdf/amr.urdf', warn=said.append)
    assert text == with_file((ROOT / 'urdf/amr.urdf').read_text(), str(ROOT / 'urdf/amr.urdf'))
    with pytest.raises(DescriptionError, match='takes no arguments'):
        description_at('package://amr_description/urdf/amr.urdf', {'x': '1'}, warn=said.append)
