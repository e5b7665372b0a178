# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
``$(var …)`` and ``$(find-pkg-share …)`` in parameter files, which a launch file would replace.

No launch file runs here, so the value of a variable is taken from the robot: with the joints
``joint1`` and ``joint2``, ``$(var prefix)1`` and ``$(var prefix)2`` have the prefix ``joint``.
"""

from collections.abc import Collection, Iterator, Mapping
import hashlib
import os
from pathlib import Path
import re
from typing import Any

from amr_description.ament_index import package_prefix
from amr_description.errors import AmrError
from amr_description.model.robot import Robot
from amr_description.model.ros2_control_tag import hardware_of
from amr_description.parameter_files import load_yaml
from amr_description.text import quote

_VARIABLE = re.compile(r'\$\(var\s+([\w.-]+)\s*\)')
_SHARE = re.compile(r'\$\(find-pkg-share\s+([\w-]+)\s*\)')
_DIGITS = 12  # of the SHA-256


def substituted_file(path: Path, robot: Robot) -> tuple[Path, str]:
    """
    Return a parameter file with the values of its substitutions, and what they are, in one line.

    A file without any, or whose values nothing tells, is returned as it is, with ''. The copy is
    in ``$ROS_HOME/parameters`` (``~/.ros/parameters``), under a name of its content.
    """
    try:
        text = path.read_text('utf-8')
    except (OSError, UnicodeDecodeError):  # whoever reads it for good says why
        return path, ''
    if '$(' not in text:
        return path, ''
    values = values_of_variables(text, *names_of(robot))
    changed = substituted(text, values)
    if changed == text:
        return path, ''
    found = ', '.join(f'$(var {name}) is {quote(value)}' for name, value in values.items())
    why = f': {found}, by the names of the robot' if found else ''
    try:
        copy = _written(path, changed)
    except (OSError, RuntimeError):  # there is no such folder, or nobody has a home
        return path, ''
    return copy, f'{path} is used with its substitutions made{why}: {copy}'


def substituted(text: str, values: Mapping[str, str]) -> str:
    """Return a text with the values of variables, and of the packages that are installed."""

    def share(match: re.Match[str]) -> str:
        try:
            return str(package_prefix(match[1]) / 'share' / match[1])
        except AmrError:  # the one that opens the file says so
            return match[0]

    text = _VARIABLE.sub(lambda match: values.get(match[1], match[0]), text)
    return _SHARE.sub(share, text)


def values_of_variables(text: str, *names: Collection[str]) -> dict[str, str]:
    """
    Return the values of the variables in a parameter file by which its texts are names.

    Of several values with which the texts are names, only an empty prefix counts.

    Args:
        text: the file.
        *names: those of the parts of a robot, one kind after the other: a text is a name of the
            first kind of which it can be one.
    """
    try:
        texts = [*_texts_of(load_yaml(text))]
    except AmrError:  # whoever reads it for good says where
        return {}
    possible: dict[str, set[str]] = {}
    for each in dict.fromkeys(texts):
        found = (_values_in(each, kind) for kind in names)
        for variable, values in next(filter(None, found), {}).items():
            possible[variable] = possible.get(variable, values) & values
    return {
        name: min(values) for name, values in possible.items() if len(values) == 1 or '' in values
    }


def names_of(robot: Robot) -> tuple[list[str], list[str]]:
    """Return what a parameter file may name of a robot: joints; links, sensors and GPIOs."""
    parts = [part.name for info in hardware_of(robot) for part in (*info.sensors, *info.gpios)]
    return [joint.name for joint in robot.joints], [link.name for link in robot.links] + parts


def _values_in(text: str, names: Collection[str]) -> dict[str, set[str]]:
    """Return the values of each variable in a text with which the text is one of the names."""
    variables: list[str] = []

    def group(match: re.Match[str]) -> str:
        if match[1] in variables:
            return f'(?P=v{variables.index(match[1])})'
        variables.append(match[1])
        return f'(?P<v{len(variables) - 1}>.*)'

    parts = _VARIABLE.split(text)
    if len(parts) == 1 or not any(parts[::2]):
        return {}  # nothing beside the variables, so that any name would do
    pattern, end = '', 0
    for match in _VARIABLE.finditer(text):
        pattern += re.escape(text[end : match.start()]) + group(match)
        end = match.end()
    pattern += re.escape(text[end:])
    found = [each for name in names if (each := re.fullmatch(pattern, name)) is not None]
    return {v: {match[f'v{i}'] for match in found} for i, v in enumerate(variables) if found}


def _texts_of(value: Any) -> Iterator[str]:
    """Yield the texts with variables in the values of a file."""
    if isinstance(value, str) and '$(var' in value:
        yield value
    elif isinstance(value, Mapping):
        for each in value.values():
            yield from _texts_of(each)
    elif isinstance(value, list):
        for each in value:
            yield from _texts_of(each)


def _written(path: Path, text: str) -> Path:
    """Write a copy of a file, unless it is there. Raises OSError, RuntimeError."""
    folder = Path(os.environ.get('ROS_HOME') or Path.home() / '.ros') / 'parameters'
    digest = hashlib.sha256(text.encode()).hexdigest()[:_DIGITS]
    copy = folder / f'{path.stem}_{digest}{path.suffix}'
    if not copy.is_file() or copy.read_text('utf-8', errors='replace') != text:
        folder.mkdir(parents=True, exist_ok=True)
        draft = copy.with_suffix(f'.{os.getpid()}')
        draft.write_text(text, 'utf-8')
        draft.replace(copy)
    return copy
