# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
What happens at events: handlers of launch -> conditions and event handlers of a stack.

Lists of actions are visited before anything starts. Functions are called when the event comes;
what they return can be lines for the log and Shutdown, but no process: all that may be started is
known, and checked, before anything starts.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Sequence
from dataclasses import dataclass, field
import re
from typing import Any, Protocol

from amr_description.bringup import handlers
from amr_description.bringup.conditions import (
    all_of,
    any_of,
    Condition,
    exited,
    exited_cleanly,
    logged,
    NodeRef,
    StackState,
    started,
)
from amr_description.bringup.description import Node as StackNode
from amr_description.bringup.handlers import EventHandler, Level, Stopping
from amr_description.bringup.process import ErrorLine
from amr_description.errors import BringupError
from amr_description.launch_api.actions import EmitEvent, Log, TimerAction
from amr_description.launch_api.context import LaunchContext
from amr_description.launch_api.descriptions import Action
from amr_description.launch_api.events import (
    Event,
    ExecutionComplete,
    Handler,
    OnExecutionComplete,
    OnLine,
    OnProcessExit,
    OnProcessIO,
    OnProcessStart,
    OnShutdown,
    ProcessExited,
    ProcessIO,
    ProcessStarted,
    Shutdown,
)
from amr_description.launch_api.lifecycle import (
    LifecycleTransition,
    OnStateTransition,
    Transition,
)
from amr_description.launch_api.locations import at, refusal
from amr_description.launch_api.processes import ExecuteProcess
from amr_description.launch_api.substitutions import perform_substitutions


@dataclass(frozen=True)
class Started:
    """What has become of an action."""

    node: NodeRef | None
    """None: no process is started for it."""
    when: Condition | None
    """When; None: at once."""
    transitions: list[tuple[Transition, NodeRef]] = field(default_factory=list)
    """What it is asked for, and what asks it."""

    def reached(self, handler: OnStateTransition) -> list[Condition]:
        """Return when the transitions that a handler waits for have succeeded."""
        steps = [step for transition, step in self.transitions if handler.is_of(transition)]
        return [exited_cleanly(step) for step in steps]


@dataclass(frozen=True, eq=False)
class Registered:
    """A handler that was visited."""

    handler: Handler
    context: LaunchContext
    when: Condition | None
    """From when on it is there."""


class Listeners:
    """What is called with each line of a process; OnProcessIO adds to it."""

    def __init__(self) -> None:
        """Begin with none."""
        self.functions: list[Callable[[str], handlers.Reaction]] = []

    def __call__(self, line: str) -> handlers.Reaction:
        """Call all."""
        if not self.functions:
            return None
        found: list[Any] = []
        for function in self.functions:
            reaction = function(line)
            found += reaction if isinstance(reaction, list) else []
        return found


class Translating(Protocol):
    """What this needs of a translation."""

    context: LaunchContext
    when: Condition | None
    nodes: list[StackNode]
    started: dict[Action, Started]
    event_handlers: list[EventHandler]
    notes: list[tuple[Level, str]]

    def visit(self, entities: Iterable[object] | None) -> None:
        """Visit entities."""
        ...

    def later(self, when: Condition | None, context: LaunchContext) -> Any:
        """Have what is visited within the context be done at that time."""
        ...


class Handling:
    """The event handlers of a launch file."""

    def __init__(self, translation: Translating) -> None:
        """Begin with none."""
        self._translation = translation
        self._waiting: list[Registered] = []
        self._at_the_end: list[Registered] = []

    def add(self, registered: Registered) -> None:
        """Note a handler that was visited."""
        at_the_end = isinstance(registered.handler, OnShutdown)
        (self._at_the_end if at_the_end else self._waiting).append(registered)

    def resolve(self) -> None:
        """Visit what handlers do, which may start what others wait for. Raises BringupError."""
        while ready := self._ready():
            self._waiting = [each for each in self._waiting if each not in ready]
            for each in ready:
                self._with_place(each)
        for each in self._waiting:
            name = type(each.handler).__name__
            why = 'its target is not started'
            if isinstance(each.handler, OnStateTransition):
                why = 'the launch file asks its target for no such transition'
            text = f'{each.handler.where}: {name} never comes: {why}'
            self._translation.notes.append(('INFO', text))
        for each in self._at_the_end:
            _require_lines_only(each.handler)

    def on_shutdown(self) -> Callable[[Stopping], Sequence[handlers.Log]] | None:
        """Return what is called when the launch stops; None: nothing."""
        if not self._at_the_end:
            return None

        def run(stopping: Stopping) -> list[handlers.Log]:
            event = Shutdown(reason=stopping.reason or 'all processes have ended')
            found: list[handlers.Log] = []
            for each in self._at_the_end:
                context = each.context.copy()
                context.extend_locals({'event': event})
                parts = _reactions(_result(each.handler, event, context), context)
                found += [part for part in parts if isinstance(part, handlers.Log)]
            return found

        return run

    def _ready(self) -> list[Registered]:
        """Return those whose targets were visited; if there are none, those of any process."""
        of_actions = [each for each in self._waiting if isinstance(each.handler.target, Action)]
        known = [each for each in of_actions if self._is_known(each.handler)]
        return known or [each for each in self._waiting if each not in of_actions]

    def _is_known(self, handler: Handler) -> bool:
        target = handler.target
        made = self._translation.started.get(target) if isinstance(target, Action) else None
        if made is not None and isinstance(handler, OnStateTransition):
            return bool(made.reached(handler))
        return made is not None

    def _with_place(self, registered: Registered) -> None:
        try:
            self._resolve(registered)
        except BringupError as error:
            raise at(error, registered.handler.where) from None

    def _targets(self, handler: Handler) -> list[tuple[Action, Started]]:
        every = self._translation.started
        if isinstance(handler.target, Action):
            return [(handler.target, every[handler.target])]
        if handler.target is not None and not callable(handler.target):
            raise refusal(f'target_action={handler.target!r}: it takes an action', '')
        matches = handler.target
        return [
            (action, made)
            for action, made in every.items()
            if isinstance(action, ExecuteProcess) and (matches is None or matches(action))
        ]

    def _resolve(self, registered: Registered) -> None:
        handler, targets = registered.handler, self._targets(registered.handler)
        if isinstance(handler, OnProcessIO):
            for action, made in targets:
                self._listen(handler, action, made, registered.context)
            return
        pairs = [
            (condition, action)
            for action, made in targets
            if (condition := _condition(handler, action, made)) is not _NEVER
        ]
        if not pairs:
            return
        conditions = [condition for condition, _ in pairs if condition is not None]
        when = registered.when
        if len(conditions) == len(pairs):
            event = any_of(*conditions) if len(conditions) > 1 else conditions[0]
            when = event if when is None else all_of(when, event)
        if handler.function is not None:
            self._call(registered, when, [action for _, action in pairs])
            return
        context = registered.context.copy()
        defined = self._translation.context.launch_configurations
        for name, value in defined.items():
            context.launch_configurations.setdefault(name, value)
        with self._translation.later(when, context):
            self._translation.visit(handler.entities)

    def _call(
        self, registered: Registered, when: Condition | None, actions: Sequence[Action]
    ) -> None:
        """Have a function called at an event."""
        handler = registered.handler
        if when is None:
            raise refusal(f'{type(handler).__name__} of what is not started here', '')

        def run(state: StackState) -> handlers.Reaction:
            event = self._event(handler, actions, state)
            return _reactions(_result(handler, event, registered.context), registered.context)

        text = f'call the function of {type(handler).__name__} ({handler.where})'
        self._translation.event_handlers.append(EventHandler(when, run, text))

    def _event(self, handler: Handler, actions: Sequence[Action], state: StackState) -> Event:
        """Return the event that a function is given: that of the first process it is true of."""
        for action in actions:
            node = self._translation.started[action].node
            if node is None:
                continue
            now = state.nodes[node]
            if isinstance(handler, OnProcessStart) and now.started:
                return ProcessStarted(action, self._name_of(node))
            if now.returncode is not None:
                if isinstance(handler, OnExecutionComplete):
                    return ExecutionComplete(action)
                return ProcessExited(action, self._name_of(node), returncode=now.returncode)
        return ExecutionComplete(actions[0])

    def _name_of(self, node: NodeRef) -> str:
        """Return the name of a process on the screen, once all that is started is known."""
        number = 1 + [*map(id, self._translation.nodes)].index(id(node))
        return f'{node.executable}-{number}'

    def _listen(
        self, handler: OnProcessIO, action: Action, made: Started, context: LaunchContext
    ) -> None:
        listeners = getattr(made.node, 'on_output', None)
        if made.node is None or not isinstance(listeners, Listeners):
            return
        name = self._name_of(made.node)

        def on_line(line: str) -> handlers.Reaction:
            event = io_event(action, name, line)
            results = [function(event) for function in dict.fromkeys(handler.functions)]
            return _reactions(results, context)

        listeners.functions.append(on_line)


def io_event(action: object, name: str, line: str) -> ProcessIO:
    """Return the event of a line, which may be known to be one of stderr."""
    is_error = isinstance(line, ErrorLine)
    text = f'{line}\n'.encode()
    return ProcessIO(action, name, text=text, from_stdout=not is_error, from_stderr=is_error)


_NEVER = all_of()


def _condition(handler: Handler, action: Action, made: Started) -> Condition | None:
    """Return when the event of a handler comes; None: at once; ``_NEVER``: never."""
    if isinstance(handler, OnStateTransition):
        reached = made.reached(handler)
        return any_of(*reached) if len(reached) > 1 else reached[0] if reached else _NEVER
    if isinstance(action, TimerAction):
        return made.when if isinstance(handler, OnExecutionComplete) else _NEVER
    if made.node is None:  # its counterpart is that nothing is needed
        return made.when if isinstance(handler, OnProcessStart) else _NEVER
    if isinstance(handler, OnProcessStart):
        return started(made.node)
    if isinstance(handler, OnLine):
        return logged(made.node, re.escape(handler.text))
    if isinstance(handler, OnProcessExit | OnExecutionComplete):
        return exited(made.node)
    raise refusal(f'{type(handler).__name__} is not understood here', '')


def _result(handler: Handler, event: Event, context: LaunchContext) -> object:
    return handler.entities if handler.function is None else handler.function(event, context)


def _reactions(result: object, context: LaunchContext) -> list[Any]:
    """Return what a stack does about the result of a function. Raises BringupError."""
    return list(_parts(result, context))


def _parts(result: object, context: LaunchContext) -> Iterator[handlers.Log | handlers.Shutdown]:
    if result is None:
        return
    if isinstance(result, list | tuple):
        for each in result:
            yield from _parts(each, context)
        return
    if not isinstance(result, Action) or _starts_something(result):
        raise refusal(
            f'a function of an event handler has returned {type(result).__name__}, which cannot '
            'be started here: give the handler a list of actions in place of the function',
            '',
        )
    if result.condition is not None and not result.condition.evaluate(context):
        return
    if isinstance(result, Log):
        yield handlers.Log(perform_substitutions(context, result.msg))
    elif isinstance(result, EmitEvent) and isinstance(result.event, Shutdown):
        yield handlers.Shutdown(result.event.text(context))
    else:
        yield from _parts(list(result.execute(context) or ()), context)


def _starts_something(action: Action) -> bool:
    """Return whether a process is needed for it, now or later."""
    if isinstance(action, EmitEvent):
        return not isinstance(action.event, Shutdown)
    return isinstance(action, ExecuteProcess | TimerAction | LifecycleTransition)


def _require_lines_only(handler: Handler) -> None:
    """Raise BringupError if what is to be done at the end starts a process."""
    for each in handler.entities:
        if isinstance(each, Action) and _starts_something(each):
            raise refusal(
                f'OnShutdown cannot start {type(each).__name__}: all is stopped then',
                handler.where,
            )
