# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
How far a stack has come: what may start now, what failed, when it is ready or over.

Pure: the orchestrator tells it of starts, ends, lines, the world outside and the time, and asks.

Patience: how long each wait of a stack may take.

A wait is counted from when all the nodes that it depends on were started: who waits for the end
of a step has patience with that step alone, however long it took until the step could start. The
seconds of an ``after`` come on top. Who waits for a failure or for a request waits for ever.
"""

from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
import math

from amr_description.bringup.conditions import (
    After,
    Condition,
    Graph,
    Logged,
    NameOf,
    NodeState,
    OnRequest,
    PathLook,
    StackState,
    Verdict,
    waits_for_request,
    walk,
)
from amr_description.bringup.description import Node, nodes_of, Stack
from amr_description.bringup.handlers import call_exit_handler, Exited, HandlerResult, Shutdown
from amr_description.bringup.placement import Placement
from amr_description.errors import BringupError

TIMED_OUT = 124
"""The exit code, as that of ``timeout(1)``."""

type Wait = tuple[Node | None, Condition]
"""Who waits, and what for; None: the stack itself, to be ready."""


@dataclass(frozen=True)
class Expired:
    """A wait that took too long."""

    node: Node | None
    """Who waited; None: the stack itself."""
    condition: Condition
    seconds: float
    """How long it waited."""
    situation: StackState
    """How it was at the end."""

    exit_code = TIMED_OUT

    def text(self, name_of: NameOf) -> str:
        """Say what was waited for, how long, and what is there instead."""
        who = name_of(self.node) if self.node else 'the stack, to be ready,'
        lack = self.condition.explain_unmet(self.situation, name_of)
        told = f'{who} waited {self.seconds:.0f} s in vain: {lack}'
        others = [
            f'{name_of(node)} still runs'
            for node, state in self.situation.states.items()
            if state.running and f'{name_of(node)} still runs' not in told
        ]
        return '; '.join([told, *others])


class Timeouts:
    """When each wait began, and when it is over."""

    def __init__(self, patience: Mapping[Node, float], patience_of_stack: float) -> None:
        """``patience``: s that each node waits."""
        self._patience: Mapping[Node | None, float] = {**patience, None: patience_of_stack}
        self._began: dict[Node | None, float] = {}

    def expired(self, waits: Iterable[Wait], situation: StackState) -> Expired | None:
        """Return the first wait whose patience is over."""
        for node, condition in waits:
            deadline = self._deadline(node, condition, situation)
            if deadline is not None and situation.time >= deadline:
                seconds = situation.time - self._began[node]
                return Expired(node, condition, seconds, situation)
        return None

    def deadlines(self, waits: Iterable[Wait], situation: StackState) -> list[float]:
        """Return the times at which the patience of those waits is over that have begun."""
        found = (self._deadline(node, condition, situation) for node, condition in waits)
        return [deadline for deadline in found if deadline is not None]

    def _deadline(
        self, node: Node | None, condition: Condition, situation: StackState
    ) -> float | None:
        states = situation.states
        if node not in self._began:
            if condition.waits_forever(situation):
                return None
            if not all(states[n].started or states[n].never for n in condition.nodes):
                return None
            self._began[node] = situation.time
        deadline = self._began[node] + self._patience[node] + condition.delay
        return None if math.isinf(deadline) else deadline


@dataclass(frozen=True)
class Failure:
    """The first end of a required node that stops the stack."""

    node: Node
    returncode: int
    """As in :class:`NodeState`; 0 only if it was to be started again, too often."""
    restarts: int = 0
    """How often it was started again before."""

    @property
    def exit_code(self) -> int:
        """The exit code of the whole, 1..255: the node's own, or 128 + signal as in shells."""
        return (self.returncode or 1) if self.returncode >= 0 else 128 - self.returncode


class Scheduler:
    """The states of all nodes of a stack; owned by the orchestrator's event loop."""

    def __init__(self, stack: Stack, begin: float = 0.0) -> None:
        """Begin with nothing started; ``begin``: the time, s, of a clock that never goes back."""
        placement = Placement(stack)
        self._conditions = {placed.node: placed.start_when for placed in placement.nodes}
        self._ready_when = placement.ready_when
        all_conditions = [*self._conditions.values(), self._ready_when]
        self._parts = dict.fromkeys(part for each in all_conditions for part in walk(each))
        self._logged = [part for part in self._parts if isinstance(part, Logged)]
        self._states = {node: NodeState() for node in self._conditions}
        self._last_start: dict[Node, float] = {}
        self._situation = StackState(self._states, time=begin, began=begin)
        self._waits = Timeouts(
            {placed.node: placed.patience for placed in placement.nodes}, stack.patience
        )
        self._ready = False
        self.failure: Failure | Expired | None = None
        self.gave_up: list[Expired] = []
        """Waits of optional nodes whose patience is over: they are not started any more."""
        self.shutdown: Shutdown | None = None
        """Which handler wants all to be stopped, and why."""
        self.over = False
        """Whether nothing more is to be started and what runs is to be stopped."""

    @property
    def situation(self) -> StackState:
        """What the conditions judge now."""
        return self._situation

    def start(self, node: Node) -> None:
        """Note that the process of the node was started."""
        self._last_start[node] = self._situation.time
        self._states[node] = NodeState(started=True, restarts=self._states[node].restarts)
        self._changed()

    def end(self, node: Node, returncode: int, last_lines: Sequence[str] = ()) -> None:
        """
        Note that the process of the node ended; see :class:`NodeState` for the code.

        What ends after the stack is over ended because of that, and is no failure.

        :param last_lines: What it wrote last, for the handler of its end.
        """
        if not self.over and self._is_started_again(node):
            return
        restarts = self._states[node].restarts
        self._states[node] = NodeState(started=True, returncode=returncode, restarts=restarts)
        self._changed()
        if self.over:
            return
        if callable(node.on_exit):
            self._obey(call_exit_handler(node.on_exit, Exited(node, returncode, last_lines)))
        failed = returncode != 0 or node.respawn is not None
        blocks_a_required_node = any(waiting.required for waiting in self.unreachable())
        if failed and (node.required or blocks_a_required_node):
            self.failure = Failure(node, returncode, restarts)
        ended_for_all = returncode == 0 and node.on_exit == 'shutdown'
        wished = self.shutdown is not None
        self.over = self.failure is not None or wished or ended_for_all or self._is_idle()

    def hear(self, node: Node, line: str) -> bool:
        """Note a line that the process of the node wrote; return whether a condition asks."""
        said = self._situation.said
        heard = {c for c in self._asked_of(node) if c not in said and c.matches(line)}
        if heard:
            self._changed(said=said | heard)
        return bool(heard)

    def see(
        self, *, graph: Graph | None = None, paths: Mapping[str, PathLook] | None = None
    ) -> None:
        """Note what is seen of the world outside."""
        if graph is not None:
            self._changed(graph=graph)
        if paths is not None:
            self._changed(paths=paths)

    def tick(self, time: float) -> None:
        """Note the time, s."""
        self._changed(time=time)

    def at(self, time: float) -> None:
        """
        Note the time, s; what has waited too long ends the stack, or is given up.

        Called once all that has happened until then was told.
        """
        self.tick(time)
        while not self.over:
            expired = self._waits.expired(self._pending(), self._situation)
            if expired is None:
                return
            if expired.node is None or expired.node.required:
                self.failure, self.over = expired, True
                return
            self.gave_up.append(expired)
            self._changed()
            self.over = self._is_idle()

    def next_time(self) -> float | None:
        """Return the time at which :meth:`at` has something to say; None: only events matter."""
        times = [state.restart_at for state in self._states.values()]
        for _, condition in self._pending():
            times += [p.due(self._situation) for p in walk(condition) if isinstance(p, After)]
        times += self._waits.deadlines(self._pending(), self._situation)
        return min((t for t in times if t is not None and t > self._situation.time), default=None)

    def startable(self) -> list[Node]:
        """Return the nodes that are to be started now, in the order of the stack."""
        return [node for node, state in self._states.items() if self._is_due(node, state)]

    def unreachable(self) -> list[Node]:
        """Return the nodes that wait, also through others, for what can no longer happen."""
        return [node for node in self.waiting() if self._states[node].never]

    def waiting(self) -> list[Node]:
        """Return the nodes that were not started yet."""
        return [node for node, state in self._states.items() if not state.started]

    def waits_for(self, node: Node) -> Condition | None:
        """Return the condition of a node, its groups' with it; None: it starts at once."""
        return self._conditions[node]

    def waits(self) -> list[Wait]:
        """Return who waits, and what for, in the order of the stack."""
        return list(self._pending())

    def lookouts(self) -> Iterator[Condition]:
        """Yield the parts of all conditions that somebody still waits for."""
        for _, condition in self._pending():
            yield from walk(condition)

    @property
    def ready(self) -> bool:
        """Whether the stack came up: ``ready_when`` held, or every node was started."""
        self._ready = self._ready or self._ready_when.evaluate(self._situation) is Verdict.HOLDS
        return self._ready

    @property
    def never_ready(self) -> Condition | None:
        """What the stack needs to be ready and can no longer have; None: it still may."""
        lost = not self.ready and self._ready_when.evaluate(self._situation) is Verdict.NEVER
        return self._ready_when if lost else None

    def _obey(self, wishes: HandlerResult) -> None:
        """Note what a handler wants."""
        self.shutdown = wishes.shutdown
        try:
            nodes = list(nodes_of(wishes.members))
        except BringupError as error:
            self.shutdown = Shutdown(f'on_exit returned what is no reaction: {error}', exit_code=1)
            return
        for node in nodes:
            if not waits_for_request(self._conditions.get(node)):
                self.shutdown = Shutdown(
                    f'on_exit asks for {node}, which is not in the stack with '
                    'start_when=on_request()',
                    exit_code=1,
                )
                return
        parts = (part for node in nodes for part in walk(self._conditions[node]))
        requests = {part for part in parts if isinstance(part, OnRequest)}
        self._changed(said=self._situation.said | requests)

    def _asked_of(self, node: Node) -> list[Logged]:
        return [part for part in self._logged if part.node is node]

    def _pending(self) -> Iterator[Wait]:
        """Yield who waits and what for; None: the stack itself, to be ready."""
        for node in self.waiting():
            condition = self._conditions[node]
            if condition is not None and not self._states[node].never:
                yield node, condition
        if not self.ready and self._ready_when.evaluate(self._situation) is Verdict.NOT_YET:
            yield None, self._ready_when

    def _is_due(self, node: Node, state: NodeState) -> bool:
        if state.restart_at is not None:
            return state.restart_at <= self._situation.time
        return not state.started and not state.never and self._judge(node) is Verdict.HOLDS

    def _judge(self, node: Node) -> Verdict:
        condition = self._conditions[node]
        return Verdict.HOLDS if condition is None else condition.evaluate(self._situation)

    def _is_started_again(self, node: Node) -> bool:
        rule, now = node.respawn, self._situation.time
        if rule is None:
            return False
        was_steady = now - self._last_start[node] >= rule.steady
        restarts = 0 if was_steady else self._states[node].restarts
        if rule.limit is not None and restarts >= rule.limit:
            return False
        at = now + rule.delay * rule.backoff**restarts
        self._states[node] = NodeState(started=True, restarts=restarts + 1, restart_at=at)
        self._changed()
        return True

    def _is_idle(self) -> bool:
        """Nothing runs, and nothing that waits will ever start."""
        alive = any(s.running or s.restart_at is not None for s in self._states.values())
        outlook = any(
            condition.is_external for node, condition in self._pending() if node is not None
        )
        return not (alive or outlook or self.startable())

    def _changed(self, **news: object) -> None:
        """Make the new situation: what was given up, what it leads to, what holds since when."""
        for expired in self.gave_up:
            self._mark_never(expired.node)
        self._situation = replace(self._situation, states=dict(self._states), **news)
        while stuck := [n for n in self.waiting() if self._is_newly_stuck(n)]:
            for node in stuck:
                self._mark_never(node)
            self._situation = replace(self._situation, states=dict(self._states))
        for part in self._parts:
            self._note_since(part)

    def _is_newly_stuck(self, node: Node) -> bool:
        return not self._states[node].never and self._judge(node) is Verdict.NEVER

    def _mark_never(self, node: Node) -> None:
        self._states[node] = replace(self._states[node], never=True)

    def _note_since(self, part: Condition) -> None:
        """Note since when the condition holds that an ``after`` counts from; inner ones first."""
        since, now = self._situation.held_since, self._situation
        if not isinstance(part, After) or part.condition is None or part.condition in since:
            return
        if part.condition.evaluate(now) is Verdict.HOLDS:
            self._situation = replace(now, held_since={**since, part.condition: now.time})
