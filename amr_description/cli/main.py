# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
The entry point of every command, and its exit codes.

================================================  =============================  ============
what happened                                     what it prints                 exit code
================================================  =============================  ============
the verb returned                                 nothing more                   what it
                                                                                 returned
an :class:`~amr_description.errors.AmrError`      its line, on stderr            ``exit_code``
the command line is wrong                         argparse's usage and error     2
Ctrl-C                                            nothing                        2 (SIGINT)
SIGTERM while ROS is in use                       nothing                        15 (SIGTERM)
the reader of the output has closed (``| head``)  nothing                        141
the output cannot be written, as on a full disk   why, on stderr                 1
any other exception: a bug                        its traceback                  1
================================================  =============================  ============
"""

from collections.abc import Sequence
import errno
import signal
import sys

from amr_description import streams
from amr_description.errors import AmrError
from amr_description.registry import resolve

PROGRAMS = {
    'ros2': 'amr_description.cli.ros2',
    'check_urdf': 'amr_description.cli.check_urdf',
    'launch_test': 'amr_description.launch_testing.command',
}
_FULL = (errno.ENOSPC, errno.EDQUOT)


def main(command: str, argv: Sequence[str]) -> int:
    """
    Run one of :data:`PROGRAMS` with the arguments after its name; return its exit code.

    For ``sys.exit()``: all output is flushed, so nothing can fail at exit.
    """
    try:
        streams.open_missing()
        streams.make_line_buffered()
        code = resolve(f'{PROGRAMS[command]}:main')(list(argv))
        sys.stdout.flush()
        return code
    except AmrError as error:
        print(error, file=sys.stderr)
        return error.exit_code
    except KeyboardInterrupt as stop:
        return getattr(stop, 'signum', signal.SIGINT)
    except BrokenPipeError:
        streams.abandon_stdout()
        return 128 + signal.SIGPIPE
    except OSError as error:
        if error.errno not in _FULL:
            raise
        streams.abandon_stdout()
        print(f'the output cannot be written: {error.strerror}', file=sys.stderr)
        return AmrError.exit_code


def ros2() -> int:
    """Console entry of ``ros2``."""
    return main('ros2', sys.argv[1:])


def check_urdf() -> int:
    """Console entry of ``check_urdf``."""
    return main('check_urdf', sys.argv[1:])
