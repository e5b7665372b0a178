# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""A package that lacks a library of C++: its Python half is built, and the rest is named."""

import os
import subprocess
import sys

import pytest
from support.needs import need_compiler
from support.running_programs import PATIENCE

RULES = """cmake_minimum_required(VERSION 3.8)
project(mixed_pkg)
find_package(ament_cmake REQUIRED)
find_package(ament_cmake_python REQUIRED)
find_package(no_such_library REQUIRED)
if(NOT no_such_library_FOUND)
  message(FATAL_ERROR "it is needed")
endif()
add_library(mixed_lib SHARED src/a.cpp)
target_link_libraries(mixed_lib PUBLIC no_such_library::no_such_library)
command_of_no_such_library(mixed_lib)
add_executable(mixed_node src/b.cpp)
target_include_directories(mixed_node PRIVATE include)
add_custom_command(TARGET mixed_node POST_BUILD COMMAND echo done)
install(TARGETS mixed_lib EXPORT export_mixed LIBRARY DESTINATION lib)
install(TARGETS mixed_node DESTINATION lib/${PROJECT_NAME})
install(FILES ${CMAKE_CURRENT_BINARY_DIR}/generated.h DESTINATION include)
install(PROGRAMS scripts/tool.py DESTINATION lib/${PROJECT_NAME})
ament_python_install_package(mixed_py)
ament_export_targets(export_mixed)
ament_package()
"""
FILES = {
    'package.xml': """<package format="3"><name>mixed_pkg</name><version>0.0.0</version>
<description>d</description><maintainer email="a@example.com">a</maintainer><license>MIT</license>
<buildtool_depend>ament_cmake</buildtool_depend>
<export><build_type>ament_cmake</build_type></export></package>
""",
    'mixed_py/__init__.py': 'X = 5\n',
    'scripts/tool.py': '#!/usr/bin/env python3\nfrom mixed_py import X\nprint("tool", X)\n',
}


@pytest.fixture
def workspace(tmp_path):
    """A function: build the package with these rules; returns the finished process."""
    need_compiler()
    environment = {**os.environ, 'COLCON_HOME': str(tmp_path)}

    def built(rules, *words):
        for name, text in {**FILES, 'CMakeLists.txt': rules}.items():
            path = tmp_path / 'src/mixed_pkg' / name
            path.parent.mkdir(parents=True, exist_ok=True)
            path.write_text(text)
        (tmp_path / 'src/mixed_pkg/scripts/tool.py').chmod(0o755)
        command = [sys.executable, '-m', 'colcon', 'build', *words]
        return subprocess.run(
            command, cwd=tmp_path, env=environment, capture_output=True, text=True,
            timeout=4 * PATIENCE,
        )  # fmt: skip

    return built


def test_the_python_half_is_built_and_what_is_left_out_is_named(tmp_path, workspace):
    for words in ([], ['--symlink-install', '--cmake-force-configure']):
        built = workspace(RULES, *words)
        assert built.returncode == 0, built.stdout + built.stderr
        said = [line for line in built.stderr.splitlines() if line and line[:3] != '---']
        assert said == [
            'mixed_pkg: only its Python half is built, without mixed_lib, mixed_node: it needs '
            "'no_such_library' (find_package, CMakeLists.txt:5)"
        ]
    used = subprocess.run(
        ['bash', '-c', f'. {tmp_path}/install/setup.bash && ros2 run mixed_pkg tool.py'],
        capture_output=True, text=True, timeout=PATIENCE,
    )  # fmt: skip
    assert used.stdout == 'tool 5\n', used.stderr


def test_a_package_without_a_python_half_is_refused_as_before(workspace):
    built = workspace(RULES.replace('ament_python_install_package(mixed_py)', ''))
    assert built.returncode == 1
    assert "mixed_pkg needs 'no_such_library' (find_package, CMakeLists.txt:5)" in built.stderr


@pytest.mark.long
def test_what_the_python_half_itself_lacks_ends_the_build(workspace):
    rules = RULES.replace('(mixed_py)', '(mixed_py PACKAGE_DIR nowhere)')
    built = workspace(rules)
    assert built.returncode == 1
    assert "mixed_pkg needs 'no_such_library'" in built.stderr
