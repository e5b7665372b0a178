# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""Which files a request to the simulator may name."""

import os
from pathlib import Path
import subprocess
import sys

import pytest
from support.needs import need

from amr_description.trusted_files import distrust, distrust_argument, distrust_new

OTHER = 65534


@pytest.fixture
def file(open_path):
    path = open_path / 'folder' / 'robot.urdf.xacro'
    path.parent.mkdir()
    path.write_text('<robot/>')
    path.parent.chmod(0o755)
    path.chmod(0o644)
    return path


def test_a_file_of_ours_is_taken(file):
    assert distrust(file) == ''
    assert distrust(file.parent / '..' / 'folder' / file.name) == ''


@pytest.mark.parametrize('name', ['none', 'x' * 3000, 'a\0b'])
def test_one_that_is_not_there_is_left_to_its_reader(tmp_path, name):
    assert distrust(tmp_path / name) == ''


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


def test_what_not_everybody_may_read_is_not_told_to_who_asks(file, monkeypatch):
    file.parent.chmod(0o750)
    assert distrust(file) == '', 'in a home of Ubuntu'
    file.chmod(0o640)
    assert f'is not taken from a request: not everybody may read {file};' in distrust(file)
    monkeypatch.setenv('AMENT_PREFIX_PATH', str(file.parent))
    assert distrust(file) == '', 'of a package'


def test_a_guarded_process_reads_what_a_request_may_name(file):
    """Python itself is read, wherever it is; of links it is where they lead that counts."""
    secret = file.with_name('secret')
    secret.write_text('a secret')
    secret.chmod(0o600)
    link = file.with_name('link')
    link.symlink_to(secret)
    code = (
        'import sys; from amr_description.trusted_files import guard_reads; guard_reads()\n'
        'import wave, yaml\n'
        'for path in sys.argv[1:]:\n'
        '    try: print(open(path).read())\n'
        '    except (OSError, ValueError) as error: print(type(error).__name__, error)\n'
    )
    words = [sys.executable, '-c', code, file, secret, link, file.with_name('none')]
    done = subprocess.run(words, capture_output=True, text=True, check=True)
    text, *refusals, missing = done.stdout.splitlines()
    assert text == '<robot/>'
    assert len(refusals) == 2
    for refusal in refusals:
        assert refusal.startswith('PermissionError')
        assert f'not everybody may read {secret}' in refusal
    assert missing.startswith('FileNotFoundError')


@pytest.mark.parametrize('value', ['', '0.2', '-1e3', 'true', 'package://a/b.stl', 'a b', 'ü_1'])
def test_plain_arguments_are_taken(value):
    assert distrust_argument('a', value) == ''


@pytest.mark.parametrize(
    'value',
    ['f()', '9**9**9', '${1}', '$(env HOME)', '[1]', "'a'", '"a"', 'a\n', '{}', 'a;b', '`'],
)
def test_an_argument_that_could_be_an_expression_is_not_taken(value):
    reason = distrust_argument('wide', value)
    assert reason.startswith('the argument wide is not taken from a request: it is ')
    assert 'create -file' in reason
    assert '\n' not in reason


def test_a_new_folder_is_below_a_place_where_others_change_nothing(open_path):
    assert distrust_new(Path('a/b'), open_path) == ''
    assert distrust_new(open_path / 'a', open_path) == ''
    assert distrust_new(Path('a'), Path('/')) == ''
    assert f'is not below {open_path}' in distrust_new(Path('/'), open_path)
    shared = open_path / 'shared'
    shared.mkdir()
    shared.chmod(0o777)
    assert f'others may write to {shared};' in distrust_new(shared / 'a' / 'b', open_path)
    assert distrust_new(Path('a'), shared) != ''
