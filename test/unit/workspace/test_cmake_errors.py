# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""What a package lacks, from the words of CMake 3.28."""

import pytest

from amr_description.workspace.cmake_errors import missing

MODULES = '/usr/share/cmake-3.28/Modules'
CONFIG = """\
CMake Error at CMakeLists.txt:{line} (find_package):
  By not providing "Find{name}.cmake" in CMAKE_MODULE_PATH this project has
  asked CMake to find a package configuration file provided by "{name}", but
  CMake did not find one.

  Could not find a package configuration file provided by "{name}" with any
  of the following names:

    {name}Config.cmake


"""
COMMAND = """\
CMake Error at CMakeLists.txt:{line} ({name}):
  Unknown CMake command "{name}".


"""
VERSION = """\
CMake Error at CMakeLists.txt:3 (find_package):
  Could not find a configuration file for package "rclcpp" that is compatible
  with requested version "99.0".

"""
REQUESTED = """\
CMake Error at CMakeLists.txt:3 (find_package):
  Could not find a package configuration file provided by "Eigen3" (requested
  version 3.3) with any of the following names:

"""
DEEP = f"""\
CMake Warning at CMakeLists.txt:1:
  Something "else"

CMake Error at {MODULES}/CMakeFindDependencyMacro.cmake:76 (find_package):
  By not providing "Findtf2.cmake" in CMAKE_MODULE_PATH this project has asked
  CMake to find a package configuration file provided by "tf2", but CMake did
  not find one.
Call Stack (most recent call first):
  /opt/share/tf2_ros/cmake/tf2_rosConfig.cmake:2 (find_dependency)
  CMakeLists.txt:7 (find_package)


"""
MODULE = f"""\
CMake Error at {MODULES}/FindPackageHandleStandardArgs.cmake:230 (message):
  Could NOT find Boost (missing: Boost_INCLUDE_DIR)
Call Stack (most recent call first):
  {MODULES}/FindBoost.cmake:2393 (find_package_handle_standard_args)
  CMakeLists.txt:3 (find_package)

"""
PKG_CONFIG = f"""\
CMake Error at {MODULES}/FindPkgConfig.cmake:619 (message):
  The following required packages were not found:

   - libusb-1.0

Call Stack (most recent call first):
  CMakeLists.txt:4 (pkg_check_modules)

"""
RULES = """\
project(bot)
if(UNIX)
endif()
if(BUILD_TESTING)
  if(TRUE)
    find_package(rostest REQUIRED)
  endif()
endif()
find_package(rclcpp REQUIRED)
"""


@pytest.fixture
def source(tmp_path, monkeypatch):
    (tmp_path / 'package.xml').write_text('<package><name> bot </name></package>')
    (tmp_path / 'CMakeLists.txt').write_text(RULES)
    index = tmp_path / 'prefix/share/ament_index/resource_index/packages'
    index.mkdir(parents=True)
    (index / 'tf2_msgs').touch()
    monkeypatch.setenv('AMENT_PREFIX_PATH', f'/nowhere:{tmp_path / "prefix"}')
    return str(tmp_path)


@pytest.mark.parametrize(
    ('said', 'line'),
    [
        (
            CONFIG.format(line=9, name='rclcpp'),
            "bot needs 'rclcpp' (find_package, CMakeLists.txt:9), which is not here: PyPI has few"
            ' C++ libraries of ROS. Put it into this workspace, write the node in Python, or build'
            ' where ROS 2 Jazzy is installed (apt install ros-jazzy-rclcpp)',
        ),
        (VERSION, "bot needs 'rclcpp' 99.0 (find_package, CMakeLists.txt:3), which is not here: "),
        (DEEP, "bot needs 'tf2' (find_package, CMakeLists.txt:7), which is not here: "),
        (
            CONFIG.format(line=3, name='catkin'),
            "bot needs 'catkin' (find_package, CMakeLists.txt:3), which is of ROS 1: ",
        ),
        (
            CONFIG.format(line=3, name='tf2_msgs'),
            "bot needs 'tf2_msgs' (find_package, CMakeLists.txt:3), which is here for Python only",
        ),
        (
            REQUESTED,
            "bot needs 'Eigen3' 3.3 (find_package, CMakeLists.txt:3), a C++ library that this"
            ' machine does not have: install its development package',
        ),
        (MODULE, "bot needs 'Boost' (find_package, CMakeLists.txt:3), a C++ library that "),
        (
            COMMAND.format(line=9, name='ament_magic'),
            'bot calls ament_magic(), CMakeLists.txt:9, which is no command here: find_package()',
        ),
        (PKG_CONFIG, "bot needs 'libusb-1.0' (find_package, CMakeLists.txt:4), a C++ library "),
    ],
)
def test_what_is_missing_is_a_line(source, said, line):
    found = str(missing(said, source))
    assert found.startswith(line) and '\n' not in found


@pytest.mark.parametrize(
    'said',
    [
        '',
        'CMake Error at CMakeLists.txt:3 (message):\n  my own words\n\n',
        'FAILED: x.o\nerror: y\n',
    ],
)
def test_other_failures_are_left_as_they_are(source, said):
    assert missing(said, source) is None


def test_what_only_tests_need(source):
    lacks = missing(CONFIG.format(line=6, name='rostest'), source)
    assert lacks.is_for_tests
    lacks = missing(COMMAND.format(line=6, name='add_launch_test'), source)
    assert lacks.is_for_tests
    assert not missing(CONFIG.format(line=9, name='rclcpp'), source).is_for_tests


def test_a_package_without_manifest_is_called_as_its_folder(tmp_path):
    line = str(missing(CONFIG.format(line=1, name='a'), str(tmp_path / 'my_arm')))
    assert line.startswith("my_arm needs 'a' ")
