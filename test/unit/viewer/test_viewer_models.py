# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""A robot's description as a page gets it: joints, findings, and only those files it names."""

import gzip
import math
import os
from xml.sax.saxutils import escape

from fixtures.sim.driving import AMR
from hypothesis import example, given, strategies as st
import pytest
from support.examples import examples
from support.mesh_files import box, glb, gltf, write

from amr_description.model.meshes import load_mesh
from amr_description.model.origins import Origin, with_origins
from amr_description.viewer.description import describe_robot
from amr_description.viewer.http import digest, StaticFiles

JOINT = '<joint name="{0}" type="{1}"><parent link="a"/><child link="{0}_link"/>{2}</joint>'
LINK = '<link name="{0}_link"/>'
BOX = box((0.2, 0.4, 0.6))


def urdf(*parts):
    return f'<robot name="r"><link name="a"/>{"".join(parts)}</robot>'


def joints(*specs):
    text = urdf(*(LINK.format(name) + JOINT.format(name, *rest) for name, *rest in specs))
    return describe_robot('/', text).message.joints


def drawn(uri):
    return (
        '<link name="b"><visual><geometry>'
        f'<mesh filename="{uri}"/></geometry></visual></link>'
        '<joint name="ab" type="fixed"><parent link="a"/><child link="b"/></joint>'
    )


def test_the_shipped_robot_is_described():
    described = describe_robot('/r1', AMR)
    message = described.message
    assert (described.name, message.robot, message.urdf) == ('amr', '/r1', AMR)
    assert message.root == 'base_footprint'
    assert [joint.kind for joint in message.joints] == ['continuous'] * 4
    assert described.joints == tuple(joint.name for joint in message.joints)
    assert (message.meshes, described.files, message.findings) == ({}, {}, ())


def test_joints_have_limits_and_a_place_to_be_centred_at():
    lift, arm, wheel, ball = joints(
        ('lift', 'prismatic', '<limit lower="1" upper="3" effort="1" velocity="1"/>'),
        ('arm', 'revolute', '<limit lower="-1" upper="2" effort="1" velocity="1"/>'),
        ('wheel', 'continuous', ''),
        (
            'tip',
            'revolute',
            '<limit lower="-1" upper="2" effort="1" velocity="1"/><mimic joint="arm"/>',
        ),
    )
    assert (lift.lower, lift.upper, lift.zero, lift.follows) == (1, 3, 2, None)
    assert (arm.lower, arm.upper, arm.zero) == (-1, 2, 0)
    assert (wheel.lower, wheel.upper, wheel.zero) == (-math.pi, math.pi, 0)
    assert ball.follows == 'arm'


def test_what_has_no_one_position_has_no_slider():
    assert joints(('a1', 'fixed', ''), ('a2', 'floating', ''), ('a3', 'planar', '')) == ()


def test_findings_say_where_what_and_what_would_do():
    text = urdf('\n<material name="m"/>', '\n<material name="m"/>')
    (finding,) = [f for f in describe_robot('/', text).message.findings if f.level == 'error']
    assert finding.line == 3
    assert finding.text == 'material "m" is not unique'
    assert finding.remedy == 'give every material a name of its own'


def test_findings_name_the_file_that_the_text_is_from():
    text = urdf('\n<material name="m"/>', '\n<material name="m"/>')
    origins = {1: Origin('/r.xacro', 7), 3: Origin('/parts.xacro', 20, 'paint', ('/r.xacro', 9))}
    found = describe_robot('/', with_origins(text, origins)).message.findings
    (finding,) = [each for each in found if each.level == 'error']
    assert finding.line == 20
    assert finding.text == (
        'parts.xacro: material "m" is not unique (in macro "paint", called at /r.xacro:9)'
    )


@pytest.mark.parametrize('text', ['', 'no xml', '<robot/>', '<a/>', '<robot name="r">'])
def test_what_is_no_description_is_told_by_its_findings(text):
    message = describe_robot('/', text).message
    assert 'error' in {each.level for each in message.findings}
    assert message.joints == ()


@pytest.mark.parametrize('scheme', ['file://', ''])
def test_a_mesh_is_served_under_its_content(tmp_path, scheme):
    mesh = tmp_path / 'b part.STL'
    mesh.write_bytes(b'solid')
    uri = f'{scheme}{mesh}'
    described = describe_robot('/', urdf(drawn(uri)))
    name = f'{digest(b"solid")}.stl'
    assert described.message.meshes == {uri: f'/mesh/{name}'}
    assert described.files == {name: mesh}


def test_no_file_is_served_that_is_no_mesh_whatever_a_description_names(tmp_path):
    secret = tmp_path / 'passwords'
    secret.write_text('x')
    for uri in (f'file://{secret}', 'file:///etc/passwd', f'file://{tmp_path}', 'http://h/a.stl'):
        described = describe_robot('/', urdf(drawn(uri)))
        assert (described.message.meshes, described.files) == ({}, {})
        assert any('cannot be drawn' in each.text for each in described.message.findings)


@given(
    st.sampled_from(['', 'file://', 'package://', 'package://amr_description/', '//', 'model://']),
    st.text(st.characters(exclude_categories=['Cs', 'Cc']), max_size=9),
)
@example('file://', '[')
def test_any_name_of_a_mesh_is_a_file_or_a_finding(scheme, rest):
    described = describe_robot('/', urdf(drawn(escape(scheme + rest, {'"': '&quot;'}))))
    assert described.message.meshes == {}
    assert described.message.findings


@examples(50)
@given(st.integers(0, len(AMR)), st.integers(0, 200), st.text(max_size=9))
def test_any_text_is_a_description_or_has_findings(at, count, text):
    message = describe_robot('/', AMR[:at] + text + AMR[at + count :]).message
    assert message.root or message.findings


def test_what_has_no_end_is_not_read(tmp_path):
    os.mkfifo(tmp_path / 'pipe.stl')
    (tmp_path / 'zero.png').symlink_to('/dev/zero')
    for name in ('pipe.stl', 'zero.png'):
        message = describe_robot('/', urdf(drawn(f'file://{tmp_path}/{name}'))).message
        assert message.meshes == {}
        assert any('is no regular file' in each.text for each in message.findings)


@pytest.mark.parametrize('name', ['key.png', 'key.stl', 'key.dae', 'key.glb'])
def test_a_link_to_a_file_of_another_kind_is_not_served(tmp_path, name):
    (tmp_path / 'id_rsa').write_text('PRIVATE KEY')
    (tmp_path / name).symlink_to('id_rsa')
    described = describe_robot('/', urdf(drawn(f'file://{tmp_path}/{name}')))
    assert (described.message.meshes, described.files) == ({}, {})
    assert any("not ''" in each.text for each in described.message.findings)
    assert 'PRIVATE' not in repr(described)


def test_textures_are_served_too(tmp_path):
    (tmp_path / 'wood.png').write_bytes(b'png')
    uri = f'file://{tmp_path}/wood.png'
    text = urdf(f'<material name="wood"><texture filename="{uri}"/></material>')
    assert describe_robot('/', text).message.meshes == {uri: f'/mesh/{digest(b"png")}.png'}


def test_textures_that_a_collada_file_names_are_served_by_their_place_beside_it(tmp_path):
    (tmp_path / 'meshes').mkdir()
    (tmp_path / 'a&b.png').write_bytes(b'png')
    names = ('../a&amp;b.png', './gone.jpg', 'image_id', '/etc/passwd', 'file:///x.png', 'p.dae')
    images = ''.join(f'<image><init_from>\n {each} </init_from></image>' for each in names)
    mesh = tmp_path / 'meshes' / 'part.dae'
    mesh.write_text(f'<COLLADA>{images}</COLLADA>')
    folder = f'file://{tmp_path}/meshes/'
    message = describe_robot('/', urdf(drawn(f'{folder}part.dae'))).message
    assert message.meshes == {
        f'{folder}part.dae': f'/mesh/{digest(mesh.read_bytes())}.dae',
        f'{folder}../a&b.png': f'/mesh/{digest(b"png")}.png',
    }
    assert [each.text.split()[0] for each in message.findings if 'drawn' in each.text] == [
        f'{folder}gone.jpg'
    ]


@pytest.mark.parametrize('suffix', ['.fbx', '.msh'])
def test_a_mesh_that_the_page_cannot_read_is_told(tmp_path, suffix):
    (tmp_path / f'part{suffix}').write_bytes(b'x')
    message = describe_robot('/', urdf(drawn(f'file://{tmp_path}/part{suffix}'))).message
    assert message.meshes == {}
    assert any(f"not '{suffix}'" in each.text for each in message.findings)


@pytest.mark.parametrize('suffix, content', [('.glb', glb(BOX)), ('.GLTF', gltf(BOX).encode())])
def test_gltf_is_served_as_stl_with_z_up(tmp_path, suffix, content):
    uri = f'file://{write(tmp_path / f"part{suffix}", content)}'
    described = describe_robot('/', urdf(drawn(uri)))
    name = f'{digest(content)}.stl'
    assert described.message.meshes == {uri: f'/mesh/{name}'}
    served = load_mesh(write(tmp_path / name, described.files[name]))
    assert served.size == pytest.approx((0.2, 0.6, 0.4))
    assert described.message.findings == ()


def test_a_broken_gltf_file_is_told(tmp_path):
    message = describe_robot('/', urdf(drawn(f'file://{write(tmp_path / "a.glb", "x")}'))).message
    assert message.meshes == {}
    assert any('it cannot be read as .glb' in each.text for each in message.findings)


@pytest.fixture
def static(tmp_path):
    folder = tmp_path / 'static'
    (folder / 'deep').mkdir(parents=True)
    (folder / 'index.html').write_text('<html>')
    (folder / 'deep' / 'a.js').write_text('1')
    (folder / 'notes.md').write_text('no')
    (folder / 'link.js').symlink_to(tmp_path / 'gone.js')
    (tmp_path / 'outside.js').write_text('secret')
    return folder


def test_files_are_served_with_their_type(static):
    files = StaticFiles(static)
    assert files.get('/index.html').data == b'<html>'
    assert files.get('/deep/a.js').kind == 'text/javascript; charset=utf-8'


@pytest.mark.parametrize(
    'path',
    ['/', '', '/x.js', '/../outside.js', '/deep/../index.html', '//index.html', 'index.html',
     '/notes.md', '/deep', '/link.js', '/index.html/', '/./index.html', '/\0'],
)  # fmt: skip
def test_nothing_else_is(static, path):
    assert StaticFiles(static).get(path) is None


def test_a_file_that_changes_has_another_tag(static):
    files = StaticFiles(static)
    before = files.get('/index.html')
    assert files.get('/index.html') is before
    (static / 'index.html').write_text('<html lang="en">')
    assert files.get('/index.html').tag != before.tag


def test_a_text_is_compressed_as_the_browser_takes_it(static):
    files = StaticFiles(static)
    script = static / 'deep' / 'a.js'
    script.write_text('1;' * 500)
    plain = files.get('/deep/a.js')
    small = files.get('/deep/a.js', {'gzip'})
    assert (plain.encoding, small.encoding) == (None, 'gzip')
    assert gzip.decompress(small.data) == plain.data
    assert len({plain.tag, small.tag}) == 2
    assert files.get('/deep/a.js', {'gzip'}) is small, 'compressed once'
    script.with_name('a.js.br').write_bytes(b'by the build')
    built = files.get('/deep/a.js', {'gzip', 'br'})
    assert (built.data, built.encoding, built.kind) == (b'by the build', 'br', plain.kind)
    assert files.get('/deep/a.js', {'gzip'}) is small
    assert files.get('/deep/a.js.br') is None


def test_a_picture_is_not_compressed_again(static):
    (static / 'a.png').write_bytes(b'png' * 500)
    assert StaticFiles(static).get('/a.png', {'gzip', 'br'}).encoding is None


def test_a_page_that_is_not_built_has_no_files(tmp_path):
    assert StaticFiles(tmp_path / 'nowhere').get('/index.html') is None
