# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
Every way in which a program is told to stop, as one request: SIGINT, SIGTERM, SIGHUP and the lifeline.

The lifeline is a pipe whose write end only the parent holds. The parent puts the number of the read end into the
environment variable ``AMR_LIFELINE_FD``; when the read end reports end of file the parent is gone, even by SIGKILL,
and the program stops as on SIGTERM.

rclpy's own signal handlers shut the context down at once, so that a node cannot send its last message (the zero
velocity of a teleop), know nothing of SIGHUP (a closed terminal) and let a second Ctrl-C raise in the middle of the
clean-up. Here a request has two phases at most, and a ``KeyboardInterrupt`` is raised at most once in a process:

====================================== ==============================================================
where the program is                   what the first signal does
====================================== ==============================================================
inside ``with stop.on_stop(callback)`` ``callback()``; a second signal raises ``KeyboardInterrupt``
anywhere else                          ``KeyboardInterrupt`` in the main thread, ``wake()`` in ours
after either (clean-up)                nothing: it is on its way out
====================================== ==============================================================

This module imports no rclpy.
"""

import os
import signal
import stat
import threading
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from select import select
from types import FrameType, TracebackType
from typing import Self

STOP_SIGNALS = (signal.SIGINT, signal.SIGTERM, signal.SIGHUP)
LIFELINE_VARIABLE = 'AMR_LIFELINE_FD'
_LEAVE = 0  # written into the wake-up pipe to end the watching thread; no signal has this number


class StopRequested(KeyboardInterrupt):
    """Raised at most once in the main thread of a program that is asked to stop; ``signum`` is the reason."""

    def __init__(self, signum: signal.Signals) -> None:
        super().__init__(signum.name)
        self.signum = signum


class StopRequests:
    """
    A context manager that turns signals and the lifeline into requests to stop.

    :param wake: Called (in a thread of this class) when a request finds the program outside of :meth:`on_stop`.
        It must end whatever wait in C the main thread may be in, so that ``KeyboardInterrupt`` gets its turn.

    Signals are handled only if it is entered in the main thread (a rule of Python); the lifeline always. SIGHUP stays
    ignored where it was (``nohup``).
    """

    def __init__(self, wake: Callable[[], object]) -> None:
        self.signum: signal.Signals | None = None
        """The first request, or None; the lifeline counts as SIGTERM."""
        self._wake = wake
        self._callback: Callable[[], object] | None = None
        self._raised = False
        self._leaving = False
        self._thread = threading.Thread(target=self._watch, name='stop_requests', daemon=True)

    def __enter__(self) -> Self:
        self._lifeline = _inherited_lifeline()
        self._pipe_out, self._pipe_in = os.pipe()
        os.set_blocking(self._pipe_in, False)
        self._previous = {}
        if threading.current_thread() is threading.main_thread():
            self._previous_wakeup_fd = signal.set_wakeup_fd(
                self._pipe_in, warn_on_full_buffer=False
            )
            for signum in STOP_SIGNALS:
                if signum != signal.SIGHUP or signal.getsignal(signum) != signal.SIG_IGN:
                    self._previous[signum] = signal.signal(signum, self._handle)
        self._thread.start()
        return self

    def __exit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        traceback: TracebackType | None,
    ) -> None:
        self.leave()
        os.write(self._pipe_in, bytes([_LEAVE]))
        self._thread.join()
        for signum, handler in self._previous.items():
            # Once asked to stop, the process ends soon: SIG_IGN lasts through the interpreter's own shutdown too.
            signal.signal(signum, handler if self.signum is None else signal.SIG_IGN)
        if self._previous:
            signal.set_wakeup_fd(self._previous_wakeup_fd)
        os.close(self._pipe_in)
        os.close(self._pipe_out)

    @contextmanager
    def on_stop(self, callback: Callable[[], object]) -> Iterator[None]:
        """
        While inside, a request to stop calls ``callback`` instead of interrupting the program.

        The callback comes from another thread, must be quick, and may come more than once; the body leaves the block
        soon after it. The block is the last working phase: once it is left, all further requests are ignored.
        """
        self._callback = callback
        try:
            if self.signum is not None:
                callback()
            yield
        finally:
            self.leave()
            self._callback = None

    def leave(self) -> None:
        """Ignore every request from now on: the program is cleaning up and ends by itself."""
        self._leaving = True

    def _handle(self, signum: int, _frame: FrameType | None) -> None:
        """Run in the main thread, between two bytecodes, as every signal handler of Python."""
        first = self.signum is None
        if first:
            self.signum = signal.Signals(signum)
        if self._leaving or self._raised or (first and self._callback is not None):
            return
        self._raised = True
        raise StopRequested(self.signum)

    def _watch(self) -> None:
        """Thread: the wake-up pipe gets a byte per signal at once, even while the main thread waits in C."""
        sources = [self._pipe_out] if self._lifeline is None else [self._pipe_out, self._lifeline]
        while True:
            ready, _, _ = select(sources, [], [])
            if self._pipe_out in ready:
                numbers = os.read(self._pipe_out, 64)
                if _LEAVE in numbers:
                    return
                if any(number in STOP_SIGNALS for number in numbers):
                    self._react()
            if self._lifeline in ready and not os.read(self._lifeline, 4096):
                sources.remove(self._lifeline)
                os.kill(os.getpid(), signal.SIGTERM)

    def _react(self) -> None:
        callback = self._callback
        if callback is not None:
            callback()
        elif not self._leaving:
            self._wake()


def _inherited_lifeline() -> int | None:
    """
    The read end of the lifeline, or None.

    A grandchild may inherit the variable without the descriptor; whatever has that number then is not a pipe that was
    open before the program opened anything, so it is left alone.
    """
    text = os.environ.get(LIFELINE_VARIABLE, '')
    if not text.isdecimal():
        return None
    try:
        return int(text) if stat.S_ISFIFO(os.fstat(int(text)).st_mode) else None
    except OSError:
        return None
