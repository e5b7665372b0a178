# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
Patience: how long each wait of a stack may take.

A wait is counted from when all the nodes that it depends on were started: who waits for the end
of a step has patience with that step alone, however long it took until the step could start. The
seconds of an ``after`` come on top. Who waits for a failure or for a request waits for ever.
"""

from collections.abc import Iterable, Mapping
from dataclasses import dataclass
import math

from amr_description.bringup.conditions import Condition, NameOf
from amr_description.bringup.description import Node
from amr_description.bringup.situation import Situation

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
    situation: Situation
    """How it was at the end."""

    exit_code = TIMED_OUT

    def text(self, name_of: NameOf) -> str:
        """Say what was waited for, how long, and what is there instead."""
        who = name_of(self.node) if self.node else 'the stack, to be ready,'
        lack = self.condition.lack(self.situation, name_of)
        told = f'{who} waited {self.seconds:.0f} s in vain: {lack}'
        others = [
            f'{name_of(node)} still runs'
            for node, state in self.situation.states.items()
            if state.running and f'{name_of(node)} still runs' not in told
        ]
        return '; '.join([told, *others])


class Waits:
    """When each wait began, and when it is over."""

    def __init__(self, patience: Mapping[Node, float], patience_of_stack: float) -> None:
        """``patience``: s that each node waits."""
        self._patience: Mapping[Node | None, float] = {**patience, None: patience_of_stack}
        self._began: dict[Node | None, float] = {}

    def expired(self, waits: Iterable[Wait], situation: Situation) -> Expired | None:
        """Return the first wait whose patience is over."""
        for node, condition in waits:
            deadline = self._deadline(node, condition, situation)
            if deadline is not None and situation.time >= deadline:
                seconds = situation.time - self._began[node]
                return Expired(node, condition, seconds, situation)
        return None

    def deadlines(self, waits: Iterable[Wait], situation: Situation) -> list[float]:
        """Return the times at which the patience of those waits is over that have begun."""
        found = (self._deadline(node, condition, situation) for node, condition in waits)
        return [deadline for deadline in found if deadline is not None]

    def _deadline(
        self, node: Node | None, condition: Condition, situation: Situation
    ) -> float | None:
        states = situation.states
        if node not in self._began:
            if condition.is_dormant(situation):
                return None
            if not all(states[n].started or states[n].never for n in condition.nodes):
                return None
            self._began[node] = situation.time
        deadline = self._began[node] + self._patience[node] + condition.delay
        return None if math.isinf(deadline) else deadline
