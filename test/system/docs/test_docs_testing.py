# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""docs/test_your_robot.md: its tests pass where a reader runs them; what it names is there."""

import os
import re
import sys

import pytest
from support import preloaded
from support.doc_pages import Page, ROOT

from amr_description.testing.simulation import Simulation

PAGE = Page('test_your_robot.md')
FIRST, CONFTEST, TESTS, FLEET, ARM, SENSORS, SAME_BITS = PAGE.blocks('python')
(ARM_YAML,) = PAGE.blocks('yaml')
OF_README, _ = Page('../README.md').blocks('python')
ARM_URDF = ROOT / 'test' / 'fixtures' / 'sim' / 'arm.urdf'


@pytest.mark.parametrize('block', [FIRST, FLEET, SENSORS, SAME_BITS])
def test_a_block_holds(block):
    PAGE.run(block)


def test_the_block_of_the_front_page_holds(monkeypatch):
    monkeypatch.chdir(ROOT / 'examples/rover')
    PAGE.run(OF_README)


def test_the_tests_of_the_page_pass(tmp_path):
    (tmp_path / 'conftest.py').write_text(CONFTEST)
    (tmp_path / 'test_my_robot.py').write_text(TESTS)
    (tmp_path / 'test_my_arm.py').write_text(ARM)
    (tmp_path / 'arm.yaml').write_text(ARM_YAML)
    (tmp_path / 'arm.urdf').write_text(ARM_URDF.read_text())
    paths = {'PYTHONPATH': os.pathsep.join(filter(None, sys.path))}
    # Without the options of the run that this is part of, and plugins that take 2 s to load.
    only_its_own = {'PYTEST_ADDOPTS': '', 'PYTEST_DISABLE_PLUGIN_AUTOLOAD': '1'}
    ended = preloaded.run(
        [sys.executable, '-m', 'pytest', '-q', '-p', 'no:cacheprovider', str(tmp_path)],
        timeout=120,
        cwd=tmp_path,
        env=os.environ | paths | only_its_own,
    )
    assert ended.returncode == 0, ended.stdout + ended.stderr
    assert '5 passed' in ended.stdout


def test_what_the_page_names_is_there():
    assert PAGE.is_sound()
    named = set(re.findall(r'\bsim\.(\w+)', PAGE.text))
    # An instance attribute; all others are of the class and its bases.
    assert named - {'node'} <= set(dir(Simulation))
