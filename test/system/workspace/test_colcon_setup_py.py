# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""A setup.py that cannot be read is one line, and the packages beside it are built."""

import os
import subprocess
import sys

import pytest
from support.running_programs import PATIENCE

from amr_description.workspace.colcon import cause

SETUP = """
from setuptools import setup
setup(name='{0}', version='0.0.0', packages=['{0}'], data_files=[
    ('share/ament_index/resource_index/packages', ['resource/{0}']),
    ('share/{0}', ['package.xml'])])
"""
XML = """<package format="3"><name>{0}</name><version>0.0.0</version><description>d</description>
<maintainer email="a@example.com">a</maintainer><license>MIT</license>
<export><build_type>ament_python</build_type></export></package>
"""
FAULTS = {
    'a_module': ('import generate_parameter_library_py\n', 'ModuleNotFoundError: No module named'),
    'b_syntax': ('\n\ndef x(:\n', 'SyntaxError: invalid syntax'),
    'c_file': ('x = 1\nopen("nope.txt")\n', 'FileNotFoundError: [Errno 2] No such file'),
}
LINES = {'a_module': 1, 'b_syntax': 3, 'c_file': 2}


def write(workspace, name, before=''):
    files = {
        'setup.py': before + SETUP.format(name),
        'package.xml': XML.format(name),
        'setup.cfg': f'[develop]\nscript_dir=$base/lib/{name}\n',
        f'resource/{name}': '',
        f'{name}/__init__.py': '',
    }
    for path, text in files.items():
        file = workspace / 'src' / name / path
        file.parent.mkdir(parents=True, exist_ok=True)
        file.write_text(text)


@pytest.mark.parametrize('fault', FAULTS)
def test_a_setup_py_that_cannot_be_read_is_one_line_and_the_others_are_built(tmp_path, fault):
    before, error = FAULTS[fault]
    write(tmp_path, fault, before)
    write(tmp_path, 'z_ok')
    built = subprocess.run(
        [sys.executable, '-m', 'colcon', 'build', '--parallel-workers', '1'],
        cwd=tmp_path,
        env={**os.environ, 'COLCON_HOME': str(tmp_path)},
        capture_output=True,
        text=True,
        timeout=4 * PATIENCE,
    )
    assert built.returncode == 1
    said = built.stderr.partition(f'--- stderr: {fault}\n')[2].partition('---\n')[0]
    (line,) = said.splitlines()
    assert line.startswith(f'setup.py:{LINES[fault]}: {error}')
    assert 'Traceback' not in built.stderr
    assert f'1 package failed: {fault}' in built.stdout
    assert (tmp_path / 'install/z_ok/share/z_ok/package.xml').is_file()


def test_the_last_place_in_the_file_is_named():
    traceback = """Traceback (most recent call last):
  File "<string>", line 1, in <module>
  File "/lib/core.py", line 266, in run_setup
  File "<string>", line 7, in <module>
  File "<string>", line 4, in version
  File "/lib/other.py", line 3, in f
ValueError: no version

"""
    assert cause(traceback) == 'setup.py:4: ValueError: no version'
    assert cause('') == 'setup.py: it cannot be read'
