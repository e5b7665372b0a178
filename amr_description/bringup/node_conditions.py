# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""Conditions on what became of the nodes of the stack, what they wrote, and who asks for one."""

from dataclasses import dataclass
import re
from typing import TYPE_CHECKING

from amr_description.bringup.conditions import Condition, leaves, NameOf, Verdict
from amr_description.bringup.kinds import require, TEXT
from amr_description.bringup.situation import Situation
from amr_description.errors import BringupError

if TYPE_CHECKING:
    from amr_description.bringup.description import Node


@dataclass(frozen=True)
class _OfNode(Condition):
    """On one node."""

    node: 'Node'

    @property
    def nodes(self) -> 'tuple[Node, ...]':
        return (self.node,)

    def lack(self, situation: Situation, name_of: NameOf) -> str:
        state, name = situation.states[self.node], name_of(self.node)
        if state.returncode is not None:
            return f'{name} ended with {state.returncode}'
        if state.restart_at is not None:
            return f'{name} waits for its next start'
        return f'{name} still runs' if state.started else f'{name} was not started'


@dataclass(frozen=True)
class _ExitedCleanly(_OfNode):
    def judge(self, situation: Situation) -> Verdict:
        state = situation.states[self.node]
        if state.returncode is None:
            return Verdict.NEVER if state.never else Verdict.NOT_YET
        return Verdict.HOLDS if state.returncode == 0 else Verdict.NEVER

    def describe(self, name_of: NameOf) -> str:
        return f'{name_of(self.node)} exited with code 0'


@dataclass(frozen=True)
class _Failed(_OfNode):
    def is_dormant(self, situation: Situation) -> bool:
        return self.judge(situation) is Verdict.NOT_YET

    def judge(self, situation: Situation) -> Verdict:
        state = situation.states[self.node]
        if state.returncode is None:
            return Verdict.NEVER if state.never else Verdict.NOT_YET
        return Verdict.NEVER if state.returncode == 0 else Verdict.HOLDS

    def describe(self, name_of: NameOf) -> str:
        return f'{name_of(self.node)} failed'


@dataclass(frozen=True)
class _Started(_OfNode):
    def judge(self, situation: Situation) -> Verdict:
        state = situation.states[self.node]
        if state.started:
            return Verdict.HOLDS
        return Verdict.NEVER if state.never else Verdict.NOT_YET

    def describe(self, name_of: NameOf) -> str:
        return f'{name_of(self.node)} was started'


@dataclass(frozen=True)
class _Settled(_Started):
    """Started, or optional and given up."""

    def judge(self, situation: Situation) -> Verdict:
        given_up = situation.states[self.node].never and not self.node.required
        return Verdict.HOLDS if given_up else super().judge(situation)


@dataclass(frozen=True)
class Logged(_OfNode):
    """See :func:`logged`."""

    pattern: str

    def __post_init__(self) -> None:
        """Refuse what is no regular expression."""
        require('logged(…, %s)', self.pattern, TEXT)
        try:
            re.compile(self.pattern)
        except re.error as error:
            raise BringupError(f'logged(…, {self.pattern!r}): {error}') from None

    def matches(self, line: str) -> bool:
        """Say whether this is the line."""
        return re.search(self.pattern, line) is not None

    def judge(self, situation: Situation) -> Verdict:
        if self in situation.said:
            return Verdict.HOLDS
        state = situation.states[self.node]
        over = state.never or state.returncode is not None
        return Verdict.NEVER if over else Verdict.NOT_YET

    def describe(self, name_of: NameOf) -> str:
        return f'{name_of(self.node)} said {self.pattern!r}'

    def lack(self, situation: Situation, name_of: NameOf) -> str:
        return f'{name_of(self.node)} has not said {self.pattern!r}'


@dataclass(frozen=True, eq=False)
class OnRequest(Condition):
    """See :func:`on_request`; each is another one."""

    def is_dormant(self, situation: Situation) -> bool:
        return self.judge(situation) is Verdict.NOT_YET

    def judge(self, situation: Situation) -> Verdict:
        return Verdict.HOLDS if self in situation.said else Verdict.NOT_YET

    def describe(self, name_of: NameOf) -> str:
        return 'a handler asks for it'

    def lack(self, situation: Situation, name_of: NameOf) -> str:
        return 'no handler asks for it'


def exited_cleanly(node: 'Node') -> Condition:
    """
    Hold once the node has ended with exit code 0.

    Other than launch's OnProcessExit, which fires after a failure too.
    """
    return _ExitedCleanly(node)


def failed(node: 'Node') -> Condition:
    """Hold once the node has ended otherwise; it is ``required=False``, or all stops then."""
    return _Failed(node)


def started(node: 'Node') -> Condition:
    """Hold once the node's process was started, as launch's OnProcessStart, even if it ended."""
    return _Started(node)


def settled(node: 'Node') -> Condition:
    """As :func:`started`; also if the node is optional and can never start."""
    return _Settled(node)


def logged(node: 'Node', pattern: str) -> Condition:
    """Hold once a line that the node wrote matched, anywhere in it, a regular expression."""
    return Logged(node, pattern)


def on_request() -> Condition:
    """Hold once a handler has asked for the node; see :mod:`handlers`."""
    return OnRequest()


def may_never_hold(condition: Condition | None) -> bool:
    """Say whether it is no fault if it never holds: it is for a failure, or for a request."""
    return any(isinstance(part, OnRequest | _Failed) for part in leaves(condition))


def waits_for_request(condition: Condition | None) -> bool:
    """Say whether a handler has to ask before it can hold."""
    return any(isinstance(part, OnRequest) for part in leaves(condition))
