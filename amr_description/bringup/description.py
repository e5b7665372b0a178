# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
What a stack is written with: :class:`Node`, :class:`Group` and :class:`Stack`, named as in launch.

A value of the wrong type raises BringupError at once, with the field that it was given for.
"""

from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field, KW_ONLY, replace
from os import PathLike
from pathlib import Path
from typing import Literal, TypeAlias

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
from amr_description.bringup.handlers import (
    EventHandler,
    ExitHandler,
    Level,
    LineHandler,
    StopHandler,
)
from amr_description.errors import BringupError

Scalar: TypeAlias = bool | int | float | str
ParameterValue: TypeAlias = Scalar | Sequence[Scalar] | Mapping[str, 'ParameterValue']


@dataclass(frozen=True)
class ParameterText:
    """The text of a parameter file, which is written into the log folder."""

    text: str


@dataclass(frozen=True)
class LateTable:
    """A table of parameters that is known only when the node starts."""

    make: Callable[[], Mapping[str, ParameterValue]]
    """Raises BringupError: then the node is not started."""
    text: str
    """Its source, for ``--print``."""


Parameters: TypeAlias = Sequence[
    Mapping[str, ParameterValue] | ParameterText | LateTable | str | Path
]

DEFAULT_TIMEOUT = 60.0
"""s"""

_MEMBERS = validation.list_of('nodes, groups and stacks')
_COMMON_FIELDS = {
    'namespace': validation.NAMESPACE.or_none(),
    'environment': validation.ENVIRONMENT,
    'parameters': validation.list_of(
        "tables and files, as [{'speed': 1.0}, 'arm.yaml']",
        lambda entry: isinstance(entry, Mapping | ParameterText | LateTable | str | PathLike),
    ),
    'remappings': validation.REMAPPINGS,
    'start_when': CONDITION.or_none(),
}


START = 10.0
"""s of running after which a failure is none of the start."""


@dataclass(frozen=True)
class Respawn:
    """Start a node again whenever it ends, whatever its exit code, until the stack stops."""

    delay: float = 1.0
    """s from its end to its first restart."""
    backoff: float = 2.0
    """Factor from each delay to the next one."""
    limit: int | None = 5
    """Restarts in a row, after which its next end is a failure; None: no limit."""
    steady: float = 60.0
    """s of running after which delay and limit start over."""

    def __post_init__(self) -> None:
        """Raise BringupError if it would restart without a pause, or never."""
        numbers = dict.fromkeys(('delay', 'backoff', 'steady'), validation.NUMBER)
        validation.require_fields(
            'Respawn(…', self, {**numbers, 'limit': validation.NUMBER.or_none()}
        )
        if not (self.delay > 0 and self.backoff >= 1 and (self.limit is None or self.limit > 0)):
            raise BringupError(f'{self}: it takes delay > 0, backoff >= 1 and limit > 0 (or None)')


_NODE_FIELDS = {
    'package': validation.FILE_NAME,
    'name': validation.NAME.or_none(),
    **_COMMON_FIELDS,
    'arguments': validation.ARGUMENTS,
    'prefix': validation.TEXT,
    'timeout': validation.NUMBER.or_none(),
    'required': validation.Validator(
        "True, False or 'at start'", lambda value: isinstance(value, bool) or value == 'at start'
    ),
    'respawn': validation.Validator('Respawn(…)', lambda v: isinstance(v, Respawn)).or_none(),
    'on_exit': validation.Validator(
        "'continue', 'shutdown' or a function",
        lambda value: value in ('continue', 'shutdown') or callable(value),
    ),
    'terminal': validation.BOOLEAN,
    'command': validation.ARGUMENTS.or_none(),
    'is_ros': validation.BOOLEAN,
    'folder': validation.VALUE.or_none(),
    'on_output': validation.FUNCTION.or_none(),
}
_STACK_FIELDS = {
    'ready_when': CONDITION.or_none(),
    'timeout': validation.NUMBER,
    'on_shutdown': validation.FUNCTION.or_none(),
    'event_handlers': validation.list_of(
        'event handlers, as [EventHandler(exited(node), function)]',
        lambda value: isinstance(value, EventHandler),
    ),
    'next_steps': validation.TEXT,
    'notes': validation.list_of("pairs, as [('INFO', 'a text')]", validation.is_pair),
}


@dataclass(frozen=True, eq=False, repr=False)
class Node(NodeRef):
    """
    One process of a stack; compared by identity, so that ``start_when`` can refer to it.

    The command line is launch's: ``<prefix>/lib/<package>/<executable> <arguments> --ros-args …``.
    """

    executable: str
    _: KW_ONLY
    package: str = 'amr_description'
    name: str | None = None
    """Name of the ROS node (``-r __node:=``); None: the default of the executable."""
    namespace: str | None = None
    """That of the ROS node (``-r __ns:=``), relative to its group's unless it begins with /."""
    parameters: Parameters = ()
    """Tables of parameters and paths of YAML files; later ones override earlier ones."""
    remappings: Sequence[tuple[str, str]] = ()
    """Pairs (from, to), ``-r from:=to``."""
    arguments: Sequence[object] = ()
    """The words before ``--ros-args``."""
    environment: Mapping[str, str | None] = field(default_factory=dict)
    """Environment variables beside those of the bring-up and of its groups; None: without it."""
    prefix: str = ''
    """Words before the command line: ``gdb -ex run --args``, ``valgrind``, ``nice -n 10``."""
    start_when: Condition | None = None
    """None: at once."""
    timeout: float | None = None
    """s to wait for ``start_when``; None: the timeout of its stack; ``math.inf``: no timeout."""
    required: bool | Literal['at start'] = True
    """
    Whether its failure (an exit code other than 0, or a signal) stops the stack; ``'at start'``:
    one in the first 10 s does, as of a wrong parameter, and no later one.
    """
    respawn: Respawn | None = None
    on_exit: Literal['continue', 'shutdown'] | ExitHandler = 'continue'
    """What happens when it ends with exit code 0; or a handler that is called at its end."""
    terminal: bool = False
    """Whether it reads keys and needs the terminal, see terminal.py; at most one in a stack."""
    command: Sequence[str] | None = None
    """The words of a program that is no executable of a package, as of launch's ExecuteProcess."""
    is_ros: bool = False
    """Whether such a program is a ROS node: its command line goes on with ``--ros-args``."""
    folder: str | Path | None = None
    """Where it is started; None: where the bring-up is."""
    on_output: LineHandler | None = None
    """Called with each line of its output; as ``on_exit``, but it starts nothing."""

    def __post_init__(self) -> None:
        """Raise BringupError for a field of the wrong type."""
        validation.require('Node(%s)', self.executable, validation.FILE_NAME)
        validation.require_fields(f'Node({self.executable!r}', self, _NODE_FIELDS)
        if self.timeout is not None:
            _check_timeout(self.timeout)

    def __repr__(self) -> str:
        """Return it as short as error messages need it."""
        return f'Node({self.executable!r})'


@dataclass(frozen=True, eq=False)
class Group(Member):
    """
    Nodes, groups and stacks with something in common.

    Environment variables and parameters of inner groups override those of outer ones; of
    remappings those of the outer groups win, as in launch.
    """

    members: Sequence[Member]
    _: KW_ONLY
    namespace: str | None = None
    """Prepended to those of its members; relative to its own group's unless it begins with /."""
    environment: Mapping[str, str | None] = field(default_factory=dict)
    parameters: Parameters = ()
    remappings: Sequence[tuple[str, str]] = ()
    start_when: Condition | None = None
    """What every member waits for, in addition to its own condition."""

    def __post_init__(self) -> None:
        """Raise BringupError for a field of the wrong type."""
        validation.require('Group(%s)', self.members, _MEMBERS)
        validation.require_fields('Group(…', self, _COMMON_FIELDS)


@dataclass(frozen=True, eq=False)
class Stack(Member):
    """What to start, in which order, and when it is ready; it may be part of another stack."""

    nodes: Sequence[Member]
    _: KW_ONLY
    ready_when: Condition | None = None
    """None: once every node was started and every included stack is ready."""
    timeout: float = DEFAULT_TIMEOUT
    """s that each wait in it may take before the stack fails; ``math.inf``: no timeout."""
    on_shutdown: StopHandler | None = None
    """Called once, before the first process is signalled."""
    event_handlers: Sequence[EventHandler] = ()
    next_steps: str = ''
    """Logged after ``ready in … s:``: what a user would type next."""
    notes: Sequence[tuple[Level, str]] = ()
    """Logged before the first node starts; see ``notes_on``."""

    def __post_init__(self) -> None:
        """Raise BringupError if the stack could not run as it is written."""
        validation.require('Stack(%s)', self.nodes, _MEMBERS)
        validation.require_fields('Stack(…', self, _STACK_FIELDS)
        nodes = list(nodes_of(self.nodes))
        if not nodes and not self.notes and not self.event_handlers:
            raise BringupError('a stack needs at least one node')
        if len(set(nodes)) < len(nodes):
            twice = next(n for n in nodes if nodes.count(n) > 1)
            raise BringupError(f'the same {twice} stands twice in the stack; make a second Node')
        with_terminal = [node.executable for node in nodes if node.terminal]
        if len(with_terminal) > 1:
            raise BringupError(
                f'{" and ".join(with_terminal)} want the terminal, which one node can have'
            )
        handled = [handler.when for handler in self.event_handlers]
        for condition in [*_conditions(self.nodes), *handled, self.ready_when]:
            for node in condition.nodes if condition else ():
                if node not in nodes:
                    raise BringupError(
                        f'a condition waits for {validation.shortened(node)}, '
                        'which is not in the list of the stack'
                    )
        _check_timeout(self.timeout)

    @property
    def all_notes(self) -> list[tuple[Level, str]]:
        """Its notes and those of the included stacks, without repetitions."""
        inner = [note for stack in stacks_of(self.nodes) for note in stack.all_notes]
        return list(dict.fromkeys([*self.notes, *inner]))

    @property
    def stop_handlers(self) -> list[StopHandler]:
        """Its own handler and those of the included stacks."""
        inner = [each for stack in stacks_of(self.nodes) for each in stack.stop_handlers]
        return [*([self.on_shutdown] if self.on_shutdown else []), *inner]

    @property
    def all_next_steps(self) -> str:
        """Its own next steps or, if it has none, those of the included stacks."""
        inner = (stack.all_next_steps for stack in stacks_of(self.nodes))
        return self.next_steps or '\n'.join(filter(None, inner))

    @property
    def readiness(self) -> Condition:
        """The condition for being ready; names in it are relative to the stack's namespace."""
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

    def evaluate(self, state: StackState) -> Verdict:
        return self.stack.readiness.evaluate(state)

    def describe(self, name_of: NameOf) -> str:
        return self.stack.readiness.describe(name_of)

    def explain_unmet(self, state: StackState, name_of: NameOf) -> str:
        return self.stack.readiness.explain_unmet(state, name_of)

    def resolved(self, scope: Scope) -> Condition:
        return self.stack.readiness.resolved(replace(scope, namespace=scope.stacks[self.stack]))


def ready(stack: Stack) -> Condition:
    """Hold once a stack that is part of this one is ready."""
    validation.require(
        'ready(%s)', stack, validation.Validator('a Stack', lambda value: isinstance(value, Stack))
    )
    return _Ready(stack)


def nodes_of(members: Sequence[Member], *, into_stacks: bool = True) -> Iterator[Node]:
    """
    Yield the nodes of a tree, in its order.

    Args:
        members: the roots.
        into_stacks: whether to yield the nodes of included stacks too.
    """
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
                    f'{validation.shortened(member)} stands in a stack; '
                    'there can be Node, Group, Stack'
                )


def stacks_of(members: Sequence[Member]) -> Iterator[Stack]:
    """Yield the stacks of a tree, without the ones that these include."""
    for member in members:
        if isinstance(member, Stack):
            yield member
        elif isinstance(member, Group):
            yield from stacks_of(member.members)


def _check_timeout(seconds: float) -> None:
    if not seconds > 0:  # nan, too
        raise BringupError(f'timeout={seconds}: it takes more than 0 s')


def _conditions(members: Sequence[Member]) -> Iterator[Condition | None]:
    """Yield the conditions of a tree, but not of included stacks, which have checked theirs."""
    for member in members:
        if isinstance(member, Node | Group):
            yield member.start_when
        if isinstance(member, Group):
            yield from _conditions(member.members)
