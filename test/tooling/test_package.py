# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""The conventions of an ament_python package, and the traps that fail silently when forgotten."""

import ast
from importlib import import_module
from operator import attrgetter
import os
from pathlib import Path
import re
import shutil
import subprocess
import sys
import xml.etree.ElementTree as ElementTree

from ament_index_python.packages import get_package_prefix
from ament_index_python.resources import get_resource
import pytest
from support.paths import EXECUTABLES, PROJECT, ROOT

from amr_description import entry

NAME = 'amr_description'
MANIFEST = ElementTree.parse(ROOT / 'package.xml').getroot()
# colcon and the packages of this checkout; on the distribution's ROS other rules hold.
IN_PIP_UNDERLAY = Path(sys.prefix) == ROOT / '.venv'
only_in_pip_underlay = pytest.mark.skipif(not IN_PIP_UNDERLAY, reason='needs .venv')


def setup_arguments():
    """The keywords that setup.py hands to setuptools."""
    text = (ROOT / 'setup.py').read_text()
    captured = {}
    code = compile(text, 'setup.py', 'exec')
    namespace = {'__name__': 'setup'}
    before = Path.cwd()
    os.chdir(ROOT)
    try:
        with pytest.MonkeyPatch.context() as patch:
            patch.setattr('setuptools.setup', captured.update)
            exec(code, namespace)
    finally:
        os.chdir(before)
    return captured


SETUP = setup_arguments()
DATA_FILES = [(target, file) for target, files in SETUP['data_files'] for file in files]


def declared_dependencies():
    tags = ('depend', 'exec_depend')
    return {element.text.strip() for tag in tags for element in MANIFEST.iter(tag)}


def imported_top_levels(folder):
    for path in folder.rglob('*.py'):
        for node in ast.walk(ast.parse(path.read_text())):
            if isinstance(node, ast.Import):
                yield from (alias.name.split('.')[0] for alias in node.names)
            elif isinstance(node, ast.ImportFrom) and not node.level:
                yield node.module.split('.')[0]


def test_manifest_is_format_3_and_of_ament_python():
    assert MANIFEST.get('format') == '3'
    assert MANIFEST.findtext('export/build_type') == 'ament_python'
    assert MANIFEST.findtext('license') == 'Apache-2.0'


@only_in_pip_underlay
def test_manifest_is_valid_for_colcon():
    # An invalid one (an e-mail address, say) is only warned of, and the package then built as
    # plain Python, without the hooks that put it on AMENT_PREFIX_PATH.
    from catkin_pkg.package import parse_package

    warnings = []
    package = parse_package(ROOT, warnings=warnings)
    assert warnings == []
    assert package.get_build_type() == 'ament_python'
    for maintainer in package.maintainers:
        assert re.fullmatch(r'[\w.+-]+@[\w-]+(\.[\w-]+)+', maintainer.email)
        assert len(maintainer.email.rpartition('.')[2]) > 1


def test_manifest_and_project_agree():
    assert MANIFEST.findtext('name') == PROJECT['name'] == NAME
    assert MANIFEST.findtext('version') == PROJECT['version']
    assert MANIFEST.findtext('license') == SETUP['license']
    (maintainer,) = PROJECT['maintainers']
    assert MANIFEST.find('maintainer').get('email') == maintainer['email']


def test_every_ros_package_that_is_imported_is_declared():
    ros = {'rclpy', 'ament_index_python', 'rosidl_runtime_py', 'tf2_ros'}
    used = {
        name
        for name in imported_top_levels(ROOT / NAME)
        if name in ros or name.endswith(('_msgs', '_interfaces'))
    }
    assert used <= declared_dependencies()


def test_every_declared_ros_package_is_there():
    for name in declared_dependencies():
        if name == 'xacro' and IN_PIP_UNDERLAY:  # on PyPI it is a Python package like any other
            assert import_module(name)
        elif not name.startswith('python3-'):
            assert get_package_prefix(name)


def test_setup_declares_nothing_that_breaks_a_build():
    # The first is unknown to setuptools from 72 on: colcon then runs unittest, and no test at all.
    assert 'tests_require' not in SETUP
    assert PROJECT['optional-dependencies']['test'] == ['pytest']
    # colcon evaluates what setuptools prints; of this, in pyproject.toml, that would be an object.
    assert 'requires-python' in PROJECT['dynamic']
    assert isinstance(SETUP['python_requires'], str)
    # Where colcon links, setup.py has only what is named here beside it.
    assert 'pyproject.toml' in {file for _, file in DATA_FILES}


def test_scripts_go_where_ros2_run_looks():
    text = (ROOT / 'setup.cfg').read_text()
    assert f'script_dir=$base/lib/{NAME}' in text
    assert f'install_scripts=$base/lib/{NAME}' in text
    assert 'testpaths=test' in text


@pytest.mark.parametrize('name', EXECUTABLES)
def test_executable_can_be_imported(name):
    way_in, _, target = EXECUTABLES[name].partition(':')
    assert way_in == f'{NAME}.entry'
    program = attrgetter(target)(entry)
    assert program.path == (target if name == 'xacro' else f'{NAME}.{target}')
    assert callable(program.find())


def test_executables_are_installed():
    folder = Path(get_package_prefix(NAME), 'lib', NAME)
    assert {path.name for path in folder.iterdir()} == EXECUTABLES.keys()
    assert all(os.access(path, os.X_OK) for path in folder.iterdir())


def test_package_is_in_the_ament_index():
    content, prefix = get_resource('packages', NAME)
    assert content == (ROOT / 'resource' / NAME).read_text() == ''
    assert prefix == get_package_prefix(NAME)


def test_all_data_files_are_installed():
    source = {
        str(path.relative_to(ROOT))
        for folder in ('urdf', 'config')
        for path in (ROOT / folder).rglob('*')
        if path.is_file()
    }
    assert source <= {file for _, file in DATA_FILES}
    prefix = Path(get_package_prefix(NAME))
    for target, file in DATA_FILES:
        installed = prefix / target / Path(file).name
        assert installed.read_bytes() == (ROOT / file).read_bytes()


@only_in_pip_underlay
def test_installed_data_files_are_links():
    # setuptools from 80 on copies instead, without a word: edits would have no effect.
    prefix = Path(get_package_prefix(NAME))
    for target, file in DATA_FILES:
        installed = prefix / target / Path(file).name
        assert installed.is_symlink()
        assert installed.resolve() == ROOT / file


@only_in_pip_underlay
def test_no_link_is_left_of_a_file_that_is_gone():
    prefix = Path(get_package_prefix(NAME))
    assert [path for path in prefix.rglob('*') if path.is_symlink() and not path.exists()] == []


@only_in_pip_underlay
def test_colcon_sees_this_package_alone():
    # Not the interface packages below interfaces/, nor what .venv holds.
    command = [sys.executable, '-m', 'colcon', 'list']
    listed = subprocess.run(command, cwd=ROOT, capture_output=True, text=True, check=True)
    assert listed.stdout == f'{NAME}\t.\t(ros.ament_python)\n'


@pytest.mark.parametrize('script', ['setup', 'run', 'test', 'bench', 'release', '../.ci/run'])
def test_scripts_are_executable(script):
    path = ROOT / 'scripts' / script
    assert os.access(path, os.X_OK)
    assert path.read_text().startswith('#!')


@pytest.mark.parametrize(
    'script', ['setup', 'run', 'test', 'bench', 'lint', 'release', 'screenshots', 'fuzz_urdf']
)
@pytest.mark.parametrize('option', ['-h', '--help'])
def test_scripts_print_their_help_and_do_nothing(script, option, tmp_path):
    alone = shutil.copy(ROOT / 'scripts' / script, tmp_path)  # beside no set-up
    done = subprocess.run([alone, option], capture_output=True, text=True)
    assert (done.returncode, done.stderr) == (0, '')
    first, *lines = done.stdout.splitlines()
    assert first.startswith(f'scripts/{script} ')
    text = (ROOT / 'scripts' / script).read_text().partition('\n\n')[0].splitlines()
    assert [f'# {line}'.rstrip() for line in (first, *lines)] == text[4:]


def test_license_is_there():
    assert 'Apache License' in (ROOT / 'LICENSE').read_text()
    assert MANIFEST.find('license').get('file') == 'LICENSE'
