# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
Texts that are known when a launch description is visited: LaunchConfiguration and the others.

Descriptions are those that ``ros2 launch --show-args`` prints of default values.
"""

from collections.abc import Iterable, Mapping
import os
from pathlib import Path
import re
import shlex
import shutil
import subprocess
from typing import Any, TypeAlias, TypeGuard
import uuid

from amr_description.ament_index import executable_of, hint_at, OWN_PACKAGE
from amr_description.errors import BringupError, ResourceError
from amr_description.launch_api import opened_files
from amr_description.launch_api.context import LaunchContext
from amr_description.launch_api.counterparts import prefix_of, share_of
from amr_description.launch_api.locations import at, Located, refusal
from amr_description.text import suggestion

SomeSubstitutions: TypeAlias = Any
"""A text, a substitution, or a list of them, as in launch."""


ON_STDERR = ('fail', 'ignore', 'warn', 'capture')
"""What a Command may do about what its program writes to stderr."""


class SubstitutionFailure(BringupError):  # noqa: N818 - as in launch
    """A substitution has no text."""


class Substitution(Located):
    """Base of all; users derive from it, too."""

    def describe(self) -> str:
        """Return it in words."""
        return repr(self)

    def perform(self, context: LaunchContext) -> str:
        """Return its text."""
        raise NotImplementedError(f'{type(self).__name__}.perform')

    def failure(self, text: str) -> SubstitutionFailure:
        """Return an error with the place of this substitution."""
        return at(SubstitutionFailure(text), self.where)


class TextSubstitution(Substitution):
    """A text as it stands."""

    def __init__(self, *, text: str) -> None:
        if not isinstance(text, str):
            raise refusal(f'TextSubstitution(text={text!r}): it takes a text')
        self.text = text

    def describe(self) -> str:
        return f"'{self.text}'"

    def perform(self, context: LaunchContext) -> str:
        return self.text


def is_a_substitution(value: object) -> bool:
    """Return whether a value is a substitution, or a list with one."""
    if isinstance(value, str | bytes) or not isinstance(value, Iterable):
        return _performs(value)
    return any(map(_performs, value))


def normalize_to_list_of_substitutions(subst: SomeSubstitutions) -> list[Substitution]:
    """Return texts and substitutions as a list of substitutions. Raises BringupError."""
    if _performs(subst):
        return [subst]
    if isinstance(subst, str | Path):
        return [TextSubstitution(text=str(subst))]
    if isinstance(subst, Iterable) and not isinstance(subst, bytes | dict):
        return [one for each in subst for one in _single(each)]
    raise refusal(f'{subst!r} is no text, substitution or list of them')


def _performs(value: object) -> TypeGuard[Substitution]:
    """Return whether it is a substitution: one of ours, or of an original ``launch``."""
    return not isinstance(value, type) and callable(getattr(value, 'perform', None))


def _single(value: object) -> list[Substitution]:
    if isinstance(value, str | Path) or _performs(value):
        return normalize_to_list_of_substitutions(value)
    raise refusal(f'{value!r} in a list is no text and no substitution')


def runs_a_command(value: object) -> bool:
    """Return whether a value, or a substitution somewhere in it, is what a program prints."""
    if isinstance(value, Command):
        return True
    if isinstance(value, Mapping):
        return any(runs_a_command(each) for pair in value.items() for each in pair)
    if isinstance(value, list | tuple):
        return any(map(runs_a_command, value))
    if isinstance(value, Substitution | Located):
        return any(map(runs_a_command, vars(value).values()))
    return False


def perform_substitutions(context: LaunchContext, subs: Iterable[Substitution]) -> str:
    """Return the texts of substitutions, joined."""
    return ''.join(each.perform(context) for each in subs)


def text_of(context: LaunchContext, value: SomeSubstitutions) -> str:
    """Return the text of whatever launch takes as one."""
    return perform_substitutions(context, normalize_to_list_of_substitutions(value))


def described(subs: Iterable[Substitution]) -> str:
    """Return substitutions in words, as launch joins them."""
    return ' + '.join(each.describe() for each in subs)


class LaunchConfiguration(Substitution):
    """The value of an argument, or of SetLaunchConfiguration."""

    def __init__(
        self, variable_name: SomeSubstitutions, *, default: SomeSubstitutions = None
    ) -> None:
        self.variable_name = normalize_to_list_of_substitutions(variable_name)
        if default is not None and not isinstance(default, str | Path | Substitution | Iterable):
            default = str(default)  # as launch does: a number, or True
        self._default = None if default is None else normalize_to_list_of_substitutions(default)

    def describe(self) -> str:
        return f'LaunchConfig({described(self.variable_name)})'

    def perform(self, context: LaunchContext) -> str:
        name = perform_substitutions(context, self.variable_name)
        context.read.add(name)
        if name in context.launch_configurations:
            return str(context.launch_configurations[name])
        if self._default is not None:
            return perform_substitutions(context, self._default)
        known = list(context.launch_configurations)
        raise self.failure(
            f"launch configuration '{name}' does not exist{suggestion(name, known)}"
        )


class EnvironmentVariable(Substitution):
    """An environment variable, as SetEnvironmentVariable has left it."""

    def __init__(
        self, name: SomeSubstitutions, *, default_value: SomeSubstitutions = None
    ) -> None:
        self.name = normalize_to_list_of_substitutions(name)
        self.default_value = (
            None if default_value is None else normalize_to_list_of_substitutions(default_value)
        )

    def describe(self) -> str:
        return f'EnvVar({described(self.name)})'

    def perform(self, context: LaunchContext) -> str:
        name = perform_substitutions(context, self.name)
        if name in context.environment:
            return context.environment[name]
        if self.default_value is not None:
            return perform_substitutions(context, self.default_value)
        raise self.failure(f"environment variable '{name}' does not exist")


class PathJoinSubstitution(Substitution):
    """Parts of a path, joined by slashes; a part may be a list of texts."""

    def __init__(self, substitutions: Iterable[SomeSubstitutions]) -> None:
        self.substitutions = [normalize_to_list_of_substitutions(each) for each in substitutions]

    def describe(self) -> str:
        return f"PathJoin('{' + '.join(described(each) for each in self.substitutions)}')"

    def perform(self, context: LaunchContext) -> str:
        return os.path.join(*(perform_substitutions(context, each) for each in self.substitutions))

    def __truediv__(self, other: SomeSubstitutions) -> 'PathJoinSubstitution':
        """Return the path with one part more: ``PathJoinSubstitution(['a', 'b']) / 'c'``."""
        return PathJoinSubstitution([*self.substitutions, other])


class PathSubstitution(PathJoinSubstitution):
    """``PathSubstitution('a') / 'b' / 'c'``."""

    def __init__(self, path: SomeSubstitutions) -> None:
        super().__init__([path])


class StringJoinSubstitution(Substitution):
    """Texts, joined by a delimiter."""

    def __init__(
        self, substitutions: Iterable[SomeSubstitutions], delimiter: SomeSubstitutions = ''
    ) -> None:
        self.substitutions = [normalize_to_list_of_substitutions(each) for each in substitutions]
        self.delimiter = normalize_to_list_of_substitutions(delimiter)

    def describe(self) -> str:
        return f"StringJoin('{' + '.join(described(each) for each in self.substitutions)}')"

    def perform(self, context: LaunchContext) -> str:
        texts = [perform_substitutions(context, each) for each in self.substitutions]
        return perform_substitutions(context, self.delimiter).join(texts)


class FindExecutable(Substitution):
    """The path of a program on the PATH."""

    def __init__(self, *, name: SomeSubstitutions) -> None:
        self.name = normalize_to_list_of_substitutions(name)

    def describe(self) -> str:
        return f'FindExec({described(self.name)})'

    def perform(self, context: LaunchContext) -> str:
        name = perform_substitutions(context, self.name)
        found = shutil.which(name, path=context.environment.get('PATH'))
        if found is None and name == 'xacro':
            found = str(executable_of(OWN_PACKAGE, name))
        if found is None:
            raise self.failure(f"executable '{name}' not found on the PATH")
        return found


class Command(Substitution):
    """What a program prints."""

    def __init__(
        self, command: SomeSubstitutions, *, on_stderr: SomeSubstitutions = 'fail'
    ) -> None:
        self.command = normalize_to_list_of_substitutions(command)
        self.on_stderr = normalize_to_list_of_substitutions(on_stderr)

    def describe(self) -> str:
        return f'Command({described(self.command)})'

    def perform(self, context: LaunchContext) -> str:
        text = perform_substitutions(context, self.command)
        on_stderr = perform_substitutions(context, self.on_stderr)
        if on_stderr not in ON_STDERR:
            raise self.failure(
                "expected 'on_stderr' to be one of: 'fail', 'ignore', 'warn' or 'capture'"
            )
        merged = on_stderr == 'capture'
        try:
            result = subprocess.run(
                self._words(text),
                env=context.environment,
                stdin=subprocess.DEVNULL,
                stdout=subprocess.PIPE,
                stderr=subprocess.STDOUT if merged else subprocess.PIPE,
                text=True,
                check=False,
            )
        except (OSError, ValueError) as error:
            raise self.failure(f"the command '{text}' cannot be run: {error}") from None
        said = (result.stderr or '').strip().splitlines()
        last = _without_a_file(text) or (f': {said[-1]}' if said else '')
        if result.returncode:
            raise self.failure(f'executed command failed. Command: {text}{last}')
        if said and on_stderr in ('fail', 'warn'):
            fault = f'executed command showed stderr output. Command: {text}{last}'
            if on_stderr == 'fail':
                raise self.failure(fault)
            context.notes.append(('WARNING', fault))
        return result.stdout

    def _words(self, text: str) -> list[str]:
        try:
            words = shlex.split(text)
        except ValueError as error:
            raise self.failure(f"the command '{text}' cannot be split: {error}") from None
        if words and words[0] == 'xacro' and shutil.which('xacro') is None:
            words[0] = str(executable_of(OWN_PACKAGE, 'xacro'))
        for word in words[1:]:
            opened_files.note(word)
        return words


def _without_a_file(command: str) -> str:
    """
    Return that a description is not there which a command of xacro names; '': it is none.

    xacro ends with an AttributeError of Python then, as ``xml.parsers`` is not imported.
    """
    program, *words = shlex.split(command)
    if os.path.basename(program) != 'xacro':
        return ''
    paths = (Path(word) for word in words if word.endswith(('.xacro', '.urdf')))
    path = next((each for each in paths if not each.exists()), None)
    return '' if path is None else f": there is no file '{path}'{hint_at(path)}"


class FileContent(Substitution):
    """The text of a file."""

    def __init__(self, path: SomeSubstitutions) -> None:
        self.path = normalize_to_list_of_substitutions(path)

    def describe(self) -> str:
        return f'FileContent({described(self.path)})'

    def perform(self, context: LaunchContext) -> str:
        path = perform_substitutions(context, self.path)
        try:
            return Path(path).read_text('utf-8')
        except (OSError, UnicodeDecodeError) as error:
            raise self.failure(f"FileContent '{path}': {error}") from None


class ThisLaunchFile(Substitution):
    """The path of the file that is visited."""

    def describe(self) -> str:
        return 'ThisLaunchFile()'

    def perform(self, context: LaunchContext) -> str:
        return str(context.get_locals_as_dict()['current_launch_file_path'])


class ThisLaunchFileDir(Substitution):
    """The folder of the file that is visited."""

    def describe(self) -> str:
        return 'ThisLaunchFileDir()'

    def perform(self, context: LaunchContext) -> str:
        return str(context.get_locals_as_dict()['current_launch_file_directory'])


class LaunchLogDir(Substitution):
    """The folder of log files of the run: the variable ROS_LOG_DIR of all that is started."""

    def describe(self) -> str:
        return 'LaunchLogDir()'

    def perform(self, context: LaunchContext) -> str:
        base = context.environment.get('ROS_LOG_DIR')
        home = context.environment.get('ROS_HOME') or '~/.ros'
        return str(Path(base or f'{home}/log').expanduser())


class AnonName(Substitution):
    """A name that is unique to this run: the same for each use of one ``name``."""

    def __init__(self, name: SomeSubstitutions) -> None:
        self.name = normalize_to_list_of_substitutions(name)

    def describe(self) -> str:
        return f'AnonName({described(self.name)})'

    def perform(self, context: LaunchContext) -> str:
        name = perform_substitutions(context, self.name)
        key = f'anon{name}'
        context.launch_configurations.setdefault(key, f'{name}_{uuid.uuid4().hex[:12]}')
        return str(context.launch_configurations[key])


class LocalSubstitution(Substitution):
    """A local of the context, ``event.reason`` within a handler."""

    def __init__(self, expression: str, description: str | None = None) -> None:
        if not re.fullmatch(r'[A-Za-z_][\w.]*', expression):
            raise refusal(f"LocalSubstitution('{expression}'): it takes a name, as 'event.reason'")
        self.expression = expression
        self.description = description

    def describe(self) -> str:
        return f"LocalVar('{self.description or self.expression}')"

    def perform(self, context: LaunchContext) -> str:
        first, *rest = self.expression.split('.')
        try:
            value: Any = context.get_locals_as_dict()[first]
            for name in rest:
                value = getattr(value, name)
        except (KeyError, AttributeError):
            raise self.failure(f"there is no '{self.expression}' here") from None
        return str(value)


class FindPackagePrefix(Substitution):
    """The prefix that a package is installed in."""

    def __init__(self, package: SomeSubstitutions) -> None:
        self.package = normalize_to_list_of_substitutions(package)

    def describe(self) -> str:
        return f'{type(self).__name__}(pkg={described(self.package)})'

    def find(self, package: str) -> str:
        """Return the prefix of a package, also of one in whose place is one of ours."""
        return prefix_of(package)

    def perform(self, context: LaunchContext) -> str:
        package = perform_substitutions(context, self.package)
        try:
            return self.find(package)
        except BringupError as error:
            raise at(error, self.where) from None


class FindPackageShare(FindPackagePrefix):
    """The share folder of a package."""

    def find(self, package: str) -> str:
        return share_of(package)


class ExecutableInPackage(Substitution):
    """The path of an executable of a package."""

    def __init__(self, executable: SomeSubstitutions, package: SomeSubstitutions) -> None:
        self.executable = normalize_to_list_of_substitutions(executable)
        self.package = normalize_to_list_of_substitutions(package)

    def describe(self) -> str:
        return f'ExecInPkg(pkg={described(self.package)}, exec={described(self.executable)})'

    def perform(self, context: LaunchContext) -> str:
        package = perform_substitutions(context, self.package)
        try:
            return str(executable_of(package, perform_substitutions(context, self.executable)))
        except ResourceError as error:
            raise self.failure(str(error)) from None
