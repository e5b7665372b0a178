# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""What controller managers say of their controllers and hardware."""

from collections.abc import Mapping
from dataclasses import dataclass, field


@dataclass(frozen=True, slots=True, kw_only=True)
class ObservedController:
    """A loaded controller."""

    name: str
    type_name: str = ''
    state: str = 'active'
    """Of its lifecycle."""
    commands: tuple[str, ...] = ()
    """The command interfaces that it claims, or would claim if it were active."""
    is_chained: bool = False
    """Whether it takes its commands from another controller."""
    parameters: Mapping[str, object] = field(default_factory=dict)
    """Of a drive: its parameters."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Component:
    """A hardware component."""

    name: str
    state: str = 'active'
    plugin: str = ''
    interfaces: tuple[str, ...] = ()
    """The names of all its command and state interfaces."""


@dataclass(frozen=True, slots=True, kw_only=True)
class ObservedManager:
    """A controller manager."""

    name: str = '/controller_manager'
    answers: bool = True
    """Whether its services do."""
    controllers: tuple[ObservedController, ...] = ()
    components: tuple[Component, ...] = ()
    types: tuple[str, ...] = ()
    """Of controllers, that it can load."""
    wanted: Mapping[str, str] = field(default_factory=dict)
    """The type of each controller that its parameters name."""

    @property
    def namespace(self) -> str:
        """That of its controllers, too; empty: the root."""
        return self.name.rpartition('/')[0]


@dataclass(frozen=True, slots=True, kw_only=True)
class ObservedLogLine:
    """What a node has logged."""

    node: str
    """Full name."""
    text: str
    is_error: bool = False


@dataclass(frozen=True, slots=True, kw_only=True)
class ObservedControllers:
    """All controller managers, and who waits for one."""

    managers: tuple[ObservedManager, ...] = ()
    spawners: tuple[str, ...] = ()
    """Full names of the nodes of spawners, which end once their controllers are active."""
    log: tuple[ObservedLogLine, ...] = ()
    """Warnings and errors of managers and their controllers."""
