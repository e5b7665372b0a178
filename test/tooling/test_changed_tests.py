# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""Which tests ``scripts/test --changed`` runs."""

import os
import subprocess
import sys

from environment.changed_tests import affected_tests, changed_paths
import pytest
from support.needs import need_program
from support.paths import ROOT


@pytest.mark.parametrize(
    ('changed', 'tests'),
    [
        ([], []),
        (['LICENSE', 'CHANGELOG.md'], []),
        (['test/unit/sim/test_gone.py'], []),
        (['test/unit/base/test_text.py'], ['test/unit/base/test_text.py']),
        (['test/unit/base/test_text.py', 'test/support/paths.py'], ['test']),
        (
            ['amr_description/errors.py', 'test/unit/base/test_text.py'],
            ['test/system/base', 'test/tooling/test_architecture.py', 'test/unit/base'],
        ),
        (
            ['amr_description/sim/ros/entities.py'],
            ['test/ros/sim', 'test/system/sim', 'test/tooling/test_architecture.py',
             'test/unit/sim'],
        ),
        (['scripts/setup', 'amr_description/errors.py'],
         ['test/system/base', 'test/tooling', 'test/unit/base']),
        (['README.md'], ['test/system/docs', 'test/unit/docs']),
        (['examples/rover/setup.py'], ['test/system/docs', 'test/unit/docs']),
    ],
)  # fmt: skip
def test_the_folders_mirror_the_package(changed, tests):
    assert affected_tests(changed, ROOT) == tests


def test_what_git_does_not_know_is_one_line(tmp_path):
    scripts = tmp_path / 'scripts/environment'
    scripts.mkdir(parents=True)
    need_program('git', 'git')
    program = scripts / 'changed_tests.py'
    program.write_text((ROOT / 'scripts/environment/changed_tests.py').read_text())
    ended = subprocess.run(
        [sys.executable, '-ES', program],
        capture_output=True,
        text=True,
        env={'GIT_CEILING_DIRECTORIES': str(tmp_path), 'PATH': os.environ['PATH']},
    )
    assert (ended.returncode, ended.stdout) == (1, '')
    (line,) = ended.stderr.splitlines()
    assert 'git does not know what has changed here: fatal: not a git repository' in line


def test_without_git_is_one_line(tmp_path):
    program = ROOT / 'scripts' / 'environment' / 'changed_tests.py'
    ended = subprocess.run(
        [sys.executable, '-ES', program],
        capture_output=True,
        text=True,
        env={'PATH': str(tmp_path)},
    )
    assert (ended.returncode, ended.stdout) == (1, '')
    (line,) = ended.stderr.splitlines()
    assert 'there is no git here' in line


def test_committed_edited_and_new_files_count(tmp_path):
    need_program('git', 'git')

    def git(*words):
        identity = ['-c', 'user.name=a', '-c', 'user.email=a@b']
        subprocess.run(['git', '-C', tmp_path, *identity, *words], check=True)

    git('init', '--quiet', '--initial-branch=main')
    for name in ('edited', 'same', 'committed', 'new'):
        if name == 'committed':
            git('add', '.')
            git('commit', '--quiet', '-m', 'first')
            git('switch', '--quiet', '-c', 'other')
        (tmp_path / name).write_text(name)
        if name == 'committed':
            git('add', '.')
            git('commit', '--quiet', '-m', 'second')
    (tmp_path / 'edited').write_text('other')
    assert changed_paths(tmp_path) == ['committed', 'edited', 'new']
