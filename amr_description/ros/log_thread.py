# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
The ``Log`` port over a node's logger: the caller only stores the line, a thread emits it.

rcutils writes to stderr and to ``/rosout``, which may block; the control thread must not. rclpy
holds the interpreter's lock meanwhile, so the thread first waits until stderr takes a line.
"""

import queue
import threading
import time

from amr_description.log import Severity, Throttle
from amr_description.ros.rclpy_internals import RcutilsLogger
from amr_description.streams import wait_for_stderr
from amr_description.text import encodable

_MOST_WAITING = 2000
"""Lines: those beyond, logged faster than they can be written, are counted and dropped."""
_STOP_TIMEOUT = 5.0
"""s: how long :meth:`LogThread.stop` waits for a terminal that takes nothing."""


class LogThread:
    """
    Emits the lines of all loggers, in the order in which they were logged.

    A plugin that logs a line at every update, thousands a second, must neither fill the memory nor
    keep the process from ending: lines that are too many are dropped, and their number is logged.
    """

    def __init__(self) -> None:
        self._lines = Lines()
        # A daemon: whatever ends the process before stop(), it must not wait for us.
        self._thread = threading.Thread(target=self._run, name='log', daemon=True)
        self._thread.start()

    def log_of(self, logger: RcutilsLogger) -> 'NodeLog':
        """Return the port of one component."""
        return NodeLog(logger, self._lines)

    def stop(self) -> None:
        """Emit what waits, and end."""
        self._lines.end()
        self._thread.join(_STOP_TIMEOUT)

    def _run(self) -> None:
        while (line := self._lines.get()) is not None:
            logger, severity, text, dropped = line
            wait_for_stderr()
            if dropped:
                logger.warning(
                    f'{dropped} lines of the log were dropped: more is said than can be written'
                )
            _emit(logger, severity, encodable(str(text)))


class Lines:
    """The lines that wait; any thread puts, and never waits."""

    def __init__(self) -> None:
        self._queue: queue.SimpleQueue[tuple[RcutilsLogger, Severity, str, int] | None] = (
            queue.SimpleQueue()
        )
        self._dropped = 0

    def put(self, logger: RcutilsLogger, severity: Severity, text: str) -> None:
        """Take a line, or drop it where too many wait."""
        if self._queue.qsize() >= _MOST_WAITING:
            self._dropped += 1
            return
        dropped, self._dropped = self._dropped, 0
        self._queue.put((logger, severity, text, dropped))

    def end(self) -> None:
        """Let the reader end behind what waits."""
        self._queue.put(None)

    def get(self) -> tuple[RcutilsLogger, Severity, str, int] | None:
        """
        Wait for the next line, which is None at the end; with it comes how many were dropped
        before it.
        """
        return self._queue.get()


class NodeLog:
    """See :class:`amr_description.control.contracts.Log`."""

    def __init__(self, logger: RcutilsLogger, lines: Lines) -> None:
        self._logger = logger
        self._lines = lines
        self._throttle = Throttle(time.monotonic)

    def __call__(self, severity: Severity, text: str, *, throttle: float = 0.0) -> None:
        """Log ``text``, unless its like was logged within ``throttle`` s of wall time."""
        if throttle <= 0.0 or self._throttle.passes(text, throttle):
            self._lines.put(self._logger, severity, text)


class LoggerLog:
    """The port over a node's logger, for programs whose threads may wait: it emits at once."""

    def __init__(self, logger: RcutilsLogger) -> None:
        self._logger = logger

    def __call__(self, severity: Severity, text: str, *, throttle: float = 0.0) -> None:
        """Log ``text``; such programs throttle nothing."""
        _emit(self._logger, severity, text)


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
