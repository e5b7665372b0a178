# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
Start Python programs from an interpreter that has loaded their modules already.

A program of ours spends most of its start on imports: 0.2 s of processor time for ``ros2``, 0.8 s
for the simulator; a whole run of the tests starts a thousand. ``Popen`` is that of ``subprocess``,
but a Python program is forked from a server that has done nothing but import. The program is a
process and a child of the test all the same: with a pid, session, environment, folder, streams,
signals and an end of its own, and nothing of DDS is initialised before.

What differs: its modules are loaded before it asks for them, so a test of what a program imports
must use ``subprocess``; these modules are not taken down object by object at its end, which would
copy all their memory; and ``/proc/PID/cmdline`` is the server's. A command that is no Python
program, one with options of the interpreter, and one whose environment changes the interpreter is
started as ever.
"""

import ctypes
import fcntl
import functools
import gc
import importlib
import io
import json
import os
from pathlib import Path
import runpy
import socket
import struct
import subprocess
import sys
import termios
import threading
import warnings

from support.paths import ROOT

from amr_description.forking import end_without_teardown, ForkTracing

_LENGTH = struct.Struct('<I')
_PID = struct.Struct('<i')
_PR_SET_CHILD_SUBREAPER = 36
# What an interpreter, a loader or a library reads as it starts, or as it is imported.
_READ_AT_START = ('PYTHON', 'LANG', 'LC_', 'LD_', 'RMW_', 'MUJOCO', 'OMP_', 'OPENBLAS', 'MALLOC')
_READ_LATER = ('PYTHONPATH', 'PYTHONUNBUFFERED', 'PYTHONDONTWRITEBYTECODE')
# One server has what ``ros2`` and most nodes load, the other the simulator.
_LIGHT = """
amr_description.cli.main amr_description.cli.ros2 amr_description.cli.action.send_goal
amr_description.cli.lifecycle amr_description.cli.param.load amr_description.cli.service.call
amr_description.cli.topic.echo amr_description.cli.topic.hz amr_description.cli.topic.pub
amr_description.nodes.spawner numpy rosidl_generator_py std_msgs.msg std_srvs.srv
"""
_SIMULATOR = 'amr_description.nodes.mujoco_sim'
_SERVER = f"""
import sys
base = sys.path[1:]
sys.path[:0] = [{str(ROOT)!r}, {str(ROOT / 'test')!r}]
from support import preloaded
preloaded.serve(base)
"""
# Have an interpreter take the terminal at its stdin as a terminal emulator does, then become
# another program.
_TAKE_TERMINAL = """
import fcntl, os, sys, termios
fcntl.ioctl(0, termios.TIOCSCTTY, 0)
os.execvp(sys.argv[1], sys.argv[1:])
"""


class Popen(subprocess.Popen):
    """
    ``subprocess.Popen``, quicker for Python programs.

    A program with a session of its own has the terminal at its stdin as its controlling one.
    """

    def _execute_child(self, args, executable, preexec_fn, close_fds, pass_fds, cwd, env, *rest):
        _startup, _flags, shell, *streams, _restore, _gid, _gids, _uid, _umask, session, _ = rest
        given = [streams[0], streams[3], streams[5]]
        files = [own if fd == -1 else fd for fd, own in zip(given, range(3), strict=True)]
        variables = dict(os.environ if env is None else env)
        program = None if executable or preexec_fn or pass_fds or shell else _program(args)
        takes_terminal = session and os.isatty(files[0])
        if program is None or not _is_plain(variables):
            if takes_terminal:
                args = [sys.executable, '-I', '-S', '-c', _TAKE_TERMINAL, *args]
            super()._execute_child(
                args, executable, preexec_fn, close_fds, pass_fds, cwd, env, *rest
            )
            return
        request = {
            'program': [os.fsdecode(word) for word in program],
            'variables': {os.fsdecode(key): os.fsdecode(variables[key]) for key in variables},
            'folder': os.fsdecode(cwd or os.getcwd()),
            'session': session,
            'terminal': takes_terminal,
        }
        server = _server(_SIMULATOR if _SIMULATOR in program else _LIGHT)
        try:
            self.pid = server.start(request, files)
            self._child_created = True
        finally:
            self._close_pipe_fds(*streams)


def run(command, *, timeout, **options):
    """``subprocess.run(command, capture_output=True, text=True)``, by this ``Popen``."""
    pipes = {'stdout': subprocess.PIPE, 'stderr': subprocess.PIPE, 'text': True}
    with Popen(command, **pipes, **options) as process:
        try:
            out, err = process.communicate(timeout=timeout)
        except BaseException:
            process.kill()
            raise
    return subprocess.CompletedProcess(command, process.returncode, out, err)


def _program(args):
    """The words after the interpreter: ``-m MODULE``, ``-c CODE`` or a file, or None."""
    if isinstance(args, str | bytes) or len(args) < 2 or args[0] != sys.executable:
        return None
    first, second = (os.fsdecode(word) for word in [*args[1:3], ''][:2])
    if second.startswith('amr_description.bringup'):
        return None  # it loads next to nothing, and looks at processes and their command lines
    is_known = first in ('-m', '-c') and len(args) > 2 or not first.startswith('-')
    return args[1:] if is_known else None


def _is_plain(variables):
    """Whether an interpreter with these variables starts as the server did."""

    def of_interpreter(table):
        return {
            key: value
            for key, value in table.items()
            if key.startswith(_READ_AT_START) and key not in _READ_LATER
        }

    return of_interpreter(variables) == of_interpreter(os.environ)


@functools.cache
def _server(modules):
    return _Server(modules)


class _Server:
    """The test's side of the interpreter that is forked; it ends with the test run."""

    def __init__(self, modules):
        self._lock = threading.Lock()
        self._libc = ctypes.CDLL(None, use_errno=True)
        self._socket, theirs = socket.socketpair()
        variables = {key: each for key, each in os.environ.items() if key != 'PYTHONPATH'}
        subprocess.Popen(
            [sys.executable, '-c', _SERVER, str(theirs.fileno()), *modules.split()],
            # OpenBLAS's threads do not outlive a fork, and its end waits for them.
            env=variables | {'OPENBLAS_NUM_THREADS': '1'},
            cwd=ROOT,
            pass_fds=[theirs.fileno()],
            stdin=subprocess.DEVNULL,
            start_new_session=True,
        )
        theirs.close()

    def start(self, request, files):
        """Have a program forked that becomes a child of this process; return its pid."""
        data = json.dumps(request).encode()
        with self._lock:
            # The program's parent ends at once, and who takes orphans is this process, for now.
            self._libc.prctl(_PR_SET_CHILD_SUBREAPER, 1)
            try:
                socket.send_fds(self._socket, [_LENGTH.pack(len(data))], files)
                self._socket.sendall(data)
                reply = self._socket.recv(_PID.size, socket.MSG_WAITALL)
            finally:
                self._libc.prctl(_PR_SET_CHILD_SUBREAPER, 0)
        return _PID.unpack(reply)[0]


def _serve(connection):
    """Fork a program for each request, until the test run ends; return in each program."""
    tracing = ForkTracing()
    while True:
        head, files, _, _ = socket.recv_fds(connection, _LENGTH.size, 3)
        if not head:
            sys.exit()
        request = json.loads(connection.recv(_LENGTH.unpack(head)[0], socket.MSG_WAITALL))
        reader, writer = os.pipe()
        begun, held = os.pipe()
        tracing.before_fork()
        between = os.fork()
        if between == 0:
            os.close(held)
            pid = os.fork()
            if pid == 0:
                tracing.after_fork_in_child()
                os.read(begun, 1)
                for fd in (reader, writer, begun):
                    os.close(fd)
                connection.close()
                return request, files
            os.write(writer, _PID.pack(pid))
            os._exit(0)
        tracing.after_fork_in_parent()
        os.waitpid(between, 0)
        os.close(held)  # the program has its new parent now, and begins
        for fd in (begun, *files):
            os.close(fd)
        connection.sendall(os.read(reader, _PID.size))
        os.close(reader)
        os.close(writer)


def _become(request, files):
    """Make this process what an interpreter is that has just been started."""
    for fd, standard in zip(files, range(3), strict=True):
        os.dup2(fd, standard)
        os.close(fd)
    if request['session']:
        os.setsid()
    if request['terminal']:
        fcntl.ioctl(0, termios.TIOCSCTTY, 0)
    os.environ.clear()
    os.environ.update(request['variables'])
    os.chdir(request['folder'])
    unbuffered = bool(os.environ.get('PYTHONUNBUFFERED'))
    sys.dont_write_bytecode = bool(os.environ.get('PYTHONDONTWRITEBYTECODE'))
    for fd, name in enumerate(('stdin', 'stdout', 'stderr')):
        stream = _stream(fd, getattr(sys, name), unbuffered)
        setattr(sys, name, stream)
        setattr(sys, f'__{name}__', stream)


def _stream(fd, like, unbuffered):
    """A standard stream as the interpreter makes it."""
    raw = io.FileIO(fd, 'w' if fd else 'r', closefd=False)
    raw.name = like.name
    buffered = io.BufferedWriter if fd else io.BufferedReader
    return io.TextIOWrapper(
        raw if unbuffered and fd else buffered(raw),
        encoding=like.encoding,
        errors=like.errors,
        line_buffering=not unbuffered and (fd == 2 or os.isatty(fd)),
        write_through=unbuffered,
    )


def _execute(program, base):
    """Run ``-m MODULE``, ``-c CODE`` or a file as the main program."""
    kind, *rest = program
    path = [folder for folder in os.environ.get('PYTHONPATH', '').split(os.pathsep) if folder]
    if kind == '-m':
        sys.argv = rest
        sys.path[:] = dict.fromkeys([os.getcwd(), *path, *base])
        runpy.run_module(rest[0], run_name='__main__', alter_sys=True)
    elif kind == '-c':
        sys.argv = ['-c', *rest[1:]]
        sys.path[:] = dict.fromkeys(['', *path, *base])
        exec(compile(rest[0], '<string>', 'exec'), sys.modules['__main__'].__dict__)
    else:
        sys.argv = program
        sys.path[:] = dict.fromkeys([str(Path(kind).resolve().parent), *path, *base])
        runpy.run_path(kind, run_name='__main__')


def serve(base):
    """
    Import the modules that the command line names, fork programs, and run them in the forks.

    Args:
        base: What the interpreter itself had in ``sys.path``.
    """
    loaded = end_without_teardown()
    for name in sys.argv[2:]:
        importlib.import_module(name)
    for name in [name for name in sys.modules if name.startswith('amr_description.nodes.')]:
        del sys.modules[name]  # what is run as the main program must not be loaded under its name
    # The threads that this warning is about are those that LTTng starts and no program needs.
    warnings.filterwarnings('ignore', 'This process .* is multi-threaded', DeprecationWarning)
    gc.freeze()
    loaded |= sys.modules
    with socket.socket(fileno=int(sys.argv[1])) as connection:
        request, files = _serve(connection)
    _become(request, files)
    _execute(request['program'], base)
