# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""CMake as colcon starts it: what it says when something fails, and what it does without."""

import os
import subprocess
import sys

import pytest
from support.paths import ROOT

from amr_description.workspace.cmake import compiles_nothing, write_stub

LACKS = """\
CMake Error at CMakeLists.txt:{line} (find_package):
  By not providing "Find{name}.cmake" in CMAKE_MODULE_PATH this project has
  asked CMake to find a package configuration file provided by "{name}", but
  CMake did not find one.

"""
# A CMake that finds what it is given the folder of, and says what it was started with.
FAKE = """\
#!/bin/sh
echo "started: $*"
case "$*" in
    *--version*) exit 0 ;;
    *-Durdf_DIR=*) ;;
    *wants_urdf*) cat {folder}/urdf >&2; exit 1 ;;
esac
case "$*" in
    *BUILD_TESTING=OFF*) ;;
    *wants_urdf*) cat {folder}/rostest >&2; exit 1 ;;
esac
case "$*" in
    *--build*) cat {folder}/ninja; exit 1 ;;
    *wants_rclcpp*) cat {folder}/rclcpp >&2; exit 1 ;;
esac
echo 'CMake Warning' >&2
"""
NINJA = """\
[1/2] Building one.o
FAILED: two.o
two.cpp:1: error: no
"""
RULES = """\
project(bot)
# add_library(not_really)
find_package(urdf REQUIRED)
if(BUILD_TESTING)
  find_package(rostest REQUIRED)
endif()
install(DIRECTORY urdf DESTINATION share/bot)
"""


@pytest.fixture
def cmake(tmp_path):
    """Run our CMake, over the fake one, in an empty folder of a build."""
    fake = tmp_path / 'cmake'
    fake.write_text(FAKE.format(folder=tmp_path))
    fake.chmod(0o755)
    for name, line in (('urdf', 3), ('rostest', 5), ('rclcpp', 3)):
        (tmp_path / name).write_text(LACKS.format(name=name, line=line))
    (tmp_path / 'ninja').write_text(NINJA)
    (tmp_path / 'build').mkdir()
    for name in ('cc', 'c++'):
        (tmp_path / name).symlink_to('/bin/true')
    code = 'import sys; sys.path.insert(0, sys.argv[1]); from amr_description.workspace.cmake'
    code += ' import main; sys.exit(main(sys.argv[2], sys.argv[3:]))'

    def run(*words, path=f'{tmp_path}:{os.environ["PATH"]}', **variables):
        command = [sys.executable, '-I', '-S', '-c', code, ROOT, fake, *words]
        done = subprocess.run(
            command,
            cwd=tmp_path / 'build',
            env={'PATH': path, **variables},
            capture_output=True,
            text=True,
        )
        return done.returncode, done.stdout, done.stderr

    return run


@pytest.fixture
def package(tmp_path):
    """Write the rules of a package; return its folder."""

    def write(name, rules):
        (tmp_path / name).mkdir()
        (tmp_path / name / 'CMakeLists.txt').write_text(rules)
        return str(tmp_path / name)

    return write


def test_what_succeeds_is_as_it_was(cmake, package):
    source = package('fine', 'project(fine)\n')
    assert cmake(source) == (0, f'started: {source}\n', 'CMake Warning\n')
    assert cmake('--version') == (0, 'started: --version\n', '')


def test_a_package_that_compiles_is_refused_in_a_line(cmake, package):
    code, log, said = cmake(package('wants_rclcpp', 'add_executable (n n.cpp)\n'))
    assert (code, said.count('\n')) == (1, 1)
    assert said.startswith("wants_rclcpp needs 'rclcpp' (find_package, CMakeLists.txt:3), which")
    assert LACKS.format(name='rclcpp', line=3) in log  # colcon's log has the whole text


def test_a_package_of_files_is_built_without_libraries_and_the_tools_of_its_tests(
    cmake, package, tmp_path
):
    code, _, said = cmake(package('wants_urdf', RULES))
    assert code == 0
    assert said == (
        "CMake Warning\nwants_urdf is built without its tests, which need 'rostest': that is not"
        ' here\n'
    )
    assert (tmp_path / 'build/stubs/urdf/urdfConfig.cmake').is_file()


def test_what_ninja_says_of_a_failure_is_seen(cmake):
    code, log, said = cmake('--build', '.')
    assert (code, said) == (1, NINJA.partition('\n')[2])
    assert log == f'started: --build .\n{NINJA}'


def test_faults_of_a_former_build_hide_none_of_this_one(cmake, tmp_path):
    faults = tmp_path / 'build/rosidl_generate_interfaces/bot/faults'
    faults.parent.mkdir(parents=True)
    faults.write_text("A.msg:1:1: unknown type 'flaot64'")
    assert cmake('--build', '.')[2] == NINJA.partition('\n')[2]


def test_colcon_may_ask_what_there_is_to_install_in_vain(cmake):
    assert cmake('--build', '.', '--target', 'help') == (1, '', '')


def test_files_are_installed_without_a_compiler(cmake, package, tmp_path):
    (tmp_path / 'bin').mkdir()
    for name in ('sh', 'cat'):
        (tmp_path / 'bin' / name).symlink_to(f'/bin/{name}')
    source = package('bot', RULES)
    _, log, _ = cmake(source, path=str(tmp_path / 'bin'))
    assert '-DCMAKE_CXX_COMPILER=/bin/false -DCMAKE_CXX_COMPILER_FORCED=TRUE' in log
    _, log, _ = cmake(source, path=str(tmp_path / 'bin'), CC='cc', CXX='c++')
    assert log == f'started: {source}\n'
    (tmp_path / 'build/CMakeCache.txt').write_text('CMAKE_CXX_COMPILER:FILEPATH=/bin/false\n')
    code, _, said = cmake('--build', '.')
    assert (code, said.startswith('error: to compile C or C++ takes a compiler')) == (1, True)


@pytest.mark.parametrize(
    ('rules', 'expected'),
    [
        (RULES, True),
        ('add_library(a a.cpp)', False),
        ('  rosidl_generate_interfaces(${PROJECT_NAME} "msg/A.msg")', False),
        ('ament_auto_add_executable(a a.cpp)', False),
    ],
)
def test_what_compiles_is_known(tmp_path, rules, expected):
    (tmp_path / 'CMakeLists.txt').write_text(rules)
    for place in ('build/CMakeCache.txt', 'build/x.cmake', '.git/y.cmake'):
        (tmp_path / place).parent.mkdir(exist_ok=True)
        (tmp_path / place).write_text('add_library(of a build)')
    assert compiles_nothing(tmp_path) == expected


def test_what_the_manifest_names_is_known_beforehand(cmake, package, tmp_path):
    rules = 'find_package(there)\nfind_package (urdf REQUIRED)\n#find_package(no)\n'
    source = package('files', f'{rules}find_package(ament_x)\nfind_package(Eigen3)\n')
    names = ('there', 'urdf', 'no', 'ament_x')
    manifest = ''.join(f'<depend>{name}</depend>' for name in names)
    (tmp_path / 'files/package.xml').write_text(manifest)
    (tmp_path / 'prefix/share/there/cmake').mkdir(parents=True)
    (tmp_path / 'prefix/share/there/cmake/thereConfig.cmake').touch()
    _, log, _ = cmake(source, AMENT_PREFIX_PATH=str(tmp_path / 'prefix'))
    assert log == f'started: {source} -Durdf_DIR={tmp_path}/build/stubs/urdf\n'


def test_what_brings_commands_has_no_stub(tmp_path):
    assert [write_stub(name, tmp_path) for name in ('ament_x', 'rosidl_y', 'catkin')] == [None] * 3
