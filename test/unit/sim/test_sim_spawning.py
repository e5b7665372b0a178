# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""What may be spawned; every refusal has simulation_interfaces' code and one clear line."""

import math
import struct

from fixtures.sim.driving import AMR, Lines, ROOT
import pytest

from amr_description.errors import SpawnError
from amr_description.model.frames import Transform
from amr_description.sim.spawning import checked_pose, free_name, read_description, SpawnCode
from amr_description.sim.world import MujocoWorld

TUTORIAL = (ROOT / 'test' / 'fixtures' / 'tutorial' / 'amr.urdf').read_text()
BOX = '<geometry><box size="0.5 0.3 0.1"/></geometry>'


@pytest.fixture
def world():
    world = MujocoWorld('empty', log=Lines())
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
        ('x', '<sdf version="1.9"/>', Transform(), 103, 'x: the description is SDF'),
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


def test_free_name():
    assert free_name('amr', ()) == 'amr'
    assert free_name('amr', ('amr',)) == 'amr_1'
    assert free_name('amr', ('amr', 'amr_1', 'amr_3')) == 'amr_2'


def test_quaternion_of_any_length_is_taken_as_a_direction():
    pose = checked_pose(Transform((1.0, 2.0, 3.0), (0.0, 0.0, 0.0, 2.0)))
    assert pose == Transform((1.0, 2.0, 3.0))


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
def test_mesh_that_cannot_be_had(package, uri, code, text):
    log = Lines()
    world = MujocoWorld('empty', log=log)
    good = 'package://my_robot/meshes/chassis.stl'
    with pytest.raises(SpawnError, match=text) as refusal:
        world.spawn('amr', with_meshes(good, uri))
    assert refusal.value.code == code
    assert 'amr:' in str(refusal.value) and 'collision of link "base_link"' in str(refusal.value)
    # Physics can do without a visual.
    world.spawn('amr', with_meshes(uri, good))
    assert 'visual of link "base_link"' in log.text and 'it is not drawn' in log.text


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
