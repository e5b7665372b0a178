# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""What CMake calls: its request, and when there is nothing to do."""

from pathlib import Path

import pytest
from support.public_interfaces import write_package

from amr_description.interface_build import cmake_target

USED = ('other_msgs', 'Other')


@pytest.fixture
def request_text(tmp_path):
    write_package(tmp_path / 'src', 'my_msgs', {'msg/A.msg': 'other_msgs/Other o\n'})
    other = tmp_path / 'other/share/other_msgs/msg'
    other.mkdir(parents=True)
    for name in ('Other', 'Unused'):
        (other / f'{name}.json').write_text('1')
    return (
        f'name=my_msgs\nsource={tmp_path}/src\nbuild={tmp_path}/build\n'
        f'install={tmp_path}/install\ninterface=msg/A.msg\ndependency=other_msgs\n'
    )


@pytest.fixture
def builds(request_text, tmp_path, monkeypatch):
    """A function that brings the package up to date; says whether there was anything to do."""

    def make(request, _prefixes):
        request.stage.mkdir(parents=True, exist_ok=True)
        return frozenset({USED})

    monkeypatch.setattr(cmake_target, '_build', make)

    def build(text=request_text):
        return cmake_target.build(cmake_target.read_request(text), text, [tmp_path / 'other'])

    return build


def test_a_request(request_text, tmp_path):
    text = f'{request_text}interface=/made:srv/B.srv\n'
    request = cmake_target.read_request(text)
    assert request.interfaces == (
        (tmp_path / 'src', Path('msg/A.msg')),
        (Path('/made'), Path('srv/B.srv')),
    )
    assert request.dependencies == {'other_msgs'}


def test_the_same_is_built_once(builds):
    assert builds()
    assert not builds()


@pytest.mark.parametrize(
    ('file', 'needs_build'),
    [
        ('src/msg/A.msg', True),
        ('src/package.xml', True),
        ('other/share/other_msgs/msg/Other.json', True),
        ('other/share/other_msgs/msg/Unused.json', False),
    ],
)
def test_only_what_it_depends_on_makes_it_stale(builds, tmp_path, file, needs_build):
    builds()
    with (tmp_path / file).open('a') as stream:
        stream.write('\n')
    assert builds() == needs_build
    assert not builds()


def test_another_list_of_files_begins_anew(builds, request_text, tmp_path):
    builds()
    left = tmp_path / 'build/stage/lib/left.so'
    left.parent.mkdir()
    left.touch()
    assert builds(request_text.replace('dependency', 'interface=msg/A.msg\ndependency'))
    assert not left.exists()


def test_a_build_that_failed_is_not_up_to_date(builds, tmp_path, monkeypatch):
    builds()
    (tmp_path / 'src/msg/A.msg').write_text('int8 a\n')

    def fail(*_):
        raise KeyboardInterrupt

    with monkeypatch.context() as broken:
        broken.setattr(cmake_target, '_build', fail)
        with pytest.raises(KeyboardInterrupt):
            builds()
    assert builds()


def test_a_fault_of_rosidl_is_one_line(request_text, tmp_path, monkeypatch, capsys):
    monkeypatch.setattr(cmake_target, 'build', lambda *_: 1 / 0)
    (tmp_path / 'build').mkdir()
    (tmp_path / 'request').write_text(request_text)
    assert cmake_target.main([str(tmp_path / 'request')]) == 1
    (line,) = capsys.readouterr().err.splitlines()
    assert line == (
        f'{tmp_path}/src: rosidl fails: ZeroDivisionError: division by zero; '
        f'where: {tmp_path}/build/failure.log'
    )
    assert 'Traceback' in (tmp_path / 'build/failure.log').read_text()
