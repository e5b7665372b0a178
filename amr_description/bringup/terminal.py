# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
One process of a stack with the terminal: it reads keys as if a shell had started it.

The orchestrator does for it what an interactive shell does for a job: the process stays in the
session of the terminal, leads a process group of its own, and that group gets the terminal. So its
raw mode works, and Ctrl-C, Ctrl-Z and the size of the window are told to it alone.

=====================================  ==========================================================
what happens                           what is done
=====================================  ==========================================================
it ends, in whatever way               the terminal is taken back, its settings as they were; of
                                       one that died also the keys nobody read are dropped
Ctrl-Z stops it                        the terminal is taken back and the orchestrator, with the
                                       whole job that it is part of, stops too: the shell goes on
``fg``                                 it gets the terminal again, with its own settings
``bg``, or started in the background   it waits; once the job is in the foreground it gets it
=====================================  ==========================================================

While it has the terminal the console shows only warnings and errors of the others.
"""

import asyncio
from collections.abc import Callable, Mapping, Sequence
import contextlib
import os
import signal
import subprocess
import termios

from amr_description.bringup.process import held_back, RunningProcess
from amr_description.errors import UsageError

type _Settings = list[int | list[bytes | int]]  # as termios.tcgetattr() returns them

STDIN = 0  # sys.stdin is None where it was closed
_LOOK_PERIOD = 0.5  # s: how soon it is seen that the shell has put the job into the foreground
# What a program that died may have left on: the kitty keyboard protocol, an invisible cursor.
_REPAIR = b'\x1b[<u\x1b[?25h'
_MUTE_TERMINALS = ('', 'dumb', 'linux')  # values of TERM: those that may print it


def require_terminal(program: str, package: str) -> None:
    """Raise UsageError, with what to do instead, if a program that reads keys can get none."""
    if not os.isatty(STDIN):
        raise UsageError(
            f'standard input is not a terminal, and {program} reads keys from it: run this in a '
            'terminal (over ssh: ssh -t), or bring up a stack without it and, in a terminal of '
            f'its own, ros2 run {package} {program}'
        )


def as_foreground() -> contextlib.AbstractContextManager[None]:
    """Use the terminal, while inside, also as what it takes for a background job."""
    return held_back(signal.SIGTTOU)


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

        :param inherit: A file descriptor that the child gets under the same number.
        :param on_lent: Called with whether the process has the terminal, when that changes.
        :raises OSError: The operating system cannot start it.
        """
        self._on_lent = on_lent
        self._is_lent = False
        self._ours: _Settings | None = None
        self._its: _Settings | None = None  # kept while it is stopped
        self._look_again: asyncio.TimerHandle | None = None
        process = subprocess.Popen(command, env=environment, pass_fds=(inherit,), process_group=0)
        super().__init__(process)
        self.last_lines.append('what it said stands above')  # we hear nothing of it
        self._give()

    def poll(self) -> bool:
        """Return whether the process has ended; follow it when it was stopped."""
        if super().poll():
            self._take_back()
            return True
        if os.waitid(os.P_PID, self.pid, os.WSTOPPED | os.WNOHANG):
            self._stop_with_it()
        return False

    def send(self, number: signal.Signals) -> None:
        """Signal its process group; a stopped one has to go on to hear it."""
        super().send(number)
        if not self._is_lent:
            self._continue()

    def close(self) -> None:
        """Forget the terminal."""
        if self._look_again is not None:
            self._look_again.cancel()

    def _give(self) -> None:
        """Give it the terminal if it is ours to give, else look again."""
        if self.returncode is not None:
            return
        owner = _foreground()
        if owner not in (None, os.getpgrp()):
            self._on_lent(False)
            loop = asyncio.get_running_loop()
            self._look_again = loop.call_later(_LOOK_PERIOD, self._give)
            return
        self._is_lent = True
        self._on_lent(True)
        with as_foreground(), contextlib.suppress(OSError, termios.error):  # the terminal is gone
            self._ours = termios.tcgetattr(STDIN)
            if owner is not None:
                os.tcsetpgrp(STDIN, self.pid)
            if self._its is not None:
                termios.tcsetattr(STDIN, termios.TCSADRAIN, self._its)
        self._continue()  # it may have been stopped because it was too early

    def _take_back(self) -> None:
        if not self._is_lent:
            return
        with as_foreground(), contextlib.suppress(OSError, termios.error):  # the terminal is gone
            if _foreground() == self.pid:
                os.tcsetpgrp(STDIN, os.getpgrp())
            if self.returncode:
                termios.tcflush(STDIN, termios.TCIFLUSH)
                if os.environ.get('TERM', '') not in _MUTE_TERMINALS:
                    os.write(STDIN, _REPAIR)
            if self._ours is not None:
                termios.tcsetattr(STDIN, termios.TCSADRAIN, self._ours)
        self._is_lent = False
        self._on_lent(False)

    def _stop_with_it(self) -> None:
        """Leave the terminal to the shell until it is given to this job again."""
        if not self._is_lent:
            return  # _give() looks again and again
        with contextlib.suppress(termios.error):
            self._its = termios.tcgetattr(STDIN)
        self._take_back()
        os.killpg(os.getpgrp(), signal.SIGTSTP)  # without a shell, the kernel goes on at once
        self._give()

    def _continue(self) -> None:
        with contextlib.suppress(ProcessLookupError):
            os.killpg(self.pid, signal.SIGCONT)


def _foreground() -> int | None:
    """Return the process group in the foreground; None: not our session's terminal, or gone."""
    try:
        return os.tcgetpgrp(STDIN)
    except OSError:
        return None
