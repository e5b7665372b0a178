# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
What a stack waits for while it starts, told to who waits with it.

On a terminal that is one line, written anew a few times a second and gone when the stack is up;
elsewhere a line every few seconds, if it takes so long.
"""

import asyncio
from collections.abc import Callable
import time

from amr_description.bringup.conditions import NameOf
from amr_description.bringup.console import Console, LAUNCH
from amr_description.bringup.description import Node
from amr_description.bringup.progress import Progress
from amr_description.bringup.waits import Wait

_REFRESH = 0.25  # s between two states of the line on a terminal
_PATIENCE = 5.0  # s between two lines elsewhere


class StartStatus:
    """Looks at the progress again and again until the stack is up, or over."""

    def __init__(
        self, console: Console, name_of: NameOf, clock: Callable[[], float] = time.monotonic
    ) -> None:
        """``clock``: s; never goes back."""
        self._console = console
        self._name_of = name_of
        self._clock = clock
        self._begin = clock()
        self._since: dict[Node | None, float] = {}
        self._timer: asyncio.TimerHandle | None = None

    def follow(self, progress: Progress) -> None:
        """Tell of it from here on; called after each event, so that it is known since when."""
        if _is_done(progress):
            return
        self._look(progress)
        if self._timer is None:
            self._plan(progress)

    def end(self) -> None:
        """Tell no more."""
        if self._timer is not None:
            self._timer.cancel()
            self._timer = None
        self._console.status('')

    def text(self, progress: Progress) -> str:
        """Return the line; empty: nothing is waited for that could happen next."""
        waits = self._look(progress)
        if not waits:
            return ''
        now = self._clock()
        node, condition = waits[0]
        who = self._name_of(node) if node else 'the stack'
        more = f' and {len(waits) - 1} more' if len(waits) > 1 else ''
        return (
            f'{now - self._begin:.1f} s: {who} waits until {condition.describe(self._name_of)} '
            f'({now - self._since[node]:.1f} s){more}'
        )

    def _look(self, progress: Progress) -> list[Wait]:
        """Return the waits that can be over next; note since when they are."""
        states = progress.situation.states
        waits = [
            (node, condition)
            for node, condition in progress.waits()
            if all(states[other].started for other in condition.nodes)
        ]
        now = self._clock()
        self._since = {node: self._since.get(node, now) for node, _ in waits}
        return waits

    def _plan(self, progress: Progress) -> None:
        period = _REFRESH if self._console.erases else _PATIENCE
        loop = asyncio.get_running_loop()
        self._timer = loop.call_later(period, self._tell, progress)

    def _tell(self, progress: Progress) -> None:
        if _is_done(progress):
            self.end()
            return
        text = self.text(progress)
        if self._console.erases:
            self._console.status(text)
        elif text:
            self._console.say('INFO', LAUNCH, text)
        self._plan(progress)


def _is_done(progress: Progress) -> bool:
    return progress.ready or progress.over
