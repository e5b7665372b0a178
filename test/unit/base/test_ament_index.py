# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""The ament index is read as ament_index_python reads it, and without it."""

import os
import subprocess
import sys

from ament_index_python import get_package_prefix, get_packages_with_prefixes
import pytest
from support.paths import ROOT

from amr_description.ament_index import hint_at, package_prefix, packages
from amr_description.errors import DescriptionError, ResourceError
from amr_description.model.description_file import description_text

INDEX = 'share/ament_index/resource_index/packages'
FINDS = """
<robot name="cart" xmlns:xacro="http://www.ros.org/wiki/xacro">
  <xacro:include filename="$(find wheels)/wheel.xacro"/>
</robot>
"""


@pytest.fixture
def index(tmp_path, monkeypatch):
    """Two workspaces and a folder that is not there; one package is in both."""
    for prefix, names in (('upper', ['cart', 'wheels_2']), ('lower', ['cart', 'arm', '.hidden'])):
        folder = tmp_path / prefix / INDEX
        folder.mkdir(parents=True)
        for name in names:
            (folder / name).touch()
    (tmp_path / 'lower' / INDEX / 'folder').mkdir()
    paths = [tmp_path / name for name in ('upper', 'nowhere', 'lower')]
    monkeypatch.setenv('AMENT_PREFIX_PATH', os.pathsep.join(map(str, paths)))
    return tmp_path


def test_the_first_prefix_that_has_a_package_counts(index):
    found = packages()
    assert list(found) == ['arm', 'cart', 'wheels_2']
    assert found['cart'] == package_prefix('cart') == index / 'upper'
    assert package_prefix('arm') == index / 'lower'
    assert {name: str(path) for name, path in found.items()} == get_packages_with_prefixes()
    assert str(package_prefix('cart')) == get_package_prefix('cart')


@pytest.mark.parametrize('name', ['car', '.hidden', 'folder', '../cart', '', 'a' * 5000, 'a\0'])
def test_what_is_no_package_is_not_found(index, name):
    with pytest.raises(ResourceError, match='not found, searching: ') as refusal:
        package_prefix(name)
    assert ('did you mean' in str(refusal.value)) is ('car' in name)


@pytest.mark.parametrize(
    ('prefix', 'words'),
    [('', 'AMENT_PREFIX_PATH is empty; source'), ('upper', 'did you mean wheels_2')],
)
def test_find_without_the_package_says_what_would_do(index, monkeypatch, prefix, words):
    monkeypatch.setenv('AMENT_PREFIX_PATH', prefix and str(index / prefix))
    file = index / 'cart.urdf.xacro'
    file.write_text(FINDS)
    with pytest.raises(DescriptionError, match=f"package 'wheels' not found.*{words}"):
        description_text(file)


def test_it_needs_no_package_of_ros():
    code = (
        'import sys; sys.modules["ament_index_python"] = None\n'
        'from amr_description.model.description_file import description_at\n'
        'print(len(description_at("package://amr_description/urdf/amr_sensors.urdf.xacro",'
        ' warn=print)))'
    )
    environment = {**os.environ, 'PYTHONPATH': str(ROOT), 'AMENT_PREFIX_PATH': ''}
    run = subprocess.run(
        [sys.executable, '-c', code], env=environment, check=True, stdout=subprocess.PIPE
    )
    assert int(run.stdout) > 10_000


def test_a_file_that_would_be_found_from_a_folder_below_is_said(tmp_path, monkeypatch):
    """The line of a page, typed at the root of the checkout."""
    monkeypatch.chdir(tmp_path)
    asked = tmp_path / 'urdf' / 'rover[1].urdf'
    assert hint_at(asked) == ''
    for folder in ('examples/rover', 'mine'):
        (tmp_path / folder / 'urdf').mkdir(parents=True)
        (tmp_path / folder / 'urdf' / asked.name).touch()
    assert hint_at(asked) == '; it is in mine and in examples/rover: cd mine'
    assert hint_at(asked.parent) == hint_at(tmp_path) == '', 'folders are no files'
    with pytest.raises(DescriptionError, match=r'No such file or directory; it is in mine and'):
        description_text(f'urdf/{asked.name}')


def test_in_a_folder_that_is_gone_nothing_is_known(tmp_path, monkeypatch):
    (tmp_path / 'gone').mkdir()
    monkeypatch.chdir(tmp_path / 'gone')
    (tmp_path / 'gone').rmdir()
    with pytest.raises(DescriptionError, match='No such file or directory$'):
        description_text('robot.urdf')
