# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""``check_urdf --inertia``: what a link weighs, from its shapes, against closed forms."""

import re
import xml.etree.ElementTree as ET

import pytest
from support.mesh_files import box, dae, FACES, write

from amr_description.cli import check_urdf
from amr_description.errors import UsageError

A, B, C = SIZE = (0.2, 0.4, 0.6)


@pytest.fixture
def inertial(tmp_path, capsys):
    """Runs --inertia on link b with these parts; gives exit code, element and stderr."""

    def inertial(parts, *options, link='b', own=''):
        text = f'<robot name="r"><link name="a"/><link name="b">{own}{parts}</link>'
        text += '<joint name="j" type="fixed"><parent link="a"/><child link="b"/></joint></robot>'
        path = write(tmp_path / 'r.urdf', text)
        code = check_urdf.main([str(path), '--inertia', link, *options])
        out, err = capsys.readouterr()
        return code, ET.fromstring(out) if out else None, err

    return inertial


def collision(shape, origin=''):
    return f'<collision>{origin}<geometry>{shape}</geometry></collision>'


def numbers(element, *names):
    return [float(word) for name in names for word in element.get(name).split()]


def moments(m, a, b, c):
    return [m * (b * b + c * c) / 12, m * (a * a + c * c) / 12, m * (a * a + b * b) / 12]


MESH = '<mesh filename="b.dae"/>'


@pytest.mark.parametrize('meter', [1.0, 0.01])
@pytest.mark.parametrize('up', ['Y_UP', 'Z_UP'])
def test_a_mesh_weighs_what_its_closed_form_says(tmp_path, inertial, meter, up):
    size = [each / meter for each in SIZE]
    write(tmp_path / 'b.dae', dae(box(size, (0, 0, 0.5 / meter)), meter=meter, up=up))
    turned = '<origin xyz="1 0 0" rpy="0 0 1.5707963267948966"/>'
    code, found, err = inertial(collision(MESH, turned), '--density', '500')
    assert (code, err) == (0, '')
    assert numbers(found.find('origin'), 'xyz', 'rpy') == pytest.approx([1, 0, 0.5, 0, 0, 0])
    assert numbers(found.find('mass'), 'value') == pytest.approx([24.0])
    # Turned by a quarter about Z: x and y have changed places.
    assert numbers(found.find('inertia'), 'ixx', 'iyy', 'izz') == pytest.approx(
        moments(24.0, B, A, C), rel=1e-5
    )
    assert numbers(found.find('inertia'), 'ixy', 'ixz', 'iyz') == [0.0, 0.0, 0.0]


def test_shapes_are_joined_and_mass_is_shared_by_volume(inertial):
    left = collision('<box size="1 1 1"/>', '<origin xyz="0 0.5 0"/>')
    right = collision('<box size="1 1 1"/>', '<origin xyz="0 -0.5 0"/>')
    _, found, _ = inertial(left + right, '--mass', '6')
    assert numbers(found.find('mass'), 'value') == [6.0]
    assert numbers(found.find('inertia'), 'ixx', 'iyy', 'izz') == pytest.approx(
        moments(6, 1, 2, 1)
    )


def test_the_mass_of_the_description_holds_where_none_is_given(inertial):
    own = '<inertial><mass value="3"/><inertia ixx="9" iyy="9" izz="9" ixy="0" ixz="0" iyz="0"/>'
    _, found, _ = inertial(collision('<sphere radius="0.5"/>'), own=f'{own}</inertial>')
    assert numbers(found.find('mass'), 'value') == [3.0]
    assert numbers(found.find('inertia'), 'ixx') == pytest.approx([0.4 * 3 * 0.25])
    with pytest.raises(UsageError, match='add --mass KG or --density'):
        inertial(collision('<sphere radius="0.5"/>'))


def test_visuals_are_weighed_where_nothing_touches(inertial):
    seen = '<visual><geometry><box size="1 1 1"/></geometry></visual>'
    _, found, _ = inertial(seen, '--density', '2')
    assert numbers(found.find('mass'), 'value') == [2.0]


def test_what_cannot_be_weighed_is_refused(tmp_path, inertial):
    write(tmp_path / 'b.dae', dae(box(SIZE), FACES[1:]))
    for parts, link, text in (
        (collision(MESH), 'b', r'\(b.dae\): it is not closed.*: 3 of its 18 edges'),
        (collision('<mesh filename="c.stl"/>'), 'b', 'c.stl: there is no such file'),
        ('', 'b', 'link "b" has neither <collision> nor <visual>'),
        ('', 'c', 'there is no link "c"; there are: "a", "b"'),
        (collision('<box size="1 1 0"/>'), 'b', 'it has no volume'),
    ):
        code, found, err = inertial(parts, '--mass', '1', link=link)
        assert (code, found) == (1, None)
        assert err.startswith('error: ') and err.count('\n') == 1 and re.search(text, err)


@pytest.mark.parametrize('options', [['--mass', '0'], ['--density', 'nan'], ['--mass', 'x']])
def test_a_weight_is_a_number_above_0(inertial, options, capsys):
    with pytest.raises(SystemExit):
        inertial('', *options)
    assert 'is no number above 0' in capsys.readouterr().err


def test_a_weight_is_that_of_a_link(tmp_path):
    path = write(tmp_path / 'r.urdf', '<robot name="r"><link name="a"/></robot>')
    with pytest.raises(UsageError, match='--inertia LINK'):
        check_urdf.main([str(path), '--mass', '1'])
