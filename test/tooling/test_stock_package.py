# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""``colcon test`` of Python packages as ``ros2 pkg create`` of Jazzy writes them."""

import subprocess
import sys
import xml.etree.ElementTree as ElementTree

import pytest
from support.paths import ROOT

pytestmark = pytest.mark.skipif(sys.prefix != str(ROOT / '.venv'), reason='needs .venv')

MANIFEST = """\
<?xml version="1.0"?>
<package format="3">
  <name>{name}</name>
  <version>0.0.0</version>
  <description>TODO: Package description</description>
  <maintainer email="me@todo.todo">me</maintainer>
  <license>TODO: License declaration</license>
  <test_depend>ament_copyright</test_depend>
  <test_depend>ament_flake8</test_depend>
  <test_depend>ament_pep257</test_depend>
  <test_depend>python3-pytest</test_depend>
  <export>
    <build_type>ament_python</build_type>
  </export>
</package>
"""
SETUP = """\
from setuptools import find_packages, setup

package_name = '{name}'

setup(
    name=package_name,
    version='0.0.0',
    packages=find_packages(exclude=['test']),
    data_files=[
        ('share/ament_index/resource_index/packages', ['resource/' + package_name]),
        ('share/' + package_name, ['package.xml']),
    ],
    install_requires=['setuptools'],
    zip_safe=True,
    maintainer='me',
    maintainer_email='me@todo.todo',
    description='TODO: Package description',
    license='TODO: License declaration',
    tests_require=['pytest'],
    entry_points={{'console_scripts': ['node = {name}.node:main']}},
)
"""
SETTINGS = """\
[develop]
script_dir=$base/lib/{name}
[install]
install_scripts=$base/lib/{name}
"""
COPYRIGHT = """\
from ament_copyright.main import main
import pytest


{skip}@pytest.mark.copyright
@pytest.mark.linter
def test_copyright():
    assert main(argv=['.', 'test']) == 0, 'Found errors'
"""
SKIP = "@pytest.mark.skip(reason='No copyright header has been placed.')\n"
FLAKE8 = """\
from ament_flake8.main import main_with_errors
import pytest


@pytest.mark.flake8
@pytest.mark.linter
def test_flake8():
    code, errors = main_with_errors(argv=[])
    assert code == 0, '\\n'.join(errors)
"""
PEP257 = """\
from ament_pep257.main import main
import pytest


@pytest.mark.linter
@pytest.mark.pep257
def test_pep257():
    assert main(argv=['.', 'test']) == 0, 'Found code style errors / warnings'
"""
RIGHT = """\
def main():
    print('Hi from a stock package.')
"""
WRONG = '''\
def main():
    """prints"""
    print("Hi from a stock package.")
'''
OWN = """\
from {name}.node import main


def test_greeting(capsys):
    main()
    assert capsys.readouterr().out == '{expected}\\n'
"""


def write_package(folder, name, *, node, skip, expected):
    files = {
        'package.xml': MANIFEST.format(name=name),
        'setup.py': SETUP.format(name=name),
        'setup.cfg': SETTINGS.format(name=name),
        f'resource/{name}': '',
        f'{name}/__init__.py': '',
        f'{name}/node.py': node,
        'test/test_copyright.py': COPYRIGHT.format(skip=skip),
        'test/test_flake8.py': FLAKE8,
        'test/test_pep257.py': PEP257,
        'test/test_own.py': OWN.format(name=name, expected=expected),
    }
    for path, text in files.items():
        (folder / name / path).parent.mkdir(parents=True, exist_ok=True)
        (folder / name / path).write_text(text)


def shell(workspace, text):
    """Run a command line in a fresh shell of a user whose home is empty."""
    return subprocess.run(
        ['bash', '--norc', '--noprofile', '-c', text],
        cwd=workspace,
        env={'HOME': str(workspace), 'PATH': '/usr/bin:/bin', 'TERM': 'dumb'},
        capture_output=True,
        text=True,
        timeout=120,
    )


@pytest.fixture(scope='module')
def tested(tmp_path_factory):
    """A workspace of two packages, built, and tested from a shell that has sourced it alone."""
    workspace = tmp_path_factory.mktemp('ws')
    greeting = 'Hi from a stock package.'
    write_package(workspace / 'src', 'stock', node=RIGHT, skip=SKIP, expected=greeting)
    write_package(workspace / 'src', 'wrong', node=WRONG, skip='', expected='Hello')
    built = shell(workspace, f'. {ROOT}/install/setup.bash; colcon build --symlink-install')
    assert (built.returncode, built.stderr) == (0, '')
    done = shell(workspace, '. install/setup.bash; colcon test; colcon test-result --all')
    return workspace, done


def results(workspace, package):
    """Return name → text of the failure, '' or 'skipped'."""
    report = ElementTree.parse(workspace / 'build' / package / 'pytest.xml')
    return {
        case.get('name'): 'skipped'
        if case.find('skipped') is not None
        else ''.join(part.text for part in case.findall('failure'))
        for case in report.iter('testcase')
    }


@pytest.mark.long
def test_tests_of_a_stock_package_run_and_pass(tested):
    workspace, done = tested
    assert results(workspace, 'stock') == {
        'test_copyright': 'skipped', 'test_flake8': '', 'test_pep257': '', 'test_greeting': '',
    }  # fmt: skip
    assert '--- stderr: stock' not in done.stderr  # no warning either
    assert 'build/stock/pytest.xml: 4 tests, 0 errors, 0 failures, 1 skipped' in done.stdout


def test_what_is_wrong_fails_by_its_cause(tested):
    workspace, done = tested
    found = results(workspace, 'wrong')
    said = (workspace / 'log/latest_test/wrong/stdout.log').read_text()
    assert all(found.values()) and len(found) == 4
    assert "assert 'Hi from a stock package.\\n' == 'Hello\\n'" in found['test_greeting']
    # Of a plugin of flake8, as in Jazzy.
    assert 'Q000 Double quotes found but single quotes preferred' in found['test_flake8']
    assert 'wrong/node.py:2 in public function `main`: D400: First line should end with' in said
    assert '\nwrong/node.py: no copyright notice' in said
    assert 'build/wrong/pytest.xml: 4 tests, 0 errors, 4 failures, 0 skipped' in done.stdout
    assert done.returncode == 1
