# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
Run a package specific executable.

What follows the executable is handed to it as it stands. Its signals are its own: Ctrl-C reaches
it from the terminal, and what another process sends to 'ros2 run' is passed on.

examples:
  ros2 run amr_description talker
  ros2 run amr_description talker --ros-args -r __ns:=/left -r topic:=chatter
  ros2 run --prefix 'gdb -ex run --args' my_package my_node
"""

from argparse import ArgumentParser, Namespace, REMAINDER
from collections.abc import Mapping, Sequence, Set
import os
from pathlib import Path
import shlex
import shutil
import signal
import sys

from amr_description.errors import AmrError, UsageError
from amr_description.stand_ins import INSTEAD_OF_PACKAGES, STAND_INS

_OURS = 'amr_description'
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


def add_arguments(parser: ArgumentParser) -> None:
    """Add the arguments of the command."""
    parser.add_argument(
        '--prefix',
        default='',
        help='Prefix command, which should go before the executable. Command must be wrapped in '
        "quotes if it contains spaces (e.g. --prefix 'gdb -ex run --args').",
    )
    parser.add_argument('package_name', help='Name of the ROS package')
    parser.add_argument('executable_name', help='Name of the executable')
    parser.add_argument('argv', nargs=REMAINDER, help='Pass arbitrary arguments to the executable')


def main(args: Namespace) -> int:
    """
    Run an executable; return its exit code, or minus the number of the signal that ended it.

    (The shell sees the last byte of that: 254 after Ctrl-C.)
    """
    from amr_description.ament_index import is_own
    from amr_description.bringup.environment import child_environment

    executable = _find(args.package_name, args.executable_name)
    command = [*_prefix(args.prefix), str(executable), *args.argv]
    environment = child_environment(executable, os.environ)
    if 'PYTHONUNBUFFERED' not in os.environ:  # is for pipes; this child may have a terminal
        environment.pop('PYTHONUNBUFFERED', None)
    sys.stdout.flush()
    # Ctrl-C while it is still being imported waits until entry.py unblocks it: Python itself would
    # print a traceback.
    unblocks = not args.prefix and executable.parent.name == _OURS and is_own(executable)
    code = run_to_end(command, environment, {signal.SIGINT} if unblocks else frozenset())
    if code:
        print(f'[ros2run]: {_end(code)}')
    return code


def _find(package: str, name: str) -> Path:
    """Return the path of an executable, or of what stands in for it. Raises AmrError."""
    from amr_description.ament_index import executables_of, is_own, overlay, packages
    from amr_description.text import did_you_mean

    known = packages()
    instead = INSTEAD_OF_PACKAGES.get(package)
    if instead and package not in known and (package, name) not in STAND_INS:
        raise AmrError(f"Package '{package}' not found: {instead}")
    others = sorted(other for owner, other in STAND_INS if owner == package)
    if package not in known and _OURS in known and others and name not in others:
        raise AmrError(f"Package '{package}' not found; of it there are here: {', '.join(others)}")
    if known and package not in known and (package, name) not in STAND_INS:
        named = did_you_mean(package, [*known, *(owner for owner, _ in STAND_INS)])
        raise AmrError(f"Package '{package}' not found{named}")
    if package in known or (package, name) not in STAND_INS or _OURS not in known:
        found = _only_one(executables_of(package), package, name)
        if package == _OURS and (first := overlay()) and is_own(found):
            lacks = f"package '{package}' of {first} has no '{name}'"
            print(f'[ros2run]: {lacks}: running {found}', file=sys.stderr)
        return found
    stand_in = STAND_INS[package, name]
    ours = executables_of(_OURS)
    if stand_in not in {path.name for path in ours}:
        raise AmrError(f"Package '{package}' not found, and {_OURS} has no '{stand_in}' yet")
    print(
        f"[ros2run]: package '{package}' is not installed: running '{stand_in}' of {_OURS}",
        file=sys.stderr,
    )
    return _only_one(ours, _OURS, stand_in)


def _only_one(executables: Sequence[Path], package: str, name: str) -> Path:
    """Return the one of that name. Raises AmrError."""
    paths = [path for path in executables if path.name == name]
    if not paths:
        from amr_description.text import did_you_mean

        names = sorted({path.name for path in executables})
        raise AmrError(
            f"No executable found: package '{package}' has no '{name}', "
            + (f'it has {", ".join(names)}' if names else 'nor any other')
            + did_you_mean(name, names)
        )
    if len(paths) > 1:
        raise AmrError('\n'.join(['Multiple executables found:', *(f'- {p}' for p in paths)]))
    return paths[0]


def _prefix(text: str) -> list[str]:
    """Return the words of ``--prefix``. Raises UsageError."""
    try:
        words = shlex.split(text)
    except ValueError as error:
        raise UsageError(f"--prefix '{text}' is not a command: {error}") from error
    if words and not shutil.which(words[0]):
        raise AmrError(f"--prefix '{text}': there is no command '{words[0]}'")
    return words


def _end(code: int) -> str:
    import signal

    if code > 0:
        return f'Process exited with failure {code}'
    return signal.strsignal(-code) or f'Signal {-code}'


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
            [*command],
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
