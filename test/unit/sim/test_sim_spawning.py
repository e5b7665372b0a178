# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""What may be spawned; every refusal has simulation_interfaces' code and one clear line."""

import math
import re
import struct

from fixtures.sim.driving import AMR, Lines, ROOT
import mujoco
import pytest

from amr_description.errors import SpawnError
from amr_description.model.frames import Transform
from amr_description.sim.spawning import checked_pose, free_name, read_description, SpawnCode
from amr_description.sim.world import MujocoWorld

TUTORIAL = (ROOT / 'test' / 'fixtures' / 'tutorial' / 'amr.urdf').read_text()
BOX = '<geometry><box size="0.5 0.3 0.1"/></geometry>'


@pytest.fixture
def world():
    world = MujocoWorld('empty', strict=True, log=Lines())
    world.spawn('first', AMR)
    return world


def without_inertial_of_the_first_wheel(urdf):
    start = urdf.index('<inertial>', urdf.index('<link name="wheel_front_left">'))
    end = urdf.index('</inertial>', start) + len('</inertial>')
    return urdf[:start] + urdf[end:]


@pytest.mark.parametrize(
    'name, urdf, pose, code, text',
    [
        ('first', AMR, Transform(), 101, "already an entity 'first'"),
        ('', AMR, Transform(), 102, "'' cannot name an entity: letters"),
        ('a robot', AMR, Transform(), 102, "'a robot' cannot name an entity"),
        ('a/b', AMR, Transform(), 102, "'a/b' cannot name an entity"),
        ('x', '<sdf version="1.9"/>', Transform(), 103, 'x: the description is SDF; .* -topic r'),
        ('x', '<mujoco/>', Transform(), 103, 'x: the description is MJCF'),
        ('x', ' \n', Transform(), 104, 'no robot description'),
        ('x', AMR[: len(AMR) // 2], Transform(), 106, 'x:[0-9]+: not well-formed XML'),
        ('x', '<html/>', Transform(), 106, 'x:1: this is no URDF'),
        (
            'x',
            AMR.replace('<parent link="base_link"/>', '<parent link="chassis"/>', 1),
            Transform(),
            106,
            'parent link is not defined: found "chassis"',
        ),
        (
            'x',
            without_inertial_of_the_first_wheel(AMR),
            Transform(),
            106,
            'link "wheel_front_left".*inertial',
        ),
        (
            'x',
            '<robot name="x"><link name="base"/></robot>',
            Transform(),
            106,
            'x: no link has mass, so nothing can move the robot; add <inertial>',
        ),
        ('x', AMR, Transform((0, 0, math.nan)), 109, r'pose is position \(0, 0, nan\)'),
        ('x', AMR, Transform((0, 0, 0), (0, 0, 0, 0)), 109, 'quaternion of length 1'),
    ],
)
def test_refusals(world, name, urdf, pose, code, text):
    with pytest.raises(SpawnError, match=text) as refusal:
        world.spawn(name, urdf, pose)
    assert refusal.value.code == code
    assert '\n' not in str(refusal.value)
    assert world.names == ('first',)


def test_source_is_named_in_messages():
    with pytest.raises(SpawnError, match='^/robot_description:1: this is no URDF'):
        read_description('<html/>', '/robot_description')


def test_warnings_of_the_checker_are_logged():
    log = Lines()
    MujocoWorld('empty', log=log).spawn('tutorial', TUTORIAL)
    assert 'WARN tutorial:' in log.text
    assert 'drives the robot backwards' in log.text


def block_of(part):
    return f'<gazebo reference="{part}"/>'


def told_of(extra):
    """Return the lines about our robot with more in its description."""
    log = Lines()
    read_description(AMR.replace('</robot>', f'{extra}</robot>'), 'amr.urdf', log)
    return log.text.splitlines()


def test_a_warning_that_is_alone_is_told_in_full():
    (line,) = told_of(block_of('part'))
    assert 'amr.urdf:' in line and 'expected a link or a joint' in line


def test_many_warnings_are_one_line_that_names_each_kind_and_the_checker():
    (line,) = told_of(''.join(map(block_of, 'abcd')) + '<wheel/><wheel/><foot/>')
    assert line.startswith('WARN amr.urdf: 7 warnings, which check_urdf lists in full: ')
    what = '<gazebo> refers to what is not there, and is ignored: found "a" (and 3 more like it)'
    assert what in line
    assert '"<wheel>" in URDF: it is ignored (and 2 more like it)' in line


def test_what_is_made_of_a_fault_is_a_line_each_before_that():
    pins = ''.join(
        f'<link name="pin_{number}"/><joint name="turns_{number}" type="continuous">'
        f'<parent link="base_link"/><child link="pin_{number}"/></joint>'
        for number in range(4)
    )
    *taken, others = told_of(pins + block_of('a') + block_of('b'))
    assert [f'"pin_{number}"' in line for number, line in enumerate(taken)] == [True] * 4
    assert all('it is given 0.001 kg' in line for line in taken)
    assert '2 warnings, which check_urdf lists in full' in others


def test_free_name():
    assert free_name('amr', ()) == 'amr'
    assert free_name('amr', ('amr',)) == 'amr_1'
    assert free_name('amr', ('amr', 'amr_1', 'amr_3')) == 'amr_2'


def test_quaternion_of_any_length_is_taken_a_direction():
    pose = checked_pose(Transform((1.0, 2.0, 3.0), (0.0, 0.0, 0.0, 2.0)))
    assert pose == Transform((1.0, 2.0, 3.0))


@pytest.mark.parametrize('x', [float('nan'), float('inf'), 1e300])
def test_a_pose_that_physics_cannot_hold_is_refused(x):
    with pytest.raises(SpawnError, match='finite numbers, up to 1e'):
        checked_pose(Transform((x, 0.0, 0.0)))


def test_tutorial_robot_drives_backwards_as_its_text_says(world):
    robot = world.spawn('tutorial', TUTORIAL, Transform((0.0, 3.0, 0.0)))
    wheels = [joint.name for joint in robot.description.joints if joint.has_position]
    robot.joints(wheels).command('velocity', [5.0] * 4)
    world.step(500)
    assert robot.pose('base_footprint').translation[0] == pytest.approx(-0.49, abs=0.01)


# --- meshes --------------------------------------------------------------------------------------


def binary_stl():
    """A tetrahedron about the origin, 0.1 m high."""
    h = 0.05
    a, b, c, d = (h, h, h), (h, -h, -h), (-h, h, -h), (-h, -h, h)
    faces = [(a, b, c), (a, d, b), (a, c, d), (b, d, c)]
    body = b''.join(
        struct.pack('<12fH', 0, 0, 0, *(x for corner in face for x in corner), 0) for face in faces
    )
    return bytes(80) + struct.pack('<I', len(faces)) + body


@pytest.fixture
def package(tmp_path, monkeypatch):
    """A ROS package ``my_robot`` with ``meshes/chassis.stl``."""
    marker = tmp_path / 'share' / 'ament_index' / 'resource_index' / 'packages' / 'my_robot'
    marker.parent.mkdir(parents=True)
    marker.touch()
    meshes = tmp_path / 'share' / 'my_robot' / 'meshes'
    meshes.mkdir(parents=True)
    (meshes / 'chassis.stl').write_bytes(binary_stl())
    (meshes / 'chassis.dae').write_text('<COLLADA/>')
    (meshes / 'chassis.fbx').write_text('')
    monkeypatch.setenv('AMENT_PREFIX_PATH', str(tmp_path))
    return meshes.parent


def with_meshes(visual, collision):
    mesh = '<geometry><mesh filename="{}"/></geometry>'
    head, first, second, *tail = AMR.split(BOX)
    assert not tail
    return head + mesh.format(visual) + first + mesh.format(collision) + second


def test_meshes_are_found_in_packages_and_files(package):
    log = Lines()
    mesh = 'meshes/chassis.stl'
    urdf = with_meshes(f'package://my_robot/{mesh}', f'file://{package}/{mesh}')
    world = MujocoWorld('empty', log=log)
    world.spawn('amr', urdf, Transform((0.0, 0.0, 0.05)))
    world.spawn('another', urdf, Transform((0.0, 3.0, 0.05)))
    world.step(500)
    assert world.robot('amr').pose('base_link').translation[2] == pytest.approx(0.1, abs=1e-3)
    assert log.lines == []


def test_mesh_beside_the_description(package):
    source = package / 'robot.urdf'
    source.touch()
    urdf = with_meshes('meshes/chassis.stl', 'meshes/chassis.stl')
    MujocoWorld('empty').spawn('amr', read_description(urdf, str(source)))


@pytest.mark.parametrize(
    'uri, code, text',
    [
        ('package://nobodys/x.stl', 107, "package 'nobodys' is not found in AMENT_PREFIX_PATH"),
        ('package://my_robot/x.stl', 107, 'no file package://my_robot/x.stl, which is /.*/x.stl'),
        ('file:///nowhere/x.stl', 107, 'there is no file file:///nowhere/x.stl'),
        ('http://example.org/x.stl', 107, "scheme 'http' is not known"),
        ('package://my_robot/meshes/chassis.dae', 108, '/chassis.dae: (there is|it cannot be)'),
        ('package://my_robot/meshes/chassis.fbx', 108, r'reads .stl, .*, .msh, not .fbx'),
    ],
)
def test_mesh_that_cannot_be_had_is_refused_when_strict(package, uri, code, text):
    log = Lines()
    world = MujocoWorld('empty', strict=True, log=log)
    good = 'package://my_robot/meshes/chassis.stl'
    with pytest.raises(SpawnError, match=text) as refusal:
        world.spawn('amr', with_meshes(good, uri))
    assert refusal.value.code == code
    assert 'amr:' in str(refusal.value) and 'collision of link "base_link"' in str(refusal.value)
    # Physics can do without a visual.
    world.spawn('amr', with_meshes(uri, good))
    assert 'visual of link "base_link"' in log.text and 'it is not drawn' in log.text


def collision_geoms(world):
    """The geoms of the chassis that touch, by their type."""
    body = world.engine.spec.body('amr/base_link')
    return [geom.type for geom in body.geoms if geom.contype]


def test_a_collision_whose_mesh_is_missing_takes_the_shape_of_its_visual(package):
    log = Lines()
    world = MujocoWorld('empty', log=log)
    good = 'package://my_robot/meshes/chassis.stl'
    world.spawn('amr', with_meshes(good, 'package://my_robot/meshes/gone.stl'))
    assert collision_geoms(world) == [mujoco.mjtGeom.mjGEOM_MESH]
    (line,) = log.text.splitlines()
    assert 'mesh of a collision of link "base_link": there is no file' in line
    assert line.endswith('; the shape of its visual is taken')


def test_a_collision_without_any_mesh_is_left_out_and_the_visuals_are_told_in_one_line(package):
    log = Lines()
    world = MujocoWorld('empty', log=log)
    gone = 'package://my_robot/meshes/gone.stl'
    visual = f'<visual><geometry><mesh filename="{gone}"/></geometry></visual>'
    world.spawn('amr', with_meshes(gone, gone).replace('<visual>', f'{visual}<visual>', 1))
    assert collision_geoms(world) == []
    collision, visuals = log.text.splitlines()
    assert 'collision of link "base_link"' in collision and collision.endswith('; it is left out')
    assert 'visual of link "base_link"' in visuals
    assert visuals.endswith('; it is not drawn in the simulation, nor are 1 others')


def test_of_two_meshes_in_one_geometry_the_first_counts(package):
    mesh = '<mesh filename="package://my_robot/meshes/chassis.stl"/>'
    world = MujocoWorld('empty')
    both = f'<geometry>{mesh}{mesh.replace("chassis", "gone")}</geometry>'
    world.spawn('amr', AMR.replace(BOX, both))
    assert collision_geoms(world) == [mujoco.mjtGeom.mjGEOM_MESH]


def test_shapes_without_a_volume_are_left_out():
    world = MujocoWorld('empty')
    world.spawn('amr', AMR.replace(BOX, '<geometry><box size="0.5 0 0.1"/></geometry>'))
    assert collision_geoms(world) == []


def test_a_negative_limit_of_effort_is_none():
    """MuJoCo would take its amount."""
    limit = '<axis xyz="0 0 -1"/><limit effort="-1" velocity="-1"/>'
    world = MujocoWorld('empty')
    world.spawn('amr', AMR.replace('<axis xyz="0 0 -1"/>', limit))
    assert not world.engine.model.jnt_actfrclimited.any()


def test_a_robot_without_any_mass_is_spawned_and_each_link_is_told():
    log = Lines()
    world = MujocoWorld('empty', log=log)
    cart = re.sub('(?s)<inertial>.*?</inertial>', '', AMR)
    world.spawn('amr', cart, Transform((0.0, 0.0, 0.05)))
    world.step(1000)
    assert world.robot('amr').pose('base_link').translation[2] == pytest.approx(0.1, abs=2e-3)
    assert log.text.count('; it is given 0.001 kg') == 5


def test_what_has_no_inertial_weighs_nothing_beside_what_has():
    """MuJoCo would take the mass of water in the collision shape."""
    start, end = AMR.index('<inertial>'), AMR.index('</inertial>') + len('</inertial>')
    own = f'<link name="weight">{AMR[start:end]}</link><joint name="w" type="fixed">'
    own += '<parent link="base_link"/><child link="weight"/></joint></robot>'
    world = MujocoWorld('empty')
    world.spawn('amr', (AMR[:start] + AMR[end:]).replace('</robot>', own))
    assert world.engine.model.body_mass.sum() == pytest.approx(7.0)


def test_codes_are_those_of_simulation_interfaces():
    names = [code.name for code in SpawnCode if code > 100]
    assert names == [
        'NAME_NOT_UNIQUE',
        'NAME_INVALID',
        'UNSUPPORTED_FORMAT',
        'NO_RESOURCE',
        'NAMESPACE_INVALID',
        'RESOURCE_PARSE_ERROR',
        'MISSING_ASSETS',
        'UNSUPPORTED_ASSETS',
        'INVALID_POSE',
    ]
    assert [int(code) for code in SpawnCode if code > 100] == list(range(101, 110))


TWICE = """<robot name="box"><link name="base">
<visual><geometry><box size=".2 .2 .2"/></geometry><material name="a"><color rgba="1 0 0 1"/>
</material><material name="b"><color rgba="0 1 0 1"/></material></visual>
<collision><geometry><box size=".2 .2 .2"/></geometry><geometry><sphere radius="1"/></geometry>
</collision><inertial><mass value="1"/><mass value="2"/>{moments}{moments}</inertial>
<inertial><mass value="5"/>{moments}</inertial></link>
<link name="arm"><inertial><mass value="1"/>{moments}</inertial></link>
<joint name="j" type="revolute"><parent link="base"/><child link="arm"/>
<origin xyz="0 0 .2"/><origin xyz="0 0 .4"/><axis xyz="0 0 1"/><axis xyz="0 1 0"/>
<limit lower="-1" upper="1" effort="1" velocity="1"/><limit lower="-2" upper="2" effort="1"
velocity="1"/><dynamics damping="1"/><dynamics damping="2"/></joint></robot>"""


def test_what_the_checker_says_is_ignored_is_ignored():
    """All that stands twice where one is enough: MuJoCo refuses most of it."""
    moments = '<inertia ixx=".01" iyy=".01" izz=".01" ixy="0" ixz="0" iyz="0"/>'
    world = MujocoWorld('empty')
    world.spawn('box', TWICE.format(moments=moments), Transform((0.0, 0.0, 0.1)))
    model = world.engine.model
    assert model.body('box/base').mass[0] == 1.0
    assert model.joint('box/j').axis.tolist() == [0.0, 0.0, 1.0]
    assert model.body('box/arm').pos.tolist() == [0.0, 0.0, 0.2]
    assert model.joint('box/j').range.tolist() == [-1.0, 1.0]
    world.step(100)
    assert world.robot('box').pose('base').translation[2] == pytest.approx(0.1, abs=1e-3)
