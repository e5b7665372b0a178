# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""Lines of log that come again and again."""

from collections.abc import Callable
import math
import re

_FIRST_NUMBER = re.compile(r'-?\d.*', re.DOTALL)


class Throttle:
    """Lets lines of one format through once in a while; those equal up to a digit are of one."""

    def __init__(self, clock: Callable[[], float]) -> None:
        """``clock``: s; it never goes back."""
        self._clock = clock
        self._latest: dict[str, float] = {}

    def passes(self, text: str, period: float) -> bool:
        """Whether no line of this format has passed for ``period`` s; it passes then."""
        key, now = _FIRST_NUMBER.sub('', text), self._clock()
        if now - self._latest.get(key, -math.inf) < period:
            return False
        self._latest[key] = now
        return True
