# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""Mesh files as triangles: units, axes, scenes, scale, and what cannot be read."""

import json
import os
import subprocess
import sys

from hypothesis import given, HealthCheck, strategies as st
import numpy as np
import pytest
from support.examples import examples
from support.mesh_files import (
    ascii_stl,
    binary_stl,
    box,
    dae,
    FACES,
    glb,
    gltf,
    gltf_tree,
    obj,
    write,
)

from amr_description.errors import MeshError
from amr_description.model.frames import Transform
from amr_description.model.mesh_solids import solid_mesh
from amr_description.model.meshes import declared_up_axis, load_mesh, stl_bytes

SIZE, CENTER = (0.2, 0.4, 0.6), (1.0, 2.0, 3.0)
BOX = box(SIZE, CENTER)


def middle(mesh):
    return (mesh.vertices.min(axis=0) + mesh.vertices.max(axis=0)) / 2.0


def signed_volume(mesh):
    return np.linalg.det(mesh.vertices[mesh.faces]).sum() / 6.0


@pytest.mark.parametrize('meter', [None, 1.0, 0.01, 0.0254])
@pytest.mark.parametrize('up', [None, 'X_UP', 'Y_UP', 'Z_UP'])
def test_collada_has_its_unit_applied_and_its_up_axis_not(tmp_path, meter, up):
    # As RViz and Gazebo: see the docstring of the module.
    path = write(tmp_path / 'box.dae', dae(BOX, meter=meter, up=up))
    mesh = load_mesh(path)
    unit = meter or 1.0
    assert mesh.size == pytest.approx([unit * each for each in SIZE], rel=1e-6)
    assert middle(mesh) == pytest.approx([unit * each for each in CENTER], rel=1e-6)
    assert signed_volume(mesh) == pytest.approx(0.048 * unit**3, rel=1e-5)
    assert declared_up_axis(path) == up


@pytest.mark.parametrize(
    'suffix, content',
    [('.stl', ascii_stl(BOX)), ('.stl', binary_stl(BOX)), ('.STL', binary_stl(BOX)),
     ('.obj', obj(BOX)), ('.obj', 'mtllib gone.mtl\nusemtl red\n' + obj(BOX))],
)  # fmt: skip
def test_formats_without_unit_and_axis_are_taken_they_are(tmp_path, suffix, content):
    path = write(tmp_path / f'box{suffix}', content)
    mesh = load_mesh(path)
    assert mesh.size == pytest.approx(SIZE, rel=1e-6)
    assert middle(mesh) == pytest.approx(CENTER, rel=1e-6)
    assert signed_volume(mesh) == pytest.approx(0.048, rel=1e-5)
    assert declared_up_axis(path) is None


@pytest.mark.parametrize('suffix, content', [('.gltf', gltf(BOX)), ('.glb', glb(BOX))])
def test_gltf_has_y_up(tmp_path, suffix, content):
    mesh = load_mesh(write(tmp_path / f'box{suffix}', content))
    assert mesh.size == pytest.approx((0.2, 0.6, 0.4), rel=1e-6)
    assert middle(mesh) == pytest.approx((1.0, -3.0, 2.0), rel=1e-6)
    assert signed_volume(mesh) == pytest.approx(0.048, rel=1e-5)


def test_a_polygon_of_an_obj_file_becomes_triangles(tmp_path):
    square = 'v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1 2 3 4\n'
    assert len(load_mesh(write(tmp_path / 'a.obj', square)).faces) == 2


def test_the_transforms_of_a_scene_are_applied_and_a_geometry_counts_each_time(tmp_path):
    moved = '<translate>5 0 0</translate><scale>2 1 1</scale>'
    mirrored = '<scale>-1 1 1</scale>'
    shape = '<instance_geometry url="#g"/>'
    scene = f'<node>{moved}<node>{shape}</node></node><node>{mirrored}{shape}</node>'
    mesh = load_mesh(write(tmp_path / 'a.dae', dae(box((1, 1, 1)), nodes=scene, meter=0.5)))
    assert len(mesh.faces) == 2 * len(FACES)
    assert mesh.vertices[:, 0].min() == pytest.approx(-0.25)
    assert mesh.vertices[:, 0].max() == pytest.approx(3.0)
    # A mirrored part has its outside outside.
    assert signed_volume(mesh) == pytest.approx((2.0 + 1.0) / 8.0)


@given(st.tuples(*[st.sampled_from([-2.0, -1.0, 0.5, 3.0])] * 3))
@examples(20, suppress_health_check=[HealthCheck.function_scoped_fixture])
def test_scale_stretches_and_mirrors_and_never_turns_inside_out(tmp_path, scale):
    mesh = load_mesh(write(tmp_path / 'a.obj', obj(BOX)), scale)
    assert mesh.size == pytest.approx([abs(s) * each for s, each in zip(scale, SIZE, strict=True)])
    assert middle(mesh) == pytest.approx([s * c for s, c in zip(scale, CENTER, strict=True)])
    assert signed_volume(mesh) == pytest.approx(0.048 * abs(np.prod(scale)))


def test_a_shape_needs_neither_material_nor_picture(tmp_path):
    broken = """<library_images><image id="i"><init_from>http://h/x.png</init_from></image>
</library_images><library_effects><effect id="e"><profile_COMMON><technique sid="c"><phong>
<diffuse><color>no colour</color></diffuse></phong></technique></profile_COMMON></effect>
</library_effects><library_materials><material id="m"><instance_effect url="#e"/></material>
</library_materials><library_geometries>"""
    bound = """<instance_geometry url="#g"><bind_material><technique_common>
<instance_material symbol="m" target="#m"/></technique_common></bind_material>
</instance_geometry>"""
    text = dae(BOX).replace('<library_geometries>', broken)
    text = text.replace('<instance_geometry url="#g"/>', bound)
    assert load_mesh(write(tmp_path / 'a.dae', text)).size == pytest.approx(SIZE)


def test_gltf_names_buffers_beside_it_alone(tmp_path):
    (tmp_path / 'in').mkdir()
    for uri, is_beside in (('box.bin', True), ('../box.bin', False), ('http://h/b', False)):
        tree, data = gltf_tree(BOX, uri=uri)
        (tmp_path / 'box.bin').write_bytes(data)
        (tmp_path / 'in' / 'box.bin').write_bytes(data)
        path = write(tmp_path / 'in' / 'box.gltf', json.dumps(tree))
        if is_beside:
            assert load_mesh(path).size == pytest.approx((0.2, 0.6, 0.4))
        else:
            with pytest.raises(MeshError):
                load_mesh(path)


def test_stl_of_a_mesh_is_the_mesh(tmp_path):
    mesh = load_mesh(write(tmp_path / 'a.dae', dae(BOX, meter=0.01)))
    data = stl_bytes(mesh)
    assert data == stl_bytes(load_mesh(tmp_path / 'a.dae'))
    again = load_mesh(write(tmp_path / 'b.stl', data))
    assert again.size == pytest.approx(mesh.size)
    assert solid_mesh(again, Transform(), 'b').volume == pytest.approx(0.048e-6, rel=1e-4)


NAN = ' '.join(['nan'] + ['0'] * 23)
ENTITIES = ''.join(
    f'<!ENTITY {name} "{10 * f"&{before};"}">'
    for before, name in zip('abcdefgh', 'bcdefghi', strict=True)
)
LAUGHS = f'<!DOCTYPE l [<!ENTITY a "ha">{ENTITIES}]><COLLADA>&i;</COLLADA>'
NODES = ''.join(
    f'<node id="n{i}"><instance_node url="#n{i + 1}"/><instance_node url="#n{i + 1}"/></node>'
    for i in range(40)
)
LOOP = '<node id="a"><instance_node url="#a"/></node>'
BOMB = NODES + '<node id="n40"><instance_geometry url="#g"/></node>'
HUGE = json.dumps({**gltf_tree(BOX)[0], 'accessors': [{'count': 10**12}] * 2})
TWO_PARENTS = json.dumps(
    {**gltf_tree(BOX)[0], 'nodes': [{'children': [1]}, {'children': [2]}, {'children': [1]}]}
)


@pytest.mark.parametrize(
    'name, content, text',
    [
        ('a.stl', None, 'there is no such file'),
        ('a.stl', '', 'it is empty'),
        ('a.dae', '', 'it is empty'),
        ('a.fbx', 'x', "a mesh of type '.fbx' is not read; .stl, .obj, .dae, .gltf, .glb are"),
        ('a.stl', 'no mesh', 'cannot be read as .stl|there is no triangle'),
        ('a.stl', binary_stl(BOX)[:-7], 'cannot be read as .stl|there is no triangle'),
        ('a.obj', 'v 0 0 0\n', 'there is no triangle'),
        ('a.obj', obj(BOX) + 'f 1 2 99\n', 'cannot be read as .obj'),
        ('a.obj', obj([(float('nan'), 0.0, 0.0), *BOX[1:]]), 'no finite number'),
        ('a.stl', binary_stl([(float('inf'), 0.0, 0.0), *BOX[1:]]), 'no finite number'),
        ('a.dae', '<COLLADA', 'not well-formed XML'),
        ('a.dae', '<robot/>', 'its root element is <robot>, not <COLLADA>'),
        ('a.dae', '<COLLADA/>', 'cannot be read as .dae|there is no triangle'),
        ('a.dae', dae(BOX, positions=NAN), 'a coordinate is NaN'),
        ('a.dae', dae(BOX, positions='1 2 3'), 'cannot be read|there is no triangle'),
        ('a.dae', dae(BOX, meter='0'), '<unit meter="0"/> is no length in m'),
        ('a.dae', dae(BOX, meter='big'), '<unit meter="big"/> is no length in m'),
        ('a.dae', dae(BOX).replace('triangles', 'tristrips'), '<tristrips> is not read'),
        ('a.dae', LAUGHS, 'document type declaration'),
        ('a.dae', dae(BOX, nodes=LOOP), 'contains itself'),
        ('a.dae', dae(BOX, nodes=BOMB), 'names its geometries too often'),
        ('a.gltf', '{', 'cannot be read as .gltf'),
        ('a.gltf', HUGE, 'more than 10000000 triangles'),
        ('a.gltf', TWO_PARENTS, 'two parents'),
        ('a.glb', b'glTF', 'cannot be read as .glb'),
        ('a.glb', glb(BOX)[:-40], 'cannot be read as .glb'),
    ],
)
def test_a_file_that_is_not_a_mesh_is_refused_in_one_line(tmp_path, name, content, text):
    path = tmp_path / name
    if content is not None:
        write(path, content)
    with pytest.raises(MeshError, match=text) as refusal:
        load_mesh(path)
    assert str(refusal.value).startswith(str(path))
    assert '\n' not in str(refusal.value)


def test_what_has_no_end_is_not_read(tmp_path):
    os.mkfifo(tmp_path / 'a.stl')
    (tmp_path / 'b.stl').symlink_to('/dev/zero')
    for name in ('a.stl', 'b.stl'):
        with pytest.raises(MeshError, match='no regular file'):
            load_mesh(tmp_path / name)


CONTENTS = {
    'a.dae': dae(BOX).encode(), 'a.gltf': gltf(BOX).encode(), 'a.glb': glb(BOX),
    'a.obj': obj(BOX).encode(), 'a.stl': ascii_stl(BOX).encode(), 'b.stl': binary_stl(BOX),
}  # fmt: skip


@examples(100, suppress_health_check=[HealthCheck.function_scoped_fixture])
@given(
    st.sampled_from(sorted(CONTENTS)),
    st.integers(0, 3000),
    st.integers(0, 9),
    st.binary(max_size=9),
)
def test_any_bytes_are_a_mesh_or_refused(tmp_path, name, at, count, new):
    data = CONTENTS[name]
    at %= len(data)
    path = write(tmp_path / name, data[:at] + new + data[at + count :] or b' ')
    try:
        mesh = load_mesh(path)
    except MeshError as error:
        assert '\n' not in str(error)
    else:
        assert len(mesh.faces) and np.isfinite(mesh.vertices[mesh.faces]).all()


def test_nothing_is_imported_before_there_is_a_mesh():
    code = """
import sys
from amr_description.model.checks import examine
from amr_description.cli import check_urdf
examine('<robot name="r"><link name="a"/></robot>')
print({'trimesh', 'collada', 'yourdfpy', 'numpy'} & {*sys.modules})
"""
    run = subprocess.run([sys.executable, '-c', code], capture_output=True, text=True, check=True)
    assert run.stdout == 'set()\n'


@pytest.mark.parametrize('module, package', [('trimesh', 'trimesh'), ('collada', 'pycollada')])
def test_a_package_that_is_missing_is_named(tmp_path, monkeypatch, module, package):
    monkeypatch.setitem(sys.modules, module, None)
    file = write(tmp_path / 'a.dae', dae(BOX))
    with pytest.raises(MeshError, match=f'is not installed: pip install {package}'):
        load_mesh(file)
    whole = write(tmp_path / 'a.stl', binary_stl(BOX))
    assert len(load_mesh(whole).faces) == 12
