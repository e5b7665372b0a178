# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""docs/trials.md, line by line, and what the front page has of it."""

import json
import os
import shlex
import subprocess
import sys

import pytest
from support.doc_pages import Page, ROOT

PAGE = Page('trials.md')
TRIAL, SCRIPT, MARKED = PAGE.blocks('python')
_, FRONT = Page('../README.md').blocks('python')
FIRST = 'python -m amr_description.trials dock.py:drive_to_the_dock --seeds 20'
AGAIN = 'python -m amr_description.trials dock.py:drive_to_the_dock --only 0'
PLUGINS = "pytest_plugins = ['amr_description.testing.trials_marker']"


def run(*words, cwd):
    program = [sys.executable, *map(str, words)]
    environment = os.environ | {'PYTEST_ADDOPTS': ''}  # those of the run that this test is of
    return subprocess.run(
        program, cwd=cwd, env=environment, text=True, capture_output=True, timeout=240
    )


def typed(beginning, cwd):
    line = next(line for line in PAGE.text.splitlines() if line.startswith(beginning))
    return run(*shlex.split(line)[1:], cwd=cwd)


@pytest.mark.long
def test_the_trial_finds_the_fault_and_a_line_of_its_report_repeats_it(tmp_path):
    (tmp_path / 'dock.py').write_text(TRIAL)
    done = typed(FIRST, tmp_path)
    assert done.returncode == 0, done.stderr
    shown = PAGE.blocks('text')[0].splitlines()
    assert done.stdout.splitlines()[: len(shown)] == shown
    assert AGAIN in shown[2]
    runs = json.loads((tmp_path / 'trials' / 'report.json').read_text())['runs']
    late = [run['parameters']['late'] for run in runs if run['kind'] == 'failed']
    in_time = [run['parameters']['late'] for run in runs if run['kind'] == 'passed']
    assert max(in_time) < 0.26 < min(late) + 0.02
    assert {path.name for path in (tmp_path / 'trials').iterdir()} == {
        'report.json', 'report.xml', 'report.html', 'bags'
    }  # fmt: skip
    again = typed(AGAIN, tmp_path)
    assert again.returncode == 1
    assert again.stdout.splitlines()[1] == shown[1]


def test_the_script_runs_as_it_stands(tmp_path):
    (tmp_path / 'script.py').write_text(SCRIPT)
    done = run('script.py', cwd=tmp_path)
    assert done.returncode == 0, done.stderr
    assert done.stdout.startswith('script.py:stops: 20 of 20 passed: 100.0 % (between 83.9 %')


@pytest.mark.parametrize('block', [MARKED, FRONT], ids=['page', 'front page'])
def test_the_marked_test_passes(tmp_path, block):
    assert f'`{PLUGINS}`' in PAGE.text
    (tmp_path / 'conftest.py').write_text(PLUGINS)
    # The front page leaves the import out; there are two hundred of its runs.
    (tmp_path / 'test_it.py').write_text('import pytest\n' + block.replace('(200,', '(10,'))
    rover = ROOT / 'examples' / 'rover'
    for folder in ('urdf', 'config'):
        (tmp_path / folder).symlink_to(rover / folder)
    done = run('-m', 'pytest', '-q', '-p', 'no:cacheprovider', cwd=tmp_path)
    assert done.returncode == 0, done.stdout
    assert 'passed: 100.0 %' in done.stdout


def test_what_the_page_names_is_there():
    from amr_description.trials import faults, variations

    names = {each.partition('(')[0] for each in PAGE.quoted() if '(' in each}
    found = {name for name in names if hasattr(faults, name) or hasattr(variations, name)}
    public = {'vary', 'uniform', 'normal'}
    of_faults = {
        name
        for name, each in vars(faults).items()
        if getattr(each, '__module__', '') == faults.__name__ and name.islower() and name[0] != '_'
    }
    assert of_faults <= found
    assert {'scale_mass', 'scale_friction', 'scale_wheel_radius', 'move_start'} <= found
    assert public <= {*vars(variations)}
