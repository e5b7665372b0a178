# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
CMake, as ``colcon build`` starts it here (``CMAKE_COMMAND``).

colcon shows what a build wrote to stderr. That is too much where CMake misses a library, twelve
lines for each, and too little where Ninja builds, which writes the errors of compilers and
generators to stdout. So when CMake fails, this writes one line where the cause is known, else the
words of CMake or of what it ran; the whole text goes to stdout, which is colcon's log.
"""

from collections.abc import Iterable, Iterator, Sequence
import os
from pathlib import Path
import re
import shutil
import subprocess
import sys

from amr_description.workspace.cmake_errors import Missing, missing, package_of
from amr_description.workspace.python_half import forgetting, has_python_half, PythonHalf

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
    return not _USE.search(_text_of_rules(source))


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


_COMPILERS = {'C': ('cc', 'gcc', 'clang'), 'CXX': ('c++', 'g++', 'clang++')}
_FAILED = re.compile(r'^(FAILED: |ninja: error: |CMake Error)', re.MULTILINE)
_FAULTS = 'rosidl_generate_interfaces/*/faults'
_INTERRUPTED = 130
_NO_PROGRAM = '/bin/false'  # given to CMake where there is no compiler
_NO_FEATURES = 'no known features'
_NO_COMPILER = """\
error: to compile C or C++ takes a compiler, and there was none on the PATH (Debian, Ubuntu: apt \
install g++; then: colcon build --cmake-clean-cache)
"""


def main(cmake: str, arguments: Sequence[str]) -> int:
    """
    Run CMake; return its exit code.

    Args:
        cmake: its executable.
        arguments: those of the command line.
    """
    first = arguments[0] if arguments else ''
    if first == '--build':
        folder = arguments[1] if len(arguments) > 1 else ''
        if not _is_configured(folder) and 'help' in arguments:
            return 1  # colcon asks what there is to install; Ninja would complain on its stderr
        return _build([cmake, *arguments], folder)
    if first.startswith('-') or not os.path.isdir(first):
        os.execv(cmake, [cmake, *arguments])
    return _configure([cmake, *arguments], first, _without_compiler(arguments))


def _configure(command: list[str], source: str, compilers: list[str]) -> int:
    """Configure the build of the package in ``source``, without what it can do without."""
    folder, can_do_without = Path(source), compiles_nothing(Path(source))
    more = [*compilers, *(write_expected_stubs(folder, _stubs()) if can_do_without else ())]
    notes = ''
    command[1:1] = forgetting(_stubs())
    while True:
        code, said = _run([*command, *more])
        lacks = missing(said, source) if code else None
        way_out, note = _without(lacks, folder, can_do_without) if lacks else (None, '')
        if not way_out or way_out in more:
            break
        sys.stdout.write(said)
        more.append(way_out)
        notes += note
    if lacks and has_python_half(_text_of_rules(folder)):
        code, said, note = _configure_python_half([*command, *more], lacks, said)
        notes += note
    if code and compilers and _NO_FEATURES in said:
        said = _NO_COMPILER
    _report(code, said, said, source)
    if not code:
        sys.stderr.write(notes)
    return code


def _configure_python_half(command: list[str], lacks: Missing, said: str) -> tuple[int, str, str]:
    """
    Configure a package without its C++ half.

    Args:
        command: that failed.
        lacks: what the C++ half lacks.
        said: what CMake wrote about that.

    Returns:
        The exit code, what CMake wrote to stderr, and what to say of what is left out.
    """
    half, words = PythonHalf(_stubs()), said
    while True:
        sys.stdout.write(words)
        half.begin()
        code, words = _run([*command, *half.arguments])
        other = missing(words, str(lacks.source)) if code else None
        if not (other and other.is_command and half.without(other.name)):
            break
    sys.stdout.write(words)
    if code:
        return code, said, ''  # what the whole package lacks tells more
    package, names = package_of(lacks.source), ', '.join(half.left_out)
    note = f'{package}: only its Python half is built, without {names or "what is compiled"}: '
    return code, '', f'{note}it {lacks.wish}\n'


def _text_of_rules(source: Path) -> str:
    return '\n'.join(file.read_text(encoding='utf-8', errors='replace') for file in _rules(source))


def _run(command: list[str]) -> tuple[int, str]:
    """Run CMake; return its exit code, and what it wrote to stderr."""
    with subprocess.Popen(command, stderr=subprocess.PIPE, text=True, errors='replace') as process:
        assert process.stderr
        try:
            said = process.stderr.read()
        except KeyboardInterrupt:  # CMake was sent it, too
            return _INTERRUPTED, ''
    return process.returncode, said


def _without(lacks: Missing, source: Path, can_do_without: bool) -> tuple[str | None, str]:
    """Return the argument to build a package without what it lacks, and what to say of it."""
    if lacks.is_for_tests:
        package = package_of(source)
        return (
            '-DBUILD_TESTING=OFF',
            f'{package} is built without its tests, which need {lacks.name!r}: that is not here\n',
        )
    has_stub = can_do_without and not lacks.is_command
    return write_stub(lacks.name, _stubs()) if has_stub else None, ''


def _stubs() -> Path:
    """Return the folder for stubs: colcon starts CMake in that of the build."""
    return Path('stubs').resolve()


def _build(command: list[str], folder: str) -> int:
    """Build in ``folder``; what it prints is shown as it comes."""
    for file in Path(folder).glob(_FAULTS):
        file.unlink()  # CMake may fail before they are looked for anew
    printed: list[str] = []
    with subprocess.Popen(
        command, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, errors='replace'
    ) as process:
        assert process.stdout
        try:
            for line in process.stdout:
                printed.append(line)
                sys.stdout.write(line)
                sys.stdout.flush()
        except KeyboardInterrupt:
            return _INTERRUPTED
    if process.returncode:
        text = ''.join(printed)
        failed = _FAILED.search(text)
        if failed:
            text = text[failed.start() :]
        if text.startswith('FAILED: ') and _cached(folder, 'CMAKE_C(XX)?_COMPILER') == _NO_PROGRAM:
            text = _NO_COMPILER
        faults = sorted(Path(folder).glob(_FAULTS))  # interface_build/cmake_target.py writes them
        text = ''.join(file.read_text() for file in faults) or text
        _report(process.returncode, text, '', _cached(folder, 'CMAKE_HOME_DIRECTORY'))
    return process.returncode


def _report(code: int, said: str, unwritten: str, source: str) -> None:
    """Write why CMake failed to stderr, and to stdout what of its words is not there yet."""
    line = missing(said, source) if code else None
    if line:
        sys.stdout.write(unwritten)
        said = f'{line}\n'
    sys.stdout.flush()
    sys.stderr.write(said)


def _without_compiler(arguments: Sequence[str]) -> list[str]:
    """
    Return what lets CMake go on where there is no compiler.

    ``project(my_robot)`` asks for C and C++ although most packages that only install files never
    compile anything. Where something is compiled, the build ends with :data:`_NO_COMPILER`.
    """
    if any('CMAKE_TOOLCHAIN_FILE' in argument for argument in arguments):
        return []
    more = []
    for language, names in _COMPILERS.items():
        variable = f'CMAKE_{language}_COMPILER'
        if (
            os.environ.get('CC' if language == 'C' else 'CXX')
            or any(argument.startswith(f'-D{variable}=') for argument in arguments)
            or any(map(shutil.which, names))
        ):
            continue
        more += [f'-D{variable}={_NO_PROGRAM}', f'-D{variable}_FORCED=TRUE']
    return more


def _is_configured(folder: str) -> bool:
    return any(os.path.exists(os.path.join(folder, name)) for name in ('build.ninja', 'Makefile'))


def _cached(folder: str, variable: str) -> str:
    """Return the value of a variable in the cache of ``folder``, a pattern; empty: not there."""
    try:
        cache = Path(folder, 'CMakeCache.txt').read_text(encoding='utf-8', errors='replace')
    except OSError:
        return ''
    found = re.search(rf'^{variable}:\w+=(?P<value>.*)$', cache, re.MULTILINE)
    return found['value'] if found else ''
