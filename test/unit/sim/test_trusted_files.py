# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""Which files a request to the simulator may name."""

import os

import pytest
from support.needs import need

from amr_description.errors import RequestError
from amr_description.sim.ros.trusted_files import distrust, folder_of

OTHER = 65534


@pytest.fixture
def file(tmp_path):
    path = tmp_path / 'folder' / 'robot.urdf.xacro'
    path.parent.mkdir(mode=0o755)
    path.write_text('<robot/>')
    path.chmod(0o644)
    return path


def test_a_file_of_ours_is_taken(file):
    assert distrust(file) == ''
    assert distrust(file.parent / '..' / 'folder' / file.name) == ''


def test_one_that_is_not_there_is_left_to_its_reader(tmp_path):
    assert distrust(tmp_path / 'none') == ''


def test_pipes_devices_and_folders_are_no_files(tmp_path):
    os.mkfifo(tmp_path / 'pipe')
    (tmp_path / 'link').symlink_to('/dev/zero')
    for name in ('pipe', 'link', '.'):
        assert distrust(tmp_path / name) == 'is no regular file'


@pytest.mark.parametrize('what', ['file', 'folder'])
def test_what_others_may_write_to_is_not_taken(file, what):
    shared = file if what == 'file' else file.parent
    shared.chmod(0o777)
    assert f'is not taken from a request: others may write to {shared};' in distrust(file)
    shared.chmod(0o1777 if what == 'folder' else 0o644)
    assert distrust(file) == '', 'a folder as /tmp'


def test_nor_by_a_link_to_it(file, tmp_path):
    file.parent.chmod(0o777)
    link = tmp_path / 'ours.xacro'
    link.symlink_to(file)
    assert 'others may write to' in distrust(link)


@pytest.mark.parametrize('what', ['file', 'folder'])
def test_what_belongs_to_another_user_is_not_taken(file, what):
    need(os.geteuid() == 0, 'only root can give files to another user; run it as root')
    theirs = file if what == 'file' else file.parent
    os.chown(theirs, OTHER, OTHER)
    assert f'{theirs} belongs to the user {OTHER};' in distrust(file)


def test_files_of_packages_are_everybodys(file, monkeypatch):
    file.chmod(0o666)
    monkeypatch.setenv('AMENT_PREFIX_PATH', str(file.parent))
    assert distrust(file) == ''
    assert distrust(file.parent / '..' / 'folder' / file.name) == ''
    outside = file.parent.parent / 'outside'
    outside.write_text('')
    outside.chmod(0o666)
    assert distrust(file.parent / '..' / 'outside') != ''


@pytest.mark.parametrize('name', ['none', 'x' * 3000, 'a\0b'])
def test_a_folder_that_cannot_be_is_none(tmp_path, name):
    assert folder_of(str(tmp_path)) == tmp_path
    with pytest.raises(RequestError):
        folder_of(str(tmp_path / name))
    assert distrust(tmp_path / name) == ''
