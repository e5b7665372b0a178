# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
When a node of a stack starts: what a condition is, how conditions combine, and time.

A condition is pure: it judges a :class:`StackState`, and is asked again after every event. Those on
nodes stand in ``node_conditions.py``, those on the world outside in ``outside_conditions.py``.

Conditions on what became of the nodes of the stack, what they wrote, and who asks for one.

What conditions judge: how far the nodes are, what they said, what else there is.
"""

from abc import ABC, abstractmethod
from collections.abc import Callable, Iterator, Mapping, Set as AbstractSet
from dataclasses import dataclass, field, replace
import enum
import re

from amr_description.bringup.validation import NUMBER, require, TEXT, Validator
from amr_description.errors import BringupError


class Member:
    """What may stand in a stack: a node, a group or a stack; compared by identity."""


class NodeRef(Member):
    """What conditions, states and events know of a node of a stack; compared by identity."""

    executable: str
    required: bool


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
class StackState:
    """All that conditions may look at; a new one is made after each event."""

    states: Mapping[NodeRef, NodeState]
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


type NameOf = Callable[[NodeRef], str]


class Verdict(enum.Enum):
    """What a condition says of the present situation."""

    HOLDS = 'holds'
    NOT_YET = 'not yet'
    NEVER = 'never'  # nothing that can still happen will make it hold


@dataclass(frozen=True)
class Scope:
    """Where a condition stands in a stack: what its relative names mean."""

    namespace: str = '/'
    stacks: Mapping[Member, str] = field(default_factory=dict)
    """The namespaces of the stacks that stand in the whole one."""

    def absolute(self, name: str) -> str:
        """Return the full name of a topic, a service or a node."""
        return name if name.startswith('/') else f'{self.namespace.rstrip("/")}/{name}'


class Condition(ABC):
    """What ``start_when`` and ``ready_when`` take; compared by value."""

    @property
    def nodes(self) -> tuple[NodeRef, ...]:
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

    def waits_forever(self, situation: StackState) -> bool:
        """Say whether it waits for a failure or a request, which has not come and need not."""
        return any(part.waits_forever(situation) for part in self.parts)

    @property
    def is_external(self) -> bool:
        """Whether it can come to hold although no process of the stack does anything."""
        return any(part.is_external for part in self.parts)

    @abstractmethod
    def evaluate(self, situation: StackState) -> Verdict:
        """Say whether it holds; called after every event of the stack."""

    @abstractmethod
    def describe(self, name_of: NameOf) -> str:
        """Say it in words: ``create-3 exited with code 0``."""

    @abstractmethod
    def explain_unmet(self, situation: StackState, name_of: NameOf) -> str:
        """Say why it does not hold, and what is there instead: ``create-3 still runs``."""

    def resolved(self, scope: Scope) -> 'Condition':
        """Return it with full names."""
        return self


CONDITION = Validator(
    'a condition, as exited_cleanly(node)', lambda value: isinstance(value, Condition)
)


def walk(condition: Condition | None) -> Iterator[Condition]:
    """Yield a condition, or what it is made of, innermost first."""
    if condition is not None:
        for part in condition.parts:
            yield from walk(part)
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

    def explain_unmet(self, situation: StackState, name_of: NameOf) -> str:
        lacking = [c for c in self.conditions if c.evaluate(situation) is not Verdict.HOLDS]
        return '; '.join(dict.fromkeys(c.explain_unmet(situation, name_of) for c in lacking))


@dataclass(frozen=True)
class _AllOf(_Combined):
    def evaluate(self, situation: StackState) -> Verdict:
        verdicts = {condition.evaluate(situation) for condition in self.conditions}
        for verdict in (Verdict.NEVER, Verdict.NOT_YET):
            if verdict in verdicts:
                return verdict
        return Verdict.HOLDS

    def describe(self, name_of: NameOf) -> str:
        return ' and '.join(condition.describe(name_of) for condition in self.conditions)


@dataclass(frozen=True)
class _AnyOf(_Combined):
    def evaluate(self, situation: StackState) -> Verdict:
        verdicts = {condition.evaluate(situation) for condition in self.conditions}
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
    def is_external(self) -> bool:
        return self.condition is None or self.condition.is_external

    def due(self, situation: StackState) -> float | None:
        """Return the time at which it will hold; None: that is not known yet."""
        if self.condition is None:
            return situation.began + self.seconds
        since = situation.held_since.get(self.condition)
        return None if since is None else since + self.seconds

    def evaluate(self, situation: StackState) -> Verdict:
        due = self.due(situation)
        if due is None:
            verdict = self.condition.evaluate(situation)
            return Verdict.NEVER if verdict is Verdict.NEVER else Verdict.NOT_YET
        return Verdict.HOLDS if situation.time >= due else Verdict.NOT_YET

    def describe(self, name_of: NameOf) -> str:
        origin = f'since {self.condition.describe(name_of)}' if self.condition else 'of the stack'
        return f'{self.seconds:g} s have passed {origin}'

    def explain_unmet(self, situation: StackState, name_of: NameOf) -> str:
        due = self.due(situation)
        if due is None:
            return self.condition.explain_unmet(situation, name_of)
        return f'{due - situation.time:.1f} s are left'

    def resolved(self, scope: Scope) -> Condition:
        inner = self.condition.resolved(scope) if self.condition else None
        return replace(self, condition=inner)


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


@dataclass(frozen=True)
class _OfNode(Condition):
    """On one node."""

    node: NodeRef

    @property
    def nodes(self) -> tuple[NodeRef, ...]:
        return (self.node,)

    def explain_unmet(self, situation: StackState, name_of: NameOf) -> str:
        state, name = situation.states[self.node], name_of(self.node)
        if state.returncode is not None:
            return f'{name} ended with {state.returncode}'
        if state.restart_at is not None:
            return f'{name} waits for its next start'
        return f'{name} still runs' if state.started else f'{name} was not started'


@dataclass(frozen=True)
class _ExitedCleanly(_OfNode):
    def evaluate(self, situation: StackState) -> Verdict:
        state = situation.states[self.node]
        if state.returncode is None:
            return Verdict.NEVER if state.never else Verdict.NOT_YET
        return Verdict.HOLDS if state.returncode == 0 else Verdict.NEVER

    def describe(self, name_of: NameOf) -> str:
        return f'{name_of(self.node)} exited with code 0'


@dataclass(frozen=True)
class _Failed(_OfNode):
    def waits_forever(self, situation: StackState) -> bool:
        return self.evaluate(situation) is Verdict.NOT_YET

    def evaluate(self, situation: StackState) -> Verdict:
        state = situation.states[self.node]
        if state.returncode is None:
            return Verdict.NEVER if state.never else Verdict.NOT_YET
        return Verdict.NEVER if state.returncode == 0 else Verdict.HOLDS

    def describe(self, name_of: NameOf) -> str:
        return f'{name_of(self.node)} failed'


@dataclass(frozen=True)
class _Started(_OfNode):
    def evaluate(self, situation: StackState) -> Verdict:
        state = situation.states[self.node]
        if state.started:
            return Verdict.HOLDS
        return Verdict.NEVER if state.never else Verdict.NOT_YET

    def describe(self, name_of: NameOf) -> str:
        return f'{name_of(self.node)} was started'


@dataclass(frozen=True)
class _Settled(_Started):
    """Started, or optional and given up."""

    def evaluate(self, situation: StackState) -> Verdict:
        given_up = situation.states[self.node].never and not self.node.required
        return Verdict.HOLDS if given_up else super().evaluate(situation)


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

    def evaluate(self, situation: StackState) -> Verdict:
        if self in situation.said:
            return Verdict.HOLDS
        state = situation.states[self.node]
        over = state.never or state.returncode is not None
        return Verdict.NEVER if over else Verdict.NOT_YET

    def describe(self, name_of: NameOf) -> str:
        return f'{name_of(self.node)} said {self.pattern!r}'

    def explain_unmet(self, situation: StackState, name_of: NameOf) -> str:
        return f'{name_of(self.node)} has not said {self.pattern!r}'


@dataclass(frozen=True, eq=False)
class OnRequest(Condition):
    """See :func:`on_request`; each is another one."""

    def waits_forever(self, situation: StackState) -> bool:
        return self.evaluate(situation) is Verdict.NOT_YET

    def evaluate(self, situation: StackState) -> Verdict:
        return Verdict.HOLDS if self in situation.said else Verdict.NOT_YET

    def describe(self, name_of: NameOf) -> str:
        return 'a handler asks for it'

    def explain_unmet(self, situation: StackState, name_of: NameOf) -> str:
        return 'no handler asks for it'


def exited_cleanly(node: NodeRef) -> Condition:
    """
    Hold once the node has ended with exit code 0.

    Other than launch's OnProcessExit, which fires after a failure too.
    """
    return _ExitedCleanly(node)


def failed(node: NodeRef) -> Condition:
    """Hold once the node has ended otherwise; it is ``required=False``, or all stops then."""
    return _Failed(node)


def started(node: NodeRef) -> Condition:
    """Hold once the node's process was started, as launch's OnProcessStart, even if it ended."""
    return _Started(node)


def settled(node: NodeRef) -> Condition:
    """As :func:`started`; also if the node is optional and can never start."""
    return _Settled(node)


def logged(node: NodeRef, pattern: str) -> Condition:
    """Hold once a line that the node wrote matched, anywhere in it, a regular expression."""
    return Logged(node, pattern)


def on_request() -> Condition:
    """Hold once a handler has asked for the node; see :mod:`handlers`."""
    return OnRequest()


def may_never_hold(condition: Condition | None) -> bool:
    """Say whether it is no fault if it never holds: it is for a failure, or for a request."""
    return any(isinstance(part, OnRequest | _Failed) for part in walk(condition))


def waits_for_request(condition: Condition | None) -> bool:
    """Say whether a handler has to ask before it can hold."""
    return any(isinstance(part, OnRequest) for part in walk(condition))
