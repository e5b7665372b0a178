# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
The first hour of an engineer who tests a robot in CI: the workflow of docs/ci.md, step by step.

As a runner does it: each step is a file that ``bash -e`` runs in the workspace, from an empty
home, without a variable of ours. Where people fell before, and what types it now:

=====================================================  ==========================================
no workflow                                            test_the_workflow
tests of a package with ``package://``                 test_the_workflow
nothing says ``source scripts/activate``               test_the_workflow
nothing to upload                                      test_the_workflow
``colcon test`` ends with 0                            test_a_failure_fails_the_job
a test enters somebody's live robot                    test/system/testing/
the log of a failed test, own frames in its report     test/system/testing/
set-up says how long it takes                          test/tooling/test_setup.py
=====================================================  ==========================================
"""

import os
import shutil
import subprocess
import sys
from xml.etree import ElementTree

import pytest
from support.doc_pages import Page, ROOT
from support.shells import fresh_variables
import yaml

pytestmark = pytest.mark.long('a colcon build and all of its tests, in a fresh home')
PAGE = Page('ci.md')
ROVER = ROOT / 'examples/rover'
WORKFLOW = yaml.safe_load((ROVER / '.github/workflows/test.yml').read_text())
STEPS = {step['name']: step['run'] for step in WORKFLOW['jobs']['test']['steps'] if 'run' in step}
GET, SET_UP, CHECK, TEST = STEPS
PATIENCE = 120.0
"""s; a bound that only a broken test reaches."""


class Runner:
    """A machine of the CI service: the workspace, and a home with nothing in it."""

    def __init__(self, folder):
        self.workspace, self.home = folder / 'workspace', folder / 'home'
        self.workspace.mkdir()
        self.home.mkdir()
        self.variables = fresh_variables(self.home)
        shutil.copytree(ROVER, self.workspace / 'src/rover')

    def run(self, text, code=0, patience=PATIENCE):
        """Run a step; return what it prints."""
        script = self.home.parent / 'step.sh'
        script.write_text(text)
        done = subprocess.run(
            ['bash', '--noprofile', '--norc', '-e', script],
            cwd=self.workspace,
            env=self.variables,
            stdin=subprocess.DEVNULL,
            stdout=subprocess.PIPE,
            stderr=subprocess.STDOUT,
            text=True,
            timeout=patience,
            check=False,
        )
        assert done.returncode == code, done.stdout
        return done.stdout


@pytest.fixture(scope='module')
def runner(tmp_path_factory):
    """One on which the workflow has run; this checkout is there as if it had been cloned."""
    machine = Runner(tmp_path_factory.mktemp('ci'))
    (machine.workspace / 'amr_description').symlink_to(ROOT)
    machine.said = {name: machine.run(STEPS[name]) for name in (SET_UP, CHECK, TEST)}
    machine.report = ElementTree.parse(machine.workspace / 'build/rover/pytest.xml').getroot()
    return machine


def test_the_workflow(runner):
    assert runner.said[SET_UP] == ''
    assert runner.said[CHECK].endswith('\n    passed\n')
    assert '3 passed' in runner.said[TEST]
    assert runner.said[TEST].endswith('Summary: 3 tests, 0 errors, 0 failures, 0 skipped\n')
    assert len(runner.report.findall('.//testcase')) == 3
    # colcon has built the robot's package and nothing else.
    assert [each.name for each in (runner.workspace / 'build').glob('*/')] == ['rover']


def test_the_stack_of_the_package_is_found(runner):
    """As docs/your_own_robot.md starts it, in a shell that sources the workspace alone."""
    printed = runner.run('source install/setup.bash\nros2 launch rover rover_sim.py --print')
    assert 'spawner joint_state_broadcaster imu_sensor_broadcaster' in printed
    assert str(runner.workspace / 'install/rover/share/rover/config/rover.yaml') in printed


def test_what_is_uploaded_is_there(runner):
    (upload,) = (step for step in WORKFLOW['jobs']['test']['steps'] if 'upload' in str(step))
    for pattern in upload['with']['path'].split():
        folder = runner.home if pattern.startswith('~/') else runner.workspace
        if not pattern.startswith('~/'):  # the logs of ROS: of programs, where some were started
            assert list(folder.glob(pattern)), pattern
    assert upload['if'] == 'always()'


def test_a_failure_fails_the_job(runner):
    test = runner.workspace / 'src/rover/test/test_wrong.py'
    test.write_text('def test_wrong():\n    assert 1 + 1 == 3\n')
    try:
        said = runner.run(
            STEPS[TEST].replace('direct+', 'direct+ --pytest-args " -k" wrong'), code=1
        )
    finally:
        test.unlink()
    assert 'assert (1 + 1) == 3' in said
    assert '1 failure' in said


def test_the_page_shows_the_workflow():
    text = (ROVER / '.github/workflows/test.yml').read_text()
    for block in PAGE.blocks('yaml'):
        assert block in text
    assert sum(map(len, PAGE.blocks('yaml'))) > 0.8 * len(text)
    assert STEPS[GET] in PAGE.text.replace('        run: ', '')


@pytest.mark.long
def test_a_fresh_clone(tmp_path):
    """The first and the second step for once, of what is committed; it fetches packages."""
    machine = Runner(tmp_path)
    # What the runner gives: Python 3.12 by actions/setup-python, and its way to PyPI.
    machine.variables |= {
        key: each
        for key, each in os.environ.items()
        if 'PROXY' in key.upper() or key[:4] == 'PIP_'
    }
    machine.variables['PATH'] = f'{sys.base_prefix}/bin:{machine.variables["PATH"]}'
    published = 'https://github.com/OWNER/amr_description'
    machine.run(STEPS[GET].replace(published, f'file://{ROOT} amr_description'))
    assert 'done in' in machine.run(STEPS[SET_UP], patience=10 * PATIENCE)
    assert 'robot name is: rover' in machine.run(STEPS[CHECK])
