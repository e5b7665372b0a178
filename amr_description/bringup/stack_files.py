# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""Where stacks are: in the table of the ready-made ones, or in a Python file of a user."""

from collections.abc import Callable, Mapping
import importlib.util
from pathlib import Path

from amr_description.bringup.arguments import as_typed, declared, resolve, suggestion
from amr_description.bringup.description import Stack
from amr_description.bringup.packages import path_of
from amr_description.bringup.stacks import STACKS
from amr_description.errors import BringupError, UsageError
from amr_description.registry import resolve as import_target

type StackFunction = Callable[..., Stack]

_making: list[str] = []  # the stacks of which the function is being called


def find_stack(name: str) -> StackFunction:
    """Return the function of a stack of the table, or of a file ``<function>.py``."""
    if name in STACKS:
        return import_target(STACKS[name])
    path = Path(name)
    if path.suffix != '.py':
        raise UsageError(f"unknown stack '{name}'{suggestion(name, list(STACKS))}")
    if not path.is_file():
        raise UsageError(f"no stack: there is no file '{name}'")
    spec = importlib.util.spec_from_file_location(path.stem, path)
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    if not callable(getattr(module, path.stem, None)):
        raise BringupError(f"'{name}' has no function '{path.stem}' that returns its Stack")
    return getattr(module, path.stem)


def include(name: str | Path, **values: object) -> Stack:
    """
    Return a stack to stand among the nodes of another one.

    ::

        robot = include(Path(__file__).with_name('my_robot.py'), rtf=0.5)
        rviz = Node('rviz2', package='rviz2', start_when=ready(robot))
        return Stack([robot, rviz])

    :param name: The name of a ready-made stack, a ``package://`` URI, or a path.
    :param values: Its arguments; they are checked as if they were typed.
    """
    found = str(name) if name in STACKS else str(path_of(str(name)))
    return make_stack(found, {each: as_typed(value) for each, value in values.items()})


def make_stack(name: str, given: Mapping[str, str]) -> Stack:
    """Return a stack, as :func:`find_stack` takes its name; ``given``: its arguments, as typed."""
    if name in _making:
        chain = ' includes '.join(f"'{each}'" for each in [*_making, name])
        raise BringupError(f'a stack can not stand in itself: {chain}')
    function = find_stack(name)
    values = resolve(declared(function), given)
    _making.append(name)
    try:
        stack = function(**values)
    finally:
        _making.pop()
    if not isinstance(stack, Stack):
        raise BringupError(f"'{name}' returned {stack!r}; a stack's function returns a Stack")
    return stack
