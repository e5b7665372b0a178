# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
The Python half of a package of CMake whose C++ half needs a library that is not here.

cv_bridge, diagnostic_updater, tf2_geometry_msgs and the like have a Python package beside their
libraries, which is what nodes in Python import. Rules of CMake that are read after ``project()``
take the other half out: what is not found is no error, a library or an executable becomes a target
that builds nothing, and a command that only a missing package has does nothing.
"""

from pathlib import Path
import re

_PYTHON = re.compile(r'^[^#\n]*\bament_python_install_package\s*\(', re.MULTILINE)
_GENERATED = re.compile(r'^[^#\n]*\brosidl_generate_interfaces\s*\(', re.MULTILINE)
_LEFT_OUT = 'left_out.txt'
_RULES = 'python_half.cmake'
_FIRST_RULES = """\
include_guard(GLOBAL)
# Nothing that is missing stops the build.
macro(find_package name)
  set(_amr_arguments ${ARGN})
  list(REMOVE_ITEM _amr_arguments REQUIRED QUIET)
  _find_package(${name} ${_amr_arguments} QUIET)
  # Other files ask what is found to go on in another way.
  string(FIND "${CMAKE_CURRENT_LIST_FILE}" "${CMAKE_SOURCE_DIR}/" _amr_place)
  if(_amr_place EQUAL 0)
    set(${name}_FOUND TRUE)
  endif()
endmacro()
# Libraries and executables are targets that are installed, exported and linked in vain.
function(add_library name)
  if("ALIAS" IN_LIST ARGN OR "IMPORTED" IN_LIST ARGN)
    _add_library(${name} ${ARGN})
  else()
    _add_library(${name} INTERFACE)
    file(APPEND "@LEFT_OUT@" "${name}\\n")
  endif()
endfunction()
function(add_executable name)
  if("ALIAS" IN_LIST ARGN OR "IMPORTED" IN_LIST ARGN)
    _add_executable(${name} ${ARGN})
  else()
    add_library(${name})
  endif()
endfunction()
# Headers that would have been generated are not there.
function(install kind)
  if(kind STREQUAL "FILES")
    _install(${kind} ${ARGN} OPTIONAL)
  else()
    _install(${kind} ${ARGN})
  endif()
endfunction()
function(add_custom_command first)
  if(NOT first STREQUAL "TARGET")
    _add_custom_command(${first} ${ARGN})
  endif()
endfunction()
"""
_ON_TARGETS = (
    'target_compile_definitions',
    'target_compile_features',
    'target_compile_options',
    'target_include_directories',
    'target_link_directories',
    'target_link_libraries',
    'target_link_options',
    'target_precompile_headers',
    'target_sources',
)
_MODULES = ('pybind11_add_module', 'python3_add_module', 'python_add_library')
_NOTHING = 'function({0})\nendfunction()\n'
_MODULE = 'function({0} name)\n  add_library(${{name}})\nendfunction()\n'


def has_python_half(rules: str) -> bool:
    """
    Return whether a package can do without its other half.

    One with messages cannot: their libraries are compiled.

    Args:
        rules: the text of all its rules of CMake.
    """
    return bool(_PYTHON.search(rules)) and not _GENERATED.search(rules)


def forgetting(folder: Path) -> list[str]:
    """Return the arguments by which CMake forgets the rules of an earlier build in a folder."""
    return ['-UCMAKE_PROJECT_INCLUDE'] if (folder / _RULES).exists() else []


class PythonHalf:
    """The rules that take the other half of a package out."""

    def __init__(self, folder: Path) -> None:
        """Write them below a folder, which may be there from an earlier build."""
        folder.mkdir(parents=True, exist_ok=True)
        self._rules = folder / _RULES
        self._left_out = folder / _LEFT_OUT
        self._commands: set[str] = set()
        text = _FIRST_RULES.replace('@LEFT_OUT@', self._left_out.as_posix())
        text += ''.join(map(_NOTHING.format, _ON_TARGETS))
        text += ''.join(map(_MODULE.format, _MODULES))
        self._rules.write_text(text, encoding='utf-8')

    @property
    def arguments(self) -> list[str]:
        """The arguments of CMake by which the rules are read."""
        return [
            f'-DCMAKE_PROJECT_INCLUDE={self._rules}',
            '-DBUILD_TESTING=OFF',
            # Links are refused for targets that build nothing; and install() would be another.
            '-DAMENT_CMAKE_SYMLINK_INSTALL=OFF',
        ]

    def begin(self) -> None:
        """Forget what an earlier run of CMake has left out."""
        self._left_out.unlink(missing_ok=True)

    def without(self, command: str) -> bool:
        """Have a command do nothing; return whether that is new."""
        if command in self._commands:
            return False
        self._commands.add(command)
        with self._rules.open('a', encoding='utf-8') as file:
            file.write(_NOTHING.format(command))
        return True

    @property
    def left_out(self) -> list[str]:
        """The names of the libraries and executables that are not built, in order."""
        try:
            names = self._left_out.read_text(encoding='utf-8').split()
        except OSError:
            return []
        return list(dict.fromkeys(names))
