# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""Runs a child process to its end like a shell: with the terminal, signals and exit code."""

from collections.abc import Mapping, Sequence, Set
import os
import signal

from amr_description.errors import AmrError

_FORWARDED = {
    signal.SIGINT,
    signal.SIGTERM,
    signal.SIGHUP,
    signal.SIGQUIT,
    signal.SIGUSR1,
    signal.SIGUSR2,
}
_SENT_BY_KERNEL = 0x80  # SI_KERNEL of siginfo_t: the terminal's Ctrl-C
_GRACE = 2.0  # s


def run_to_end(
    command: Sequence[str],
    environment: Mapping[str, str],
    blocked: Set[signal.Signals] = frozenset(),
) -> int:
    """
    Run a command with our stdin, stdout and stderr; return its exit code.

    ``blocked``: signals that stay pending until the command unblocks them, as it is made to do.

    The exit code is minus the number of a signal that ended it. A signal from the terminal reaches
    the child by itself, as it is in the same process group. A signal that a process sends to us is
    passed on, so a ``kill`` of this process does not leave the child behind. SIGINT is passed on
    only if the child is still running after a while: it may have been sent to the whole group
    (``timeout -s INT``), and a second SIGINT would interrupt the child's clean-up.

    Raises AmrError if the command cannot be started.
    """
    watched = _FORWARDED | {signal.SIGCHLD}
    previous = signal.pthread_sigmask(signal.SIG_BLOCK, watched)
    try:
        pid = _start(command, environment, previous | blocked)
        return os.waitstatus_to_exitcode(_serve_signals(pid, watched))
    finally:
        signal.pthread_sigmask(signal.SIG_SETMASK, previous)


def _start(
    command: Sequence[str], environment: Mapping[str, str], mask: set[int | signal.Signals]
) -> int:
    try:
        return os.posix_spawnp(
            command[0],
            command,
            environment,
            setsigmask=mask,
            setsigdef=(signal.SIGPIPE, signal.SIGXFSZ),  # which Python ignores
        )
    except OSError as error:
        raise AmrError(f'{command[0]} cannot be started: {error.strerror}') from error


def _serve_signals(pid: int, watched: set[signal.Signals]) -> int:
    """Pass signals on until the child ends; return its wait status."""
    interrupt_pending = False
    while True:
        if interrupt_pending:
            info = signal.sigtimedwait(watched, _GRACE)
        else:
            info = signal.sigwaitinfo(watched)
        ended, status = os.waitpid(pid, os.WNOHANG)
        if ended:
            return status
        if info is None:
            os.kill(pid, signal.SIGINT)
            interrupt_pending = False
        elif info.si_signo != signal.SIGCHLD and info.si_code != _SENT_BY_KERNEL:
            if info.si_signo == signal.SIGINT:
                interrupt_pending = True
            else:
                os.kill(pid, info.si_signo)
