# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
What stands in for a library, in packages that compile nothing.

Many packages of descriptions, meshes and launch files say ``find_package(urdf REQUIRED)`` and use
nothing of it. They need no C++ to be installed.
"""

from pathlib import Path
import re

# Commands that make something of what was found.
_USE = re.compile(
    r'^[^#\n]*\b(add_library|add_executable|add_custom_command|ament_auto_add_\w+|rosidl_\w+|'
    r'pybind11_add_module|generate_parameter_library|xacro_add_\w+|ExternalProject_Add|'
    r'FetchContent_\w+)\s*\(',
    re.MULTILINE,
)
# These bring commands of CMake, which a stand-in would not have.
_OF_THE_BUILD = re.compile(r'ament_|rosidl_|catkin$|.*_cmake$|.*_cmake_module$')
_CONFIG = '# Nothing: the package that asks for it compiles nothing.\n'
_VERSION = 'set(PACKAGE_VERSION_COMPATIBLE TRUE)\n'


def compiles_nothing(source: Path) -> bool:
    """Return whether a package only installs files, as far as its rules tell."""
    rules = [*source.rglob('CMakeLists.txt'), *source.rglob('*.cmake')]
    return not any(
        _USE.search(file.read_text(encoding='utf-8', errors='replace')) for file in rules
    )


def stand_in(name: str, folder: Path) -> str | None:
    """
    Write what ``find_package(name)`` finds then; return the argument of CMake for it.

    Args:
        name: of the package that is not here.
        folder: where to.

    Returns:
        None: what this package has cannot be done without.
    """
    if _OF_THE_BUILD.match(name):
        return None
    place = folder / name
    place.mkdir(parents=True, exist_ok=True)
    (place / f'{name}Config.cmake').write_text(_CONFIG, encoding='utf-8')
    (place / f'{name}ConfigVersion.cmake').write_text(_VERSION, encoding='utf-8')
    return f'-D{name}_DIR={place}'
