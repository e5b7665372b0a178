# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""What a package lacks, from what CMake says when it cannot configure it."""

from collections.abc import Iterator
from dataclasses import dataclass
import os
from pathlib import Path
import re

_NAME = re.compile(r'<name>\s*([\w-]+)\s*</name>')
_ERROR = re.compile(r'^CMake Error at (.+?):(\d+) \((\w+)\):$')
_CALL = re.compile(r'  (.+?):(\d+) \(\w+\)$')
_RULES = 'CMakeLists.txt'
# Of find_package() and find_dependency(); of a version; of Find*.cmake; of pkg_check_modules().
_MISSING = (
    re.compile(
        r'package configuration file provided by "([^"]+)"(?: \(requested version ([^)]+)\))?'
    ),
    re.compile(
        r'configuration file for package "([^"]+)" that is compatible with requested version'
        r' (?:range )?"([^"]+)"'
    ),
    re.compile(r'Could NOT find (\S+)'),
    re.compile(r'required packages were not found: - (\S+)'),
)
_UNKNOWN_COMMAND = re.compile(r'Unknown CMake command "(\S+)"')
_OF_ROS = re.compile(r'[a-z][a-z0-9]*(_[a-z0-9]+)*')


@dataclass(frozen=True)
class Missing:
    """A package that CMake asks for in vain, or a command of one."""

    name: str
    version: str | None
    place: tuple[str, int] | None
    """File and line of the package's own rules."""
    source: Path
    """The folder of the package that asks."""
    is_command: bool = False

    @property
    def is_for_tests(self) -> bool:
        """Whether only the tests of the package need it."""
        return self.place is not None and _is_for_tests(self.source / self.place[0], self.place[1])

    def __str__(self) -> str:
        """Say which package lacks what, where it asks for it, and what would do."""
        package = package_of(self.source)
        if self.is_command:
            return (
                f'{package} {self.wish}, which is no command here: '
                'find_package() of the package that has it is missing, or that package'
            )
        return f'{package} {self.wish}, {_advice(self.name)}'

    @property
    def wish(self) -> str:
        """What is asked for, and where: ``needs 'OpenCV' (find_package, CMakeLists.txt:12)``."""
        where = f', {self.place[0]}:{self.place[1]}' if self.place else ''
        if self.is_command:
            return f'calls {self.name}(){where}'
        wanted = f'{self.name!r} {self.version}' if self.version else repr(self.name)
        return f'needs {wanted} (find_package{where})'


def missing(said: str, source: str) -> Missing | None:
    """
    Return what a package lacks, None where CMake failed for another reason.

    Args:
        said: what CMake wrote.
        source: the folder of the package; empty: not known.
    """
    for text, places in _errors(said):
        own = next((each for each in places if os.path.basename(each[0]) == _RULES), None)
        for pattern in _MISSING:
            found = pattern.search(text)
            if found:
                name, version = found[1], found[2] if pattern.groups > 1 else None
                return Missing(name, version, own, Path(source))
        if found := _UNKNOWN_COMMAND.search(text):
            return Missing(found[1], None, own, Path(source), is_command=True)
    return None


def _errors(said: str) -> Iterator[tuple[str, list[tuple[str, int]]]]:
    """Yield the text of each error, on one line, and the places it comes from, innermost first."""
    lines = said.splitlines()
    for start, line in enumerate(lines):
        begin = _ERROR.match(line)
        if not begin:
            continue
        places = [(begin[1], int(begin[2]))]
        words = []
        for following in lines[start + 1 :]:
            call = _CALL.match(following)
            if call:
                places.append((call[1], int(call[2])))
            elif following.startswith('  ') or not following.strip():
                words += following.split()
            elif not following.startswith('Call Stack'):
                break
        yield ' '.join(words), places


def _advice(name: str) -> str:
    """Say what a missing package is, as far as its name tells, and what would do."""
    if name == 'catkin':
        return 'which is of ROS 1: the package has to be moved to ROS 2 (ament_cmake) first'
    if not _OF_ROS.fullmatch(name):
        return 'a C++ library that this machine does not have: install its development package'
    if _is_here(name):
        return (
            'which is here for Python only: put its package into this workspace, to build it too'
        )
    return (
        'which is not here: PyPI has few C++ libraries of ROS. Put it into this workspace,'
        ' write the node in Python, or build where ROS 2 Jazzy is installed (apt install'
        f' ros-jazzy-{name.replace("_", "-")})'
    )


def _is_here(name: str) -> bool:
    """Return whether a package is installed, if not for CMake."""
    prefixes = os.environ.get('AMENT_PREFIX_PATH', '').split(os.pathsep)
    index = 'share/ament_index/resource_index/packages'
    return any(prefix and os.path.exists(f'{prefix}/{index}/{name}') for prefix in prefixes)


def package_of(source: Path) -> str:
    """Return the name of the package in a folder: of its manifest, else of the folder."""
    try:
        manifest = (source / 'package.xml').read_text(encoding='utf-8', errors='replace')
    except OSError:
        manifest = ''
    found = _NAME.search(manifest)
    return found[1] if found else source.resolve().name


def _is_for_tests(rules: Path, line: int) -> bool:
    """Return whether a line of ``CMakeLists.txt`` stands below ``if(BUILD_TESTING)``."""
    try:
        lines = rules.read_text(encoding='utf-8', errors='replace').splitlines()[: line - 1]
    except OSError:
        return False
    conditions: list[str] = []
    for text in lines:
        if begin := re.match(r'\s*if\s*\((.*)', text, re.IGNORECASE):
            conditions.append(begin[1])
        elif re.match(r'\s*endif\s*\(', text, re.IGNORECASE) and conditions:
            conditions.pop()
    return any('BUILD_TESTING' in condition for condition in conditions)
