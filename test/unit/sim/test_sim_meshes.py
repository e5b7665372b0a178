# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""Robots of meshes in the simulator: whatever the format, they stand where their shape says."""

from fixtures.sim.driving import Lines
from lxml import etree
import mujoco
import numpy as np
import pytest
from support.mesh_files import ascii_stl, binary_stl, box, dae, FACES, glb, gltf, obj, write

from amr_description.cli import check_urdf
from amr_description.errors import SpawnError
from amr_description.model.frames import Transform
from amr_description.model.meshes import TriangleMesh
from amr_description.sim import meshes as sim_meshes
from amr_description.sim.meshes import insert_meshes, resolve_meshes, THICKNESS
from amr_description.sim.spawning import read_description
from amr_description.sim.world import MujocoWorld

SIZE = (0.2, 0.4, 0.6)
BOX = box(SIZE, (0.0, 0.0, 0.1))
"""From 0.2 m below to 0.4 m above its origin."""
Y_UP_BOX = [(x, z, -y) for x, y, z in BOX]


def centimetres(corners):
    return [tuple(100.0 * each for each in corner) for corner in corners]


def urdf(name, visual=None, scale='1 1 1'):
    """A robot of one link, with a mass of 48 kg; its mesh lies beside it."""
    seen = visual or name
    return f"""<robot name="crate"><link name="base_link">
<inertial><origin xyz="0 0 0.1"/><mass value="48"/>
<inertia ixx="2.08" iyy="1.6" izz="0.8" ixy="0" ixz="0" iyz="0"/></inertial>
<visual><geometry><mesh filename="{seen}" scale="{scale}"/></geometry></visual>
<collision><geometry><mesh filename="{name}" scale="{scale}"/></geometry></collision>
</link></robot>"""


def spawned(folder, text, log=None, height=0.25):
    source = write(folder / 'crate.urdf', text)
    world = MujocoWorld('empty', log=log or Lines())
    robot = read_description(text, str(source))
    world.spawn('crate', robot, Transform((0.0, 0.0, height)))
    return world


CRATES = {
    'metres.dae': dae(BOX, up='Z_UP'),
    'metres_y.dae': dae(BOX, meter=1.0, up='Y_UP'),
    'centimetres.dae': dae(centimetres(BOX), meter=0.01, up='Z_UP'),
    'centimetres_y.dae': dae(centimetres(BOX), meter=0.01, up='Y_UP'),
    'a.gltf': gltf(Y_UP_BOX),
    'a.glb': glb(Y_UP_BOX),
    'text.stl': ascii_stl(BOX),
    'binary.stl': binary_stl(BOX),
    'a.obj': obj(BOX),
}


@pytest.mark.parametrize('name', CRATES)
def test_a_robot_of_a_mesh_stands_on_the_ground_and_weighs_what_it_should(tmp_path, name, capsys):
    write(tmp_path / name, CRATES[name])
    log = Lines()
    world = spawned(tmp_path, urdf(name), log)
    world.step(1000)
    pose = world.robot('crate').pose('base_link')
    assert pose.translation == pytest.approx((0.0, 0.0, 0.2), abs=1e-3)
    assert log.lines == []
    # 1000 kg/m³ · 0.2 m · 0.4 m · 0.6 m, and the moments of the box in the URDF.
    options = ('--inertia', 'base_link', '--density', '1000')
    assert check_urdf.main([str(tmp_path / 'crate.urdf'), *options]) == 0
    told = etree.fromstring(capsys.readouterr().out)
    assert float(told.find('mass').get('value')) == pytest.approx(48.0)
    given = etree.fromstring(urdf(name)).find('.//inertia').attrib
    for key, moment in told.find('inertia').attrib.items():
        assert float(moment) == pytest.approx(float(given[key]), rel=1e-5)


@pytest.mark.parametrize('name', ['metres.dae', 'a.glb', 'text.stl'])
def test_scale_is_applied_once(tmp_path, name):
    write(tmp_path / name, CRATES[name])
    world = spawned(tmp_path, urdf(name, scale='2 2 0.5'))
    world.step(1000)
    assert world.robot('crate').pose('base_link').translation[2] == pytest.approx(0.1, abs=1e-3)


def test_a_robot_of_meshes_may_go_and_come_again(tmp_path):
    write(tmp_path / 'a.obj', CRATES['a.obj'])
    world = spawned(tmp_path, urdf('a.obj'))
    count = world.engine.model.nmesh
    world.remove('crate')
    assert world.engine.model.nmesh == 0
    world.spawn('crate', urdf(str(tmp_path / 'a.obj')), Transform((0.0, 0.0, 0.25)))
    assert world.engine.model.nmesh == count > 0


@pytest.mark.parametrize('name', ['metres.dae', 'binary.stl', 'a.obj'])
def test_a_mirrored_mesh_stands_on_its_other_end(tmp_path, name):
    write(tmp_path / name, CRATES[name])
    mirrored = urdf(name, scale='1 -1 -1').replace('0 0 0.1', '0 0 -0.1')
    world = spawned(tmp_path, mirrored, height=0.45)
    world.step(1000)
    assert world.robot('crate').pose('base_link').translation[2] == pytest.approx(0.4, abs=1e-3)


def test_names_in_any_script_are_names(tmp_path):
    folder = tmp_path / 'möbel'
    folder.mkdir()
    write(folder / 'größe ж.stl', CRATES['binary.stl'])
    text = urdf('möbel/größe ж.stl').replace('base_link', 'короб')
    world = spawned(tmp_path, text)
    world.step(1000)
    assert world.robot('crate').pose('короб').translation[2] == pytest.approx(0.2, abs=1e-3)


def test_meshes_of_one_name_in_two_folders_are_two(tmp_path):
    for folder, corners in (('seen', BOX), ('touched', box((0.2, 0.2, 0.2)))):
        (tmp_path / folder).mkdir()
        write(tmp_path / folder / 'base.stl', binary_stl(corners))
    world = spawned(tmp_path, urdf('touched/base.stl', 'seen/base.stl'))
    world.step(1000)
    assert world.robot('crate').pose('base_link').translation[2] == pytest.approx(0.1, abs=1e-3)


def prepared(folder, text):
    """The spec of a description's meshes, ready to compile."""
    tree = etree.fromstring(text)
    settings = etree.SubElement(etree.SubElement(tree, 'mujoco'), 'compiler')
    settings.attrib.update({'strippath': 'false', 'discardvisual': 'false'})
    found = resolve_meshes(tree, str(write(folder / 'crate.urdf', text)), Lines())
    spec = mujoco.MjSpec.from_string(etree.tostring(tree, encoding='unicode'))
    insert_meshes(spec, found)
    return spec, found


def test_equal_files_give_equal_bytes_and_one_mesh_each(tmp_path):
    write(tmp_path / 'a.dae', CRATES['metres.dae'])
    models = []
    for _ in range(2):
        sim_meshes._load.cache_clear()
        spec, found = prepared(tmp_path, urdf('a.dae'))
        assert len(found) == 2  # one to see, one to touch
        models.append(spec.compile())
    assert [mesh.name for mesh in spec.meshes] == ['a', 'a1']
    assert models[0].mesh_vert.tobytes() == models[1].mesh_vert.tobytes()
    assert models[0].geom_pos.tobytes() == models[1].geom_pos.tobytes()
    assert sorted(path.name for path in tmp_path.iterdir()) == ['a.dae', 'crate.urdf']


def test_a_shape_is_the_same_whatever_its_format(tmp_path):
    for name in ('a.obj', 'binary.stl', 'text.stl', 'metres.dae'):
        write(tmp_path / name, CRATES[name])
    for name in ('a.obj', 'text.stl', 'metres.dae'):
        spec, _ = prepared(tmp_path, urdf(name, 'binary.stl'))
        one, other = spec.meshes
        corners = [np.reshape(mesh.uservert, (-1, 3)).tolist() for mesh in (one, other)]
        assert sorted(corners[0]) == sorted(corners[1])
        assert len(corners[0]) == 8  # STL has each corner six times


@pytest.mark.parametrize('count', [0, 1, 300])
def test_corners_are_shared_as_unique_rows_are(count):
    numbers = np.random.default_rng(1).choice([-1.5, -0.0, 0.0, 1.0, np.nan], (3 * count, 3))
    mesh = TriangleMesh(numbers, np.arange(3 * count).reshape(-1, 3))
    rows = np.ascontiguousarray(numbers, dtype=np.float32)
    whole = rows.view([('x', 'f4'), ('y', 'f4'), ('z', 'f4')]).reshape(-1)
    _, first, corner = np.unique(whole, return_index=True, return_inverse=True)
    shared = sim_meshes._with_shared_corners(mesh)
    assert shared.vertices.tobytes() == numbers[first].tobytes()
    assert np.array_equal(shared.faces, corner[mesh.faces])


FLAT = {
    'square': [(-0.5, -0.5, 0.0), (0.5, -0.5, 0.0), (0.5, 0.5, 0.0), (-0.5, 0.5, 0.0)],
    'line': [(-0.5, 0.0, 0.0), (0.0, 0.0, 0.0), (0.5, 0.0, 0.0), (0.5, 0.0, 0.0)],
    'point': [(0.0, 0.0, 0.0)] * 4,
}


@pytest.mark.parametrize('name', FLAT)
def test_a_collision_mesh_without_thickness_is_given_some(tmp_path, name):
    write(tmp_path / 'flat.stl', binary_stl(FLAT[name], [(0, 1, 2), (0, 2, 3)]))
    write(tmp_path / 'a.stl', binary_stl(BOX))
    world = spawned(tmp_path, urdf('flat.stl', 'a.stl'))
    world.step(1000)
    height = world.robot('crate').pose('base_link').translation[2]
    assert height == pytest.approx(THICKNESS / 2.0, abs=1e-3)


def test_a_visual_without_area_is_left_out(tmp_path):
    write(tmp_path / 'line.stl', binary_stl(FLAT['line'], [(0, 1, 2)]))
    write(tmp_path / 'a.stl', binary_stl(BOX))
    log = Lines()
    spawned(tmp_path, urdf('a.stl', 'line.stl'), log)
    assert 'line.stl: its triangles have no area; it is not drawn' in log.text


def test_an_stl_with_more_triangles_than_mujoco_reads(tmp_path):
    corners = np.array(BOX)[np.array(FACES * 16_667)]
    records = np.zeros(len(corners), dtype=[('n', '<f4', 3), ('v', '<f4', (3, 3)), ('c', '<u2')])
    records['v'] = corners
    head = bytes(80) + len(corners).to_bytes(4, 'little')
    write(tmp_path / 'large.stl', head + records.tobytes())
    _, found = prepared(tmp_path, urdf('large.stl'))
    assert {len(mesh.faces) for mesh in found.values()} == {200_004}
    # To touch, not to see too: that would take as long again.
    write(tmp_path / 'small.stl', binary_stl(BOX))
    world = spawned(tmp_path, urdf('large.stl', 'small.stl'))
    world.step(1000)
    assert world.robot('crate').pose('base_link').translation[2] == pytest.approx(0.2, abs=1e-3)


def test_a_flat_picture_on_a_robot_does_not_refuse_it(tmp_path):
    write(tmp_path / 'a.dae', CRATES['metres.dae'])
    write(tmp_path / 'flat.dae', dae([(0, 0, 0), (1, 0, 0), (0, 1, 0)], [(0, 1, 2)]))
    world = spawned(tmp_path, urdf('a.dae', 'flat.dae'))
    world.step(1000)
    assert world.robot('crate').pose('base_link').translation[2] == pytest.approx(0.2, abs=1e-3)


def test_a_file_that_has_changed_is_read_again(tmp_path):
    write(tmp_path / 'a.dae', CRATES['metres.dae'])
    prepared(tmp_path, urdf('a.dae'))
    write(tmp_path / 'a.dae', dae(box((1.0, 1.0, 1.25))))
    _, found = prepared(tmp_path, urdf('a.dae'))
    assert {mesh.size for mesh in found.values()} == {(1.0, 1.0, 1.25)}


def test_a_robot_of_meshes_comes_back_under_its_name(tmp_path):
    world = spawned(tmp_path, urdf(write(tmp_path / 'a.obj', obj(BOX)).name))
    robot = world.robot('crate').description
    meshes = world.engine.model.nmesh
    world.remove('crate')
    assert world.engine.model.nmesh == 0
    with pytest.raises(SpawnError, match='raise z by 0.200 m'):
        world.spawn('crate', robot)
    world.spawn('crate', robot, Transform((0.0, 0.0, 0.25)))
    assert world.engine.model.nmesh == meshes > 0
