# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
The entry point of every executable: Ctrl-C prints no traceback, even while libraries are imported.

``pyproject.toml`` names ``amr_description.entry:nodes.talker.main`` in place of
``amr_description.nodes.talker:main``. Importing rclpy or MuJoCo takes 0.1 s to 1 s, during which
Ctrl-C would print a traceback. There is nothing to clean up yet, so the process just exits with
code 130, as programs do on SIGINT. From its ``main`` on the program handles Ctrl-C itself; a
KeyboardInterrupt that it does not catch is quiet, too.

The start of Python and of the script that setuptools writes, some 50 ms, is not covered. A parent
process can cover it by starting the program with SIGINT blocked, as the bring-up does.
"""

from collections.abc import Callable
from contextlib import suppress
import gc
import importlib
import os
import signal
import sys

INTERRUPTED = 128 + signal.SIGINT
_BLAS_THREADS = 'OPENBLAS_NUM_THREADS'
LIFELINE_VARIABLE = 'AMR_LIFELINE_FD'
"""By which the bring-up hands its lifeline (``bringup/lifeline.py``) to the programs it starts."""


def python_command(code: str) -> tuple[str, ...]:
    """
    Return a command that runs ``code``, which imports modules of this package.

    They are those of this installation, whatever PYTHONPATH and the current folder say: a
    workspace may have a package of the same name.
    """
    folder = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))
    return (sys.executable, '-P', '-c', f'import sys; sys.path.insert(0, {folder!r}); {code}')


class LazyEntryPoint:
    """A function that is imported when called: ``LazyEntryPoint('package').module.main()``."""

    def __init__(self, path: str) -> None:
        """Store the dotted name of a package, a module or a function."""
        self.path = path

    def __getattr__(self, name: str) -> 'LazyEntryPoint':
        """Return the entry point of a member."""
        return LazyEntryPoint(f'{self.path}.{name}')

    def __call__(self) -> int | None:
        """Import the function and call it; return the exit code."""
        return run(self.find)

    def find(self) -> Callable[[], int | None]:
        """Import the function."""
        module, _, function = self.path.rpartition('.')
        return getattr(importlib.import_module(module), function)


def run(
    find: Callable[[], Callable[[], int | None]], interrupted: int = INTERRUPTED
) -> int | None:
    """
    Call the function that ``find`` imports, and return its exit code.

    SIGINT stays ignored where it was (a job in the background of a script).

    Args:
        find: imports and returns the function.
        interrupted: the exit code after Ctrl-C.
    """
    handles_sigint = signal.getsignal(signal.SIGINT) is signal.default_int_handler
    if handles_sigint:
        # No exception: during an import it could be swallowed, or reported as an ImportError.
        signal.signal(signal.SIGINT, lambda *_: os._exit(interrupted))
    # The bring-up starts executables of this package with SIGINT blocked, so that a Ctrl-C stays
    # pending until here; earlier, Python itself would print a traceback.
    if sys.platform != 'win32':
        signal.pthread_sigmask(signal.SIG_UNBLOCK, [signal.SIGINT])
    main = _imported(find)
    try:
        if handles_sigint:
            signal.signal(signal.SIGINT, signal.default_int_handler)
        return main()
    except KeyboardInterrupt:
        return interrupted
    except (OSError, RuntimeError) as error:  # RuntimeError: of Fast DDS
        if 'Too many open files' not in str(error):
            raise
        program = os.path.basename(sys.argv[0])
        print(f'{program}: too many open files: `ulimit -n` is too low here', file=sys.stderr)
        return 1


def _imported(
    find: Callable[[], Callable[[], int | None]],
) -> Callable[[], int | None]:
    """
    Import the function with the garbage collector off: what is imported stays for good.

    The collector would look through all of it several times in vain, at the end once more; without
    it 10 to 20 % of the CPU time of an import is saved (CPython 3.12).
    """
    use_one_blas_thread()
    have_home()
    was_enabled = gc.isenabled()
    gc.disable()
    try:
        return find()
    finally:
        gc.freeze()
        if was_enabled:
            gc.enable()


def use_one_blas_thread() -> None:
    """
    Have numpy, when it is imported, start no threads.

    Its OpenBLAS starts one for each processor, which waits for its first work in a loop; no matrix
    here is large enough for two. One thread will do, in this process alone: what it starts gets
    ``os.environ``, which does not change.
    """
    if _BLAS_THREADS not in os.environ:
        os.putenv(_BLAS_THREADS, '1')


def have_home() -> None:
    """
    Have ``HOME``, below which ROS writes its logs, where the environment lacks it.

    So it is for cron, systemd, ``env -i`` and in some containers. rcl then ends every program with
    eleven lines about its own errors.
    """
    if os.environ.get('HOME') or os.environ.get('ROS_LOG_DIR') or sys.platform == 'win32':
        return
    import pwd

    with suppress(KeyError):  # a user without an entry
        os.environ['HOME'] = pwd.getpwuid(os.getuid()).pw_dir


_package = LazyEntryPoint(__package__)
bringup, nodes, testing = _package.bringup, _package.nodes, _package.testing
simulation, trials = _package.simulation, _package.trials
OWN_NODES: str = nodes.path
"""The package whose modules are the nodes, named as their executables."""
xacro = LazyEntryPoint('xacro')
