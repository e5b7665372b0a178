# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
Parameters as launch files give them -> as nodes get them.

A substitution is read as YAML, so that ``LaunchConfiguration('use_sim_time')`` is a boolean; a
text of Python stays a text. ``ParameterValue`` says the type.
"""

from collections.abc import Iterable, Mapping, Sequence
from functools import partial
from os import PathLike
from pathlib import Path
from typing import Any, get_args, get_origin, TypeAlias

import yaml

from amr_description.bringup.description import (
    LateTable,
    ParameterText,
    ParameterValue as Plain,
)
from amr_description.launch_api.context import LaunchContext
from amr_description.launch_api.locations import Located, refusal
from amr_description.launch_api.rewriting import WrittenFile
from amr_description.launch_api.substitutions import (
    is_a_substitution,
    normalize_to_list_of_substitutions,
    perform_substitutions,
    runs_a_command,
    SomeSubstitutions,
    Substitution,
    text_of,
)
from amr_description.launch_api.text_syntax import parse_text
from amr_description.text import truth

_HINT = (
    'If the parameter is meant to be a string, try wrapping it in '
    'launch_ros.parameter_descriptions.ParameterValue(value, value_type=str)'
)

Entry: TypeAlias = Mapping[str, Plain] | ParameterText | LateTable | str | Path


class ParameterValue(Located):
    """A value with its type: str, int, float, bool or a list of one of them."""

    def __init__(self, value: Any, *, value_type: Any = None) -> None:
        self.value = value
        self.value_type = value_type

    def evaluate(self, context: LaunchContext, name: str = '') -> Plain:
        """Return the value. Raises BringupError."""
        kind = self.value_type
        if get_origin(kind) in (list, Sequence) or kind is list:
            return self._list(context, name)
        if not is_a_substitution(self.value) and not isinstance(self.value, str):
            return _python_value(context, self.value, name, self.where)
        text = text_of(context, self.value)
        if kind is None:
            return _from_yaml(text, name, self.where)
        return self._typed(text, kind, name)

    def _list(self, context: LaunchContext, name: str) -> list[Any]:
        kind = (get_args(self.value_type) or (str,))[0]
        if isinstance(self.value, str | Substitution):
            given = yaml.safe_load(text_of(context, self.value))
        else:
            given = [
                text_of(context, each) if is_a_substitution(each) else each for each in self.value
            ]
        if not isinstance(given, list):
            raise refusal(f"parameter '{name}' is {given!r}, which is no list", self.where)
        return [self._typed(str(each), kind, name) for each in given]

    def _typed(self, text: str, kind: Any, name: str) -> Any:
        if kind is str:
            return text
        value = truth(text) if kind is bool else None
        if kind in (int, float):
            try:
                value = kind(text)
            except ValueError:
                value = None
        if value is None:
            called = getattr(kind, '__name__', kind)
            raise refusal(f"parameter '{name}' is '{text}', which is no {called}", self.where)
        return value


class Parameter(ParameterValue):
    """A parameter with its name."""

    def __init__(self, name: SomeSubstitutions, value: Any, *, value_type: Any = None) -> None:
        super().__init__(value, value_type=value_type)
        self.name = name


class ParameterFile(Located):
    """A parameter file, in which ``$(var …)`` may stand."""

    def __init__(self, param_file: SomeSubstitutions, *, allow_substs: Any = False) -> None:
        self.param_file = normalize_to_list_of_substitutions(param_file)
        self.allow_substs = allow_substs

    def evaluate(self, context: LaunchContext) -> Entry:
        """Return its path, or its text with all ``$(…)`` replaced. Raises BringupError."""
        path = Path(perform_substitutions(context, self.param_file))
        allowed = self.allow_substs
        if not isinstance(allowed, bool):
            allowed = truth(text_of(context, allowed)) or False
        if not allowed:
            return path
        try:
            text = path.read_text('utf-8')
        except (OSError, UnicodeDecodeError) as error:
            raise refusal(f"ParameterFile '{path}': {error}", self.where) from None
        lines = text.splitlines()
        replaced = [
            line
            if '$(' not in line or line.lstrip().startswith('#')
            else perform_substitutions(context, parse_text(line, f'{path.name}:{number}'))
            for number, line in enumerate(lines, start=1)
        ]
        return ParameterText('\n'.join(replaced) + '\n')


def evaluated(
    context: LaunchContext, parameters: Any, where: str, *, is_late: bool = False
) -> list[Entry]:
    """
    Return the parameters of a node as a stack has them.

    Args:
        context: what substitutions are performed with.
        parameters: a list of tables, files, Parameter and ParameterFile.
        where: the place of the node.
        is_late: whether the node starts after others, so that a command may ask what these know.

    Raises:
        BringupError: something in it is none of these, or has no type in ROS.
    """
    if isinstance(parameters, str | Mapping) or not isinstance(parameters, Iterable):
        raise refusal(f"parameters={parameters!r}: it takes a list, as [{{'speed': 1.0}}]", where)
    entries: list[Entry] = []
    for each in parameters:
        if isinstance(each, ParameterFile):
            entries.append(each.evaluate(context))
        elif isinstance(each, Parameter):
            table = {each.name: each}
            entries.append(_entry(context, table, where, is_late=is_late))
        elif isinstance(each, Mapping):
            entries.append(_entry(context, each, where, is_late=is_late))
        elif isinstance(each, WrittenFile):
            entries.append(ParameterText(each.written(context)))
        elif isinstance(each, PathLike):
            entries.append(Path(each))
        else:
            entries.append(Path(text_of(context, each)))
    return entries


def _entry(
    context: LaunchContext, table: Mapping[Any, Any], where: str, *, is_late: bool
) -> Mapping[str, Plain] | LateTable:
    if not (is_late and runs_a_command(table)):
        return _table(context, table, where)
    commands = ', '.join(f'{text_of(context, key)}: $(command …)' for key in table)
    return LateTable(partial(_table, context.copy(), table, where), commands)


def _table(context: LaunchContext, table: Mapping[Any, Any], where: str) -> dict[str, Plain]:
    values = {}
    for key, value in table.items():
        name = text_of(context, key)
        values[name] = _value(context, value, name, where)
    return values


def _value(context: LaunchContext, value: Any, name: str, where: str) -> Plain:
    if isinstance(value, ParameterValue):
        return value.evaluate(context, name)
    if isinstance(value, Mapping):
        return _table(context, value, where)
    if is_a_substitution(value):
        return _from_yaml(text_of(context, value), name, where)
    return _python_value(context, value, name, where)


def _python_value(context: LaunchContext, value: Any, name: str, where: str) -> Any:
    """Return a value of Python; of the elements of lists some may be lists of substitutions."""
    if isinstance(value, bool | int | float | str | Path):
        return value
    if isinstance(value, bytes):
        return value.decode(errors='replace')
    if isinstance(value, Sequence):
        elements: list[Any] = [_value(context, each, name, where) for each in value]
        kinds = {type(each) for each in elements}
        return [float(each) for each in elements] if kinds == {int, float} else elements
    raise refusal(
        f"parameter '{name}' is {value!r}, a {type(value).__name__}, for which ROS has no type",
        where,
    )


def _from_yaml(text: str, name: str, where: str) -> Any:
    """Return the value of a text as YAML has it. Raises BringupError."""
    try:
        value = yaml.safe_load(text)
    except yaml.YAMLError:
        raise refusal(
            f'Unable to parse the value of parameter {name} as yaml. {_HINT}', where
        ) from None
    if isinstance(value, bool | int | float | str):
        return value
    if isinstance(value, list) and value and len({type(each) for each in value}) == 1:
        return value
    if not text.strip():
        return ''
    raise refusal(
        f"parameter '{name}' is '{text}', in YAML a {type(value).__name__}, for which ROS has no "
        f'type. {_HINT}',
        where,
    )
