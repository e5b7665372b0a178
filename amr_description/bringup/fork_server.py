# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
Starts the executables of this package by forking an interpreter that has loaded their modules.

A node spends most of its start on imports: 0.3 s of processor time for a small one, 0.8 s for the
simulator. The fork server (``forking.py``) imports once what several executables of a stack need,
and forks them. What one program alone needs is imported there, while others start. A
program that was started so is a process like any other: a child of the orchestrator, with a pid,
a session, an environment, an output and a command line (``ps``, ``pgrep -f``) of its own. Nothing
of DDS is initialised before a fork.

An executable of another package, one with a prefix such as a debugger, one for the terminal, and
one whose environment changes the interpreter are executed as ever; all are once the server has
ended.

Requests and answers are single packets: a :class:`~amr_description.forking.ForkRequest` as JSON,
with the file for stdout and stderr; the pid. The server's first packet says that it is ready.
"""

from collections.abc import Iterable, Mapping, Sequence
import contextlib
import json
import os
import socket
import subprocess

from amr_description.entry import python_command
from amr_description.forking import command_line, ForkRequest, LARGEST_PACKET, READY

_LOAD_THEIR_OWN = frozenset({'mujoco_sim', 'viewer'})
"""Executables most of whose modules no other one of a stack needs."""
_ANSWER_TIMEOUT = 5.0  # s; a fork takes some ms
_ROOM_FOR_COMMAND = 8192
"""Bytes of the server's command line, in which the programs write their own."""
_READ_AT_START = ('PYTHON', 'LANG', 'LC_', 'LD_', 'MUJOCO', 'OMP_', 'OPENBLAS', 'MALLOC')
"""What variables begin with that an interpreter or a library reads as it is loaded."""


class ForkedProcess:
    """A process that the server has forked: what is used of ``subprocess.Popen``."""

    def __init__(self, pid: int) -> None:
        """Take over a child of this process."""
        self.pid = pid
        self.returncode: int | None = None
        """Exit code or minus the signal's number; None until :meth:`poll` found the end."""

    def poll(self) -> int | None:
        """Look whether it has ended; return ``returncode``."""
        if self.returncode is None:
            pid, status = os.waitpid(self.pid, os.WNOHANG)
            if pid:
                self.returncode = os.waitstatus_to_exitcode(status)
        return self.returncode


class ForkServer:
    """The orchestrator's side of the server."""

    def __init__(
        self, executables: Iterable[str], environment: Mapping[str, str], inherit: int
    ) -> None:
        """
        Start the server.

        This process must be a subreaper: so it becomes the parent of what the server forks.

        Args:
            executables: the names of those of this package that will be started, in this order.
            environment: the variables of the server; programs may have others.
            inherit: a file descriptor that each program gets under the same number.

        Raises:
            OSError: the operating system cannot start it.
        """
        self._environment = dict(environment)
        self.is_ready = False
        """Whether it forks programs."""
        self.is_over = False
        """Whether it has ended, or does not answer."""
        shared = [each for each in executables if each not in _LOAD_THEIR_OWN]
        self._socket, theirs = socket.socketpair(socket.AF_UNIX, socket.SOCK_SEQPACKET)
        command = python_command(
            'from amr_description import forking; forking.serve(sys.argv[1:])'
        )
        with theirs, open(os.devnull, 'wb') as nowhere:
            self._process = subprocess.Popen(
                [*command, str(theirs.fileno()), *shared, ' ' * _ROOM_FOR_COMMAND],
                env=self._environment,
                stdin=subprocess.DEVNULL,
                stdout=nowhere,
                stderr=nowhere,
                pass_fds=(theirs.fileno(), inherit),
                start_new_session=True,
            )
        self._socket.settimeout(_ANSWER_TIMEOUT)

    @property
    def pid(self) -> int:
        """The server's process id."""
        return self._process.pid

    def fileno(self) -> int:
        """Return what becomes readable when the server is ready, or has ended."""
        return self._socket.fileno()

    def take_ready(self) -> None:
        """Take the packet that says that it is ready; call it when it can be read."""
        with contextlib.suppress(OSError):
            self.is_ready = self._socket.recv(len(READY)) == READY
        self.is_over = not self.is_ready

    def can_start(self, command: Sequence[str], environment: Mapping[str, str]) -> bool:
        """Return whether a fork of the server is what this command would be."""
        return (
            self.is_ready
            and not self.is_over
            and len(command_line(command)) < _ROOM_FOR_COMMAND
            and _of_interpreter(environment) == _of_interpreter(self._environment)
        )

    def start(
        self, command: Sequence[str], environment: Mapping[str, str], output: int
    ) -> ForkedProcess:
        """
        Fork a program; its SIGINT is blocked until ``entry.py`` unblocks it.

        Args:
            command: an executable of this package and its arguments.
            environment: all its environment variables.
            output: the file descriptor of its stdout and stderr.

        Raises:
            OSError: the server has ended or does not answer; it has started nothing then.
        """
        packet = json.dumps(ForkRequest(command, dict(environment))).encode()
        try:
            socket.send_fds(self._socket, [packet], [output])
            answer = self._answer()
            if not answer:
                raise ConnectionResetError('the fork server has ended')
        except OSError:
            self.is_over = True
            raise
        return ForkedProcess(int(answer))

    def _answer(self) -> bytes:
        """Return the server's answer; one that is too late ends it, lest it starts a program."""
        try:
            return self._socket.recv(LARGEST_PACKET)
        except TimeoutError:
            self._process.kill()
            self._process.wait()
            return self._socket.recv(LARGEST_PACKET)  # what came meanwhile, or b'': its end

    def end(self) -> None:
        """End the server, if it runs; what it has forked goes on."""
        self.is_over = True
        self._process.kill()
        self._process.wait()
        self._socket.close()


def _of_interpreter(environment: Mapping[str, str]) -> dict[str, str]:
    return {k: v for k, v in environment.items() if k.startswith(_READ_AT_START)}
