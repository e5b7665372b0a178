# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""What ``ros2 launch`` is asked for -> what the bring-up starts: a stack's name, or its file."""

import ast
from collections.abc import Sequence
from contextlib import suppress
from pathlib import Path
import sys

from amr_description.ament_index import is_installed, package_prefix
from amr_description.bringup.stacks import STACKS
from amr_description.cli.not_offered import INSTEAD_OF_PACKAGES
from amr_description.errors import AmrError, UsageError
from amr_description.text import suggestion

_OURS = 'amr_description'
_TUTORIALS = {'gazebo': 'simulation'}  # as the tutorial calls its launch file -> our stack
_SUFFIXES = ('.launch.py', '.launch.xml', '.launch.yaml', '.launch', '.py')


def find_launch_file(
    package: str, file: str | None, arguments: Sequence[str]
) -> tuple[str, list[str]]:
    """
    Return a stack, as the bring-up takes it, and its arguments.

    :param package: A package, or the path of a file.
    :param file: The name of a launch file; after a path the first argument.
    :raises AmrError: It is not there, or not a stack.
    """
    if _is_path(package):
        return _stack_file(Path(package)), [*([file] if file else []), *arguments]
    if file is None or ':=' in file:
        what = f"'{package}' is a stack" if package in STACKS else f"which one of '{package}'?"
        raise UsageError(f'{what}; {_known_stacks()}')
    return _of_package(package, file), list(arguments)


def stacks_of(package: str) -> list[str]:
    """Return what may be launched of a package: names of stacks, or files. Raises AmrError."""
    share = package_prefix(package) / 'share' / package
    files = []
    for path in share.rglob('*.py'):
        with suppress(AmrError):
            if path.stem in _functions(path):
                files.append(path.name)
    return [*(STACKS if package == _OURS else ()), *sorted(files)]


def _is_path(word: str) -> bool:
    return '/' in word or word.endswith(('.py', '.xml', '.yaml')) or Path(word).is_file()


def _of_package(package: str, file: str) -> str:
    if package in INSTEAD_OF_PACKAGES and not is_installed(package):
        raise AmrError(f"Package '{package}' not found: {INSTEAD_OF_PACKAGES[package]}")
    share = package_prefix(package) / 'share' / package
    found = sorted(path for path in share.rglob(file) if path.is_file()) if _is_name(file) else []
    if len(found) > 1:
        paths = ', '.join(f"'{path}'" for path in found)
        raise AmrError(
            f"file '{file}' was found more than once in the share directory of package "
            f"'{package}': [{paths}]"
        )
    if found and package == _OURS and _is_foreign(found[0]):
        with suppress(AmrError):
            stack = _ready_made(file)
            print(
                f"[ros2launch]: launch files are not supported here: in place of '{found[0]}' the "
                f"stack '{stack}' is started",
                file=sys.stderr,
            )
            return stack
    if found:
        return _stack_file(found[0])
    if package == _OURS:
        return _ready_made(file)
    raise AmrError(
        f"file '{file}' was not found in the share directory of package '{package}' which is at "
        f"'{share}'"
    )


def _is_name(file: str) -> bool:
    """Tell whether it names a file rather than being a pattern or a path."""
    return not set(file) & set('*?[/') and file not in ('', '.', '..')


def _ready_made(file: str) -> str:
    """Return one of our stacks, by its name or as the tutorial calls its launch file."""
    name = next((file.removesuffix(s) for s in _SUFFIXES if file.endswith(s)), file)
    name = _TUTORIALS.get(name, name)
    if name not in STACKS:
        raise AmrError(f"{_OURS} has no stack '{file}'{suggestion(name, list(STACKS))}")
    return name


def _known_stacks() -> str:
    lines = ', '.join(f'ros2 launch {_OURS} {name}' for name in STACKS)
    return f'there are: {lines}; or a file of yours, by its path'


def _stack_file(path: Path) -> str:
    """Return the path if there is a file with a stack in it, as the bring-up reads it."""
    if not path.is_file():
        raise AmrError(f"there is no launch file '{path}'; {_known_stacks()}")
    if _is_foreign(path):
        raise _foreign(path)
    return str(path)


def _is_foreign(path: Path) -> bool:
    """Return whether it is a launch file of ROS, and no stack. Raises AmrError."""
    if path.suffix != '.py':
        return True
    functions = _functions(path)
    return path.stem not in functions and 'generate_launch_description' in functions


def _functions(path: Path) -> set[str]:
    """Return the names of the functions of a Python file. Raises AmrError."""
    try:
        tree = ast.parse(path.read_bytes(), str(path))
    except SyntaxError as error:
        line = f', line {error.lineno}' if error.lineno else ''
        raise AmrError(f"'{path}'{line}: is not Python: {error.msg}") from error
    except (ValueError, OSError) as error:
        raise AmrError(f"'{path}': is not Python: {error}") from error
    return {node.name for node in tree.body if isinstance(node, ast.FunctionDef)}


def _foreign(path: Path) -> AmrError:
    name = path.name.partition('.')[0]
    name = _TUTORIALS.get(name, name)
    would_do = (
        f'for the one of the tutorial: ros2 launch {_OURS} {name}'
        if name in STACKS
        else f'or one of: {", ".join(STACKS)} (ros2 launch {_OURS} NAME)'
    )
    return AmrError(
        f"'{path}': launch files (*.launch.py, .xml, .yaml) are not supported here; use a stack "
        f'(docs/write_your_own_stack.md), {would_do}'
    )
