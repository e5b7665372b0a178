# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
Single keys from a terminal, and the terminal as it was in every way out.

Keys come at once and are not shown, while Ctrl-C and Ctrl-Z remain signals for the whole job, as
its user expects. Ctrl-Z is told as a key too, for the reader to call :meth:`Keyboard.suspend` when
it has stopped the robot; ``fg`` takes the terminal again.

This module imports no rclpy.
"""

import contextlib
import copy
import os
import re
import select
import signal
import termios
import tty
from types import FrameType, TracebackType
from typing import Any, Self

from amr_description.errors import AmrError
from amr_description.nodes.teleop_keys import CTRL_C, CTRL_Z

# An arrow or function key is one key: ESC [ parameters letter, or ESC O letter.
_KEY = re.compile(r'\x1b\[[0-?]*[ -/]*[@-~]|\x1bO.|.', re.DOTALL)

_RESUMED = '\x00'
_ON_SIGNAL = {signal.SIGTSTP: CTRL_Z, signal.SIGCONT: _RESUMED}


class Keyboard:
    """
    The keys of a terminal, while inside this context manager (main thread only).

    :param descriptor: The terminal, such as ``sys.stdin.fileno()``.
    :raises AmrError: It is not a terminal.
    """

    def __init__(self, descriptor: int) -> None:
        if not os.isatty(descriptor):
            raise AmrError(
                'standard input is not a terminal, so there are no keys to read; run '
                'teleop_twist_keyboard in a terminal of its own, outside of a launch file or a '
                'pipe, or drive with: ros2 topic pub -r 10 <topic> <type> "<message>"'
            )
        self._descriptor = descriptor

    def __enter__(self) -> Self:
        self._attributes = termios.tcgetattr(self._descriptor)
        self._pipe_out, self._pipe_in = os.pipe()
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

    def leave(self) -> None:
        """Have :meth:`read` return Ctrl-C; may be called from any thread."""
        os.write(self._pipe_in, CTRL_C.encode())

    def read(self, timeout: float | None) -> list[str]:
        """
        Return the keys pressed by now, waiting up to ``timeout`` s for the first (None: for ever).

        An arrow or function key is one string, its whole escape sequence. A terminal that is gone
        counts as Ctrl-C.
        """
        ready = dict(self._poll.poll(None if timeout is None else 1000.0 * timeout))
        if self._pipe_out in ready:
            keys = os.read(self._pipe_out, 16).decode()
            if _RESUMED in keys:
                self._take_terminal()
            return list(keys.replace(_RESUMED, ''))
        events = ready.get(self._descriptor, 0)
        if events & ~select.POLLIN:
            return [CTRL_C]
        return self._typed() if events else []

    def suspend(self) -> None:
        """Give the terminal back and stop until ``fg``; without a shell, the kernel goes on."""
        self._give_terminal()
        signal.signal(signal.SIGTSTP, signal.SIG_DFL)
        os.kill(os.getpid(), signal.SIGTSTP)
        signal.signal(signal.SIGTSTP, self._on_signal)
        self._take_terminal()

    def _typed(self) -> list[str]:
        """Return what has been typed: nothing if a Ctrl-Z, which drops input, came in between."""
        try:
            typed = os.read(self._descriptor, 1024)
        except OSError:  # EIO: the terminal is gone
            return [CTRL_C]
        return _KEY.findall(typed.decode(errors='replace'))

    def _on_signal(self, signum: int, _frame: FrameType | None) -> None:
        os.write(self._pipe_in, _ON_SIGNAL[signal.Signals(signum)].encode())

    def _take_terminal(self) -> None:
        attributes = copy.deepcopy(self._attributes)
        tty.cfmakecbreak(attributes)
        attributes[tty.CC][termios.VMIN] = 0  # a read never waits
        attributes[tty.IFLAG] &= ~termios.IXON  # Ctrl-S and Ctrl-V are keys like any other
        attributes[tty.LFLAG] &= ~termios.IEXTEN
        self._set_terminal(attributes)

    def _give_terminal(self) -> None:
        """Restore the settings and drop the keys not yet read: they are not for the shell."""
        self._set_terminal(self._attributes, drop_keys=True)

    def _set_terminal(self, attributes: list[Any], *, drop_keys: bool = False) -> None:
        if self._is_in_foreground():
            with contextlib.suppress(termios.error):  # the terminal is gone
                termios.tcsetattr(self._descriptor, termios.TCSANOW, attributes)
                if drop_keys:
                    termios.tcflush(self._descriptor, termios.TCIFLUSH)

    def _is_in_foreground(self) -> bool:
        """
        Whether the terminal is ours to set.

        A job in the background would be stopped by SIGTTOU, or spoil the shell's own settings. A
        terminal that is not the controlling one knows no foreground.
        """
        try:
            return os.tcgetpgrp(self._descriptor) == os.getpgrp()
        except OSError:
            return True
