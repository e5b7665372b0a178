# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""Relative paths of a description, made absolute where its file is known."""

from urllib.parse import unquote, urlsplit

from hypothesis import given, strategies as st
from lxml import etree
import pytest

from amr_description.ament_index import resolve_uri
from amr_description.bringup.urdf_text import robot_description
from amr_description.model.description_file import description_at
from amr_description.model.mesh_paths import with_absolute_paths


@pytest.fixture
def folder(tmp_path):
    (tmp_path / 'meshes').mkdir()
    for name in ('a.stl', "b & 'c' %20#.stl", 'wood.png'):
        (tmp_path / 'meshes' / name).write_text('x')
    return tmp_path


def names(text):
    return [each.get('filename') for each in etree.fromstring(text).iter('mesh', 'texture')]


def test_a_path_beside_the_file_becomes_a_uri_that_means_it(folder):
    odd = "meshes/b &amp; 'c' %20#.stl"
    text = f"""<robot name="r">
<mesh scale="1 1 1" filename="meshes/a.stl"/><mesh filename='meshes/a.stl'/>
<mesh
  filename="{odd}"/><texture filename="./meshes/wood.png"/></robot>"""
    found = with_absolute_paths(text, folder)
    assert found.count('\n') == text.count('\n')
    a, again, b, wood = names(found)
    assert a == again == f'file://{folder}/meshes/a.stl'
    assert unquote(urlsplit(b).path) == str(folder / 'meshes' / "b & 'c' %20#.stl")
    assert resolve_uri(b).is_file()
    assert wood == f'file://{folder}/meshes/wood.png'


@pytest.mark.parametrize(
    'name',
    ['package://p/a.stl', 'file:///a.stl', '/a.stl', 'http://h/a.stl', 'gone.stl', '', '~/a.stl',
     '$(find p)/a.stl', 'meshes', 'a' * 300],
)  # fmt: skip
def test_other_names_stay(folder, name):
    text = f'<robot><mesh filename="{name}"/><box filename="meshes/a.stl"/></robot>'
    assert with_absolute_paths(text, folder) == text


def test_a_package_that_is_not_installed_is_found_in_its_sources(tmp_path, monkeypatch):
    monkeypatch.setenv('AMENT_PREFIX_PATH', str(tmp_path / 'nothing'))
    mesh = tmp_path / 'src' / 'my_robot' / 'meshes' / 'a.stl'
    folder = tmp_path / 'src' / 'my_robot_bringup' / 'urdf'
    for each in (mesh.parent, folder):
        each.mkdir(parents=True)
    mesh.write_text('x')
    text = '<robot><mesh filename="package://my_robot/meshes/a.stl"/></robot>'
    other = text.replace('a.stl', 'b.stl')
    assert with_absolute_paths(other, folder) == other
    assert names(with_absolute_paths(text, folder)) == [f'file://{mesh}']
    assert names(with_absolute_paths(text, mesh.parents[1] / 'urdf')) == [f'file://{mesh}']
    model = text.replace('package', 'model')
    assert names(with_absolute_paths(model, folder)) == [f'file://{mesh}']


def test_a_model_is_found_where_gazebo_looks(tmp_path, monkeypatch):
    (tmp_path / 'crate' / 'meshes').mkdir(parents=True)
    (tmp_path / 'crate' / 'meshes' / 'a.stl').write_text('x')
    monkeypatch.setenv('GZ_SIM_RESOURCE_PATH', f'/nowhere:{tmp_path}')
    assert resolve_uri('model://crate/meshes/a.stl') == tmp_path / 'crate' / 'meshes' / 'a.stl'


def test_a_relative_file_uri_is_beside_the_description(folder):
    for uri in ('file://meshes/a.stl', 'file:meshes/a.stl', 'file://./meshes/a.stl'):
        assert resolve_uri(uri, folder).is_file()
        text = f'<robot><mesh filename="{uri}"/></robot>'
        assert names(with_absolute_paths(text, folder)) == [f'file://{folder}/meshes/a.stl']


@given(st.text(st.sampled_from('<mesh filename="\'/> a=\n\0'), max_size=200))
def test_any_text_is_passed_on(tmp_path_factory, text):
    assert with_absolute_paths(text, tmp_path_factory.getbasetemp() / 'gone') == text


def test_whatever_passes_a_description_on_does_so(folder):
    path = folder / 'r.urdf'
    path.write_text('<robot name="r"><mesh filename="meshes/a.stl"/></robot>')
    xacro = folder / 'r.urdf.xacro'
    xacro.write_text(path.read_text())
    expected = [f'file://{folder}/meshes/a.stl']
    for each in (path, xacro):
        assert names(robot_description(str(each))) == expected
        assert names(description_at(str(each), warn=print)) == expected
    assert names(description_at(f'file://{path}', warn=print)) == expected
