# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
When a node of a stack starts: what a condition is, how conditions combine, and time.

A condition is pure: it judges a :class:`Situation`, and is asked again after every event. Those on
nodes stand in ``node_conditions.py``, those on the world outside in ``outside_conditions.py``.
"""

from abc import ABC, abstractmethod
from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass, field, replace
import enum
from typing import TYPE_CHECKING

from amr_description.bringup.kinds import Kind, NUMBER, require
from amr_description.bringup.situation import Situation
from amr_description.errors import BringupError

if TYPE_CHECKING:
    from amr_description.bringup.description import Node, Stack

type NameOf = 'Callable[[Node], str]'


class Verdict(enum.Enum):
    """What a condition says of the present situation."""

    HOLDS = 'holds'
    NOT_YET = 'not yet'
    NEVER = 'never'  # nothing that can still happen will make it hold


@dataclass(frozen=True)
class Scope:
    """Where a condition stands in a stack: what its relative names mean."""

    namespace: str = '/'
    stacks: 'Mapping[Stack, str]' = field(default_factory=dict)
    """The namespaces of the stacks that stand in the whole one."""

    def absolute(self, name: str) -> str:
        """Return the full name of a topic, a service or a node."""
        return name if name.startswith('/') else f'{self.namespace.rstrip("/")}/{name}'


class Condition(ABC):
    """What ``start_when`` and ``ready_when`` take; compared by value."""

    @property
    def nodes(self) -> 'tuple[Node, ...]':
        """The nodes it depends on."""
        return tuple(node for part in self.parts for node in part.nodes)

    @property
    def parts(self) -> 'tuple[Condition, ...]':
        """The conditions that it is made of."""
        return ()

    @property
    def delay(self) -> float:
        """How long it waits on purpose, s; no patience is lost by that."""
        return max((part.delay for part in self.parts), default=0.0)

    def is_dormant(self, situation: Situation) -> bool:
        """Say whether it waits for a failure or a request, which has not come and need not."""
        return any(part.is_dormant(situation) for part in self.parts)

    @property
    def looks_outside(self) -> bool:
        """Whether it can come to hold although no process of the stack does anything."""
        return any(part.looks_outside for part in self.parts)

    @abstractmethod
    def judge(self, situation: Situation) -> Verdict:
        """Say whether it holds; called after every event of the stack."""

    @abstractmethod
    def describe(self, name_of: NameOf) -> str:
        """Say it in words: ``create-3 exited with code 0``."""

    @abstractmethod
    def lack(self, situation: Situation, name_of: NameOf) -> str:
        """Say why it does not hold, and what is there instead: ``create-3 still runs``."""

    def resolved(self, scope: Scope) -> 'Condition':
        """Return it with full names."""
        return self


CONDITION = Kind(
    'a condition, as exited_cleanly(node)', lambda value: isinstance(value, Condition)
)


def leaves(condition: Condition | None) -> Iterator[Condition]:
    """Yield a condition, or what it is made of, innermost first."""
    if condition is not None:
        for part in condition.parts:
            yield from leaves(part)
        yield condition


@dataclass(frozen=True)
class _Combined(Condition):
    conditions: tuple[Condition, ...]

    def __post_init__(self) -> None:
        """Refuse what is no condition."""
        for condition in self.conditions:
            require('all_of(…) or any_of(…), %s', condition, CONDITION)

    @property
    def parts(self) -> tuple[Condition, ...]:
        return self.conditions

    def resolved(self, scope: Scope) -> Condition:
        return replace(self, conditions=tuple(part.resolved(scope) for part in self.parts))

    def lack(self, situation: Situation, name_of: NameOf) -> str:
        lacking = [c for c in self.conditions if c.judge(situation) is not Verdict.HOLDS]
        return '; '.join(dict.fromkeys(c.lack(situation, name_of) for c in lacking))


@dataclass(frozen=True)
class _AllOf(_Combined):
    def judge(self, situation: Situation) -> Verdict:
        verdicts = {condition.judge(situation) for condition in self.conditions}
        for verdict in (Verdict.NEVER, Verdict.NOT_YET):
            if verdict in verdicts:
                return verdict
        return Verdict.HOLDS

    def describe(self, name_of: NameOf) -> str:
        return ' and '.join(condition.describe(name_of) for condition in self.conditions)


@dataclass(frozen=True)
class _AnyOf(_Combined):
    def judge(self, situation: Situation) -> Verdict:
        verdicts = {condition.judge(situation) for condition in self.conditions}
        for verdict in (Verdict.HOLDS, Verdict.NOT_YET):
            if verdict in verdicts:
                return verdict
        return Verdict.NEVER

    def describe(self, name_of: NameOf) -> str:
        return f'({" or ".join(condition.describe(name_of) for condition in self.conditions)})'


@dataclass(frozen=True)
class After(Condition):
    """See :func:`after`."""

    seconds: float
    condition: Condition | None

    @property
    def parts(self) -> tuple[Condition, ...]:
        return (self.condition,) if self.condition else ()

    @property
    def delay(self) -> float:
        return self.seconds + super().delay

    @property
    def looks_outside(self) -> bool:
        return self.condition is None or self.condition.looks_outside

    def due(self, situation: Situation) -> float | None:
        """Return the time at which it will hold; None: that is not known yet."""
        if self.condition is None:
            return situation.began + self.seconds
        since = situation.held_since.get(self.condition)
        return None if since is None else since + self.seconds

    def judge(self, situation: Situation) -> Verdict:
        due = self.due(situation)
        if due is None:
            verdict = self.condition.judge(situation)
            return Verdict.NEVER if verdict is Verdict.NEVER else Verdict.NOT_YET
        return Verdict.HOLDS if situation.time >= due else Verdict.NOT_YET

    def describe(self, name_of: NameOf) -> str:
        origin = f'since {self.condition.describe(name_of)}' if self.condition else 'of the stack'
        return f'{self.seconds:g} s have passed {origin}'

    def lack(self, situation: Situation, name_of: NameOf) -> str:
        due = self.due(situation)
        if due is None:
            return self.condition.lack(situation, name_of)
        return f'{due - situation.time:.1f} s are left'

    def resolved(self, scope: Scope) -> Condition:
        inner = self.condition.resolved(scope) if self.condition else None
        return replace(self, condition=inner)


@dataclass(frozen=True)
class _Ready(Condition):
    stack: 'Stack'

    @property
    def parts(self) -> tuple[Condition, ...]:
        return (self.stack.readiness,)

    def judge(self, situation: Situation) -> Verdict:
        return self.stack.readiness.judge(situation)

    def describe(self, name_of: NameOf) -> str:
        return self.stack.readiness.describe(name_of)

    def lack(self, situation: Situation, name_of: NameOf) -> str:
        return self.stack.readiness.lack(situation, name_of)

    def resolved(self, scope: Scope) -> Condition:
        return self.stack.readiness.resolved(replace(scope, namespace=scope.stacks[self.stack]))


def after(seconds: float, condition: Condition | None = None) -> Condition:
    """Hold so long after the condition came to hold; after the stack began, if there is none."""
    require('after(%s)', seconds, NUMBER)
    require('after(…, %s)', condition, CONDITION.or_none())
    if not 0 <= seconds < float('inf'):
        raise BringupError(f'after({seconds!r}): it takes 0 s or more')
    return After(seconds, condition)


def all_of(*conditions: Condition) -> Condition:
    """Hold once every one of the conditions holds."""
    return _AllOf(conditions)


def any_of(*conditions: Condition) -> Condition:
    """Hold once one of the conditions holds."""
    if not conditions:
        raise BringupError('any_of(): it takes one condition or more')
    return _AnyOf(conditions)


def ready(stack: 'Stack') -> Condition:
    """Hold once a stack that stands in this one is ready."""
    require('ready(%s)', stack, Kind('a Stack', lambda value: hasattr(value, 'readiness')))
    return _Ready(stack)
