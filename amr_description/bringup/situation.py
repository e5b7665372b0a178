# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""What conditions judge: how far the nodes are, what they said, what else there is."""

from collections.abc import Mapping, Set as AbstractSet
from dataclasses import dataclass, field
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from amr_description.bringup.conditions import Condition
    from amr_description.bringup.description import Node


@dataclass(frozen=True)
class NodeState:
    """How far a node has come."""

    started: bool = False
    returncode: int | None = None
    """None until it ended for good; then its exit code, or minus the signal it died of."""
    never: bool = False
    """Whether it waits for what can no longer happen."""
    restarts: int = 0
    """How often it was started again, in a row."""
    restart_at: float | None = None
    """When it is to be started again; None: it runs, or is not to be."""

    @property
    def running(self) -> bool:
        """Started, and not ended."""
        return self.started and self.returncode is None and self.restart_at is None


@dataclass(frozen=True)
class Graph:
    """What is seen of the ROS graph; all names are absolute."""

    topics: Mapping[str, AbstractSet[str]] = field(default_factory=dict)
    """Topics that somebody publishes, and their types, ``std_msgs/msg/String``."""
    services: AbstractSet[str] = frozenset()
    nodes: AbstractSet[str] = frozenset()


@dataclass(frozen=True)
class PathLook:
    """What is seen of a path."""

    there: bool
    beside: AbstractSet[str] = frozenset()
    """The names in its folder."""


@dataclass(frozen=True)
class Situation:
    """All that conditions may look at; a new one is made after each event."""

    states: 'Mapping[Node, NodeState]'
    time: float = 0.0
    """s, of any clock that never goes back."""
    began: float = 0.0
    """The time at which the stack began."""
    said: 'AbstractSet[Condition]' = frozenset()
    """The ``logged`` conditions of which a line was seen, and what handlers asked for."""
    held_since: 'Mapping[Condition, float]' = field(default_factory=dict)
    """Since when the conditions hold that an ``after`` counts from."""
    graph: Graph = field(default_factory=Graph)
    paths: Mapping[str, PathLook] = field(default_factory=dict)
