# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""How a component logs, whatever takes the lines: rcutils, a list of a test, or nothing."""

from collections.abc import Callable
import enum
import math
import re
from typing import Protocol

_FIRST_NUMBER = re.compile(r'-?\d.*', re.DOTALL)


class Severity(enum.IntEnum):
    """Severities with rcutils' numbers."""

    DEBUG = 10
    INFO = 20
    WARN = 30
    ERROR = 40
    FATAL = 50


class Log(Protocol):
    """
    The logger of a component, which has no other way to log.

    The calling thread only stores the line; another one emits it, by the component's logger.
    """

    def __call__(self, severity: Severity, text: str, *, throttle: float = 0.0) -> None:
        """
        Log ``text``.

        Args:
            severity: of the line.
            text: one line.
            throttle: least time between two lines of the same format, s; ``math.inf``: log once.
                Lines that are equal up to their first digit have the same format.
        """


def null_log(severity: Severity, text: str, *, throttle: float = 0.0) -> None:
    """Log nothing."""


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
