# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
Starts the executables of this package by forking an interpreter that has loaded their modules.

A node spends most of its start on imports: 0.3 s of processor time for a small one, 0.8 s for the
simulator. The fork server imports once what the executables of a stack need, and forks them. A
program that was started so is a process like any other: a child of the orchestrator, with a pid,
a session, an environment, an output and a command line (``ps``, ``pgrep -f``) of its own. Nothing
of DDS is initialised before a fork.

An executable of another package, one with a prefix such as a debugger, one for the terminal, and
one whose environment changes the interpreter are executed as ever; all are once the server has
ended.

Requests and answers are single packets: a :class:`_Request` as JSON, with the file for stdout and
stderr; the pid. The server's first packet says that it is ready.
"""

import atexit
from collections.abc import Iterable, Mapping, Sequence
import contextlib
import ctypes
import gc
import importlib
import json
import os
from pathlib import Path
import re
import runpy
import signal
import socket
import subprocess
import sys
from types import ModuleType
from typing import NamedTuple
import warnings

from amr_description.entry import OWN_NODES, python_command, use_one_blas_thread

_READY = b'ready'
_LARGEST_PACKET = 1 << 17  # bytes; the kernel takes 200 kB
_ANSWER_TIMEOUT = 5.0  # s; a fork takes some ms
_PR_SET_NAME = 15  # linux/prctl.h
_ROOM_FOR_COMMAND = 8192
"""Bytes of the server's command line, in which the programs write their own."""
_READ_AT_START = ('PYTHON', 'LANG', 'LC_', 'LD_', 'MUJOCO', 'OMP_', 'OPENBLAS', 'MALLOC')
"""What variables begin with that an interpreter or a library reads as it is loaded."""


class _Request(NamedTuple):
    """What to fork."""

    command: Sequence[str]
    environment: Mapping[str, str]


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
        self._socket, theirs = socket.socketpair(socket.AF_UNIX, socket.SOCK_SEQPACKET)
        command = python_command(
            'from amr_description.bringup import fork_server; fork_server.serve(sys.argv[1:])'
        )
        with theirs, open(os.devnull, 'wb') as nowhere:
            self._process = subprocess.Popen(
                [*command, str(theirs.fileno()), *executables, ' ' * _ROOM_FOR_COMMAND],
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
            self.is_ready = self._socket.recv(len(_READY)) == _READY
        self.is_over = not self.is_ready

    def can_start(self, command: Sequence[str], environment: Mapping[str, str]) -> bool:
        """Return whether a fork of the server is what this command would be."""
        return (
            self.is_ready
            and not self.is_over
            and len(_command_line(command)) < _ROOM_FOR_COMMAND
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
        packet = json.dumps(_Request(command, dict(environment))).encode()
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
            return self._socket.recv(_LARGEST_PACKET)
        except TimeoutError:
            self._process.kill()
            self._process.wait()
            return self._socket.recv(_LARGEST_PACKET)  # what came meanwhile, or b'': its end

    def end(self) -> None:
        """End the server, if it runs; what it has forked goes on."""
        self.is_over = True
        self._process.kill()
        self._process.wait()
        self._socket.close()


def _command_line(command: Iterable[str]) -> bytes:
    """Return a command line as ``/proc/PID/cmdline`` has it."""
    return b''.join(os.fsencode(word) + b'\0' for word in command)


def _of_interpreter(environment: Mapping[str, str]) -> dict[str, str]:
    return {k: v for k, v in environment.items() if k.startswith(_READ_AT_START)}


# --- The server ----------------------------------------------------------------------------------


def serve(arguments: Sequence[str]) -> None:
    """
    Be the server, and in each fork the program.

    Args:
        arguments: the file descriptor of its socket, the executables whose modules to import, and
            the room for command lines.
    """
    # Until entry.py unblocks it: a Ctrl-C for the stack then comes while a program starts.
    signal.pthread_sigmask(signal.SIG_BLOCK, [signal.SIGINT])
    descriptor, *executables, _ = arguments
    modules = end_without_teardown()
    _import_modules(executables)
    modules |= sys.modules
    request = None
    # Without a ConnectionError when the orchestrator is killed.
    with contextlib.suppress(ConnectionError), socket.socket(fileno=int(descriptor)) as connection:
        connection.send(_READY)
        request = _serve_requests(connection)
    if request is not None:
        _run(request)


def _import_modules(executables: Iterable[str]) -> None:
    """
    Import the executables' modules, and what these name in ``LOADED_LATER``.

    A fault shows itself again in the program.
    """
    use_one_blas_thread()
    gc.disable()  # nothing that is imported will ever be freed
    for name in executables:
        with contextlib.suppress(Exception):
            module = importlib.import_module(f'{OWN_NODES}.{name}')
            for later in getattr(module, 'LOADED_LATER', ()):
                importlib.import_module(later)
    gc.freeze()
    gc.enable()
    # The threads that this warning is about are those of LTTng, which no program needs.
    warnings.filterwarnings('ignore', 'This process .* is multi-threaded', DeprecationWarning)


def _serve_requests(connection: socket.socket) -> _Request | None:
    """Fork a program for each request; return it there, and None when the orchestrator is gone."""
    tracing = ForkTracing()
    while True:
        packet, files, _, _ = socket.recv_fds(connection, _LARGEST_PACKET, 1)
        if not packet:
            return None
        [output] = files
        gate, opened = os.pipe()
        reader, writer = os.pipe()
        tracing.before_fork()
        # The program's parent ends at once; its new one is the orchestrator.
        between = os.fork()
        if between == 0:
            os.close(opened)
            pid = os.fork()
            if pid == 0:
                tracing.after_fork_in_child()
                if not os.read(gate, 1):  # the server was ended before the parent was right
                    os._exit(1)
                for fd in (gate, reader, writer):
                    os.close(fd)
                for standard in (1, 2):
                    os.dup2(output, standard)
                os.close(output)
                os.setsid()
                return _Request(*json.loads(packet))
            os.write(writer, str(pid).encode())
            os._exit(0)
        tracing.after_fork_in_parent()
        os.waitpid(between, 0)
        connection.send(os.read(reader, 32))
        os.write(opened, b'1')
        for fd in (gate, opened, reader, writer, output):
            os.close(fd)


def _run(request: _Request) -> None:
    """Run a Python file as the main program."""
    command = list(request.command)
    _name_process(command)
    os.environ.clear()
    os.environ.update(request.environment)
    sys.argv = command
    sys.orig_argv = [sys.executable, *command]
    sys.path[0] = str(Path(command[0]).resolve().parent)
    runpy.run_path(command[0], run_name='__main__')


def _name_process(command: Sequence[str]) -> None:
    """
    Have ``ps`` show the command line and the name that the process would have been executed with.

    The kernel shows the memory that it once wrote the arguments to; its bounds are the fields 48
    and 49 of ``/proc/self/stat`` (proc(5)).
    """
    fields = Path('/proc/self/stat').read_bytes().rpartition(b')')[2].split()
    start, end = int(fields[45]), int(fields[46])
    text = _command_line([sys.executable, *command])[: end - start]
    ctypes.memmove(start, text.ljust(end - start, b'\0'), end - start)
    name = os.fsencode(Path(command[0]).name)
    ctypes.CDLL(None).prctl(_PR_SET_NAME, name, 0, 0, 0)


def end_without_teardown() -> dict[str, ModuleType]:
    """
    Have forks end without taking down the modules object by object, which copies their memory.

    That would be a third of the processor time of a short program. Call it before they are
    imported, so that what they have registered for the end comes first.

    Returns:
        Where to put the modules.
    """
    modules: dict[str, ModuleType] = {}
    ctypes.pythonapi.Py_IncRef(ctypes.py_object(modules))

    def forget() -> None:
        for name, module in modules.items():
            if sys.modules.get(name) is module and name not in ('builtins', 'sys', '__main__'):
                del sys.modules[name]

    atexit.register(forget)
    return modules


class ForkTracing:
    """
    What LTTng has to be told of a fork: it has threads, which rclpy's libraries start and end.

    Its ``liblttng-ust-fork`` does the same where it is loaded before the C library.
    """

    def __init__(self) -> None:
        maps = Path('/proc/self/maps').read_text(errors='surrogateescape')
        paths = re.findall(r'/\S*/liblttng-ust(?:-[0-9a-f]+)?\.so\S*', maps)
        self._library = ctypes.CDLL(paths[0]) if paths else None
        self._mask = ctypes.create_string_buffer(128)  # a sigset_t

    def before_fork(self) -> None:
        """Call it before; then one of the others."""
        if self._library:
            self._library.ust_before_fork(self._mask)

    def after_fork_in_child(self) -> None:
        """Call it in the process that is to live."""
        if self._library:
            self._library.ust_after_fork_child(self._mask)

    def after_fork_in_parent(self) -> None:
        """Call it in the process that forked."""
        if self._library:
            self._library.ust_after_fork_parent(self._mask)
