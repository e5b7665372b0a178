# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
The lifeline, a parent-death pipe: no process outlives the orchestrator, even after its SIGKILL.

Every child of a bring-up inherits

``AMR_LIFELINE_FD``
    A file descriptor: the reading end of a pipe to which nobody ever writes and whose writing end
    only the orchestrator holds. It reports POLLHUP (or end of file) as soon as the orchestrator
    is gone, for whatever reason; a node that watches it then ends as on SIGTERM. It may only be
    polled, and only if it is a FIFO: a program that a child starts with closed descriptors
    inherits the variable, but not the descriptor.
``AMR_BRINGUP_RUN``
    The name of the run, the same in all its processes. By it the guardian finds the processes
    that are left, whether or not they watch the lifeline.
"""

import contextlib
import ctypes
import os
from pathlib import Path
import signal
import subprocess
import sys

from amr_description.bringup import guardian
from amr_description.entry import LIFELINE_VARIABLE

_PR_SET_CHILD_SUBREAPER = 36  # linux/prctl.h


class Lifeline:
    """The pipe, and the guardian that waits at its reading end."""

    def __init__(self, run: str, *, adopts: bool = True) -> None:
        """
        Open the pipe and start the guardian.

        Args:
            run: the name of the run, unique on this machine.
            adopts: whether orphans become children of this process, which has no other ones.
        """
        self._run = run
        self.reader, self._writer = os.pipe()
        self._adopts = adopts
        if adopts:
            become_subreaper()
        self._guardian = self._start_guardian()

    @property
    def variables(self) -> dict[str, str]:
        """The environment variables for the children, see the module's docstring."""
        return {LIFELINE_VARIABLE: str(self.reader), guardian.RUN_VARIABLE: self._run}

    @property
    def guardian_pid(self) -> int:
        """The process id of the guardian."""
        return self._guardian.pid

    def revive_guardian(self) -> bool:
        """Start the guardian again if somebody ended it; return whether that was needed."""
        if self._guardian.poll() is None:
            return False
        self._guardian = self._start_guardian()
        return True

    def reap_adopted(self, children: set[int]) -> None:
        """
        Reap the orphans that this process has adopted as their subreaper, once they have ended.

        Args:
            children: the pids of its own children, which their Popen objects reap.
        """
        if not self._adopts:
            return
        with contextlib.suppress(ChildProcessError):
            while ended := os.waitid(os.P_ALL, 0, os.WEXITED | os.WNOHANG | os.WNOWAIT):
                if ended.si_pid in children | {self._guardian.pid}:
                    return  # it belongs to its Popen; SIGCHLD has been sent for it
                os.waitpid(ended.si_pid, 0)

    def cut(self) -> None:
        """Let the guardian end what is left; :meth:`is_over` returns whether it is done."""
        os.close(self._writer)
        os.close(self.reader)
        with contextlib.suppress(ProcessLookupError):
            os.kill(self._guardian.pid, signal.SIGCONT)  # somebody may have stopped it

    def kill_guardian(self) -> None:
        """End the guardian, which does not come to an end by itself."""
        self._guardian.kill()

    def is_over(self) -> bool:
        """Return whether the guardian has ended, after :meth:`cut`."""
        return self._guardian.poll() is not None

    def _start_guardian(self) -> subprocess.Popen[bytes]:
        program = str(Path(guardian.__file__))
        # Where it has other children, only the mark of the run says which are to be ended.
        root = os.getpid() if self._adopts else guardian.NOBODY
        arguments = [str(self.reader), self._run, str(root)]
        environment = {k: v for k, v in os.environ.items() if k != guardian.RUN_VARIABLE}
        return subprocess.Popen(
            [sys.executable, '-I', '-S', program, *arguments],
            env=environment,  # without the mark of an outer bring-up
            stdin=subprocess.DEVNULL,
            stdout=subprocess.DEVNULL,
            pass_fds=(self.reader,),
            start_new_session=True,
        )


def become_subreaper() -> None:
    """Have orphaned descendants of this process adopted by it instead of by init."""
    libc = ctypes.CDLL(None, use_errno=True)
    if libc.prctl(_PR_SET_CHILD_SUBREAPER, 1, 0, 0, 0) != 0:
        error = ctypes.get_errno()
        raise OSError(error, os.strerror(error), 'prctl(PR_SET_CHILD_SUBREAPER)')
