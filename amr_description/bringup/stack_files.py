# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""Finds and calls the function of a stack: a ready-made one, or one in a user's Python file."""

from collections.abc import Callable, Iterator, Mapping
import contextlib
import importlib.util
import inspect
from pathlib import Path
import sys
from types import ModuleType
from typing import TypeAlias

from amr_description.ament_index import path_of
from amr_description.bringup import user_errors
from amr_description.bringup.arguments import as_typed, declared, resolve
from amr_description.bringup.description import Stack
from amr_description.bringup.stacks import STACKS
from amr_description.bringup.validation import require, shortened, VALUE
from amr_description.errors import AmrError, BringupError, UsageError
from amr_description.registry import resolve as import_target
from amr_description.text import suggestion

StackFunction: TypeAlias = Callable[..., Stack]

_include_chain: list[str] = []  # the stacks whose functions are being called, outermost first


def find_stack(name: str) -> StackFunction:
    """
    Return the function of a stack.

    Args:
        name: a ready-made stack, or the path of a file ``<function>.py``.

    Raises:
        UsageError: there is no such stack or file.
        BringupError: the file raises, or contains no such function.
    """
    if name in STACKS:
        return import_target(STACKS[name])
    path = Path(name)
    if path.suffix != '.py':
        raise UsageError(f"unknown stack '{name}'{suggestion(name, list(STACKS))}")
    if not path.is_file():
        raise UsageError(f"no stack: there is no file '{name}'")
    if not path.stem.isidentifier():
        raise BringupError(
            f"'{name}': a stack's file is called as its function, by letters, digits and _"
        )
    with _located_errors(name):
        module = _import(path)
    function = getattr(module, path.stem, None)
    if not callable(function) or inspect.isclass(function):
        functions = inspect.getmembers(module, inspect.isfunction)
        there = suggestion(path.stem, [n for n, f in functions if f.__module__ == path.stem])
        raise BringupError(f"'{name}' has no function '{path.stem}' that returns a Stack{there}")
    return function


def _import(path: Path) -> ModuleType:
    spec = importlib.util.spec_from_file_location(path.stem, path)
    if spec is None or spec.loader is None:
        raise BringupError(f'{path} is no Python module')
    module = importlib.util.module_from_spec(spec)
    sys.modules.setdefault(path.stem, module)  # dataclasses look up the module of a class
    spec.loader.exec_module(module)
    return module


@contextlib.contextmanager
def _located_errors(name: str) -> Iterator[None]:
    """Turn exceptions of a user's code into one line, with the innermost location in that code."""
    try:
        yield
    except AmrError as error:
        if name not in STACKS and not error.is_located:
            error.args = (f'{error}{user_errors.location(error)}',)
            error.is_located = True
        raise
    except Exception as error:
        raise BringupError(f"'{name}' failed: {user_errors.describe(error)}") from error


def include(name: str | Path, **values: object) -> Stack:
    """
    Return a stack that can be a member of another one.

    ::

        robot = include(Path(__file__).with_name('my_robot.py'), rtf=0.5)
        rviz = Node('rviz2', package='rviz2', start_when=ready(robot))
        return Stack([robot, rviz])

    Args:
        name: a ready-made stack, a ``package://`` URI, or a path.
        values: its arguments; they are checked like those of a command line.
    """
    found = str(name) if name in STACKS else str(path_of(str(name)))
    for each, value in values.items():
        require(f"include('{name}', {each}=%s)", value, VALUE)
    return make_stack(found, {each: as_typed(value) for each, value in values.items()})


def make_stack(name: str, given: Mapping[str, str]) -> Stack:
    """
    Call the function of a stack.

    Args:
        name: as :func:`find_stack` takes it.
        given: its arguments, as a user typed them.

    Raises:
        AmrError: the stack cannot be found, does not take the arguments, or is invalid.
    """
    if name in _include_chain:
        chain = ' includes '.join(f"'{each}'" for each in [*_include_chain, name])
        raise BringupError(f'a stack can not stand in itself: {chain}')
    function = find_stack(name)
    values = resolve(declared(function), given)
    _include_chain.append(name)
    try:
        with _located_errors(name):
            stack = function(**values)
    finally:
        _include_chain.pop()
    if not isinstance(stack, Stack):
        raise BringupError(
            f"'{name}' returned {shortened(stack)}; a stack's function returns a Stack"
        )
    return stack
