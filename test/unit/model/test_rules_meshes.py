# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""What the checker says of what is in mesh files."""

import time

import pytest
from support.mesh_files import binary_stl, box, dae, FACES, obj, write

from amr_description.model.checks import examine
from amr_description.model.checks.context import CheckInputs

U = box((0.2, 0.2, 0.2)) + box((0.2, 0.2, 0.2), (1.6, 0.0, 0.0))
TWICE = FACES + [tuple(i + 8 for i in face) for face in FACES]


@pytest.fixture
def found(tmp_path):
    """Returns what is found of a robot with these shapes in its one link."""

    def found(*shapes, files=None):
        for name, content in (files or {}).items():
            write(tmp_path / name, content)
        parts = ''.join(f'<{kind}><geometry>{shape}</geometry></{kind}>' for kind, shape in shapes)
        inertial = (
            '<inertial><mass value="1"/><inertia ixx="1" iyy="1" izz="1" ixy="0" ixz="0" iyz="0"/>'
            '</inertial>'
        )
        text = f'<robot name="r"><link name="a"/><link name="b">{inertial}{parts}</link>'
        text += '<joint name="j" type="fixed"><parent link="a"/><child link="b"/></joint></robot>'
        inputs = CheckInputs(find_file=lambda uri: tmp_path / uri)
        told = examine(text, 'r.urdf', inputs).findings
        return [str(each) for each in told if 'mesh' in each.what]

    return found


def mesh(name, scale=None):
    stretched = '' if scale is None else f' scale="{scale}"'
    return f'<mesh filename="{name}"{stretched}/>'


GOOD = binary_stl(box((0.2, 0.4, 0.6)))


def test_a_good_mesh_is_let_be(found):
    both = [('visual', mesh('a.stl')), ('collision', mesh('a.stl'))]
    assert found(*both, files={'a.stl': GOOD}) == []


def test_without_files_there_are_no_findings():
    text = '<robot name="r"><link name="a"><visual><geometry><mesh filename="a.stl"/></geometry>'
    text += '</visual></link></robot>'
    assert examine(text).findings == ()


def test_a_mesh_that_is_not_there_is_not_read(found):
    assert found(('collision', mesh('gone.stl'))) == []


@pytest.mark.parametrize(
    'kind, taken',
    [('collision', "; the shape of the link's visual is taken, or none"), ('visual', '')],
)
def test_an_empty_mesh(found, kind, taken):
    (line,) = found((kind, mesh('a.dae')), files={'a.dae': ''})
    assert line.startswith(
        f'warning: r.urdf:1: the mesh of a {kind} of link "b" ("a.dae") cannot be used: found '
    )
    assert line.endswith(f'/a.dae: it is empty; export it again{taken}')


def test_a_mesh_in_millimetres(found):
    files = {'a.stl': binary_stl(box((88.1, 39.75, 58.0)))}
    (line,) = found(('visual', mesh('a.stl')), files=files)
    assert '("a.stl") is very large: found 88.1 x 39.8 x 58 m, expected the size in m' in line
    assert line.endswith('if the file is in mm, write scale="0.001 0.001 0.001"')
    assert found(('visual', mesh('a.stl', '0.001 0.001 0.001')), files=files) == []
    (line,) = found(('visual', mesh('a.stl', '-1 1 1')), files=files)
    assert line.endswith('write scale="-0.001 0.001 0.001"')


def test_a_small_part_in_millimetres_is_known_by_the_other_shapes_of_its_link(found):
    files = {'a.stl': binary_stl(box((3.0, 4.0, 5.0)))}
    shapes = [('visual', mesh('a.stl')), ('collision', '<box size="0.003 0.004 0.005"/>')]
    (line,) = found(*shapes, files=files)
    assert 'found 3 x 4 x 5 m, 1000 times the other shapes of the link' in line
    assert found(shapes[0], files=files) == []


@pytest.mark.parametrize('up', ['X_UP', 'Y_UP'])
def test_a_collada_file_with_another_axis_up(found, up):
    (line,) = found(('visual', mesh('a.dae')), files={'a.dae': dae(box((1, 1, 1)), up=up)})
    assert f'found <up_axis>{up}</up_axis>, expected Z_UP' in line
    for fine in ('Z_UP', None):
        files = {'a.dae': dae(box((1, 1, 1)), up=fine)}
        assert found(('visual', mesh('a.dae')), files=files) == []


def test_a_collision_that_is_not_closed(found):
    files = {'a.stl': binary_stl(box((1, 1, 1)), FACES[2:])}
    (line,) = found(('collision', mesh('a.stl')), files=files)
    assert 'is not closed, so it has no volume, mass or inertia: found 4 of 17 edges' in line
    assert found(('visual', mesh('a.stl')), files=files) == []


def test_a_collision_whose_hull_is_much_larger(found):
    # Two cubes of 0.2 m, 1.6 m apart: the hull is a bar of 1.8 m, 4.5 times their volume.
    files = {'a.stl': binary_stl(U, TWICE)}
    (line,) = found(('collision', mesh('a.stl')), files=files)
    assert 'holds more: found 4.5 times its volume, expected at most 2 times' in line
    assert found(('visual', mesh('a.stl')), files=files) == []


def test_a_large_mesh_takes_no_longer_than_a_breath(found):
    side = 224  # about 100,000 triangles
    corners = [(i * 0.01, j * 0.01, 0.01 * (i * j % 7)) for i in range(side) for j in range(side)]
    faces = [
        face
        for i in range(side - 1)
        for j in range(side - 1)
        for k in [i * side + j]
        for face in ((k, k + side, k + 1), (k + 1, k + side, k + side + 1))
    ]
    start = time.process_time()
    (line,) = found(('collision', mesh('a.obj')), files={'a.obj': obj(corners, faces)})
    assert f'found {4 * (side - 1)} of' in line
    assert time.process_time() - start < 10.0
