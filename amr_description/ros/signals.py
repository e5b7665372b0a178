# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
Every way in which a program is told to stop, as one request.

These are SIGINT, SIGTERM, SIGHUP and the lifeline: a pipe whose writing end only the bring-up
holds (:mod:`amr_description.bringup.lifeline`). Its reading end is inherited, its number stands
in the environment variable ``AMR_LIFELINE_FD``. When it reports POLLHUP the bring-up is gone, even
by SIGKILL, and the program stops as on SIGTERM.

rclpy's own signal handlers do not serve: they shut the context down at once, so that a node
cannot send its last message (the zero velocity of a teleop); they leave out SIGHUP (the terminal
was closed); and a second Ctrl-C raises in the middle of the clean-up. Here:

======================================  ===================================================
where the program is                    what the first request does
======================================  ===================================================
inside ``with stop.on_stop(callback)``  ``callback()``; a second raises StopRequested
inside ``with stop.deferred(wake)``     ``wake()``; StopRequested at the end of the block
cleaning up, after ``stop.leave()``     nothing: the program is on its way out
anywhere else                           StopRequested in the main thread, once, and
                                        ``wake()`` in a thread of its own
======================================  ===================================================

This module imports no rclpy.
"""

from collections.abc import Callable, Iterator
from contextlib import contextmanager
import itertools
import os
import select
import signal
import stat
import threading
from types import FrameType, TracebackType
from typing import Self

from amr_description.entry import LIFELINE_VARIABLE

STOP_SIGNALS = (signal.SIGINT, signal.SIGTERM, signal.SIGHUP)
_PATIENCE = 0.3
"""s that a callback is given to return before it is interrupted."""
_END_OF_WATCH = 0  # a byte for the wake-up pipe; no signal has this number


class StopRequested(KeyboardInterrupt):
    """The program was asked to stop by ``signum``; raised at most once, in the main thread."""

    def __init__(self, signum: signal.Signals) -> None:
        super().__init__(signum.name)
        self.signum = signum


class StopRequests:
    """
    Turn signals and the lifeline into requests to stop, while inside this context manager.

    :param wake: Called from another thread when a request finds the program outside of
        :meth:`on_stop`. It must end whatever wait in C the main thread may be in: only then
        does Python give :class:`StopRequested` its turn.

    Signals are handled only if it is entered in the main thread (a rule of Python). SIGHUP stays
    ignored where it was (``nohup``).
    """

    def __init__(self, wake: Callable[[], object]) -> None:
        self.signum: signal.Signals | None = None
        """The first request, or None; the lifeline counts as SIGTERM."""
        self._wake = wake
        self._callback: Callable[[], object] | None = None
        self._deferring: Callable[[], object] | None = None
        self._numbers = itertools.count()  # of requests
        self._raised = False
        self._leaving = False
        self._previous_handlers: dict[signal.Signals, signal._HANDLER] = {}
        self._watcher = threading.Thread(target=self._watch, name='stop_requests', daemon=True)

    def __enter__(self) -> Self:
        self._lifeline = _inherited_lifeline()
        self._pipe_out, self._pipe_in = os.pipe()
        os.set_blocking(self._pipe_in, False)
        if threading.current_thread() is threading.main_thread():
            self._previous_pipe = signal.set_wakeup_fd(self._pipe_in, warn_on_full_buffer=False)
            for signum in STOP_SIGNALS:
                if signum != signal.SIGHUP or signal.getsignal(signum) != signal.SIG_IGN:
                    self._previous_handlers[signum] = signal.signal(signum, self._handle)
        self._watcher.start()
        return self

    def __exit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        traceback: TracebackType | None,
    ) -> None:
        self.leave()
        os.write(self._pipe_in, bytes([_END_OF_WATCH]))
        self._watcher.join()
        for signum, handler in self._previous_handlers.items():
            # A process asked to stop ends soon; SIG_IGN holds through Python's own shutdown.
            signal.signal(signum, handler if self.signum is None else signal.SIG_IGN)
        if self._previous_handlers:
            signal.set_wakeup_fd(self._previous_pipe)
        os.close(self._pipe_in)
        os.close(self._pipe_out)

    @contextmanager
    def on_stop(self, callback: Callable[[], object]) -> Iterator[None]:
        """
        Have a request to stop call ``callback`` instead of interrupting the program.

        The callback comes from another thread, perhaps more than once, and must be quick; soon
        after it the body leaves the block. The block is the last working phase of a program:
        once it is left, requests are ignored.
        """
        self._callback = callback
        try:
            if self.signum is not None:
                callback()
            yield
        finally:
            self.leave()
            self._callback = None

    @contextmanager
    def deferred(self, wake: Callable[[], object]) -> Iterator[Callable[[], bool]]:
        """
        Hold a request back while callbacks run, and raise StopRequested at the end of the block.

        An exception inside a callback would go through rclpy, whose EventsExecutor logs it as
        FATAL. A body that does not end within 0.3 s, such as a callback that prints into a full
        pipe, is interrupted all the same. Inside of :meth:`on_stop` this changes nothing.

        Args:
            wake: Called from another thread, perhaps more than once; it must end whatever wait in
                C the body may be in.

        Yields:
            A function that returns whether the body is to leave the block.
        """
        if self._callback is not None:
            yield lambda: False
            return
        self._deferring = wake
        try:
            yield lambda: self.signum is not None
        finally:
            self._deferring = None
        if self.signum is not None and not (self._raised or self._leaving):
            self._raised = True
            raise StopRequested(self.signum)

    def leave(self) -> None:
        """Ignore every request from now on: the program cleans up and ends by itself."""
        self._leaving = True

    def _handle(self, signum: int, _frame: FrameType | None) -> None:
        """Main thread, between two bytecodes, as every signal handler of Python."""
        # In one step: the next signal may interrupt this handler wherever it is.
        first = next(self._numbers) == 0
        if self.signum is None:
            self.signum = signal.Signals(signum)
        if self._leaving or self._raised:
            return
        if first and (self._callback is not None or self._deferring is not None):
            return
        self._raised = True
        raise StopRequested(self.signum)

    def _watch(self) -> None:
        """Thread: the pipe gets a byte per signal at once, also while the main one waits in C."""
        poll = select.poll()
        poll.register(self._pipe_out, select.POLLIN)
        if self._lifeline is not None:
            poll.register(self._lifeline, 0)  # POLLHUP only, which needs no asking for
        is_held = False  # a request waits for the end of a deferred block
        while True:
            events = poll.poll(_PATIENCE * 1e3 if is_held else None)
            is_held = is_held and self._deferring is not None
            if is_held and not events:
                os.kill(os.getpid(), self.signum or signal.SIGINT)
            for descriptor, _event in events:
                if descriptor == self._lifeline:
                    poll.unregister(descriptor)
                    os.kill(os.getpid(), signal.SIGTERM)
                    continue
                numbers = os.read(self._pipe_out, 64)
                if _END_OF_WATCH in numbers:
                    return
                if not self._leaving and any(number in STOP_SIGNALS for number in numbers):
                    is_held = self._deferring is not None
                    (self._callback or self._deferring or self._wake)()


def _inherited_lifeline() -> int | None:
    """
    Return the reading end of the lifeline, or None.

    A grandchild may inherit the variable without the descriptor. The number then is nobody's, or
    that of something else than a pipe.
    """
    text = os.environ.get(LIFELINE_VARIABLE, '')
    if not text.isdecimal():
        return None
    try:
        return int(text) if stat.S_ISFIFO(os.fstat(int(text)).st_mode) else None
    except OSError:
        return None
