# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
When a node of a stack starts: conditions on what happened to the other nodes.

A condition is pure: it judges the states of the nodes, and is asked again after every event.
"""

from collections.abc import Callable, Mapping
from dataclasses import dataclass
import enum
from typing import Protocol, TYPE_CHECKING

if TYPE_CHECKING:
    from amr_description.bringup.description import Node


class Verdict(enum.Enum):
    """What a condition says of the present states."""

    HOLDS = 'holds'
    NOT_YET = 'not yet'
    NEVER = 'never'  # nothing that can still happen will make it hold


@dataclass(frozen=True)
class NodeState:
    """How far a node has come."""

    started: bool = False
    returncode: int | None = None
    """None until it ended; then its exit code, or minus the number of the signal it died of."""

    @property
    def running(self) -> bool:
        """Started, and not ended."""
        return self.started and self.returncode is None


class Condition(Protocol):
    """What ``start_when`` and ``ready_when`` take."""

    @property
    def nodes(self) -> 'tuple[Node, ...]':
        """The nodes it depends on."""

    def judge(self, states: 'Mapping[Node, NodeState]') -> Verdict:
        """Say whether it holds; called after every event of the stack."""

    def describe(self, name_of: 'Callable[[Node], str]') -> str:
        """Say it in words: ``create-3 exited with code 0``."""


@dataclass(frozen=True)
class _ExitedCleanly:
    node: 'Node'

    @property
    def nodes(self) -> 'tuple[Node, ...]':
        return (self.node,)

    def judge(self, states: 'Mapping[Node, NodeState]') -> Verdict:
        returncode = states[self.node].returncode
        if returncode is None:
            return Verdict.NOT_YET
        return Verdict.HOLDS if returncode == 0 else Verdict.NEVER

    def describe(self, name_of: 'Callable[[Node], str]') -> str:
        return f'{name_of(self.node)} exited with code 0'


@dataclass(frozen=True)
class _Started:
    node: 'Node'

    @property
    def nodes(self) -> 'tuple[Node, ...]':
        return (self.node,)

    def judge(self, states: 'Mapping[Node, NodeState]') -> Verdict:
        return Verdict.HOLDS if states[self.node].started else Verdict.NOT_YET

    def describe(self, name_of: 'Callable[[Node], str]') -> str:
        return f'{name_of(self.node)} was started'


@dataclass(frozen=True)
class _AllOf:
    conditions: tuple[Condition, ...]

    @property
    def nodes(self) -> 'tuple[Node, ...]':
        return tuple(node for condition in self.conditions for node in condition.nodes)

    def judge(self, states: 'Mapping[Node, NodeState]') -> Verdict:
        verdicts = {condition.judge(states) for condition in self.conditions}
        for verdict in (Verdict.NEVER, Verdict.NOT_YET):
            if verdict in verdicts:
                return verdict
        return Verdict.HOLDS

    def describe(self, name_of: 'Callable[[Node], str]') -> str:
        return ' and '.join(condition.describe(name_of) for condition in self.conditions)


def exited_cleanly(node: 'Node') -> Condition:
    """
    Hold once the node has ended with exit code 0.

    Other than launch's OnProcessExit, which fires after a failure too.
    """
    return _ExitedCleanly(node)


def started(node: 'Node') -> Condition:
    """Hold once the node's process was started, as launch's OnProcessStart, even if it ended."""
    return _Started(node)


def all_of(*conditions: Condition) -> Condition:
    """Hold once every one of the conditions holds."""
    return _AllOf(conditions)
