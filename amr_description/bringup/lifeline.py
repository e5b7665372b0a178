# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
The lifeline: what makes sure that nothing outlives the orchestrator, not even its SIGKILL.

Every child of a bring-up inherits

``AMR_LIFELINE_FD``
    The number of a file descriptor: the reading end of a pipe into which nobody ever writes and
    whose writing end only the orchestrator holds. It reports POLLHUP (or end of file) as soon as
    the orchestrator is gone, in whatever way. A node that watches it ends as on SIGTERM. It must
    only be polled; and only if it is a FIFO, as the variable outlives the descriptor where a child
    starts a program with closed descriptors.
``AMR_BRINGUP_RUN``
    The name of the run, the same in all its processes. By it the guardian finds what is left,
    whether or not it watches the lifeline.
"""

import contextlib
import ctypes
import os
from pathlib import Path
import subprocess
import sys

from amr_description.bringup import guardian

LIFELINE_VARIABLE = 'AMR_LIFELINE_FD'
_PR_SET_CHILD_SUBREAPER = 36  # linux/prctl.h


class Lifeline:
    """The pipe, and the guardian that holds its other end."""

    def __init__(self, run: str) -> None:
        """
        Open the pipe and start the guardian.

        :param run: A name that no other run on this machine has.
        """
        self._run = run
        self.reader, self._writer = os.pipe()
        become_subreaper()
        self._guardian = self._start_guardian()

    @property
    def variables(self) -> dict[str, str]:
        """The environment variables of the children, as the module's docstring says."""
        return {LIFELINE_VARIABLE: str(self.reader), guardian.RUN_VARIABLE: self._run}

    def revive(self) -> bool:
        """Start the guardian anew if somebody ended it; return whether that was needed."""
        if self._guardian.poll() is None:
            return False
        self._guardian = self._start_guardian()
        return True

    def reap_adopted(self, children: set[int]) -> None:
        """Reap the ended orphans that this process, their subreaper, has adopted."""
        with contextlib.suppress(ChildProcessError):
            while ended := os.waitid(os.P_ALL, 0, os.WEXITED | os.WNOHANG | os.WNOWAIT):
                if ended.si_pid in children | {self._guardian.pid}:
                    return  # it belongs to its Popen; SIGCHLD has been sent for it
                os.waitpid(ended.si_pid, 0)

    def cut(self) -> None:
        """Let the guardian end what is left, now; :meth:`is_over` says when that is done."""
        os.close(self._writer)
        os.close(self.reader)

    def is_over(self) -> bool:
        """Return whether the guardian, after :meth:`cut`, has done its work and is gone."""
        return self._guardian.poll() is not None

    def _start_guardian(self) -> subprocess.Popen[bytes]:
        program = str(Path(guardian.__file__))
        arguments = [str(self.reader), self._run, str(os.getpid())]
        environment = {k: v for k, v in os.environ.items() if k != guardian.RUN_VARIABLE}
        return subprocess.Popen(
            [sys.executable, '-I', '-S', program, *arguments],
            env=environment,  # without the mark of a bring-up that this one may run in
            stdin=subprocess.DEVNULL,
            stdout=subprocess.DEVNULL,
            pass_fds=(self.reader,),
            start_new_session=True,
        )


def become_subreaper() -> None:
    """Have orphaned descendants of this process adopted by it rather than by init."""
    libc = ctypes.CDLL(None, use_errno=True)
    if libc.prctl(_PR_SET_CHILD_SUBREAPER, 1, 0, 0, 0) != 0:
        error = ctypes.get_errno()
        raise OSError(error, os.strerror(error), 'prctl(PR_SET_CHILD_SUBREAPER)')
