# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""Worlds by name and by path."""

from fixtures.sim.driving import AMR, ROOT
import pytest

from amr_description.errors import DescriptionError, SimulationError
from amr_description.model.frames import Transform
from amr_description.sim.resources import (
    description_at,
    package_share,
    resolve_uri,
    shipped_worlds,
)
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


def test_unknown_world_is_told_with_the_shipped_ones(source_tree):
    with pytest.raises(SimulationError, match="world 'emty': neither .* shipped are: .*empty"):
        MujocoWorld('emty')


def test_uris(source_tree, tmp_path):
    assert package_share('amr_description') == ROOT
    assert resolve_uri('package://amr_description/urdf/amr.urdf') == ROOT / 'urdf' / 'amr.urdf'
    assert str(resolve_uri('file:///a%20b/c.stl')) == '/a b/c.stl'
    assert resolve_uri('meshes/c.stl', tmp_path) == tmp_path / 'meshes' / 'c.stl'
    assert str(resolve_uri('/meshes/c.stl', tmp_path)) == '/meshes/c.stl'
    with pytest.raises(SimulationError, match="scheme 'model' is not known"):
        resolve_uri('model://sun')


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
    assert text == (ROOT / 'urdf/amr.urdf').read_text()
    with pytest.raises(DescriptionError, match='takes no arguments'):
        description_at('package://amr_description/urdf/amr.urdf', {'x': '1'}, warn=said.append)
