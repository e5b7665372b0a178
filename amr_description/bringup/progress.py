# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
How far a stack has come: what may start now, what failed, when it is ready or over.

Pure: the orchestrator tells it of starts and ends, and asks.
"""

from dataclasses import dataclass

from amr_description.bringup.conditions import NodeState, Verdict
from amr_description.bringup.description import Node, Stack


@dataclass(frozen=True)
class Failure:
    """The first end of a required node that stops the stack."""

    node: Node
    returncode: int
    """As in :class:`NodeState`: never 0."""

    @property
    def exit_code(self) -> int:
        """The exit code of the whole, 1..255: the node's own, or 128 + signal as in shells."""
        return self.returncode if self.returncode > 0 else 128 - self.returncode


class Progress:
    """The states of all nodes of a stack; owned by the orchestrator's event loop."""

    def __init__(self, stack: Stack) -> None:
        """Begin with nothing started."""
        self._stack = stack
        self._states = {node: NodeState() for node in stack.nodes}
        self.failure: Failure | None = None
        self.over = False
        """Whether nothing more is to be started and what runs is to be stopped."""

    def start(self, node: Node) -> None:
        """Note that the process of the node was started."""
        self._states[node] = NodeState(started=True)

    def end(self, node: Node, returncode: int) -> None:
        """
        Note that the process of the node ended; see :class:`NodeState` for the code.

        What ends after the stack is over ended because of that, and is no failure.
        """
        self._states[node] = NodeState(started=True, returncode=returncode)
        if self.over:
            return
        blocks_a_required_node = any(waiting.required for waiting in self.unreachable())
        if returncode != 0 and (node.required or blocks_a_required_node):
            self.failure = Failure(node, returncode)
        ended_for_all = returncode == 0 and node.on_exit == 'shutdown'
        idle = not self.startable() and not any(s.running for s in self._states.values())
        self.over = self.failure is not None or ended_for_all or idle

    def startable(self) -> list[Node]:
        """Return the nodes that are to be started now, in the order of the stack."""
        return [n for n in self.waiting() if self._judge_start(n) is Verdict.HOLDS]

    def unreachable(self) -> list[Node]:
        """Return the nodes that wait, also through others, for what can no longer happen."""
        stuck: set[Node] = set()
        while more := [n for n in self.waiting() if n not in stuck and self._is_stuck(n, stuck)]:
            stuck.update(more)
        return [node for node in self.waiting() if node in stuck]

    def waiting(self) -> list[Node]:
        """Return the nodes that were not started yet."""
        return [node for node, state in self._states.items() if not state.started]

    @property
    def ready(self) -> bool:
        """Whether the stack is up: ``ready_when`` holds, or every node was started."""
        if self._stack.ready_when is None:
            return not self.waiting()
        return self._stack.ready_when.judge(self._states) is Verdict.HOLDS

    def _judge_start(self, node: Node) -> Verdict:
        if node.start_when is None:
            return Verdict.HOLDS
        return node.start_when.judge(self._states)

    def _is_stuck(self, node: Node, stuck: set[Node]) -> bool:
        condition = node.start_when
        if condition is None:
            return False
        return self._judge_start(node) is Verdict.NEVER or not stuck.isdisjoint(condition.nodes)
