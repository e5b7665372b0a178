# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
The state machine of a stack: what may start now, what failed, when it is ready or over.

Pure: the orchestrator reports starts, exits, lines, the ROS graph, files and the time, and asks
what to do; no method blocks or reads a clock.

Every wait has a timeout. It runs from the moment when all the nodes that the wait depends on were
started: a node that waits for a step to end gives that step the whole timeout, however long it
took until the step could start. The seconds of an ``after`` are added. A wait for a failure or
for a request has no timeout.
"""

from collections import deque
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
import math
from typing import Any, TypeAlias, TypeVar

from amr_description.bringup.conditions import (
    After,
    Condition,
    has_running_timer,
    Logged,
    NameOf,
    NodeState,
    OnRequest,
    PathState,
    RosGraph,
    StackState,
    Verdict,
    waits_for_request,
    walk,
)
from amr_description.bringup.description import Node, nodes_of, Stack, START
from amr_description.bringup.handlers import (
    call_handler,
    Exited,
    HandlerResult,
    Log,
    Reaction,
    Shutdown,
)
from amr_description.bringup.placement import Placement
from amr_description.errors import BringupError

T = TypeVar('T')

TIMED_OUT = 124
"""Exit code after a timeout, the one of ``timeout(1)``."""

_OVER = (Verdict.HOLDS, Verdict.NEVER)

Wait: TypeAlias = tuple[Node | None, Condition]
"""A node and the condition it waits for; None: the stack itself waits to be ready."""


@dataclass(frozen=True)
class Failure:
    """The first failure of a required node: it stops the stack."""

    node: Node
    returncode: int
    """As in :class:`NodeState`; 0 only if the limit of its respawns was reached."""
    restarts: int = 0
    """How often it was respawned before."""

    @property
    def exit_code(self) -> int:
        """The exit code of the bring-up, 1..255: the node's, or 128 + signal as in shells."""
        return (self.returncode or 1) if self.returncode >= 0 else 128 - self.returncode


@dataclass(frozen=True)
class Expired:
    """A wait whose timeout has expired."""

    node: Node | None
    """The node that waited; None: the stack itself."""
    condition: Condition
    seconds: float
    """How long it waited."""
    state: StackState
    """The state at that moment."""

    exit_code = TIMED_OUT

    def text(self, name_of: NameOf) -> str:
        """Return what was waited for, how long, and what is there instead."""
        who = name_of(self.node) if self.node else 'the stack, to be ready,'
        unmet = self.condition.explain_unmet(self.state, name_of)
        text = f'{who} waited {self.seconds:.0f} s in vain: {unmet}'
        others = [
            f'{name_of(node)} still runs'
            for node, state in self.state.nodes.items()
            if state.running and f'{name_of(node)} still runs' not in text
        ]
        return '; '.join([text, *others])


class Timeouts:
    """When each wait began, and when its timeout expires."""

    def __init__(self, timeouts: Mapping[Node, float], of_stack: float) -> None:
        """
        Begin without any wait.

        Args:
            timeouts: that of each node, s.
            of_stack: that of the stack for getting ready, s.
        """
        self._timeouts: Mapping[Node | None, float] = {**timeouts, None: of_stack}
        self._began: dict[Node | None, float] = {}

    def expired(self, waits: Iterable[Wait], state: StackState) -> Expired | None:
        """Return the first wait whose timeout has expired."""
        for node, condition in waits:
            deadline = self._deadline(node, condition, state)
            if deadline is not None and state.time >= deadline:
                return Expired(node, condition, state.time - self._began[node], state)
        return None

    def deadlines(self, waits: Iterable[Wait], state: StackState) -> list[float]:
        """Return the times, s, at which the timeouts that are running will expire."""
        found = (self._deadline(node, condition, state) for node, condition in waits)
        return [deadline for deadline in found if deadline is not None]

    def _deadline(
        self, node: Node | None, condition: Condition, state: StackState
    ) -> float | None:
        if node not in self._began:
            if condition.waits_forever(state):
                return None
            needed = (state.nodes[each] for each in condition.nodes)
            if not all(each.started or each.unreachable for each in needed):
                return None
            self._began[node] = state.time
        deadline = self._began[node] + self._timeouts[node] + condition.delay
        return None if math.isinf(deadline) else deadline


class Scheduler:
    """The states of all nodes of a stack; used by the orchestrator's event loop only."""

    def __init__(self, stack: Stack, start_time: float = 0.0) -> None:
        """
        Begin with nothing started.

        Args:
            stack: what to schedule.
            start_time: s, of the monotonic clock that all later times are of.
        """
        placement = Placement(stack)
        self._conditions = {each.node: each.start_when for each in placement.nodes}
        self._ready_when = placement.ready_when
        self._handlers = placement.event_handlers  # those that were not called yet
        handled = [handler.when for handler in self._handlers]
        all_conditions = [*self._conditions.values(), *handled, self._ready_when]
        self._parts = dict.fromkeys(part for each in all_conditions for part in walk(each))
        self._logged = [part for part in self._parts if isinstance(part, Logged)]
        self._nodes = {node: NodeState() for node in self._conditions}
        self._last_start: dict[Node, float] = {}
        self._have_run: set[Node] = set()
        self._state = StackState(self._nodes, time=start_time, start_time=start_time)
        self._timeouts = Timeouts(
            {each.node: each.timeout for each in placement.nodes}, stack.timeout
        )
        self._ready = False
        self.failure: Failure | Expired | None = None
        self.abandoned: list[Expired] = []
        """Expired waits of optional nodes, which will not be started any more."""
        self.shutdown: Shutdown | None = None
        """Set when a handler stops the stack."""
        self.lines: deque[Log] = deque()
        """What handlers have written, to be shown."""
        self.over = False
        """Whether nothing more is started and what runs is to be stopped."""

    @property
    def state(self) -> StackState:
        """What the conditions are evaluated against now."""
        return self._state

    def expect_start(self, node: Node) -> None:
        """Take the process of a node as started: one that will have the terminal ends all talk."""
        self._last_start[node] = self._state.time
        self._nodes[node] = NodeState(started=True, restarts=self._nodes[node].restarts)
        self._update()

    def on_start(self, node: Node) -> None:
        """Note that the process of a node was started."""
        self._have_run.add(node)
        self.expect_start(node)
        self._call_handlers()

    def on_no_start(self, node: Node, returncode: int, last_lines: Sequence[str]) -> None:
        """Note that no process could be made of a node: as :meth:`on_exit`, but it never ran."""
        self._last_start[node] = self._state.time
        is_absent = node not in self._have_run
        self._nodes[node] = replace(self._nodes[node], absent=is_absent)
        self.on_exit(node, returncode, last_lines)

    def on_exit(self, node: Node, returncode: int, last_lines: Sequence[str] = ()) -> None:
        """
        Note that the process of a node has ended, and call its handler.

        A process that ends when the stack is over ended because of that: it is no failure.

        Args:
            node: whose process it was.
            returncode: exit code, or minus the signal that ended it.
            last_lines: the last lines of its output, for the handler.
        """
        is_start = returncode != 0 and self._is_start(node)
        if not self.over and not is_start and self._plan_respawn(node):
            return
        before = self._nodes[node]
        self._nodes[node] = replace(before, started=True, returncode=returncode, restart_at=None)
        self._update()
        if self.over:
            return
        if callable(node.on_exit):
            self._react('on_exit', node.on_exit, Exited(node, returncode, last_lines))
        self._call_handlers()
        failed = returncode != 0 or node.respawn is not None
        blocks_a_required_node = any(waiting.required for waiting in self.unreachable())
        if failed and (node.required is True or is_start or blocks_a_required_node):
            self.failure = Failure(node, returncode, before.restarts)
        ends_the_stack = returncode == 0 and node.on_exit == 'shutdown'
        stopped_by_handler = self.shutdown is not None
        self.over = bool(self.failure) or stopped_by_handler or ends_the_stack or self._is_idle()

    def on_line(self, node: Node, line: str) -> bool:
        """Note a line of a node's output; return whether it fulfils a condition."""
        triggered = self._state.triggered
        found = {
            part
            for part in self._logged
            if part.node is node and part not in triggered and part.matches(line)
        }
        if found:
            self._update(triggered=triggered | found)
        if node.on_output is not None and not self.over:
            self._react('on_output', node.on_output, line)
            self.over = self.over or self.shutdown is not None
            return bool(found or self.lines or self.over)
        return bool(found)

    def observe(
        self, *, graph: RosGraph | None = None, paths: Mapping[str, PathState] | None = None
    ) -> None:
        """Note the ROS graph and files as they are now; None: not observed."""
        if graph is not None:
            self._update(graph=graph)
        if paths is not None:
            self._update(paths=paths)

    def set_time(self, time: float) -> None:
        """Note the time, s."""
        self._update(time=time)

    def advance_to(self, time: float) -> None:
        """
        Note the time, s, and expire timeouts; call it when all events until then are reported.

        An expired timeout of a required node, or of the stack itself, ends the stack; an optional
        node is abandoned.
        """
        self.set_time(time)
        self._call_handlers()
        while not self.over:
            expired = self._timeouts.expired(self.waits(), self._state)
            if expired is None:
                self.over = self._is_idle()  # the last handler of a stack may need no process
                return
            if expired.node is None or expired.node.required:
                self.failure, self.over = expired, True
                return
            self.abandoned.append(expired)
            self._update()
            self.over = self._is_idle()

    def next_time(self) -> float | None:
        """Return when :meth:`advance_to` has something to do, s; None: only after an event."""
        times = [node.restart_at for node in self._nodes.values()]
        handled = ((None, handler.when) for handler in self._handlers)
        for _, condition in (*self.waits(), *handled):
            times += [part.due(self._state) for part in walk(condition) if isinstance(part, After)]
        times += self._timeouts.deadlines(self.waits(), self._state)
        return min((t for t in times if t is not None and t > self._state.time), default=None)

    def startable(self) -> list[Node]:
        """Return the nodes to start now, in the order of the stack."""
        return [node for node, state in self._nodes.items() if self._is_startable(node, state)]

    def unreachable(self) -> list[Node]:
        """Return the nodes whose condition, directly or through others, can no longer hold."""
        return [node for node in self.waiting() if self._nodes[node].unreachable]

    def waiting(self) -> list[Node]:
        """Return the nodes that were not started yet."""
        return [node for node, state in self._nodes.items() if not state.started]

    def waits(self) -> Iterator[Wait]:
        """Yield all pending waits, in the order of the stack; that to be ready is the last."""
        for node in self.waiting():
            condition = self._conditions[node]
            if condition is not None and not self._nodes[node].unreachable:
                yield node, condition
        if not self.ready and self._ready_when.evaluate(self._state) is Verdict.NOT_YET:
            yield None, self._ready_when

    def condition_of(self, node: Node) -> Condition | None:
        """Return the condition of a node, with those of its groups; None: it starts at once."""
        return self._conditions[node]

    def pending_conditions(self) -> Iterator[Condition]:
        """Yield the conditions of all pending waits, with their parts."""
        for _, condition in self.waits():
            yield from walk(condition)

    @property
    def ready(self) -> bool:
        """Whether the stack got ready; it stays so."""
        self._ready = self._ready or self._ready_when.evaluate(self._state) is Verdict.HOLDS
        return self._ready

    @property
    def never_ready(self) -> Condition | None:
        """The condition for being ready, if it can no longer hold; else None."""
        is_lost = not self.ready and self._ready_when.evaluate(self._state) is Verdict.NEVER
        return self._ready_when if is_lost else None

    def _call_handlers(self) -> None:
        """Call the event handlers whose condition holds now."""
        while not self.over:
            due = [each for each in self._handlers if each.when.evaluate(self._state) in _OVER]
            if not due:
                return
            self._handlers = [each for each in self._handlers if each not in due]
            for handler in due:
                if handler.when.evaluate(self._state) is Verdict.HOLDS:
                    self._react('an event handler', handler.run, self._state)
            self.over = self.shutdown is not None

    def _react(self, name: str, handler: Callable[[T], Reaction], event: T) -> None:
        """Call a handler, and do what it returns."""
        self._apply(name, call_handler(name, handler, event))

    def _apply(self, name: str, result: HandlerResult) -> None:
        """Do what a handler has returned."""
        if result == HandlerResult():  # of most lines of output
            return
        self.lines += result.lines
        self.shutdown = self.shutdown or result.shutdown
        try:
            nodes = list(nodes_of(result.members))
        except BringupError as error:
            text = f'{name} returned what is no reaction: {error}'
            self.shutdown = Shutdown(text, exit_code=1)
            return
        for node in nodes:
            if not waits_for_request(self._conditions.get(node)):
                self.shutdown = Shutdown(
                    f'{name} asks for {node}, which is not in the stack with '
                    'start_when=on_request()',
                    exit_code=1,
                )
                return
        parts = (part for node in nodes for part in walk(self._conditions[node]))
        requests = {part for part in parts if isinstance(part, OnRequest)}
        self._update(triggered=self._state.triggered | requests)

    def _is_startable(self, node: Node, state: NodeState) -> bool:
        if state.restart_at is not None:
            return state.restart_at <= self._state.time
        is_waiting = not state.started and not state.unreachable
        return is_waiting and self._evaluate(node) is Verdict.HOLDS

    def _evaluate(self, node: Node) -> Verdict:
        condition = self._conditions[node]
        return Verdict.HOLDS if condition is None else condition.evaluate(self._state)

    def _is_start(self, node: Node) -> bool:
        """Return whether the end of a node, now, is one of its start, which is required."""
        has_run = self._state.time - self._last_start.get(node, self._state.time)
        is_first = self._nodes[node].restarts == 0
        return node.required == 'at start' and is_first and has_run < START

    def _plan_respawn(self, node: Node) -> bool:
        """Plan the next start of a node that has ended; return whether there will be one."""
        rule, now = node.respawn, self._state.time
        if rule is None:
            return False
        was_steady = now - self._last_start[node] >= rule.steady
        restarts = 0 if was_steady else self._nodes[node].restarts
        if rule.limit is not None and restarts >= rule.limit:
            return False
        restart_at = now + rule.delay * rule.backoff**restarts
        self._nodes[node] = replace(
            self._nodes[node], started=True, restarts=restarts + 1, restart_at=restart_at
        )
        self._update()
        return True

    def _is_idle(self) -> bool:
        """Return whether nothing runs, and nothing that waits will ever start."""
        is_alive = any(n.running or n.restart_at is not None for n in self._nodes.values())
        waits = [condition for node, condition in self.waits() if node is not None]
        waits += [handler.when for handler in self._handlers]
        may_start = any(each.is_external or has_running_timer(each, self._state) for each in waits)
        return not (is_alive or may_start or self.startable())

    def _update(self, **changes: Any) -> None:
        """Make the new state: with all that has become unreachable, and since when what holds."""
        for expired in self.abandoned:
            self._mark_unreachable(expired.node)
        self._state = replace(self._state, nodes=dict(self._nodes), **changes)
        while stuck := [node for node in self.waiting() if self._is_newly_stuck(node)]:
            for node in stuck:
                self._mark_unreachable(node)
            self._state = replace(self._state, nodes=dict(self._nodes))
        for part in self._parts:  # inner ones first
            if isinstance(part, After):
                self._note_held_since(part.condition)

    def _is_newly_stuck(self, node: Node) -> bool:
        return not self._nodes[node].unreachable and self._evaluate(node) is Verdict.NEVER

    def _mark_unreachable(self, node: Node) -> None:
        self._nodes[node] = replace(self._nodes[node], unreachable=True)

    def _note_held_since(self, condition: Condition | None) -> None:
        """Note the time at which a condition that an ``after`` counts from holds first."""
        state, since = self._state, self._state.held_since
        if condition is None or condition in since:
            return
        if condition.evaluate(state) is Verdict.HOLDS:
            self._state = replace(state, held_since={**since, condition: state.time})
