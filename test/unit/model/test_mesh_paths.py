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
