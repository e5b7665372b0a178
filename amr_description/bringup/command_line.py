# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
The command line of each node of a stack, with the parameter files that it names.

Everything that can be wrong with a node is found here, before the first process starts.
"""

from collections.abc import Mapping, Sequence
import contextlib
from dataclasses import dataclass
import os
from pathlib import Path
import re
import shlex
import shutil

from amr_description.ament_index import executable_of, is_own, OWN_PACKAGE, path_of
from amr_description.bringup.description import (
    LateTable,
    Node,
    ParameterText,
    ParameterValue,
    Stack,
)
from amr_description.bringup.environment import interpreter_of, is_of_this_python
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
    """The process that the orchestrator starts for one node."""

    resolved: ResolvedNode
    name: str
    """``<executable>-<number in the stack, from 1>``, as on the screen."""
    executable: Path
    parameter_files: Sequence[tuple[Path, str | LateTable | None]]
    """(path, what to write there before the start; None: it is a file of the user)."""
    launch_prefix: str = ''
    """Words before the command line, unless the node has a prefix of its own."""

    @property
    def node(self) -> Node:
        """The node as the stack contains it."""
        return self.resolved.node

    @property
    def environment(self) -> Mapping[str, str | None]:
        """The variables that the stack sets for the node; None: it has none of this name."""
        return self.resolved.environment

    def variables(self, base: Mapping[str, str]) -> dict[str, str]:
        """Return all variables of the process. ``base``: those of the bring-up."""
        every = {**base, **self.environment}
        return {name: value for name, value in every.items() if value is not None}

    @property
    def command(self) -> list[str]:
        """The command line, as launch builds it."""
        node = self.node
        prefix = shlex.split(node.prefix or self.launch_prefix)
        words = prefix + [str(each) for each in node.command or (str(self.executable),)]
        if node.command is not None and not node.is_ros:
            return words
        words += map(str, node.arguments)
        words.append('--ros-args')
        if node.name:
            words += ['-r', f'__node:={node.name}']
        if self.resolved.namespace:
            words += ['-r', f'__ns:={self.resolved.namespace}']
        for path, _ in self.parameter_files:
            words += ['--params-file', str(path)]
        for source, target in self.resolved.remappings:
            words += ['-r', f'{source}:={target}']
        return words

    @property
    def unblocks_sigint(self) -> bool:
        """Whether it is an executable of this package: it may be started with SIGINT blocked."""
        is_ours = self.node.package == OWN_PACKAGE and is_own(self.executable)
        is_ours = is_ours and self.node.command is None and self.node.folder is None
        return is_ours and not (self.node.prefix or self.launch_prefix)

    @property
    def is_forkable(self) -> bool:
        """Whether the fork server may start it, see ``fork_server.py``."""
        return (
            self.unblocks_sigint and not self.node.terminal and is_of_this_python(self.executable)
        )

    def explain(self, error: OSError) -> str:
        """Return why it could not be started; the kernel names no missing interpreter."""
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
        """
        Write the tables of parameters to the files that the command line names.

        Raises:
            OSError: a file cannot be written.
            BringupError: a table that is known only now cannot be made.
        """
        for path, text in self.parameter_files:
            if isinstance(text, LateTable):
                text = _parameters_text(self.name, self.resolved, text.make())
            if text is not None:
                path.write_text(text, encoding='utf-8')


@dataclass(frozen=True)
class LaunchPrefix:
    """The options ``--launch-prefix`` and ``--launch-prefix-filter``."""

    words: str = ''
    """Words before each command line: ``gdb -ex run --args``, ``valgrind``."""
    filter: str = ''
    """A regular expression; only executables whose name begins with a match get the prefix."""

    def __post_init__(self) -> None:
        """Raise UsageError or BringupError for an invalid pattern or prefix."""
        check_prefix(self.words)
        try:
            re.compile(self.filter)
        except re.error as error:
            raise UsageError(f"--launch-prefix-filter '{self.filter}': {error}") from None

    def of(self, executable: str) -> str:
        """Return the prefix of an executable's command line; '' if the filter excludes it."""
        return self.words if re.match(self.filter, executable) else ''


def check_prefix(prefix: str) -> None:
    """Raise BringupError unless a prefix begins with a command on the PATH."""
    try:
        words = shlex.split(prefix)
    except ValueError as error:
        raise BringupError(f'prefix {prefix!r}: {error}') from None
    if words and shutil.which(words[0]) is None:
        raise BringupError(f"prefix {prefix!r}: there is no command '{words[0]}' on the PATH")


def process_specs(
    stack: Stack, folder: Path, prefix: LaunchPrefix | None = None, first: int = 1
) -> list[ProcessSpec]:
    """
    Prepare the processes of a stack, in the order of its nodes; starts and writes nothing.

    Args:
        stack: the stack.
        folder: where parameter files will be written: the log folder, so that they stay readable,
            the printed command line can be typed again and no temporary file is left behind.
        prefix: that of all command lines.
        first: the number of the first node, in its name.

    Raises:
        BringupError: a parameter or a prefix is invalid.
        ResourceError: a package, an executable or a parameter file is missing.
    """
    prefix = prefix or LaunchPrefix()
    return [
        _process_spec(resolved, number, folder, prefix)
        for number, resolved in enumerate(Placement(stack).nodes, start=first)
    ]


def _process_spec(
    resolved: ResolvedNode, number: int, folder: Path, prefix: LaunchPrefix
) -> ProcessSpec:
    node = resolved.node
    check_prefix(node.prefix)
    name = f'{node.executable}-{number}'
    files: list[tuple[Path, str | LateTable | None]] = []
    for index, entry in enumerate(resolved.parameters, start=1):
        if isinstance(entry, str | Path):
            files.append((path_of(str(entry)), None))
            continue
        text = entry.text if isinstance(entry, ParameterText) else entry
        if isinstance(text, Mapping):
            text = _parameters_text(name, resolved, text)
        files.append((folder / f'{name}-parameters-{index}.yaml', text))
    executable = (
        executable_of(node.package, node.executable)
        if node.command is None
        else _program(node, resolved.environment)
    )
    return ProcessSpec(resolved, name, executable, files, prefix.of(node.executable))


def _program(node: Node, environment: Mapping[str, str | None]) -> Path:
    """Return the path of the program of a command. Raises BringupError."""
    word = str(node.command[0]) if node.command else ''
    is_path = '/' in word and node.folder is not None  # which counts from there
    program = str(Path(node.folder or '', word)) if is_path else word
    found = shutil.which(program, path=environment.get('PATH'))
    if found is None and is_path:
        raise BringupError(f"there is no program '{program}'")
    if found is None:
        raise BringupError(f"there is no command '{word}' on the PATH")
    return Path(found)


def _parameters_text(
    name: str, resolved: ResolvedNode, table: Mapping[str, ParameterValue]
) -> str:
    try:
        return yaml_text(node_key(resolved.node.name, resolved.namespace), table)
    except BringupError as error:
        raise BringupError(f'{name}: {error}') from None
