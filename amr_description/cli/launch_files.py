# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""What ``ros2 launch`` is asked for -> a stack's name, its file, or a launch file of ROS."""

import ast
from collections.abc import Sequence
from contextlib import suppress
from pathlib import Path

from amr_description.ament_index import (
    hint_at,
    is_installed,
    not_installed,
    package_prefix,
    sources_of,
)
from amr_description.bringup.stacks import STACKS
from amr_description.errors import AmrError, UsageError
from amr_description.stand_ins import INSTEAD_OF_PACKAGES
from amr_description.text import did_you_mean, suggestion

_OURS = 'amr_description'
_TUTORIALS = {'gazebo': 'simulation'}  # as the tutorial calls its launch file -> our stack
_FUNCTION = 'generate_launch_description'
MARKUP = ('.xml', '.yaml', '.yml', '.launch')
"""The endings of launch files that are not Python; ``launch_api.markup`` reads them."""
_SUFFIXES = ('.launch.py', '.launch.xml', '.launch.yaml', '.launch', '.py')


def find_launch_file(
    package: str, file: str | None, arguments: Sequence[str]
) -> tuple[str, list[str]]:
    """
    Return a stack, as the bring-up takes it, or the path of a launch file, and its arguments.

    Args:
        package: a package, or the path of a file.
        file: the name of a launch file or of a stack; after a path, the first argument.
        arguments: the others.

    Raises:
        AmrError: it is not there, or its name is not that of a launch file.
        UsageError: of a package, no file is named.
    """
    if _is_path(package):
        return _stack_file(Path(package)), [*([file] if file else []), *arguments]
    if file is None or ':=' in file:
        what = f"'{package}' is a stack" if package in STACKS else f"which one of '{package}'?"
        raise UsageError(f'{what}; {_known_stacks()}')
    return _of_package(package, file), list(arguments)


def launchable_names(package: str) -> list[str]:
    """Return what may be launched of a package: names of stacks and files. Raises AmrError."""
    share = package_prefix(package) / 'share' / package
    files = {path.name for path in launch_files_below(share, with_stacks=True)}
    return [*(STACKS if package == _OURS else ()), *sorted(files)]


def launch_files_below(folder: Path, *, with_stacks: bool = False) -> set[Path]:
    """Return the launch files of ROS below a folder, and the stacks, if these are asked for."""
    markup = ('*.launch', *(f'*.launch{ending}' for ending in MARKUP))
    files = {path for pattern in markup for path in folder.rglob(pattern)}
    for path in folder.rglob('*.py'):
        with suppress(AmrError):
            if {_FUNCTION, *((path.stem,) if with_stacks else ())} & _functions(path):
                files.add(path)
    return files


def _is_path(word: str) -> bool:
    return '/' in word or word.endswith(('.py', *MARKUP)) or Path(word).is_file()


def _of_package(package: str, file: str) -> str:
    if package in INSTEAD_OF_PACKAGES and not is_installed(package):
        raise AmrError(f"Package '{package}' not found: {INSTEAD_OF_PACKAGES[package]}")
    prefix = package_prefix(package)
    share = prefix / 'share' / package
    found = sorted(path for path in share.rglob(file) if path.is_file()) if _is_name(file) else []
    if len(found) > 1:
        paths = ', '.join(f"'{path}'" for path in found)
        raise AmrError(
            f"file '{file}' was found more than once in the share directory of package "
            f"'{package}': [{paths}]"
        )
    if found:
        return _stack_file(found[0])
    if package == _OURS:
        return _ready_made(file)
    sources = (each for folder in sources_of(package, prefix) for each in folder.rglob(file))
    source = next(sources, None) if _is_name(file) else None
    hint = not_installed(source) if source else did_you_mean(file, launchable_names(package))
    raise AmrError(
        f"file '{file}' was not found in the share directory of package '{package}' which is at "
        f"'{share}'{hint}"
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
    """Return the path if there is a file with a stack in it, or a launch file. Raises AmrError."""
    if not path.is_file():
        hint = hint_at(path) or f'; {_known_stacks()}'
        raise AmrError(f"there is no launch file '{path}'{hint}")
    if path.suffix not in ('.py', *MARKUP):
        endings = ', '.join(_SUFFIXES)
        raise AmrError(f"'{path}': the name of a launch file ends with one of {endings}")
    return str(path)


def is_launch_file(stack: str) -> bool:
    """
    Return whether it is a launch file of ROS, and no stack.

    Args:
        stack: as :func:`find_launch_file` returns it.

    Raises:
        AmrError: it is not Python.
    """
    if stack in STACKS:
        return False
    path = Path(stack)
    if path.suffix in MARKUP:
        return True
    functions = _functions(path)
    return path.stem not in functions and (
        _FUNCTION in functions or path.name.endswith('.launch.py')
    )


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
