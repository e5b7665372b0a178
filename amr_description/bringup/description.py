# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""The words of a stack: :class:`Node`, :class:`Group` and :class:`Stack`, as launch has them."""

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field, KW_ONLY, replace
from pathlib import Path
from typing import Literal

from amr_description.bringup import validation
from amr_description.bringup.conditions import (
    all_of,
    CONDITION,
    Condition,
    may_never_hold,
    Member,
    NameOf,
    NodeRef,
    Scope,
    settled,
    StackState,
    Verdict,
)
from amr_description.bringup.console import Level
from amr_description.bringup.handlers import ExitHandler, StopHandler
from amr_description.errors import BringupError

type Scalar = bool | int | float | str
type ParameterValue = Scalar | Sequence[Scalar] | Mapping[str, ParameterValue]
type Parameters = Sequence[Mapping[str, ParameterValue] | str | Path]

PATIENCE = 60.0
"""s"""

_MEMBERS = validation.list_of('nodes, groups and stacks')
_COMMON_KINDS = {
    'namespace': validation.NAMESPACE.or_none(),
    'environment': validation.ENVIRONMENT,
    'parameters': validation.PARAMETERS,
    'remappings': validation.REMAPPINGS,
    'start_when': CONDITION.or_none(),
}


@dataclass(frozen=True)
class Respawn:
    """Start a node again whenever it ends, with whatever exit code, until the stack stops."""

    delay: float = 1.0
    """s from its end to its first new start."""
    backoff: float = 2.0
    """By which each further delay is longer than the one before."""
    limit: int | None = 5
    """How often in a row; when that is over, its next end is a failure. None: for ever."""
    steady: float = 60.0
    """s; once it ran for so long, delay and limit begin anew."""

    def __post_init__(self) -> None:
        """Refuse what would start it without a pause, or never."""
        numbers = dict.fromkeys(('delay', 'backoff', 'steady'), validation.NUMBER)
        validation.require_fields(
            'Respawn(…', self, {**numbers, 'limit': validation.NUMBER.or_none()}
        )
        if not (self.delay > 0 and self.backoff >= 1 and (self.limit is None or self.limit > 0)):
            raise BringupError(f'{self}: it takes delay > 0, backoff >= 1 and limit > 0 (or None)')


_NODE_KINDS = {
    'package': validation.FILE_NAME,
    'name': validation.NAME.or_none(),
    **_COMMON_KINDS,
    'arguments': validation.ARGUMENTS,
    'prefix': validation.TEXT,
    'patience': validation.NUMBER.or_none(),
    'required': validation.TRUTH,
    'respawn': validation.Validator('Respawn(…)', lambda v: isinstance(v, Respawn)).or_none(),
    'on_exit': validation.Validator(
        "'continue', 'shutdown' or a function",
        lambda value: value in ('continue', 'shutdown') or callable(value),
    ),
    'terminal': validation.TRUTH,
}
_STACK_KINDS = {
    'ready_when': CONDITION.or_none(),
    'patience': validation.NUMBER,
    'on_shutdown': validation.FUNCTION.or_none(),
    'next_steps': validation.TEXT,
    'notes': validation.list_of("pairs, as [('INFO', 'a text')]", validation.is_pair),
}


@dataclass(frozen=True, eq=False, repr=False)
class Node(NodeRef):
    """
    One process of a stack; each Node is its own identity, so ``start_when`` can refer to it.

    The command line is launch's: ``<prefix>/lib/<package>/<executable> <arguments> --ros-args …``.
    """

    executable: str
    _: KW_ONLY
    package: str = 'amr_description'
    name: str | None = None
    """Name of the ROS node (``-r __node:=``); None: the name the program gives itself."""
    namespace: str | None = None
    """Namespace of the ROS node (``-r __ns:=``), within that of its group unless it begins /."""
    parameters: Parameters = ()
    """Tables of parameters and paths of YAML files, in order: the later wins."""
    remappings: Sequence[tuple[str, str]] = ()
    """Pairs (from, to), ``-r from:=to``."""
    arguments: Sequence[object] = ()
    """What stands before ``--ros-args``."""
    environment: Mapping[str, str] = field(default_factory=dict)
    """Environment variables, beside those of the bring-up and of its groups."""
    prefix: str = ''
    """What its command line begins with: ``gdb -ex run --args``, ``valgrind``, ``nice -n 10``."""
    start_when: Condition | None = None
    """None: at once."""
    patience: float | None = None
    """s for which ``start_when`` may lack; None: as its stack has it; ``math.inf``: for ever."""
    required: bool = True
    """Whether its failure (an exit code other than 0, or a signal) stops the stack."""
    respawn: Respawn | None = None
    on_exit: Literal['continue', 'shutdown'] | ExitHandler = 'continue'
    """What its end with exit code 0 means to the rest; or who is to be told of its end."""
    terminal: bool = False
    """Whether it reads keys: it gets the terminal itself (see terminal.py); one of a stack may."""

    def __post_init__(self) -> None:
        """Refuse what could not be started so."""
        validation.require('Node(%s)', self.executable, validation.FILE_NAME)
        validation.require_fields(f'Node({self.executable!r}', self, _NODE_KINDS)
        if self.patience is not None:
            _check_patience(self.patience)

    def __repr__(self) -> str:
        """Return what a person knows it by."""
        return f'Node({self.executable!r})'


@dataclass(frozen=True, eq=False)
class Group(Member):
    """
    Nodes, groups and stacks that have something in common.

    Of the environment and of parameters what stands further inside wins, of remappings what
    stands further outside, as in launch.
    """

    members: Sequence[Member]
    _: KW_ONLY
    namespace: str | None = None
    """Before the namespaces of its members; within that of its own group, unless it begins /."""
    environment: Mapping[str, str] = field(default_factory=dict)
    parameters: Parameters = ()
    remappings: Sequence[tuple[str, str]] = ()
    start_when: Condition | None = None
    """What every member waits for, beside what it waits for itself."""

    def __post_init__(self) -> None:
        """Refuse what no member could have."""
        validation.require('Group(%s)', self.members, _MEMBERS)
        validation.require_fields('Group(…', self, _COMMON_KINDS)


@dataclass(frozen=True, eq=False)
class Stack(Member):
    """
    What to start, in which order, and when it is ready.

    A stack may stand among the nodes of another one.
    """

    nodes: Sequence[Member]
    _: KW_ONLY
    ready_when: Condition | None = None
    """None: once every node was started, and every stack in it is ready."""
    patience: float = PATIENCE
    """s that each wait in it may take before the stack fails; ``math.inf``: for ever."""
    on_shutdown: StopHandler | None = None
    """Called once, before the first process is told to stop."""
    next_steps: str = ''
    """Printed after ``ready in … s: ``; what a person would type next."""
    notes: Sequence[tuple[Level, str]] = ()
    """Said before the first node starts; see :func:`file_notes.notes_on`."""

    def __post_init__(self) -> None:
        """Refuse a stack that could not run as it is written."""
        validation.require('Stack(%s)', self.nodes, _MEMBERS)
        validation.require_fields('Stack(…', self, _STACK_KINDS)
        nodes = list(nodes_of(self.nodes))
        if not nodes:
            raise BringupError('a stack needs at least one node')
        if len(set(nodes)) < len(nodes):
            twice = next(n for n in nodes if nodes.count(n) > 1)
            raise BringupError(f'the same {twice} stands twice in the stack; make a second Node')
        with_terminal = [node.executable for node in nodes if node.terminal]
        if len(with_terminal) > 1:
            raise BringupError(
                f'{" and ".join(with_terminal)} want the terminal, which one node can have'
            )
        for condition in [*_conditions(self.nodes), self.ready_when]:
            for node in condition.nodes if condition else ():
                if node not in nodes:
                    raise BringupError(
                        f'a condition waits for {validation.shortened(node)}, '
                        'which is not in the list of the stack'
                    )
        _check_patience(self.patience)

    @property
    def all_notes(self) -> list[tuple[Level, str]]:
        """Its notes and those of the stacks in it, each once."""
        inner = [note for stack in stacks_of(self.nodes) for note in stack.all_notes]
        return list(dict.fromkeys([*self.notes, *inner]))

    @property
    def stop_handlers(self) -> list[StopHandler]:
        """Its own handler and those of the stacks in it."""
        inner = [each for stack in stacks_of(self.nodes) for each in stack.stop_handlers]
        return [*([self.on_shutdown] if self.on_shutdown else []), *inner]

    @property
    def all_next_steps(self) -> str:
        """What it says that comes next, or else what the stacks in it say."""
        inner = (stack.all_next_steps for stack in stacks_of(self.nodes))
        return self.next_steps or '\n'.join(filter(None, inner))

    @property
    def readiness(self) -> Condition:
        """When it is ready; the names in it are relative to where the stack stands."""
        if self.ready_when is not None:
            return self.ready_when
        nodes = nodes_of(self.nodes, into_stacks=False)
        own = (settled(node) for node in nodes if not may_never_hold(node.start_when))
        return all_of(*own, *(ready(stack) for stack in stacks_of(self.nodes)))


@dataclass(frozen=True)
class _Ready(Condition):
    stack: Stack

    @property
    def parts(self) -> tuple[Condition, ...]:
        return (self.stack.readiness,)

    def evaluate(self, situation: StackState) -> Verdict:
        return self.stack.readiness.evaluate(situation)

    def describe(self, name_of: NameOf) -> str:
        return self.stack.readiness.describe(name_of)

    def explain_unmet(self, situation: StackState, name_of: NameOf) -> str:
        return self.stack.readiness.explain_unmet(situation, name_of)

    def resolved(self, scope: Scope) -> Condition:
        return self.stack.readiness.resolved(replace(scope, namespace=scope.stacks[self.stack]))


def ready(stack: Stack) -> Condition:
    """Hold once a stack that stands in this one is ready."""
    validation.require(
        'ready(%s)', stack, validation.Validator('a Stack', lambda value: isinstance(value, Stack))
    )
    return _Ready(stack)


def nodes_of(members: Sequence[Member], *, into_stacks: bool = True) -> Iterator[Node]:
    """Yield the nodes of a tree, in its order; optionally not those of the stacks in it."""
    for member in members:
        match member:
            case Node():
                yield member
            case Group():
                yield from nodes_of(member.members, into_stacks=into_stacks)
            case Stack():
                yield from nodes_of(member.nodes) if into_stacks else ()
            case _:
                raise BringupError(
                    f'{validation.shortened(member)} stands in a stack; there can be Node, Group, Stack'
                )


def stacks_of(members: Sequence[Member]) -> Iterator[Stack]:
    """Yield the stacks in a tree, not those within them."""
    for member in members:
        if isinstance(member, Stack):
            yield member
        elif isinstance(member, Group):
            yield from stacks_of(member.members)


def _check_patience(seconds: float) -> None:
    if not seconds > 0:
        raise BringupError(f'patience={seconds}: it takes more than 0 s')


def _conditions(members: Sequence[Member]) -> Iterator[Condition | None]:
    """Yield the conditions in a tree; a stack in it has judged its own."""
    for member in members:
        if not isinstance(member, Stack):
            yield member.start_when
        if isinstance(member, Group):
            yield from _conditions(member.members)
