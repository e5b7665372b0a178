# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
A node made ready to run: its command line and the parameter files that this names.

What can be wrong with a node is found here, before the first start.
"""

from collections.abc import Mapping, Sequence
import contextlib
from dataclasses import dataclass
import os
from pathlib import Path
import re
import shlex
import shutil

from amr_description.ament_index import executable_of, path_of
from amr_description.bringup.description import Node, ParameterValue, Stack
from amr_description.bringup.environment import interpreter_of
from amr_description.bringup.placement import Placement, ResolvedNode
from amr_description.errors import BringupError, UsageError


def node_key(name: str | None, namespace: str | None) -> str:
    """Return the name that a node's parameters stand under: its full name if known, else all."""
    if name and namespace:
        return f'/{namespace.strip("/")}/{name}'.replace('//', '/')
    return '/**'


def yaml_text(key: str, parameters: Mapping[str, ParameterValue]) -> str:
    """Return a parameter file for one node. Raises BringupError: ROS has no type for a value."""
    from amr_description.parameter_files import dotted, flatten, parameter_file_text

    values = {}
    for keys, value in flatten(parameters):
        if odd := [each for each in keys if not isinstance(each, str)]:
            raise BringupError(f'the name of a parameter is {odd[0]!r}, which is no text')
        values[dotted(keys)] = _checked(dotted(keys), value)
    return parameter_file_text(key, values)


def _checked(name: str, value: ParameterValue) -> ParameterValue:
    """Return a value in the types that ROS has. Raises BringupError."""
    if not isinstance(value, Sequence) or isinstance(value, str | bytes):
        return _scalar(name, value)
    if not value:
        raise BringupError(
            f"parameter '{name}' is an empty list, which has no type in ROS; leave it out"
        )
    if len({type(element) for element in value}) > 1:
        raise BringupError(
            f"parameter '{name}' has elements of several types: {list(value)}; a ROS array has one"
        )
    return [_scalar(name, element) for element in value]


def _scalar(name: str, value: object) -> bool | int | float | str:
    match value:
        case bool() | float():
            return value
        case int() if -(2**63) <= value < 2**63:
            return value
        case str() | Path() if '\0' not in str(value):
            return str(value)
    raise BringupError(
        f"parameter '{name}' is {value!r}, a {type(value).__name__}; it can be bool, "
        'int (64 bit), float, str (without NUL) or a list of one of them'
    )


@dataclass(frozen=True)
class ProcessSpec:
    """What the orchestrator starts for one node."""

    placed: ResolvedNode
    name: str
    """``<executable>-<number in the stack, from 1>``, as on the screen."""
    executable: Path
    parameter_files: Sequence[tuple[Path, str | None]]
    """(path, text to write there before the start; None: the file is the user's)."""
    launch_prefix: str = ''
    """What the command line begins with, unless its node says so itself."""

    @property
    def node(self) -> Node:
        """What it is made of."""
        return self.placed.node

    @property
    def environment(self) -> Mapping[str, str]:
        """The variables that the stack gives the node."""
        return self.placed.environment

    @property
    def command(self) -> list[str]:
        """The command line, as launch builds it."""
        node = self.node
        prefix = shlex.split(node.prefix or self.launch_prefix)
        words = [*prefix, str(self.executable), *map(str, node.arguments)]
        words.append('--ros-args')
        if node.name:
            words += ['-r', f'__node:={node.name}']
        if self.placed.namespace:
            words += ['-r', f'__ns:={self.placed.namespace}']
        for path, _ in self.parameter_files:
            words += ['--params-file', str(path)]
        for source, target in self.placed.remappings:
            words += ['-r', f'{source}:={target}']
        return words

    @property
    def takes_sigint_later(self) -> bool:
        """Whether it is a program of ours: it unblocks SIGINT once it can take it (entry.py)."""
        return self.node.package == 'amr_description' and not (
            self.node.prefix or self.launch_prefix
        )

    def why_not(self, error: OSError) -> str:
        """Say why it could not be started; of a script the kernel tells only that it was not."""
        with contextlib.suppress(OSError):
            interpreter = interpreter_of(self.executable, os.environ)
            if interpreter and not interpreter.exists():
                return f'{self.executable} begins with #!{interpreter}, which is not there'
        return str(error)

    @property
    def command_text(self) -> str:
        """The command line as one would type it."""
        return shlex.join(self.command)

    def write_parameter_files(self) -> None:
        """Write the parameters that stand in the stack to where the command line says."""
        for path, text in self.parameter_files:
            if text is not None:
                path.write_text(text, encoding='utf-8')


@dataclass(frozen=True)
class LaunchPrefix:
    """What command lines are to begin with: ``gdb -ex run --args``, ``valgrind``."""

    words: str = ''
    filter: str = ''
    """A regular expression; only executables of which the name begins so get it."""

    def __post_init__(self) -> None:
        """Refuse what is no command or no pattern."""
        check_prefix(self.words)
        try:
            re.compile(self.filter)
        except re.error as error:
            raise UsageError(f"--launch-prefix-filter '{self.filter}': {error}") from None

    def of(self, executable: str) -> str:
        """Return what the command line of an executable begins with."""
        return self.words if re.match(self.filter, executable) else ''


def check_prefix(prefix: str) -> None:
    """Raise BringupError if the command line could not begin so."""
    try:
        words = shlex.split(prefix)
    except ValueError as error:
        raise BringupError(f'prefix {prefix!r}: {error}') from None
    if words and shutil.which(words[0]) is None:
        raise BringupError(f"prefix {prefix!r}: there is no command '{words[0]}' on the PATH")


def jobs_of(stack: Stack, folder: Path, prefix: LaunchPrefix | None = None) -> list[ProcessSpec]:
    """
    Make the nodes of a stack ready to run; starts and writes nothing.

    :param folder: Where parameters are written: the log folder, so that they stay readable and
        the printed command line can be typed again, and no temporary file is ever left over.
    :param prefix: That of all command lines.
    :raises BringupError: A package, an executable, a parameter file or a prefix is missing.
    """
    placed = Placement(stack).nodes
    prefix = prefix or LaunchPrefix()
    return [_job(each, number, folder, prefix) for number, each in enumerate(placed, start=1)]


def _job(placed: ResolvedNode, number: int, folder: Path, prefix: LaunchPrefix) -> ProcessSpec:
    node = placed.node
    check_prefix(node.prefix)
    name = f'{node.executable}-{number}'
    files: list[tuple[Path, str | None]] = []
    for index, entry in enumerate(placed.parameters, start=1):
        if isinstance(entry, Mapping):
            path = folder / f'{name}-parameters-{index}.yaml'
            files.append((path, _parameters(name, placed, entry)))
        else:
            files.append((path_of(str(entry)), None))
    executable = executable_of(node.package, node.executable)
    return ProcessSpec(placed, name, executable, files, prefix.of(node.executable))


def _parameters(name: str, placed: ResolvedNode, table: Mapping[str, ParameterValue]) -> str:
    try:
        return yaml_text(node_key(placed.node.name, placed.namespace), table)
    except BringupError as error:
        raise BringupError(f'{name}: {error}') from None
