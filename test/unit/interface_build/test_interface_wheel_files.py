# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""Wheels of interface packages: which packages, and what is in the file."""

import base64
import csv
import hashlib
import io
from pathlib import Path
import sys
import zipfile

import pytest
from support.public_interfaces import write_package

from amr_description.errors import InterfaceBuildError
from amr_description.interface_build import packages, records, wheel

PYTHON = 'cp{}{}'.format(*sys.version_info)


def test_packages_are_found_at_any_depth(tmp_path):
    write_package(tmp_path / 'src/repository/a', 'a_msgs', {'msg/A.msg': ''}, ['b_msgs'])
    write_package(tmp_path / 'src/b', 'b_msgs', {'msg/B.msg': ''})
    for ignored in ('build/b', '.git/b', 'src/kept/b'):
        write_package(tmp_path / ignored, 'c_msgs', {'msg/C.msg': ''})
    (tmp_path / 'src/kept/COLCON_IGNORE').touch()
    write_package(tmp_path / 'src/code', 'code', {'code.py': ''})
    found = wheel.find_interface_packages(tmp_path)
    assert [each.name for each in found] == ['b_msgs', 'a_msgs']
    assert [each.name for each in wheel.find_interface_packages(tmp_path / 'src/b')] == ['b_msgs']


def test_no_package_is_said(tmp_path):
    with pytest.raises(InterfaceBuildError, match=f'^{tmp_path}: no package.xml with interfaces'):
        wheel.find_interface_packages(tmp_path)


def test_messages_of_packages_that_are_built_together_are_known(tmp_path):
    write_package(tmp_path / 'a', 'a_msgs', {'msg/A.msg': 'b_msgs/C c\n'}, ['b_msgs'])
    write_package(tmp_path / 'b', 'b_msgs', {'msg/B.msg': 'int8 b\n'})
    found = wheel.find_interface_packages(tmp_path)
    with pytest.raises(InterfaceBuildError, match="A.msg:1:1: b_msgs has no message 'C'"):
        wheel.check(found, {})


def test_a_wheel_holds_what_is_staged_and_its_checksums(tmp_path):
    stage = tmp_path / 'stage'
    for path in ('python/my_msgs/__init__.py', 'lib/libmy_msgs.so', 'share/my_msgs/package.xml'):
        records.write_if_different(stage / path, path)
    built = wheel.write_wheel(stage, tmp_path, 'my-msgs', '1.2.3')
    assert built.name == f'my_msgs-1.2.3-{PYTHON}-{PYTHON}-linux_x86_64.whl'
    with zipfile.ZipFile(built) as archive:
        contents = {name: archive.read(name) for name in archive.namelist()}
    data = 'my_msgs-1.2.3.data/data'
    assert {'my_msgs/__init__.py', f'{data}/lib/libmy_msgs.so'} < contents.keys()
    rows = [*csv.reader(io.StringIO(contents['my_msgs-1.2.3.dist-info/RECORD'].decode()))]
    assert {row[0] for row in rows} == contents.keys()
    for path, checksum, size in rows[:-1]:
        digest = hashlib.sha256(contents[path]).digest()
        assert checksum == f'sha256={base64.urlsafe_b64encode(digest).decode().rstrip("=")}'
        assert int(size) == len(contents[path])
    assert list(tmp_path.glob('*.unfinished')) == []


def test_files_that_do_not_change_keep_their_time(tmp_path):
    source, target = tmp_path / 'source', tmp_path / 'deep/target'
    source.write_text('a')
    records.copy_if_different(source, target)
    before = target.stat()
    records.copy_if_different(source, target)
    after = target.stat()  # its time of access may be another: it was read
    assert (after.st_ino, after.st_mtime_ns) == (before.st_ino, before.st_mtime_ns)
    source.write_text('b')
    records.copy_if_different(source, target)
    assert target.read_text() == 'b'


def test_what_was_made_of_the_same_is_current(tmp_path):
    output, record, read = (tmp_path / name for name in ('output', 'record', 'in put'))
    read.write_text('1')
    (tmp_path / 'x.d').write_text(f'x.o: {str(read).replace(" ", chr(92) + " ")} \\\n {record}\n')
    assert records.dependencies(tmp_path / 'x.d') == [read, record]
    records.write(record, ['gcc'], [read])
    assert not records.is_current(output, record, ['gcc'])
    output.touch()
    assert records.is_current(output, record, ['gcc'])
    assert not records.is_current(output, record, ['gcc', '-O2'])
    read.write_text('12')
    assert not records.is_current(output, record, ['gcc'])


def test_the_first_prefix_has_a_package(tmp_path):
    for prefix in ('overlay', 'wheels'):
        (tmp_path / prefix / 'share/a_msgs/msg').mkdir(parents=True)
        (tmp_path / prefix / 'lib').mkdir()
        (tmp_path / prefix / 'lib/liba_msgs__rosidl_generator_c.so').touch()
    (tmp_path / 'overlay/share/code/msg').mkdir(parents=True)
    underlay = packages.find_underlay(tmp_path / 'wheels', [tmp_path / 'overlay'])
    assert underlay.prefixes == {'a_msgs': tmp_path / 'overlay'}
    assert underlay.overlays == (tmp_path / 'overlay',)
    assert underlay.library_folders == (tmp_path / 'overlay/lib', tmp_path / 'wheels/lib')
    assert underlay.share('a_msgs') == Path(tmp_path / 'overlay/share/a_msgs')
