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
copy all their memory; and the interpreter of a program of this package is not taken down at all
(``forking.run_to_the_end``). A command that is no Python program, one with options of the
interpreter, and one whose environment changes the interpreter is started as ever.

A program that tests robots with ``amr_description.testing``, pytest among them, has a server of
its own, forked before it begins: its simulators are forked too.

``bringup`` is forked too, and then forks, as its children, what it would start of our Python
programs: its fork server, its guardian, what watches the graph. So a stack has the processes that
it always has, and comes up without the 2 s of processor time that imports take.
"""

import atexit
import contextlib
import ctypes
import faulthandler
import fcntl
import functools
import gc
import importlib
import io
import json
import os
from pathlib import Path
import pkgutil
import runpy
import signal
import socket
import struct
import subprocess
import sys
import termios
import threading
import traceback
import types
import warnings

from support.paths import ROOT

from amr_description.forking import (
    command_line,
    ForkTracing,
    load_type_supports,
    note_files_of_modules,
    run_to_the_end,
)

_MOST_FILES = 16
_LAST_WORDS = 5.0
"""s for a program that is aborted to say where its threads stand."""
_LENGTH = struct.Struct('<I')
_PID = struct.Struct('<i')
_PR_SET_NAME = 15
_PR_SET_CHILD_SUBREAPER = 36
# What an interpreter, a loader or a library reads as it starts, or as it is imported.
_READ_AT_START = ('PYTHON', 'LANG', 'LC_', 'LD_', 'RMW_', 'MUJOCO', 'OMP_', 'OPENBLAS', 'MALLOC')
_READ_LATER = ('PYTHONPATH', 'PYTHONUNBUFFERED', 'PYTHONDONTWRITEBYTECODE')
# One server has what ``ros2`` and nodes of tests load, the other our nodes and whole stacks. To
# fork takes 5 ms for each 70 MB that are loaded, so the first has nothing of the second.
_LIGHT = """
amr_description.bringup.main amr_description.cli.* argcomplete argcomplete.completers bz2
geometry_msgs.msg lifecycle_msgs.srv lzma nav_msgs.msg numpy random rosidl_generator_py
sensor_msgs.msg shutil simulation_interfaces.action simulation_interfaces.srv std_msgs.msg
std_srvs.srv tempfile tf2_msgs.msg
"""
_BRINGUP = 'amr_description.bringup.main'
_BRINGUP_SCRIPT = ('amr_description', 'bringup')
_TESTING = 'amr_description.testing'
_NODES = 'amr_description.nodes.'
_STACKS = f"""
{_BRINGUP} {_NODES}* amr_description.controllers.* amr_description.doctor.ros.collector
amr_description.hardware.* bz2 lzma shutil
"""
# How the commands of ``amr_description.entry.python_command`` and of the guardian begin.
_FORKED_BY_BRINGUP = ([sys.executable, '-P'], [sys.executable, '-I'])
_ROOM = 16_384
"""Bytes of the servers' command line, and of their environment, where programs write their own."""
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
        program = None if executable or preexec_fn or shell else _program(args)
        takes_terminal = session and os.isatty(files[0])
        if program is None or not _is_plain(variables):
            if takes_terminal:
                args = [sys.executable, '-I', '-S', '-c', _TAKE_TERMINAL, *args]
            super()._execute_child(
                args, executable, preexec_fn, close_fds, pass_fds, cwd, env, *rest
            )
            return
        request = {
            'command': [sys.executable, *(os.fsdecode(word) for word in program)],
            'kept': list(pass_fds),
            'program': [os.fsdecode(word) for word in program],
            'variables': {os.fsdecode(key): os.fsdecode(variables[key]) for key in variables},
            'folder': os.fsdecode(cwd or os.getcwd()),
            'session': session,
            'terminal': takes_terminal,
        }
        server = _server(_STACKS if _is_large(program) else _LIGHT)
        try:
            self.pid = server.start(request, [*files, *pass_fds])
            self._child_created = True
        finally:
            self._close_pipe_fds(*streams)


def run(command, *, timeout, **options):
    """
    ``subprocess.run(command, capture_output=True, text=True)``, by this ``Popen``.

    A program that does not end in time is aborted: it says where its threads stand, in what the
    TimeoutExpired has of its stderr.
    """
    pipes = {'stdout': subprocess.PIPE, 'stderr': subprocess.PIPE, 'text': True}
    with Popen(command, **pipes, **options) as process:
        try:
            out, err = process.communicate(timeout=timeout)
        except subprocess.TimeoutExpired as error:
            process.send_signal(signal.SIGABRT)
            with contextlib.suppress(subprocess.TimeoutExpired):  # a child of it has its pipes
                error.output, error.stderr = process.communicate(timeout=_LAST_WORDS)
            process.kill()
            raise
        except BaseException:
            process.kill()
            raise
    return subprocess.CompletedProcess(command, process.returncode, out, err)


def start_for(module):
    """Have a module that starts programs by ``subprocess`` start them so."""
    module.subprocess = types.SimpleNamespace(**vars(subprocess) | {'Popen': Popen})


def _program(args):
    """The words after the interpreter: ``-m MODULE``, ``-c CODE`` or a file, or None."""
    if isinstance(args, str | bytes):
        return None
    if Path(os.fsdecode(args[0])).parts[-2:] == _BRINGUP_SCRIPT:
        return args
    if len(args) < 2 or args[0] != sys.executable:
        return None
    first = os.fsdecode(args[1])
    is_known = first in ('-m', '-c') and len(args) > 2 or not first.startswith('-')
    return args[1:] if is_known else None


def _is_large(program):
    """Whether the server of whole stacks has what it loads."""
    module = os.fsdecode([*program, ''][1])
    return _is_bringup(program) or _tests_robots(program) or module.startswith(_NODES)


def _tests_robots(program):
    """Whether it may start simulators by ``amr_description.testing``."""
    text = os.fsdecode([*program, ''][1])
    return program[0] in ('-m', '-c') and (text == 'pytest' or _TESTING in text)


def _is_ours(program):
    """Whether it is one of this package's."""
    return _is_bringup(program) or program[0] == '-m' and program[1].startswith('amr_description.')


def _is_bringup(program):
    first, second = (os.fsdecode(word) for word in [*program[:2], ''][:2])
    return second == _BRINGUP or Path(first).parts[-2:] == _BRINGUP_SCRIPT


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
    """Start a server that has loaded modules."""
    ours, theirs = socket.socketpair()
    variables = {key: each for key, each in os.environ.items() if key != 'PYTHONPATH'}
    subprocess.Popen(
        [sys.executable, '-c', _SERVER, str(theirs.fileno()), *modules.split(), ' ' * _ROOM],
        # OpenBLAS's threads do not outlive a fork, and its end waits for them.
        env=variables | {'OPENBLAS_NUM_THREADS': '1', 'ROOM': ' ' * _ROOM},
        cwd=ROOT,
        pass_fds=[theirs.fileno()],
        stdin=subprocess.DEVNULL,
        start_new_session=True,
    )
    theirs.close()
    return _Server(ours)


class _Server:
    """The test's side of the interpreter that is forked; it ends with this process."""

    _lock = threading.Lock()
    """Of all servers: what takes orphans is the whole process, or is not."""

    def __init__(self, connection):
        self._libc = ctypes.CDLL(None, use_errno=True)
        self._socket = connection

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


def _serve(connection, tracing):
    """Fork a program for each request, until the test run ends; return in each program."""
    while True:
        head, files, _, _ = socket.recv_fds(connection, _LENGTH.size, _MOST_FILES)
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
                os.read(begun, 1)
                connection.detach()  # closed with the rest
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


def _fork_server(tracing):
    """
    Fork a server of the simulators that this program will start, and have it use that.

    Returns:
        None; in each of those simulators, what it is asked to be.
    """
    ours, theirs = socket.socketpair()
    tracing.before_fork()
    if os.fork():
        tracing.after_fork_in_parent()
        theirs.close()
        own = _Server(ours)
        global _server
        _server = lambda _modules: own  # noqa: E731
        start_for(importlib.import_module(f'{_TESTING}.program'))
        return None
    tracing.after_fork_in_child()
    os.setsid()  # Ctrl-C is for the program
    nothing = os.open(os.devnull, os.O_RDWR)
    _take_files({0: nothing, 1: nothing, 2: nothing, theirs.fileno(): theirs.fileno()})
    ours.detach()  # closed with the rest
    try:
        return _serve(theirs, tracing)
    except SystemExit:
        os._exit(0)  # the program has ended


def _become(request, files):
    """Make this process what an interpreter is that has just been started."""
    _take_files(dict(zip([0, 1, 2, *request['kept']], files, strict=True)))
    if request['session']:
        os.setsid()
    if request['terminal']:
        fcntl.ioctl(0, termios.TIOCSCTTY, 0)
    _take_variables(request['variables'])
    os.chdir(request['folder'])
    _show(request['command'])
    _take_streams()
    faulthandler.enable(2)  # run() asks it for what it says at SIGABRT


def _take_files(files):
    """Have files under the numbers that are the keys, and no others."""
    above = max(files) + 1
    held = {number: fcntl.fcntl(fd, fcntl.F_DUPFD, above) for number, fd in files.items()}
    for number, fd in held.items():
        os.dup2(fd, number)
    for fd in map(int, os.listdir('/proc/self/fd')):
        if fd not in files:
            with contextlib.suppress(OSError):  # that of the folder, closed by now
                os.close(fd)


def _take_variables(variables):
    os.environ.clear()
    os.environ.update(variables)


def _show(command):
    """
    Have ``ps`` and whoever reads ``/proc`` see this command, and the environment as it is now.

    The kernel shows the memory that it once wrote them to; its bounds are the fields 48 to 51 of
    ``/proc/self/stat`` (proc(5)).
    """
    fields = Path('/proc/self/stat').read_bytes().rpartition(b')')[2].split()
    bounds = [int(field) for field in fields[45:49]]
    variables = (f'{key}={each}' for key, each in os.environ.items())
    for (start, end), words in ((bounds[:2], command), (bounds[2:], variables)):
        text = command_line(words)[: end - start]
        ctypes.memmove(start, text.ljust(end - start, b'\0'), end - start)
    program = command[1] if Path(command[1]).parts[-2:] == _BRINGUP_SCRIPT else command[0]
    ctypes.CDLL(None).prctl(_PR_SET_NAME, os.fsencode(Path(program).name), 0, 0, 0)


def _take_streams():
    """Make the standard streams anew, as an interpreter with these variables has them."""
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
        if not hasattr(sys.modules.get(rest[0]), '__path__'):
            sys.modules.pop(rest[0], None)  # the main program must not be loaded under its name
        runpy.run_module(rest[0], run_name='__main__', alter_sys=True)
    elif kind == '-c':
        sys.argv = ['-c', *rest[1:]]
        sys.path[:] = dict.fromkeys(['', *path, *base])
        exec(compile(rest[0], '<string>', 'exec'), sys.modules['__main__'].__dict__)
    else:
        sys.argv = program
        sys.path[:] = dict.fromkeys([str(Path(kind).resolve().parent), *path, *base])
        runpy.run_path(kind, run_name='__main__')


def _fork_from_here(tracing):
    """Have this process, a ``bringup``, fork what it would start of our Python programs."""

    class Forking(subprocess.Popen):
        def _execute_child(
            self, args, executable, preexec_fn, close_fds, pass_fds, cwd, env, *rest
        ):
            _startup, _flags, _shell, *streams, _restore, _gid, _gids, _uid, _umask, session, _ = (
                rest
            )
            words = [os.fsdecode(word) for word in args]
            variables = dict(os.environ if env is None else env)
            if words[:2] not in _FORKED_BY_BRINGUP or not _is_plain(variables):
                super()._execute_child(
                    args, executable, preexec_fn, close_fds, pass_fds, cwd, env, *rest
                )
                return
            tracing.before_fork()
            self.pid = os.fork()
            if self.pid == 0:
                given = enumerate([streams[0], streams[3], streams[5]])
                files = {number: number if fd == -1 else fd for number, fd in given}
                files |= {fd: fd for fd in pass_fds}
                _be_a_child(words, variables, files, session, tracing)
            tracing.after_fork_in_parent()
            self._child_created = True
            self._close_pipe_fds(*streams)

    subprocess.Popen = Forking


def _be_a_child(words, variables, files, session, tracing):
    """Be what ``subprocess`` would have started, and end; in a fork."""
    try:
        signal.set_wakeup_fd(-1)  # of the bring-up's loop; only from 3.12 on asyncio does that
        for number in signal.valid_signals():
            if callable(signal.getsignal(number)):
                signal.signal(number, signal.SIG_DFL)
        if signal.getsignal(signal.SIGINT) == signal.SIG_DFL:
            signal.signal(signal.SIGINT, signal.default_int_handler)
        _take_files(files)
        if session:
            os.setsid()
        _take_variables(variables)
        _show(words)
        _take_streams()
        tracing.after_fork_in_child()
        _, *options = words
        while options[0] in ('-P', '-I', '-S'):
            del options[0]
        run_to_the_end(lambda: _execute(options, sys.path[1:]))
    except SystemExit as end:
        print(end.code, file=sys.stderr)
    except BaseException:
        traceback.print_exc()
    finally:
        os._exit(1)  # not by way of the bring-up's own frames, which are below these


def _end_without_modules():
    """
    Have forks end without taking down the modules object by object, which copies their memory.

    That would be a third of the processor time of a short program. Call it before they are
    imported, so that what they have registered for the end comes first.

    Returns:
        Where to put the modules.
    """
    modules = {}
    ctypes.pythonapi.Py_IncRef(ctypes.py_object(modules))

    def forget():
        for name, module in modules.items():
            if sys.modules.get(name) is module and name not in ('builtins', 'sys', '__main__'):
                del sys.modules[name]

    atexit.register(forget)
    return modules


def _modules(name):
    """The modules that a name stands for: those below a package, if it ends with ``*``."""
    if not name.endswith('.*'):
        return [name]
    package = importlib.import_module(name.removesuffix('.*'))
    below = pkgutil.walk_packages(package.__path__, f'{package.__name__}.')
    return [each.name for each in below if not each.name.endswith('.__main__')]


def serve(base):
    """
    Import the modules that the command line names, fork programs, and run them in the forks.

    Args:
        base: What the interpreter itself had in ``sys.path``.
    """
    loaded = _end_without_modules()
    gc.disable()  # nothing that is imported will ever be freed
    for name in sys.argv[2:-1]:
        for each in _modules(name):
            importlib.import_module(each)
    load_type_supports()
    # The threads that this warning is about are those that LTTng starts and no program needs.
    warnings.filterwarnings('ignore', 'This process .* is multi-threaded', DeprecationWarning)
    note_files_of_modules()
    gc.freeze()
    gc.enable()
    loaded |= sys.modules
    tracing = ForkTracing()
    with socket.socket(fileno=int(sys.argv[1])) as connection:
        request, files = _serve(connection, tracing)
    _become(request, files)
    tracing.after_fork_in_child()
    if _tests_robots(request['program']) and (started := _fork_server(tracing)):
        request, files = started
        _become(request, files)
        tracing.after_fork_in_child()
    if _is_bringup(request['program']):
        _fork_from_here(tracing)
    if _is_ours(request['program']):
        run_to_the_end(lambda: _execute(request['program'], base))
    else:  # a text, which may leave objects of ROS to the end of the interpreter
        _execute(request['program'], base)
