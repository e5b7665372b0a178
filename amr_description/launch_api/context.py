# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""What is known while a launch description is visited: configurations, environment, locals."""

from collections.abc import Mapping
import os
from types import SimpleNamespace
from typing import Any, Protocol, Self

from amr_description.bringup.handlers import Level

NAMESPACE = 'ros_namespace'
PARAMETERS = 'global_params'
REMAPPINGS = 'ros_remaps'
"""What launch_ros keeps among the launch configurations."""


class Performable(Protocol):
    """A substitution."""

    def perform(self, context: 'LaunchContext') -> str:
        """Return its text."""
        ...


class LaunchContext:
    """As in launch: what OpaqueFunction and ``perform`` are given."""

    def __init__(self, *, argv: list[str] | None = None, noninteractive: bool = False) -> None:
        """Begin with the environment of this process and no configuration."""
        self.argv = argv or []
        self.noninteractive = noninteractive
        self.launch_configurations: dict[str, Any] = {}
        self.environment_at_first: Mapping[str, str] = dict(os.environ)
        self.environment: dict[str, str] = dict(os.environ)
        self._locals: dict[str, Any] = {}
        self._configurations: list[dict[str, Any]] = []
        self._environments: list[dict[str, str]] = []
        self.read: set[str] = set()
        """The names of all configurations that a substitution asked for."""
        self.notes: list[tuple[Level, str]] = []
        """Lines that are logged when the processes start."""

    @property
    def locals(self) -> SimpleNamespace:
        """As attributes."""
        return SimpleNamespace(**self._locals)

    def get_locals_as_dict(self) -> dict[str, Any]:
        """Return the locals by name."""
        return self._locals

    def extend_locals(self, extensions: Mapping[str, Any]) -> None:
        """Add locals."""
        self._locals = {**self._locals, **extensions}

    def replace_locals(self, values: Mapping[str, Any]) -> None:
        """Have these locals alone, as they were when an included file was not visited yet."""
        self._locals = dict(values)

    def perform_substitution(self, substitution: Performable) -> str:
        """Return the text of a substitution."""
        return substitution.perform(self)

    def copy(self) -> Self:
        """Return the context as it is now; changes of one do not show in the other."""
        other = type(self)(argv=self.argv, noninteractive=self.noninteractive)
        other.launch_configurations = dict(self.launch_configurations)
        other.environment = dict(self.environment)
        other.environment_at_first = self.environment_at_first
        other.extend_locals(self._locals)
        other.read = self.read
        other.notes = self.notes
        return other

    def push_configurations(self) -> None:
        """Begin a scope: what changes from here on is forgotten by the next pop."""
        self._configurations.append(dict(self.launch_configurations))

    def pop_configurations(self) -> None:
        """End the scope."""
        self.launch_configurations = self._configurations.pop()

    def push_environment(self) -> None:
        """As :meth:`push_configurations`, of environment variables."""
        self._environments.append(dict(self.environment))

    def pop_environment(self) -> None:
        """End the scope."""
        self.environment = self._environments.pop()

    def changes_of_environment(self) -> dict[str, str | None]:
        """Return the variables that are not as they were at first; None: it is to have none."""
        first, now = self.environment_at_first, self.environment
        changes: dict[str, str | None] = {
            name: value for name, value in now.items() if first.get(name) != value
        }
        return changes | {name: None for name in first if name not in now}
