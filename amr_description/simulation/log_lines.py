# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
The log of a simulation in this process: its lines, which also go to the module :mod:`logging`.

There the logger is ``amr_description.<node>``; a program that wants to see them says so, as by
``logging.basicConfig(level='INFO')``.
"""

from collections import deque
from collections.abc import Collection, Iterator
from dataclasses import dataclass
import logging
import time as wall

from amr_description.log import Log, Severity, Throttle
from amr_description.plugin_errors import is_traceback

logging.getLogger('amr_description').addHandler(logging.NullHandler())
_MOST = 5000
"""Lines that are kept."""


@dataclass(frozen=True, slots=True)
class LogLine:
    """One line, and the node that would have said it."""

    node: str
    severity: Severity
    text: str

    def __str__(self) -> str:
        return f'[{self.severity.name}] [{self.node}]: {self.text}'


class LogLines:
    """The newest lines of all components, oldest first."""

    def __init__(self) -> None:
        self.count = 0
        """Of all lines so far."""
        self._lines: deque[LogLine] = deque(maxlen=_MOST)

    def __iter__(self) -> Iterator[LogLine]:
        return iter(self._lines)

    def log_of(self, node: str) -> Log:
        """Return the log of a component, by the full name of its node."""
        name = node.strip('/').replace('/', '.')
        logger = logging.getLogger(f'amr_description.{name}')
        repeated = Throttle(wall.monotonic)

        def log(severity: Severity, text: str, *, throttle: float = 0.0) -> None:
            if throttle and not repeated.passes(text, throttle):
                return
            self.count += 1
            self._lines.append(LogLine(name, severity, text))
            logger.log(severity, text)

        return log

    def errors_since(self, count: int, nodes: Collection[str]) -> list[str]:
        """Return the errors that some nodes have logged, each once, since there were ``count``."""
        names = {node.strip('/').replace('/', '.') for node in nodes}
        newest = [*self._lines][max(0, len(self._lines) - (self.count - count)) :]
        found = (
            each.text
            for each in newest
            if each.severity >= Severity.ERROR
            and each.node in names
            and not is_traceback(each.text)
        )
        return list(dict.fromkeys(found))
