# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
The fork server of ``bringup/fork_server.py``: an interpreter that is forked into programs.

It imports next to nothing beside the modules of the programs: they wait for it.
"""

import atexit
from collections.abc import Callable, Iterable, Mapping, Sequence
import contextlib
import ctypes
import gc
import importlib
import inspect
import json
import os
from pathlib import Path
import re
import runpy
import signal
import socket
import sys
import threading
from typing import NamedTuple
import warnings

from amr_description.entry import OWN_NODES, use_one_blas_thread

READY = b'ready'
LARGEST_PACKET = 1 << 17  # bytes; the kernel takes 200 kB
_OF_EACH_NODE = (
    'rosidl_generator_py.import_type_support_impl', 'service_msgs.msg',
    'type_description_interfaces.msg',
)  # fmt: skip
"""What rclpy imports only as it makes the first node, and its services."""
_PR_SET_NAME = 15  # linux/prctl.h


class ForkRequest(NamedTuple):
    """What to fork."""

    command: Sequence[str]
    environment: Mapping[str, str]


def command_line(command: Iterable[str]) -> bytes:
    """Return a command line as ``/proc/PID/cmdline`` has it."""
    return b''.join(os.fsencode(word) + b'\0' for word in command)


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
    _import_modules(executables)
    request = None
    # Without a ConnectionError when the orchestrator is killed.
    with contextlib.suppress(ConnectionError), socket.socket(fileno=int(descriptor)) as connection:
        connection.send(READY)
        request = _serve_requests(connection)
    if request is not None:
        run_to_the_end(lambda: _run(request))


def _import_modules(executables: Iterable[str]) -> None:
    """Import the executables' modules; a fault shows itself again in the program."""
    use_one_blas_thread()
    gc.disable()  # nothing that is imported will ever be freed
    for name in executables:
        with contextlib.suppress(Exception):
            importlib.import_module(f'{OWN_NODES}.{name}')
    load_type_supports()
    note_files_of_modules()
    gc.freeze()
    gc.enable()
    # The threads that this warning is about are those of LTTng, which no program needs.
    warnings.filterwarnings('ignore', 'This process .* is multi-threaded', DeprecationWarning)


def load_type_supports() -> None:
    """
    Load the libraries of the message packages that are imported, for all forks at once.

    Each program loads those of its messages otherwise, when it makes its first node and its first
    publishers: some 40 ms of processor time; and 15 ms for what only a node needs.
    """
    if 'rclpy.node' in sys.modules:
        for name in _OF_EACH_NODE:
            importlib.import_module(name)
    kinds = ('.msg', '.srv', '.action')
    for package in {name.partition('.')[0] for name in sys.modules if name.endswith(kinds)}:
        with contextlib.suppress(ImportError):  # a package with such a module, but no messages
            importlib.import_module(f'{package}.{package}_s__rosidl_typesupport_c')


def note_files_of_modules() -> None:
    """
    Note the file of each module, for all forks at once.

    The first line that a program logs has ``inspect`` do so, as rclpy looks for its caller: 18 ms
    of processor time.
    """
    inspect.getmodule(sys._getframe())


def _serve_requests(connection: socket.socket) -> ForkRequest | None:
    """Fork a program for each request; return it there, and None when the orchestrator is gone."""
    tracing = ForkTracing()
    while True:
        packet, files, _, _ = socket.recv_fds(connection, LARGEST_PACKET, 1)
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
                return ForkRequest(*json.loads(packet))
            os.write(writer, str(pid).encode())
            os._exit(0)
        tracing.after_fork_in_parent()
        os.waitpid(between, 0)
        connection.send(os.read(reader, 32))
        os.write(opened, b'1')
        for fd in (gate, opened, reader, writer, output):
            os.close(fd)


def _run(request: ForkRequest) -> None:
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
    text = command_line([sys.executable, *command])[: end - start]
    ctypes.memmove(start, text.ljust(end - start, b'\0'), end - start)
    name = os.fsencode(Path(command[0]).name)
    ctypes.CDLL(None).prctl(_PR_SET_NAME, name, 0, 0, 0)


def run_to_the_end(program: Callable[[], object]) -> None:
    """
    Run a program in a fork, and end the process without taking down the interpreter.

    That would look at every module and each name that is known, and so copy their memory: 10 ms of
    processor time, half of what a short program takes. What Python promises of an end is kept:
    threads are waited for, functions of ``atexit`` are called, all that was written is flushed. It
    returns, or raises what the program raised, where the interpreter has to say something.

    Args:
        program: its main function; may raise SystemExit.
    """
    code = 0
    try:
        program()
    except SystemExit as end:
        if isinstance(end.code, str):
            raise
        code = end.code or 0
    threading._shutdown()  # type: ignore[attr-defined]  # as multiprocessing ends its processes
    atexit._run_exitfuncs()
    try:
        for stream in (sys.stdout, sys.stderr):
            if stream is not None:
                stream.flush()
    except (OSError, ValueError):
        sys.exit(code)  # the interpreter tells that it cannot be written
    ctypes.CDLL(None).fflush(None)
    os._exit(code)


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
