# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""Notes on the files that a stack uses, and warnings where another copy differs."""

import hashlib
import os
import shutil

import pytest

from amr_description.bringup.input_files import notes_on

URDF = '<robot name="cart"><link name="base"/></robot>'


def build(workspace, *, copy, merged=False):
    """Install the package of a workspace, as colcon does."""
    source = workspace / 'src/robots/cart'
    prefix = workspace / 'install' if merged else workspace / 'install/cart'
    (workspace / 'build/cart').mkdir(parents=True, exist_ok=True)
    index = prefix / 'share/ament_index/resource_index/packages'
    index.mkdir(parents=True, exist_ok=True)
    (index / 'cart').touch()
    for file in [*source.glob('urdf/*'), source / 'package.xml']:
        target = prefix / 'share/cart' / file.relative_to(source)
        target.parent.mkdir(parents=True, exist_ok=True)
        target.unlink(missing_ok=True)
        if copy:
            shutil.copy2(file, target)
        else:
            target.symlink_to(file)
    return prefix


@pytest.fixture
def workspace(tmp_path, monkeypatch):
    """A workspace with the sources of one package; what it installs is on the path."""
    source = tmp_path / 'src/robots/cart'
    (source / 'urdf').mkdir(parents=True)
    (source / 'package.xml').write_text('<package><name>cart</name></package>')
    (source / 'urdf/cart.urdf').write_text(URDF)
    prefixes = [tmp_path / 'install/cart', tmp_path / 'install']
    monkeypatch.setenv('AMENT_PREFIX_PATH', os.pathsep.join(map(str, prefixes)))
    return tmp_path


def source_file(workspace, name='cart.urdf'):
    return workspace / 'src/robots/cart/urdf' / name


def warnings(*files):
    return [text for level, text in notes_on(files) if level == 'WARNING']


def digest(text):
    return f'sha256 {hashlib.sha256(text.encode()).hexdigest()[:12]}'


def edit(file, text, later):
    """Save another text, by the clock of the file system ``later`` seconds after the first."""
    saved = file.stat().st_mtime
    file.write_text(text)
    os.utime(file, (saved + later, saved + later))


def test_every_file_is_noted_with_its_hash_and_the_target_of_a_link(workspace):
    installed = build(workspace, copy=False) / 'share/cart/urdf/cart.urdf'
    ((level, text),) = notes_on([installed])
    assert level == 'INFO'
    assert text.startswith(f'using {installed} -> {source_file(workspace)} ({digest(URDF)}, saved')


@pytest.mark.parametrize('merged', [False, True])
@pytest.mark.parametrize(('later', 'age'), [(60, 'newer'), (-60, 'older')])
def test_a_stale_installed_file_is_reported_with_paths_and_hashes(workspace, merged, later, age):
    prefix = build(workspace, copy=True, merged=merged)
    installed = prefix / 'share/cart/urdf/cart.urdf'
    source = source_file(workspace)
    assert warnings(installed) == []
    edited = URDF.replace('base', 'frame')
    edit(source, edited, later)
    (warning,) = warnings(installed)
    assert warning == (
        f'{installed} ({digest(URDF)}) is used; its source, {source} ({digest(edited)}, {age}), '
        'is not the same; run scripts/setup, or colcon build --symlink-install, which links '
        'instead of copying'
    )
    build(workspace, copy=True, merged=merged)
    assert warnings(installed) == []


def test_a_source_file_whose_installed_copy_differs_is_reported(workspace):
    installed = build(workspace, copy=True) / 'share/cart/urdf/cart.urdf'
    source = source_file(workspace)
    assert warnings(source) == []
    edit(source, URDF.replace('base', 'frame'), 60)
    (warning,) = warnings(source)
    assert f'{source} (' in warning
    assert f'the installed copy, {installed} ({digest(URDF)}, older), is not the same' in warning


def test_links_are_never_stale(workspace):
    installed = build(workspace, copy=False) / 'share/cart/urdf/cart.urdf'
    edit(source_file(workspace), URDF.replace('base', 'frame'), 60)
    assert warnings(installed, source_file(workspace)) == []


def test_files_that_a_xacro_file_may_include_are_compared(workspace):
    for name in ('cart.urdf.xacro', 'wheel.xacro', 'sizes.yaml'):
        source_file(workspace, name).write_text(URDF)
    installed = build(workspace, copy=True) / 'share/cart/urdf/cart.urdf.xacro'
    edit(source_file(workspace, 'wheel.xacro'), URDF.replace('base', 'frame'), 60)
    (warning,) = warnings(installed)
    assert warning.startswith(str(installed.with_name('wheel.xacro')))
    assert warnings(installed.with_name('cart.urdf')) == []


def test_files_outside_of_built_packages_are_only_named(workspace, tmp_path):
    lone = tmp_path / 'lone.urdf'
    lone.write_text(URDF)
    assert [level for level, _ in notes_on([lone, source_file(workspace)])] == ['INFO', 'INFO']
