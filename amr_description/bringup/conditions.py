# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
When a node of a stack starts: conditions on nodes, on their output, on time, and combinations.

A condition is a pure value. The scheduler evaluates it against a :class:`StackState`, a snapshot
that it makes anew after every event. Conditions on the ROS graph and on files are in
``graph_conditions.py``.
"""

from abc import ABC, abstractmethod
from collections.abc import Callable, Iterator, Mapping, Set as AbstractSet
from dataclasses import dataclass, field, replace
import enum
import re
from typing import Literal, TypeAlias

from amr_description.bringup.validation import NUMBER, require, TEXT, Validator
from amr_description.errors import BringupError


class Member:
    """A node, a group or a stack: what a stack is made of; compared by identity."""


class NodeRef(Member):
    """A node of a stack as conditions and events see it; ``description.Node`` derives from it."""

    executable: str
    required: bool | Literal['at start']


NameOf: TypeAlias = Callable[[NodeRef], str]
"""Returns the name of a node on the screen, ``create-3``."""


@dataclass(frozen=True)
class NodeState:
    """How far a node has come."""

    started: bool = False
    returncode: int | None = None
    """Exit code, or minus the signal that ended it; None: it runs, or will run again."""
    unreachable: bool = False
    """Whether it will never start, because its condition can no longer hold."""
    restarts: int = 0
    """Respawns in a row."""
    restart_at: float | None = None
    """Time of the next respawn, s; None: none is planned."""
    absent: bool = False
    """Whether it was to be started, and no process could be made of it so far."""

    @property
    def running(self) -> bool:
        """Whether its process was started and has not ended."""
        return self.started and self.returncode is None and self.restart_at is None


@dataclass(frozen=True)
class RosGraph:
    """The ROS graph at one moment; all names are absolute."""

    topics: Mapping[str, AbstractSet[str]] = field(default_factory=dict)
    """Topics with a publisher, and their types, ``std_msgs/msg/String``."""
    services: AbstractSet[str] = frozenset()
    nodes: AbstractSet[str] = frozenset()


@dataclass(frozen=True)
class PathState:
    """A path of the file system at one moment."""

    exists: bool
    siblings: AbstractSet[str] = frozenset()
    """The names in its folder, if it does not exist."""


@dataclass(frozen=True)
class StackState:
    """All that conditions are evaluated against."""

    nodes: Mapping[NodeRef, NodeState]
    time: float = 0.0
    """s, of a monotonic clock."""
    start_time: float = 0.0
    """When the stack began, s of the same clock."""
    triggered: 'AbstractSet[Condition]' = frozenset()
    """``logged`` conditions whose line was seen, ``on_request`` ones that a handler asked for."""
    held_since: 'Mapping[Condition, float]' = field(default_factory=dict)
    """When each condition that an ``after`` counts from first held, s."""
    graph: RosGraph = field(default_factory=RosGraph)
    paths: Mapping[str, PathState] = field(default_factory=dict)


class Verdict(enum.Enum):
    """The value of a condition."""

    HOLDS = 'holds'
    NOT_YET = 'not yet'
    NEVER = 'never'  # nothing that can still happen will make it hold


@dataclass(frozen=True)
class Scope:
    """Where a condition stands in a stack; relative ROS names are resolved with it."""

    namespace: str = '/'
    stacks: Mapping[Member, str] = field(default_factory=dict)
    """The namespaces of all included stacks."""

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
        """The conditions it is made of."""
        return ()

    @property
    def delay(self) -> float:
        """How long it delays on purpose, s; timeouts are extended by it."""
        return max((part.delay for part in self.parts), default=0.0)

    @property
    def is_external(self) -> bool:
        """Whether it can come to hold without any process of the stack."""
        return any(part.is_external for part in self.parts)

    def waits_forever(self, state: StackState) -> bool:
        """Return whether it waits for a failure or a request, which may never come: no timeout."""
        return any(part.waits_forever(state) for part in self.parts)

    @abstractmethod
    def evaluate(self, state: StackState) -> Verdict:
        """Return whether it holds; called after every event of the stack."""

    @abstractmethod
    def describe(self, name_of: NameOf) -> str:
        """Return it in words: ``create-3 exited with code 0``."""

    @abstractmethod
    def explain_unmet(self, state: StackState, name_of: NameOf) -> str:
        """Return why it does not hold, with what is there instead: ``create-3 still runs``."""

    def resolved(self, scope: Scope) -> 'Condition':
        """Return the same condition with absolute names."""
        return self


CONDITION = Validator(
    'a condition, as exited_cleanly(node)', lambda value: isinstance(value, Condition)
)


def exited_cleanly(node: NodeRef) -> Condition:
    """
    Hold once the node has ended with exit code 0.

    Unlike launch's OnProcessExit, which fires after a failure as well.
    """
    return _ExitedCleanly(node)


def exited(node: NodeRef) -> Condition:
    """Hold once the node has ended, whatever its exit code: launch's OnProcessExit."""
    return _Exited(node)


def failed(node: NodeRef) -> Condition:
    """Hold once a node with ``required=False`` has failed; a required one would end the stack."""
    return _Failed(node)


def started(node: NodeRef) -> Condition:
    """Hold once the node's process was started, even if it has ended: launch's OnProcessStart."""
    return _Started(node)


def settled(node: NodeRef) -> Condition:
    """Hold once the node was started, or is optional and will never start."""
    return _Settled(node)


def logged(node: NodeRef, pattern: str) -> Condition:
    """Hold once the node wrote a line in which the regular expression is found."""
    return Logged(node, pattern)


def on_request() -> Condition:
    """Hold once a handler has returned the node; see ``handlers.py``."""
    return OnRequest()


def after(seconds: float, condition: Condition | None = None) -> Condition:
    """
    Hold some time after a condition first held.

    Args:
        seconds: The delay.
        condition: What it counts from; None: the start of the stack.
    """
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


def walk(condition: Condition | None) -> Iterator[Condition]:
    """Yield a condition after all that it is made of, innermost first; nothing for None."""
    if condition is not None:
        for part in condition.parts:
            yield from walk(part)
        yield condition


def may_never_hold(condition: Condition | None) -> bool:
    """Return whether it depends on a failure or a request; if it never holds, nothing is wrong."""
    return any(isinstance(part, OnRequest | _Failed) for part in walk(condition))


def is_end_of_node(condition: Condition) -> bool:
    """Return whether it holds once a node has ended, however."""
    return isinstance(condition, _Exited)


def has_running_timer(condition: Condition | None, state: StackState) -> bool:
    """Return whether an ``after`` in it counts down now."""
    timers = (part for part in walk(condition) if isinstance(part, After))
    return any((due := timer.due(state)) is not None and due > state.time for timer in timers)


def waits_for_request(condition: Condition | None) -> bool:
    """Return whether it depends on the request of a handler."""
    return any(isinstance(part, OnRequest) for part in walk(condition))


@dataclass(frozen=True)
class _OfNode(Condition):
    """A condition on one node."""

    node: NodeRef

    @property
    def nodes(self) -> tuple[NodeRef, ...]:
        return (self.node,)

    def explain_unmet(self, state: StackState, name_of: NameOf) -> str:
        node, name = state.nodes[self.node], name_of(self.node)
        if node.returncode is not None:
            return f'{name} ended with {node.returncode}'
        if node.restart_at is not None:
            return f'{name} waits for its next start'
        return f'{name} still runs' if node.started else f'{name} was not started'


@dataclass(frozen=True)
class _Exited(_OfNode):
    def evaluate(self, state: StackState) -> Verdict:
        node = state.nodes[self.node]
        if node.returncode is not None:
            return Verdict.HOLDS
        return Verdict.NEVER if node.unreachable else Verdict.NOT_YET

    def describe(self, name_of: NameOf) -> str:
        return f'{name_of(self.node)} exited'


@dataclass(frozen=True)
class _ExitedCleanly(_OfNode):
    def evaluate(self, state: StackState) -> Verdict:
        node = state.nodes[self.node]
        if node.returncode is None:
            return Verdict.NEVER if node.unreachable else Verdict.NOT_YET
        return Verdict.HOLDS if node.returncode == 0 else Verdict.NEVER

    def describe(self, name_of: NameOf) -> str:
        return f'{name_of(self.node)} exited with code 0'


@dataclass(frozen=True)
class _Failed(_OfNode):
    def waits_forever(self, state: StackState) -> bool:
        return self.evaluate(state) is Verdict.NOT_YET

    def evaluate(self, state: StackState) -> Verdict:
        node = state.nodes[self.node]
        if node.returncode is None:
            return Verdict.NEVER if node.unreachable else Verdict.NOT_YET
        return Verdict.NEVER if node.returncode == 0 else Verdict.HOLDS

    def describe(self, name_of: NameOf) -> str:
        return f'{name_of(self.node)} failed'


@dataclass(frozen=True)
class _Started(_OfNode):
    def evaluate(self, state: StackState) -> Verdict:
        node = state.nodes[self.node]
        if node.started and not node.absent:
            return Verdict.HOLDS
        is_over = node.unreachable or node.returncode is not None
        return Verdict.NEVER if is_over else Verdict.NOT_YET

    def describe(self, name_of: NameOf) -> str:
        return f'{name_of(self.node)} was started'


@dataclass(frozen=True)
class _Settled(_Started):
    def evaluate(self, state: StackState) -> Verdict:
        verdict = super().evaluate(state)
        given_up = verdict is Verdict.NEVER and not self.node.required
        return Verdict.HOLDS if given_up else verdict


@dataclass(frozen=True)
class Logged(_OfNode):
    """See :func:`logged`."""

    pattern: str

    def __post_init__(self) -> None:
        """Raise BringupError unless the pattern is a regular expression."""
        require('logged(…, %s)', self.pattern, TEXT)
        try:
            re.compile(self.pattern)
        except re.error as error:
            raise BringupError(f'logged(…, {self.pattern!r}): {error}') from None

    def matches(self, line: str) -> bool:
        """Return whether the pattern is found in a line."""
        return re.search(self.pattern, line) is not None

    def evaluate(self, state: StackState) -> Verdict:
        if self in state.triggered:
            return Verdict.HOLDS
        node = state.nodes[self.node]
        is_over = node.unreachable or node.returncode is not None
        return Verdict.NEVER if is_over else Verdict.NOT_YET

    def describe(self, name_of: NameOf) -> str:
        return f'{name_of(self.node)} said {self.pattern!r}'

    def explain_unmet(self, state: StackState, name_of: NameOf) -> str:
        return f'{name_of(self.node)} has not said {self.pattern!r}'


@dataclass(frozen=True, eq=False)
class OnRequest(Condition):
    """See :func:`on_request`; compared by identity, so that each node has a request of its own."""

    def waits_forever(self, state: StackState) -> bool:
        return self.evaluate(state) is Verdict.NOT_YET

    def evaluate(self, state: StackState) -> Verdict:
        return Verdict.HOLDS if self in state.triggered else Verdict.NOT_YET

    def describe(self, name_of: NameOf) -> str:
        return 'a handler asks for it'

    def explain_unmet(self, state: StackState, name_of: NameOf) -> str:
        return 'no handler asks for it'


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

    def due(self, state: StackState) -> float | None:
        """Return the time at which it will hold, s; None: not known yet."""
        if self.condition is None:
            return state.start_time + self.seconds
        since = state.held_since.get(self.condition)
        return None if since is None else since + self.seconds

    def evaluate(self, state: StackState) -> Verdict:
        due = self.due(state)
        if due is not None:
            return Verdict.HOLDS if state.time >= due else Verdict.NOT_YET
        verdict = self.condition.evaluate(state) if self.condition else None
        return Verdict.NEVER if verdict is Verdict.NEVER else Verdict.NOT_YET

    def describe(self, name_of: NameOf) -> str:
        origin = f'since {self.condition.describe(name_of)}' if self.condition else 'of the stack'
        return f'{self.seconds:g} s have passed {origin}'

    def explain_unmet(self, state: StackState, name_of: NameOf) -> str:
        due = self.due(state)
        if due is not None:
            return f'{due - state.time:.1f} s are left'
        return self.condition.explain_unmet(state, name_of) if self.condition else ''

    def resolved(self, scope: Scope) -> Condition:
        inner = self.condition.resolved(scope) if self.condition else None
        return replace(self, condition=inner)


@dataclass(frozen=True)
class _Combined(Condition):
    conditions: tuple[Condition, ...]

    def __post_init__(self) -> None:
        """Raise BringupError unless all are conditions."""
        for condition in self.conditions:
            require('all_of(…) or any_of(…), %s', condition, CONDITION)

    @property
    def parts(self) -> tuple[Condition, ...]:
        return self.conditions

    def resolved(self, scope: Scope) -> Condition:
        return replace(self, conditions=tuple(part.resolved(scope) for part in self.parts))

    def explain_unmet(self, state: StackState, name_of: NameOf) -> str:
        unmet = [c for c in self.conditions if c.evaluate(state) is not Verdict.HOLDS]
        return '; '.join(dict.fromkeys(c.explain_unmet(state, name_of) for c in unmet))


@dataclass(frozen=True)
class _AllOf(_Combined):
    def evaluate(self, state: StackState) -> Verdict:
        verdicts = {condition.evaluate(state) for condition in self.conditions}
        for verdict in (Verdict.NEVER, Verdict.NOT_YET):
            if verdict in verdicts:
                return verdict
        return Verdict.HOLDS

    def describe(self, name_of: NameOf) -> str:
        return ' and '.join(condition.describe(name_of) for condition in self.conditions)


@dataclass(frozen=True)
class _AnyOf(_Combined):
    def evaluate(self, state: StackState) -> Verdict:
        verdicts = {condition.evaluate(state) for condition in self.conditions}
        for verdict in (Verdict.HOLDS, Verdict.NOT_YET):
            if verdict in verdicts:
                return verdict
        return Verdict.NEVER

    def describe(self, name_of: NameOf) -> str:
        return f'({" or ".join(condition.describe(name_of) for condition in self.conditions)})'
