# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
Single keys from a terminal, whose settings are restored however the program ends.

:class:`Keyboard` reads keys at once and without echo; Ctrl-C and Ctrl-Z remain signals for the
whole job. Ctrl-Z is also reported as a key, so that the reader can stop the robot and then call
:meth:`Keyboard.suspend`; ``fg`` takes the terminal again.

The terminal is asked for the protocol of :mod:`amr_description.terminal` at the start; until its
answer comes, if ever, keys are ordinary ones. An answer that is still due when the terminal is
given back is awaited for 0.5 s at most: otherwise the shell would read it as input.

Imports no rclpy.
"""

import codecs
import contextlib
import copy
import os
import select
import signal
import termios
import time
import tty
from types import FrameType, TracebackType
from typing import Self

from amr_description.errors import AmrError
from amr_description.terminal import CTRL_C, CTRL_Z, is_in_foreground, KeyEvent, KeyParser

ASK = '\x1b[?u\x1b[c'
"""Query the protocol, then the terminal's identity, which every terminal reports."""
BEGIN_REPORTS = '\x1b[>31u'
"""Enable all reports: bits 1 to 16 of the protocol."""
END_REPORTS = '\x1b[<u\x1b[c'
"""Restore the mode; everything typed before it precedes the answer with the identity."""

_RESUMED = '\x00'
_ON_SIGNAL = {signal.SIGTSTP: CTRL_Z, signal.SIGCONT: _RESUMED, signal.SIGQUIT: CTRL_C}
_SIGNAL_OF = {CTRL_C: signal.SIGINT, CTRL_Z: signal.SIGTSTP}
_MUTE_TERMINALS = ('', 'dumb', 'linux')  # values of TERM: they do not answer, or send garbage
_NO_KEY = b'\x00'  # _POSIX_VDISABLE of Linux

# s; within a sequence the next byte follows at once, after the key Escape nothing follows.
_ESCAPE_TIMEOUT = 0.05
_ANSWER_TIMEOUT = 0.5  # s: more than a round trip around the world


class Keyboard:
    """
    A context manager that reads the keys of a terminal; usable once, in the main thread only.

    Args:
        descriptor: the terminal, such as ``sys.stdin.fileno()``.
        alternative: what the user can do without a terminal, for the error.
        releases: request reports of the releases of keys.

    Raises:
        AmrError: ``descriptor`` is not a terminal.
    """

    def __init__(self, descriptor: int, *, alternative: str, releases: bool) -> None:
        if not os.isatty(descriptor):
            raise AmrError(
                'standard input is not a terminal, so there are no keys to read; run '
                'teleop_twist_keyboard in a terminal of its own, outside of a launch file or a '
                f'pipe, or {alternative}'
            )
        self._descriptor = descriptor
        self._parser = KeyParser()
        self._decoder = codecs.getincrementaldecoder('utf-8')(errors='replace')
        self._wants_reports = releases and os.environ.get('TERM', '') not in _MUTE_TERMINALS
        self._reports = False
        self._questions = 0
        self._answer_by = 0.0
        self._pipe_out, self._pipe_in = os.pipe()

    def __enter__(self) -> Self:
        self._attributes = termios.tcgetattr(self._descriptor)
        self._poll = select.poll()
        self._poll.register(self._pipe_out, select.POLLIN)
        self._poll.register(self._descriptor, select.POLLIN)
        self._handlers = {s: signal.signal(s, self._on_signal) for s in _ON_SIGNAL}
        self._take_terminal()
        return self

    def __exit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        traceback: TracebackType | None,
    ) -> None:
        self._give_terminal()
        for signum, handler in self._handlers.items():
            signal.signal(signum, handler)
        os.close(self._pipe_in)
        os.close(self._pipe_out)

    def stop(self) -> None:
        """Make :meth:`read` return Ctrl-C; on any thread."""
        os.write(self._pipe_in, CTRL_C.encode())

    def read(self, timeout: float | None) -> list[KeyEvent]:
        """
        Return the keys pressed so far; wait up to ``timeout`` s for the first, None: for ever.

        An arrow or function key is one string, its whole escape sequence. A closed terminal is
        reported as Ctrl-C.
        """
        if self._parser.has_escape:
            timeout = min(_ESCAPE_TIMEOUT, _ESCAPE_TIMEOUT if timeout is None else timeout)
        ready = dict(self._poll.poll(None if timeout is None else 1000.0 * timeout))
        if self._pipe_out in ready:
            keys = os.read(self._pipe_out, 16).decode()
            if _RESUMED in keys:
                self._take_terminal()
            return [KeyEvent(key) for key in keys.replace(_RESUMED, '')]
        events = ready.get(self._descriptor, 0)
        if events & ~select.POLLIN:
            return [KeyEvent(CTRL_C)]
        if events:
            return self._typed()
        return self._parser.flush() if self._parser.has_escape else []

    def suspend(self) -> None:
        """Give the terminal back, and stop until ``fg``; ignored by the kernel without a shell."""
        self._give_terminal()
        signal.signal(signal.SIGTSTP, signal.SIG_DFL)
        os.kill(os.getpid(), signal.SIGTSTP)
        signal.signal(signal.SIGTSTP, self._on_signal)
        self._take_terminal()

    def _typed(self) -> list[KeyEvent]:
        """Return the typed keys; none if a Ctrl-Z, which drops input, came in the meantime."""
        try:
            events = self._read_input()
        except OSError:  # EIO: the terminal is gone
            return [KeyEvent(CTRL_C)]
        if self._parser.offers_releases:
            self._enable_reports()
        for event in events:
            if event.key in _SIGNAL_OF and not event.is_release:
                os.killpg(0, _SIGNAL_OF[event.key])  # as the terminal would without the protocol
        return [event for event in events if event.key not in _SIGNAL_OF]

    def _read_input(self) -> list[KeyEvent]:
        return self._parser.feed(self._decoder.decode(os.read(self._descriptor, 1024)))

    def _on_signal(self, signum: int, _frame: FrameType | None) -> None:
        os.write(self._pipe_in, _ON_SIGNAL[signal.Signals(signum)].encode())

    def _take_terminal(self) -> None:
        if not is_in_foreground(self._descriptor):
            return
        attributes = copy.deepcopy(self._attributes)
        attributes[tty.LFLAG] &= ~(termios.ECHO | termios.ICANON)
        attributes[tty.CC][termios.VMIN] = 0  # a read never waits
        attributes[tty.CC][termios.VTIME] = 0
        attributes[tty.CC][termios.VQUIT] = _NO_KEY  # Ctrl-\ would end us without restoring
        attributes[tty.IFLAG] &= ~termios.IXON  # Ctrl-S and Ctrl-V are keys like any other
        attributes[tty.LFLAG] &= ~termios.IEXTEN
        with contextlib.suppress(termios.error):  # the terminal is gone
            termios.tcsetattr(self._descriptor, termios.TCSANOW, attributes)
        if self._wants_reports:
            self._wants_reports = False
            self._ask(ASK)
        elif self._parser.offers_releases:
            self._enable_reports()

    def _give_terminal(self) -> None:
        """Restore the settings, and drop the keys not yet read: they are not for the shell."""
        if not is_in_foreground(self._descriptor):
            return
        if self._reports:
            self._reports = False
            self._ask(END_REPORTS)
        self._await_answers()
        with contextlib.suppress(termios.error):  # the terminal is gone
            termios.tcsetattr(self._descriptor, termios.TCSANOW, self._attributes)
            termios.tcflush(self._descriptor, termios.TCIFLUSH)

    def _enable_reports(self) -> None:
        if not self._reports:
            self._reports = True
            self._write(BEGIN_REPORTS)

    def _ask(self, question: str) -> None:
        self._questions += 1
        self._answer_by = time.monotonic() + _ANSWER_TIMEOUT
        self._write(question)

    def _await_answers(self) -> None:
        """Read what the terminal sends up to its last answer, within the time for it."""
        terminal = select.poll()
        terminal.register(self._descriptor, select.POLLIN)
        while self._parser.identities < self._questions:
            left = self._answer_by - time.monotonic()
            if left <= 0.0 or terminal.poll(1000.0 * left) != [(self._descriptor, select.POLLIN)]:
                return
            try:
                self._read_input()
            except OSError:  # EIO: the terminal is gone
                return

    def _write(self, text: str) -> None:
        with contextlib.suppress(OSError):  # opened for reading only, or gone
            os.write(self._descriptor, text.encode())
