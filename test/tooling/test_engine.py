# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""The simulation without ROS, where there is none: in another environment and Python."""

import json
import os
import re
import subprocess

from environment import engine
import pytest
from support.doc_pages import Page

PAGE = Page('simulation.md')
COURSE = engine.ROOT / 'examples' / 'course' / 'student'
LOOKS = (
    'import importlib.metadata as m\n'
    'print(sorted(each.metadata["Name"] for each in m.distributions()))'
)
IS_FREE = """
import sys
wrong = [name for name in sys.modules if name.split('.')[0] in ('rclpy', 'ament_index_python')
         or name.split('.')[0].endswith(('_msgs', '_interfaces'))
         or name.startswith('amr_description.') and 'ros' in name.split('.')]
assert not wrong, wrong
"""


@pytest.fixture(scope='module')
def python():
    return str(engine.prepared(engine.find_python(os.environ)))


def run(python, code, cwd=engine.ROOT, **options):
    environment = engine.environment_of(os.environ)
    command = [python, '-W', 'error', '-c', code]
    return subprocess.run(
        command, env=environment, cwd=cwd, text=True, stdout=-1, stderr=-1, **options
    )


def test_no_package_of_ros_is_there(python):
    names = run(python, LOOKS, check=True).stdout.lower()
    assert 'mujoco' in names
    assert not any(word in names for word in ('ros-', 'rclpy', 'ament', 'rosidl', '-msgs'))
    assert run(python, 'import rclpy').returncode == 1


@pytest.mark.parametrize('number', range(len(PAGE.blocks('python'))))
def test_the_page_runs_as_it_stands(python, number, tmp_path):
    block = PAGE.blocks('python')[number]
    if 'testing' in block:  # over ROS
        assert run(python, block).returncode == 1
        return
    done = run(python, block + IS_FREE, tmp_path)
    assert done.returncode == 0, done.stderr
    if not number:
        assert done.stdout.startswith('it is at 1.000 m, and takes itself to be at 1.000 m\n')
        assert done.stdout.count('joint_wheel_') == 4


def test_the_notebook_of_the_course_runs_there(python):
    notebook = json.loads((COURSE / 'first_hour.ipynb').read_text())
    cells = [''.join(c['source']) for c in notebook['cells'] if c['cell_type'] == 'code']
    said = run(python, '\n'.join(cells), check=True).stdout
    assert re.search(r'it has driven 0\.\d+ m\n.*\n.*apart\n.*rays.*\nSUCCEEDED', said), said


def test_a_part_of_the_tests_runs_there(monkeypatch):
    """All of it: ``scripts/test engine``, which is a job of its own in CI."""
    monkeypatch.delenv('PYTEST_ADDOPTS', raising=False)  # colcon's, for this run
    parts = [
        'test/unit/control/test_loop.py',
        'test/unit/base/test_gym.py',
    ]
    assert engine.main(['-q', *parts]) == 0


@pytest.mark.parametrize(
    ('missing', 'uri', 'words'),
    [
        ('xacro', 'package://amr_description/urdf/amr_sensors.urdf.xacro', 'pip install xacro'),
        ('', 'package://nowhere/urdf/a.urdf', 'AMENT_PREFIX_PATH; build it and source'),
    ],
)
def test_what_is_missing_is_named_with_what_would_do(python, missing, uri, words):
    code = f"""
import sys
sys.modules[{missing!r}] = None
from amr_description import Simulation
Simulation({uri!r}).start()
"""
    said = run(python, code).stderr.splitlines()[-1]
    assert words in said
