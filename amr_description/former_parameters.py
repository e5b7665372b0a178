# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
Parameters that an earlier release had, or another program of the name, and what is made of them.

ROS ignores a parameter that no node declares, without a word. A table says what it makes of those
that files still have, in a class attribute ``former``::

    @dataclass(frozen=True)
    class DriveParameters:
        former: ClassVar = (ignored('wheels_per_side', 'Foxy', 'the wheels are counted'),)
"""

from collections.abc import Callable, Collection, Iterator, Mapping
from dataclasses import dataclass, field
from fnmatch import fnmatchcase
from typing import Any

from amr_description.launch_variables import (
    has_variables,
    replaced as replaced_variables,
    variables_as,
)
from amr_description.parameters import Spec, specs, tables, Value

_MANY = 3
"""So many numbers of another type than declared are told in one line."""
_NAMED = 6
"""So many of them are named there."""


OF_BEFORE = 'it is of '
"""How each text on a former parameter begins; what follows is what had it."""


def is_on_former_parameter(line: str) -> bool:
    """Return whether a line of a log is a text on a former parameter."""
    return line.startswith('parameter') and f': {OF_BEFORE}' in line


@dataclass(frozen=True, slots=True)
class FormerValue:
    """What is made of a parameter."""

    text: str
    values: Mapping[str, Value]
    """Of parameters of the same table, in the place of what was given."""


@dataclass(frozen=True, slots=True)
class FormerParameter:
    """
    A parameter that is read otherwise than a table says, or that it has not.

    ``read`` gets its value, and those of the table that were given, by name; it returns None where
    there is nothing to say.
    """

    name: str
    """Perhaps with wildcards, for what stands below."""
    read: Callable[[Any, Mapping[str, Any]], FormerValue | None]


@dataclass(frozen=True, slots=True)
class Understanding:
    """What was given, as it is understood."""

    values: dict[str, Any]
    """By dotted name: only what is otherwise than given."""
    texts: dict[str, str]
    """What was made of it, by the name of the parameter in which it was found."""
    known: set[str]
    """The names of what was given that are former ones, whether or not there is a text."""
    adopted: dict[str, str] = field(default_factory=dict)
    """The values that are numbers of another type than declared, as they were given, by name."""

    @property
    def lines(self) -> list[str]:
        """The texts; those on numbers of another type, of which a file may be full, are one."""
        if len(self.adopted) < _MANY:
            return list(self.texts.values())
        given = [f"'{name}' ({value})" for name, value in self.adopted.items()]
        if len(given) > _NAMED:
            given[_NAMED:] = [f'{len(given) - _NAMED} more']
        lines = [text for name, text in self.texts.items() if name not in self.adopted]
        return [
            *lines,
            f'parameters {", ".join(given)} are numbers of another type than declared, such as '
            'integers for doubles: taken as those; a node of rclcpp refuses them',
        ]


def ignored(name: str, origin: str, instead: str) -> FormerParameter:
    """Return one that has no effect: ``origin`` had it, ``instead`` is what does."""
    text = f'{OF_BEFORE}{origin}, and has no effect: {instead}'
    return FormerParameter(name, lambda value, given: FormerValue(text, {}))


def replaced(name: str, origin: str, *new: str) -> FormerParameter:
    """Return one whose value is taken for others, where these are not given."""

    def read(value: Any, given: Mapping[str, Any]) -> FormerValue | None:
        values = {each: value for each in new if each not in given}
        text = f'{OF_BEFORE}{origin}: taken as {" and ".join(new)}'
        return FormerValue(text, values) if values else None

    return FormerParameter(name, read)


def _clamp(value: Any, given: Mapping[str, Any]) -> FormerValue | None:
    if not isinstance(value, float | int) or 'i_clamp_max' in given or 'i_clamp_min' in given:
        return None
    limit = abs(float(value))
    return FormerValue(
        f'{OF_BEFORE}earlier releases: taken as i_clamp_max {limit} and i_clamp_min {-limit}',
        {'i_clamp_max': limit, 'i_clamp_min': -limit},
    )


CLAMP = FormerParameter('i_clamp', _clamp)
"""Of the gains of a PID."""


def understand(
    table: type,
    given: Mapping[str, Any],
    joints: Collection[str] = (),
    others: Collection[str] = (),
) -> Understanding:
    """
    Return how the parameters of a file or a command line are understood.

    Args:
        table: the parameters of the node.
        given: by dotted name; others than those of the table, too.
        joints: of the robot, if it is known.
        others: the links, sensors and GPIOs of the robot.
    """
    found = Understanding({}, {}, set())
    given = dict(given)
    variables = variables_as(given, joints, others)
    for name, value in given.items():
        if joints and has_variables(value):
            given[name] = found.values[name] = replaced_variables(value, variables)
            found.texts[name] = _launched(name, value, given[name])
    for prefix, former in _all_former(table, given):
        local = _below(prefix, given)
        for name, value in local.items():
            if not fnmatchcase(name, former.name):
                continue
            found.known.add(prefix + name)
            reading = former.read(value, local)
            if reading is not None:
                full = prefix + name
                found.texts[full] = f"parameter '{full}' is {_shown(value)}: {reading.text}"
                found.values.update({prefix + n: v for n, v in reading.values.items()})
    meant = given | found.values
    for spec in specs(table, '', meant):
        value = meant.get(spec.name)
        adopted = spec.adopt(value)
        if adopted is not value:
            if spec.name not in found.values:
                found.texts[spec.name] = _adoption(spec, value, adopted)
                found.adopted[spec.name] = _shown(value)
            found.values[spec.name] = adopted
    return found


def _all_former(table: type, given: Mapping[str, Any]) -> Iterator[tuple[str, FormerParameter]]:
    for prefix, below in tables(table, given):
        for former in getattr(below, 'former', ()):
            yield prefix, former


def _adoption(spec: Spec, value: Any, adopted: Any) -> str:
    kind = 'integers' if isinstance(value, list | tuple) else 'an integer'
    article = 'a'
    if spec.type == 'integer':
        kind, article = 'a double', 'an'
    return (
        f"parameter '{spec.name}' is {_shown(value)}, {kind}, where {article} {spec.type} is "
        f'declared: taken as {_shown(adopted)}; a node of rclcpp refuses it'
    )


def _launched(name: str, value: Any, made: Any) -> str:
    what = 'what a launch file puts in is not known: write the names of the robot'
    if not has_variables(made):
        what = f'taken as {_shown(made)}, which are names of the robot'
    return f"parameter '{name}' is {_shown(value)}, for a launch file to complete: {what}"


def _shown(value: Any) -> str:
    if isinstance(value, bool):
        return str(value).lower()
    return str(list(value)) if isinstance(value, tuple) else str(value)


def _below(prefix: str, given: Mapping[str, Any]) -> dict[str, Any]:
    """Return what is given below a prefix, by the rest of its name."""
    return {
        name.removeprefix(prefix): value
        for name, value in given.items()
        if name.startswith(prefix)
    }
