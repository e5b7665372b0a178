# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""The pushes of pages: each ends when its page lets go, falls silent or has gone. No I/O."""

from collections.abc import Callable
from contextlib import suppress
from dataclasses import dataclass, replace

from amr_description.errors import ViewerError
from amr_description.viewer.requests import Push

PUSH_TIMEOUT = 0.3
"""s without a word of the page."""
NO_VECTOR = (0.0, 0.0, 0.0)


@dataclass(frozen=True, slots=True)
class _Held:
    push: Push
    page: str
    until: float


class Pushes:
    """What pages push, a link by one page at a time: by the one that pushed it last."""

    def __init__(self, apply: Callable[[Push], None]) -> None:
        """``apply`` pushes; raises ViewerError."""
        self._apply = apply
        self._held: dict[tuple[str, str, str], _Held] = {}

    def push(self, page: str, push: Push, now: float) -> None:
        """Carry out the message of a page; ``now``: s. Raises ViewerError."""
        key = (push.simulator, push.entity, push.link)
        if not any((*push.force, *push.torque)):
            if self._held.pop(key, None) is not None:
                self._apply(push)
            return
        self._apply(push)
        self._held[key] = _Held(push, page, now + PUSH_TIMEOUT)

    def expire(self, now: float) -> None:
        """Let go what was not pushed in time."""
        self._release(lambda held: held.until <= now)

    def forget(self, page: str) -> None:
        """Let go what a page pushed that has gone."""
        self._release(lambda held: held.page == page)

    def next_expiry(self) -> float | None:
        """Return when :meth:`expire` is due, s; None: nothing is pushed."""
        return min((each.until for each in self._held.values()), default=None)

    def _release(self, ends: Callable[[_Held], bool]) -> None:
        for key, held in [*self._held.items()]:
            if ends(held):
                del self._held[key]
                with suppress(ViewerError):  # the simulator has gone, and the push with it
                    self._apply(replace(held.push, force=NO_VECTOR, torque=NO_VECTOR))
