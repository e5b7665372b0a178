# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
The ``Log`` port over a node's logger: the caller only stores the line, a thread emits it.

rcutils writes to stderr and to ``/rosout``, either of which may block; the owner's tick may not.
"""

import queue
import re
import threading
import time

from rclpy.impl.rcutils_logger import RcutilsLogger

from amr_description.control.contracts import Log, Severity
from amr_description.control.foreign_errors import describe, log_traceback

_FIRST_NUMBER = re.compile(r'-?\d.*', re.DOTALL)


class LogThread:
    """Emits the lines of all components, in the order in which they were said."""

    def __init__(self) -> None:
        self._lines: queue.SimpleQueue[tuple[RcutilsLogger, Severity, str] | None] = (
            queue.SimpleQueue()
        )
        # A daemon: whatever ends the process before stop(), it must not wait for us.
        self._thread = threading.Thread(target=self._run, name='log', daemon=True)
        self._thread.start()

    def log_of(self, logger: RcutilsLogger) -> 'NodeLog':
        """Return the port of one component."""
        return NodeLog(logger, self._lines)

    def stop(self) -> None:
        """Emit what waits, and end."""
        self._lines.put(None)
        self._thread.join()

    def _run(self) -> None:
        while (line := self._lines.get()) is not None:
            _emit(*line)


class NodeLog:
    """See :class:`amr_description.control.contracts.Log`."""

    def __init__(self, logger: RcutilsLogger, lines: queue.SimpleQueue) -> None:
        self._logger = logger
        self._lines = lines
        self._last_said: dict[str, float] = {}

    def __call__(self, severity: Severity, text: str, *, throttle: float = 0.0) -> None:
        """Say ``text``, unless something like it was said within ``throttle`` s of wall time."""
        if throttle > 0.0:
            key, now = _FIRST_NUMBER.sub('', text), time.monotonic()
            if now - self._last_said.get(key, -float('inf')) < throttle:
                return
            self._last_said[key] = now
        self._lines.put((self._logger, severity, text))


def log_error(log: Log, error: Exception) -> str:
    """Say in one line what went wrong, and at DEBUG where; return the line."""
    line = ' '.join(describe(error).split())
    log(Severity.ERROR, line)
    log_traceback(log, error)
    return line


def _emit(logger: RcutilsLogger, severity: Severity, text: str) -> None:
    # rclpy refuses a severity that changes at one place of call, so each has its own line.
    match severity:
        case Severity.DEBUG:
            logger.debug(text)
        case Severity.INFO:
            logger.info(text)
        case Severity.WARN:
            logger.warning(text)
        case Severity.ERROR:
            logger.error(text)
        case Severity.FATAL:
            logger.fatal(text)
