# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""Parameters without a node: what rcl and rclpy would make of its ROS arguments."""

from collections.abc import Collection, Iterator, Mapping, Sequence
from pathlib import Path
from typing import Any, TypeVar

from amr_description.controller_manager.parameter_store import NO_VALUES
from amr_description.former_parameters import understand
from amr_description.parameter_files import (
    content_of,
    dotted,
    flatten,
    load_yaml,
    read_parameter_file,
    Section,
    sections,
)
from amr_description.parameters import build, specs, Value
from amr_description.ros_arguments import parameter_sources

_Table = TypeVar('_Table')


def given_parameters(node: str, arguments: Sequence[str]) -> dict[str, Any]:
    """
    Return what ROS arguments give a node, by dotted name.

    As rcl does, parameters are collected by the names of the sections first: what stands in one
    that comes first is overridden by what stands in later ones, also where ``-p`` has set it.

    Args:
        node: Its full name.
        arguments: Its ROS arguments.

    Raises:
        ParameterError: A file, or a value, cannot be read.
    """
    collected: dict[str, dict[str, Any]] = {}
    for pattern, name, text in parameter_sources(arguments):
        if name:
            collected.setdefault(pattern, {})[name] = load_yaml(text, content_of)
            continue
        for section in sections(read_parameter_file(Path(text))):
            values = collected.setdefault(section.pattern, {})
            if isinstance(section.parameters, dict):
                values |= {dotted(keys): value for keys, value in flatten(section.parameters)}
    found: dict[str, Any] = {}
    for pattern, values in collected.items():
        if Section((pattern,), values).is_of(node):
            found |= {name: value for name, value in values.items() if value is not None}
    return found


class PlainParameters:
    """
    The parameters of a node, in a table.

    It is a :class:`~amr_description.controller_manager.parameter_store.ParameterStore`.
    """

    def __init__(
        self, node: str, arguments: Sequence[str], given: Mapping[str, Any] = NO_VALUES
    ) -> None:
        """
        Take what the node is given.

        Args:
            node: Its full name.
            arguments: Its ROS arguments.
            given: Takes precedence over these.

        Raises:
            ParameterError: A file, or a value, cannot be read.
        """
        self.node = node
        self._given = {**given_parameters(node, arguments), **given}
        self._declared: dict[str, Any] = {
            'use_sim_time': self._given.get('use_sim_time', False),
        }
        self._checked: tuple[type, ...] = ()

    def adopt(
        self, *tables: type, joints: Collection[str] = (), others: Collection[str] = ()
    ) -> list[str]:
        """Have what was given taken as it is meant; return remarks."""
        lines: list[str] = []
        for table in tables:
            found = understand(table, self._given, joints, others)
            lines += found.lines
            self._given |= found.values
        return lines

    def declare(
        self, table: type, *, prefix: str = '', defaults: Mapping[str, Value] = NO_VALUES
    ) -> None:
        """Declare the rows of a table that are not yet."""
        for spec in specs(table, prefix, _Present(self._declared, self._given)):
            default = defaults.get(spec.name, spec.default)
            self._declared.setdefault(spec.name, self._given.get(spec.name, default))

    def declare_added(self, table: type) -> None:
        """Declare the rows of keyed groups that are new."""
        self.declare(table)

    def declare_given(self) -> None:
        """Declare what was given beyond the tables."""
        for name, value in self._given.items():
            self._declared.setdefault(name, value)

    def values(
        self, table: type[_Table], changed: Mapping[str, Any] = NO_VALUES, *, prefix: str = ''
    ) -> _Table:
        """Return the present values of a table. Raises ParameterError."""
        return build(table, _Present({**self._declared, **changed}, self._given), prefix)

    def check_sets(self, *tables: type) -> None:
        """Refuse from now on to set what these tables do not allow."""
        self._checked = (*self._checked, *tables)

    def value(self, name: str) -> Any:
        """Return a declared value, or None."""
        return self._declared.get(name)

    def names(self) -> Collection[str]:
        """Return the names of all that are declared."""
        return self._declared.keys()

    def set(self, name: str, value: Any) -> None:
        """Set a value. Raises ParameterError: it is refused."""
        for table in self._checked:
            self.values(table, {name: value})
        self._declared[name] = value


class _Present(Mapping[str, Any]):
    """Values that are declared; its names are also those that were given, and are not."""

    def __init__(self, declared: Mapping[str, Any], given: Mapping[str, Any]) -> None:
        self._declared, self._given = declared, given

    def __getitem__(self, name: str) -> Any:
        return self._declared[name]

    def __iter__(self) -> Iterator[str]:
        return iter({**self._given, **self._declared})

    def __len__(self) -> int:
        return len({**self._given, **self._declared})
