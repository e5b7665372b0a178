# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
The one process of a stack that has the terminal: it reads keys as if a shell had started it.

The orchestrator does for it what an interactive shell does for a foreground job: the process stays
in the session of the terminal, leads a process group of its own, and that group becomes the
foreground process group (tcsetpgrp). So raw mode works, and the signals of Ctrl-C, Ctrl-Z and of a
resized window go to it alone.

=====================================  ==========================================================
event                                  action
=====================================  ==========================================================
it ends, in whatever way               the terminal is taken back with its former settings; after
                                       a failure unread keys are dropped, too
Ctrl-Z stops it                        the terminal is taken back, and the orchestrator stops with
                                       the whole job that it is part of: the shell continues
``fg``                                 it gets the terminal again, with its own settings
``bg``, or started in the background   it waits, and gets the terminal when the job comes to the
                                       foreground
=====================================  ==========================================================

While it has the terminal, the console shows only warnings and errors of the other processes.
"""

import asyncio
from collections.abc import Callable, Mapping, Sequence
import contextlib
import os
import signal
import subprocess
import termios
from typing import TypeAlias

from amr_description.bringup.process import RunningProcess, signal_blocked
from amr_description.errors import UsageError

_Settings: TypeAlias = list[int | list[bytes | int]]  # as termios.tcgetattr() returns them

STDIN = 0  # sys.stdin is None where it was closed
_POLL_PERIOD = 0.5  # s between two looks whether the shell has put the job into the foreground
# Undoes what a program that died may have left on: kitty's keyboard protocol, a hidden cursor.
_RESET_SEQUENCES = b'\x1b[<u\x1b[?25h'
_WITHOUT_SEQUENCES = ('', 'dumb', 'linux')  # values of TERM: terminals that may print them


def require_terminal(program: str, package: str) -> None:
    """
    Raise UsageError, with what to do instead, if standard input is not a terminal.

    Args:
        program: the executable that reads keys.
        package: its package.
    """
    if not os.isatty(STDIN):
        raise UsageError(
            f'standard input is not a terminal, and {program} reads keys from it: run this in a '
            'terminal (over ssh: ssh -t), or bring up a stack without it and, in a terminal of '
            f'its own, ros2 run {package} {program}'
        )


def as_foreground() -> contextlib.AbstractContextManager[None]:
    """Within this context, writing to the terminal does not stop a background process."""
    return signal_blocked(signal.SIGTTOU)


class TerminalChild(RunningProcess):
    """The process that has the terminal, or waits for it."""

    def __init__(
        self,
        command: Sequence[str],
        environment: Mapping[str, str],
        inherit: int,
        on_lent: Callable[[bool], None],
    ) -> None:
        """
        Start the process and give it the terminal.

        Args:
            command: the command line.
            environment: all its environment variables.
            inherit: a file descriptor that the child gets under the same number.
            on_lent: called with whether the process has the terminal, when that changes.

        Raises:
            OSError: the operating system cannot start it.
        """
        self._on_lent = on_lent
        self._is_lent = False
        self._our_settings: _Settings | None = None
        self._its_settings: _Settings | None = None  # while it is stopped
        self._retry: asyncio.TimerHandle | None = None
        process = subprocess.Popen(command, env=environment, pass_fds=(inherit,), process_group=0)
        super().__init__(process)
        self.last_lines.append('what it said stands above')  # its output is not piped to us
        self._give()

    def poll(self) -> bool:
        """Return whether the process has ended; if it was stopped, stop with it."""
        if super().poll():
            self._take_back()
            return True
        if os.waitid(os.P_PID, self.pid, os.WSTOPPED | os.WNOHANG):
            self._stop_with_it()
        return False

    def send(self, number: signal.Signals) -> None:
        """Signal its process group; a stopped one must be continued to handle the signal."""
        super().send(number)
        if not self._is_lent:
            self._continue()

    def close(self) -> None:
        """Wait for the terminal no longer."""
        if self._retry is not None:
            self._retry.cancel()

    def _give(self) -> None:
        """Give it the terminal if we are in the foreground, else try again later."""
        if self.returncode is not None:
            return
        foreground = _foreground()
        if foreground not in (None, os.getpgrp()):
            self._on_lent(False)
            loop = asyncio.get_running_loop()
            self._retry = loop.call_later(_POLL_PERIOD, self._give)
            return
        self._is_lent = True
        self._on_lent(True)
        with as_foreground(), contextlib.suppress(OSError, termios.error):  # the terminal is gone
            self._our_settings = termios.tcgetattr(STDIN)
            if foreground is not None:
                os.tcsetpgrp(STDIN, self.pid)
            if self._its_settings is not None:
                termios.tcsetattr(STDIN, termios.TCSADRAIN, self._its_settings)
        self._continue()  # it may have been stopped for reading from the background

    def _take_back(self) -> None:
        if not self._is_lent:
            return
        with as_foreground(), contextlib.suppress(OSError, termios.error):  # the terminal is gone
            if _foreground() == self.pid:
                os.tcsetpgrp(STDIN, os.getpgrp())
            if self.returncode:
                termios.tcflush(STDIN, termios.TCIFLUSH)
                if os.environ.get('TERM', '') not in _WITHOUT_SEQUENCES:
                    os.write(STDIN, _RESET_SEQUENCES)
            if self._our_settings is not None:
                termios.tcsetattr(STDIN, termios.TCSADRAIN, self._our_settings)
        self._is_lent = False
        self._on_lent(False)

    def _stop_with_it(self) -> None:
        """Leave the terminal to the shell until this job gets it again."""
        if not self._is_lent:
            return  # _give() is being retried
        with contextlib.suppress(termios.error):
            self._its_settings = termios.tcgetattr(STDIN)
        self._take_back()
        os.killpg(os.getpgrp(), signal.SIGTSTP)  # ignored if no shell controls us
        self._give()

    def _continue(self) -> None:
        with contextlib.suppress(ProcessLookupError):
            os.killpg(self.pid, signal.SIGCONT)


def _foreground() -> int | None:
    """Return the foreground process group; None: the terminal is gone or not our session's."""
    try:
        return os.tcgetpgrp(STDIN)
    except OSError:
        return None
