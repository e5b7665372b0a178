# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""What scripts/release refuses, and what it writes, part by part; the whole: test_docs_pip.py."""

from argparse import Namespace
from datetime import date
import json
import os
from pathlib import Path
import re
import shutil
import subprocess
import sys
import zipfile

from ament_index_python.packages import get_package_prefix
from environment import SetupError
from environment.locks import Pin, pinned_versions
from environment.virtual_environment import WITHOUT_WHEEL
import pytest
from releasing import (
    archives,
    binaries,
    lock_hashes,
    locks,
    main,
    ReleaseError,
    sbom,
    sources,
    versions,
)
from releasing.archives import Member
from support.needs import need_program
from support.paths import ROOT
import yaml

LOCK = (ROOT / 'scripts/requirements.lock').read_text()
CHANGELOG = """# Changelog

## 0.2.0 (2026-03-01)

- New.

## 0.1.0

- Old.
"""
LIBRARY = 'libtf2_msgs__rosidl_typesupport_fastrtps_c.so'
EXTRA = 'the extra [ros] of pyproject.toml'
DECLARED = dict.fromkeys(
    ('package.xml', 'pyproject.toml', EXTRA, 'interfaces/pyproject.toml'), '0.2.0'
)
WHEEL = b'Wheel-Version: 1.0\nRoot-Is-Purelib: false\nTag: cp312-cp312-linux_x86_64\n\n'
NEEDS = """
a.so:     file format elf64-x86-64

Dynamic Section:
  NEEDED               {library}
  NEEDED               libc.so.6
  SONAME               liba.so

Version definitions:
1 0x01 0x0bafd179 GLIBC_9.9

Version References:
  required from libstdc++.so.6:
    0x0297f871 0x00 04 GLIBCXX_3.4.21
  required from libc.so.6:
    0x09691a75 0x00 02 {version}
"""


def test_every_file_names_the_same_version():
    assert set(versions.declared_versions(ROOT)) == {*DECLARED}
    assert re.fullmatch(
        r'\d+\.\d+\.\d+', versions.agreed_version(versions.declared_versions(ROOT))
    )


@pytest.mark.parametrize(
    ('changes', 'asked', 'fault'),
    [
        (
            {'pyproject.toml': '0.1.0'},
            None,
            'different versions: 0.2.0 in package.xml, 0.1.0',
        ),
        ({EXTRA: '0.1.0'}, None, '0.1.0 in the extra [ros] of pyproject.toml'),
        ({}, '0.3.0', 'asked for 0.3.0, found 0.2.0 in package.xml'),
        (dict.fromkeys(DECLARED, '0.2'), '0.2', '0.2 is no version MAJOR.MINOR.PATCH'),
    ],
)
def test_a_version_that_will_not_do(changes, asked, fault):
    assert versions.agreed_version(DECLARED, '0.2.0') == versions.agreed_version(DECLARED)
    with pytest.raises(ReleaseError, match=re.escape(fault)):
        versions.agreed_version(DECLARED | changes, asked)


def test_the_section_of_a_version_is_the_newest_and_dated():
    section = versions.section_of('0.2.0', CHANGELOG)
    assert section == ('0.2.0', '2026-03-01', '- New.')
    versions.check_date(section, date(2026, 3, 1))
    assert [each.version for each in versions.sections(CHANGELOG)] == ['0.2.0', '0.1.0']
    for text, version, fault in (
        (CHANGELOG, '0.3.0', 'want "## 0.3.0 (DATE)" on top, but its newest section is 0.2.0'),
        ('# Changelog\n', '0.3.0', 'but it has no section'),
        ('## 0.3.0\n\n', '0.3.0', 'the section 0.3.0 says nothing'),
    ):
        with pytest.raises(ReleaseError, match=re.escape(fault)):
            versions.section_of(version, text)
    for written, fault in (
        ('unreleased', 'write "## 0.2.0 (2026-02-28)" in place of (unreleased)'),
        ('', 'in place of (no date)'),
        ('2026-02-30', 'in place of (2026-02-30)'),
        ('2026-03-01', '2026-03-01 is to come'),
    ):
        with pytest.raises(ReleaseError, match=re.escape(fault)):
            versions.check_date(section._replace(date=written), date(2026, 2, 28))


def test_the_changelog_has_a_section_for_this_version():
    version = versions.agreed_version(versions.declared_versions(ROOT))
    assert versions.section_of(version, (ROOT / 'CHANGELOG.md').read_text()).text


def test_the_front_page_may_not_say_that_it_is_not_released():
    versions.check_readme('0.2.0', '0.1.0 is not released yet')
    with pytest.raises(ReleaseError, match='README.md says "0.2.0 is not released yet"'):
        versions.check_readme('0.2.0', 'x 0.2.0 is not released yet (')


@pytest.fixture
def checkout(tmp_path):
    """A small repository of version 0.2.0, committed, and a function that calls git in it."""
    need_program('git', 'git')
    root = tmp_path / 'repository'
    files = {
        'package.xml': '<package><version>0.2.0</version></package>',
        'pyproject.toml': '[project]\nversion = "0.2.0"\n'
        '[project.optional-dependencies]\nros = ["amr-description-ros==0.2.0"]\n',
        'interfaces/pyproject.toml': '[project]\nversion = "0.2.0"\n',
        'CHANGELOG.md': CHANGELOG,
        'README.md': '# x\n',
        '.gitignore': '*.log\n',
    }
    for name, text in files.items():
        (root / name).parent.mkdir(parents=True, exist_ok=True)
        (root / name).write_text(text)

    def git(*words):
        identity = ['-c', 'user.name=x', '-c', 'user.email=x@y.z', '-c', 'init.defaultBranch=main']
        when = {'GIT_COMMITTER_DATE': '1700000000 +0000', 'PATH': os.environ['PATH']}
        subprocess.run(['git', '-C', root, *identity, *words], check=True, env=when, stdout=-3)

    git('init')
    git('add', '.')
    git('commit', '-m', 'x')
    return root, git


def test_what_is_checked_before_anything_is_built(checkout):
    root, git = checkout
    options = Namespace(version=None, draft=False)

    def refused(fault):
        with pytest.raises(ReleaseError, match=re.escape(fault)):
            main.checked(root, options)
        assert main.checked(root, Namespace(version=None, draft=True))[0] == '0.2.0'

    git('tag', 'v0.2.0')
    assert main.checked(root, options) == ('0.2.0', ('0.2.0', '2026-03-01', '- New.'))
    (root / 'ignored.log').touch()
    main.checked(root, options)
    for name in ('a', 'b', 'c', 'd'):
        (root / name).touch()
    refused('not committed: a, b, c and 1 more; commit or stash, or try with --draft')
    git('add', '.')
    git('commit', '-m', 'y')
    refused('v0.2.0 is the tag of ')
    git('tag', '-d', 'v0.2.0')
    (root / 'README.md').write_text('0.2.0 is not released yet')
    refused('take that away')
    (root / 'pyproject.toml').write_text('[project]')
    with pytest.raises(ReleaseError, match=r'^pyproject.toml names no version'):
        main.checked(root, options)


def test_sources_are_what_git_knows_and_have_the_time_of_the_commit(checkout, tmp_path):
    root, _ = checkout
    (root / 'ignored.log').touch()
    (root / 'new').touch()
    (root / 'README.md').unlink()
    sources.copy(root, tmp_path / 'copy')
    names = {str(path.relative_to(tmp_path / 'copy')) for path in (tmp_path / 'copy').rglob('*.*')}
    assert 'ignored.log' not in names
    assert 'README.md' not in names
    assert 'interfaces/pyproject.toml' in names
    assert (tmp_path / 'copy/new').is_file()
    assert sources.time_of(root, {}) == 1700000000
    assert sources.time_of(root, {'SOURCE_DATE_EPOCH': '17'}) == 17
    with pytest.raises(ReleaseError, match='SOURCE_DATE_EPOCH=today: want seconds since 1970'):
        sources.time_of(root, {'SOURCE_DATE_EPOCH': 'today'})
    with pytest.raises(ReleaseError, match='git log: fatal: '):
        sources.time_of(tmp_path, {})


def test_the_same_contents_are_the_same_wheel(tmp_path):
    members = {
        'b.py': Member(b'b = 1\n'),
        'a.data/scripts/a': Member(b'#!/bin/sh\n', True),
        'a-1.dist-info/WHEEL': Member(WHEEL),
    }
    first, second = tmp_path / 'first', tmp_path / 'second'
    for folder, content in ((first, members), (second, dict(reversed(members.items())))):
        folder.mkdir()
        tagged = archives.retagged(content, 'cp312-cp312-manylinux_2_28_x86_64')
        archives.write(tagged, folder, 1700000000)
    name = 'a-1-cp312-cp312-manylinux_2_28_x86_64.whl'
    assert (first / name).read_bytes() == (second / name).read_bytes()
    found = archives.read(first / name)
    assert found['a.data/scripts/a'] == members['a.data/scripts/a']
    assert found['b.py'] == members['b.py']
    assert b'linux_x86_64\n' not in found['a-1.dist-info/WHEEL'].content.replace(b'_2_28_x', b'')
    with zipfile.ZipFile(first / name) as archive:
        record = archive.read('a-1.dist-info/RECORD').decode().splitlines()
        assert {info.date_time for info in archive.infolist()} == {(2023, 11, 14, 22, 13, 20)}
    assert record[-1] == 'a-1.dist-info/RECORD,,'
    assert record[-2] == 'b.py,sha256=gUX_t65JGJopeG1462lec2_LCDSw2TGVrYE3FgyotKk,6'


@pytest.mark.parametrize(
    ('version', 'fits'),
    [
        ('GLIBC_2.2.5', True),
        ('GLIBC_2.28', True),
        ('GLIBC_2.29', False),
        ('GLIBC_ABI_DT_RELR', False),
        ('GLIBC_PRIVATE', False),
        ('GLIBCXX_3.4', True),
        ('GLIBCXX_3.4.32', False),
        ('CXXABI_1.3.11', True),
        ('CXXABI_1.3.13', False),
        ('GCC_3.0', True),
        ('OMP_1.0', False),
    ],
)
def test_versions_that_the_oldest_system_has(version, fits):
    text = NEEDS.format(library='libx.so', version=version)
    assert binaries.needed_versions(text) == ['GLIBCXX_3.4.21', version]
    found = list(binaries.faults('a.so', text, {'libx.so'}))
    assert found == ([] if fits else [f'a.so needs {version}'])


def test_libraries_are_those_of_the_system_or_of_a_wheel():
    text = NEEDS.format(library='libx.so', version='GLIBC_2.4')
    assert list(binaries.faults('a.so', text, ())) == ['a.so needs libx.so, which no wheel has']
    assert binaries.newest(['GLIBC_2.4', 'GLIBC_2.17', 'GCC_3.0']) == {
        'GCC': '3.0',
        'GLIBC': '2.17',
    }


@pytest.mark.skipif(Path(sys.prefix) != ROOT / '.venv', reason='needs .venv')
def test_a_library_is_read_by_objdump(tmp_path, monkeypatch):
    need_program('objdump', 'binutils')
    shutil.copy(Path(get_package_prefix('tf2_msgs'), 'lib', LIBRARY), tmp_path)
    provided = {path.name for path in Path(sys.prefix, 'lib').glob('*.so*')}
    assert binaries.check(tmp_path, provided)['GLIBC'].startswith('2.')
    assert [name for name in binaries.compilers(tmp_path.iterdir()) if re.search(r'\d', name)]
    with pytest.raises(ReleaseError, match=r'needs lib\S+, which no wheel has \('):
        binaries.check(tmp_path, ())
    (tmp_path / 'broken.so').write_text('text')
    with pytest.raises(ReleaseError, match='objdump: .*broken.so: file format not recognized'):
        binaries.check(tmp_path, provided)
    monkeypatch.setenv('PATH', str(tmp_path))
    with pytest.raises(ReleaseError, match='there is no objdump here'):
        binaries.check(tmp_path, provided)


def test_users_get_the_lock_without_what_is_for_developers():
    pins = {pin.name for pin in locks.released_pins(LOCK)}
    assert {*pinned_versions(LOCK, (3, 12))} - pins == {*locks.DEVELOPMENT}
    for name in ('ros-jazzy-rclpy', 'mujoco', 'colcon-core', 'pytest', 'setuptools', 'empy'):
        assert name in pins
    with pytest.raises(
        ReleaseError, match='requirements.lock no longer has apsw, backports.zstd, '
    ):
        locks.released_pins('numpy==1\n')
    with pytest.raises(ReleaseError, match='want one NAME==VERSION'):
        locks.released_pins('numpy>=1\n')


def test_nothing_that_users_get_imports_what_is_for_developers():
    imports = re.compile(rf'^ *(?:import|from) ({"|".join(locks.DEVELOPMENT)})\b', re.MULTILINE)
    users = [path for path in (ROOT / 'amr_description').rglob('*.py')]
    assert [path for path in users if imports.search(path.read_text())] == []


def test_hashes_are_those_that_pip_reports():
    def item(name, digest):
        info = {'archive_info': {'hashes': {'sha256': digest}}} if digest else {'dir_info': {}}
        return {'metadata': {'name': name}, 'download_info': info}

    report = {'install': [item('PyYAML', '1f'), item('ros_rcl', '2e')]}
    assert lock_hashes.hashes_in_report(report, ['ros-rcl', 'pyyaml']) == {
        'ros-rcl': 'sha256:2e',
        'pyyaml': 'sha256:1f',
    }
    report['install'][0] = item('PyYAML', '')
    with pytest.raises(SetupError, match='gives no SHA-256 of PyYAML, numpy'):
        lock_hashes.hashes_in_report(report, ['PyYAML', 'ros-rcl', 'numpy'])


def test_requirements_have_a_version_and_a_hash_each():
    pins = [
        Pin('a', '1', '', ('sha256:0a', 'sha256:0b')),
        Pin('b', '2', 'python_version < "3.12"'),
    ]
    text = locks.requirements_text('0.2.0', pins, 'r.txt', '3.12, 3.13')
    lines = [line for line in text.splitlines() if not line.startswith('#')]
    assert lines == [
        '--find-links .',
        '--only-binary :all:',
        'a==1 \\',
        '    --hash=sha256:0a \\',
        '    --hash=sha256:0b',
        'b==2 ; python_version < "3.12"',
    ]
    assert 'pip install --no-deps -r r.txt' in text
    assert 'for CPython 3.12, 3.13 on x86-64' in text


def test_a_folder_with_other_things_is_not_replaced(tmp_path):
    for name in ('fresh', 'target'):
        (tmp_path / name).mkdir()
    (tmp_path / 'fresh/wheel').write_text('new')
    (tmp_path / 'target/thesis').touch()
    with pytest.raises(ReleaseError, match='holds other things than a release'):
        main._replace(tmp_path / 'target', tmp_path / 'fresh')
    (tmp_path / 'target/SHA256SUMS').touch()
    main._replace(tmp_path / 'target', tmp_path / 'fresh')
    assert [path.name for path in (tmp_path / 'target').iterdir()] == ['wheel']
    assert main.sums(tmp_path / 'target').endswith('  wheel\n')


def test_wheels_without_their_own_are_known():
    assert {*WITHOUT_WHEEL} <= {*pinned_versions(LOCK)}


def test_the_workflow_makes_what_the_script_makes():
    workflow = yaml.safe_load((ROOT / '.github/workflows/release.yml').read_text())
    steps = [step for job in workflow['jobs'].values() for step in job['steps']]
    commands = '\n'.join(step.get('run', '') for step in steps)
    assert 'scripts/release "${GITHUB_REF_NAME#v}" "${others[@]}"\n' in commands
    for name in (main.SUMS, main.NOTES):
        assert f' {name}' in commands or f'/{name}' in commands


def test_the_bill_of_materials_names_every_package_with_its_hash():
    versions_of = {'amr_description': '0.2.0', 'PyYAML': '6.0.3', 'ros-rclpy': '7.1.6'}
    pins = [
        Pin(name, version, '', (f'sha256:{str(number) * 64}', 'sha256:' + 'f' * 64))
        for number, (name, version) in enumerate(versions_of.items())
    ]
    text = sbom.text('0.2.0', pins, 1_700_000_000)
    bill = json.loads(text)
    assert (bill['bomFormat'], bill['specVersion']) == ('CycloneDX', '1.5')
    assert bill['metadata']['component']['version'] == '0.2.0'
    assert bill['metadata']['timestamp'] == '2023-11-14T22:13:20+00:00'
    found = {each['purl']: each['hashes'][0]['content'] for each in bill['components']}
    assert found == {
        'pkg:pypi/amr-description@0.2.0': '0' * 64,
        'pkg:pypi/pyyaml@6.0.3': '1' * 64,
        'pkg:pypi/ros-rclpy@7.1.6': '2' * 64,
    }
    refs = {each['bom-ref'] for each in bill['components']} | {'release'}
    for each in bill['dependencies']:
        assert {each['ref'], *each['dependsOn']} <= refs
    assert {len(each['hashes']) for each in bill['components']} == {2}
    assert sbom.text('0.2.0', reversed(pins), 1_700_000_000) == text
    other = pins[1]._replace(version='6.0.4')
    assert sbom.text('0.2.0', [pins[0], other, pins[2]], 1_700_000_000) != text
