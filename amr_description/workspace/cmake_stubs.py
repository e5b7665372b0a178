# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
Empty packages of CMake in place of libraries, for packages that compile nothing.

Many packages of descriptions, meshes and launch files say ``find_package(urdf REQUIRED)`` and use
nothing of it. They need no C++ to be installed.
"""

from collections.abc import Iterable, Iterator
import os
from pathlib import Path
import re

# Commands that make something of what was found.
_USE = re.compile(
    r'^[^#\n]*\b(add_library|add_executable|add_custom_command|ament_auto_add_\w+|rosidl_\w+|'
    r'pybind11_add_module|generate_parameter_library|xacro_add_\w+|ExternalProject_Add|'
    r'FetchContent_\w+)\s*\(',
    re.MULTILINE,
)
# These bring commands of CMake, which a stub would not have.
_OF_THE_BUILD = re.compile(r'ament_|rosidl_|catkin$|.*_cmake$|.*_cmake_module$')
_FIND = re.compile(r'^[^#\n]*\bfind_package\s*\(\s*(\w+)', re.MULTILINE)
_PLACES = ('share/{0}/cmake', 'lib/cmake/{0}')
_CONFIG = '# Nothing: the package that asks for it compiles nothing.\n'
_VERSION = 'set(PACKAGE_VERSION_COMPATIBLE TRUE)\n'


def compiles_nothing(source: Path) -> bool:
    """Return whether a package only installs files, as far as its rules tell."""
    return not any(
        _USE.search(file.read_text(encoding='utf-8', errors='replace')) for file in _rules(source)
    )


def _rules(source: Path) -> Iterator[Path]:
    """Yield the rules of a package; what a build left in its folder is none of it."""
    for folder, subfolders, names in os.walk(source):
        if {'COLCON_IGNORE', 'CMakeCache.txt'} & {*names}:
            subfolders.clear()
            continue
        subfolders[:] = [name for name in subfolders if not name.startswith('.')]
        for name in names:
            if name == 'CMakeLists.txt' or name.endswith('.cmake'):
                yield Path(folder, name)


def write_stub(name: str, folder: Path) -> str | None:
    """
    Write an empty package, which ``find_package(name)`` is to find.

    Args:
        name: of the package that is not here.
        folder: where to write it.

    Returns:
        The argument of CMake by which it is found; None: a stub would not do, as the package
        brings commands of CMake.
    """
    if _OF_THE_BUILD.match(name):
        return None
    place = folder / name
    place.mkdir(parents=True, exist_ok=True)
    (place / f'{name}Config.cmake').write_text(_CONFIG, encoding='utf-8')
    (place / f'{name}ConfigVersion.cmake').write_text(_VERSION, encoding='utf-8')
    return f'-D{name}_DIR={place}'


def write_expected_stubs(source: Path, folder: Path) -> list[str]:
    """
    Write the stubs that a package which compiles nothing is sure to need.

    Each failed run of CMake, which would show that one is missing, takes a second. Sure to be
    needed are those for packages of ROS, which the manifest names as well, that are in no prefix.
    Where such a library is installed elsewhere, its stub is used all the same: the package uses
    nothing of it.

    Args:
        source: the folder of the package.
        folder: where to write the stubs.

    Returns:
        The arguments of CMake by which they are found.
    """
    try:
        rules = (source / 'CMakeLists.txt').read_text(encoding='utf-8', errors='replace')
        manifest = (source / 'package.xml').read_text(encoding='utf-8', errors='replace')
    except OSError:
        return []
    prefixes = [
        prefix
        for variable in ('AMENT_PREFIX_PATH', 'CMAKE_PREFIX_PATH')
        for prefix in os.environ.get(variable, '').split(os.pathsep)
        if prefix
    ]
    lacking = (
        name
        for name in dict.fromkeys(_FIND.findall(rules.partition('BUILD_TESTING')[0]))
        if re.search(rf'>\s*{name}\s*<', manifest) and not _is_in(prefixes, name)
    )
    return [argument for name in lacking if (argument := write_stub(name, folder))]


def _is_in(prefixes: Iterable[str], name: str) -> bool:
    """Return whether a prefix has what ``find_package(name)`` looks for."""
    return any(
        os.path.exists(os.path.join(prefix, place.format(name), f'{name}{end}.cmake'))
        for prefix in prefixes
        for place in _PLACES
        for end in ('Config', '-config')
    )
