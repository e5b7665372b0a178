# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""``python -m amr_description.cli ros2 topic list``: any of the commands, without its shim."""

from collections.abc import Callable
import signal
import sys

from amr_description.entry import run


def _command() -> Callable[[], int]:
    from amr_description.cli.main import main, PROGRAMS

    if len(sys.argv) < 2 or sys.argv[1] not in PROGRAMS:
        programs = ','.join(PROGRAMS)
        print(f'usage: python -m amr_description.cli {{{programs}}} ...', file=sys.stderr)
        sys.exit(2)
    return lambda: main(sys.argv[1], sys.argv[2:])


sys.exit(run(_command, interrupted=signal.SIGINT))  # the exit code of ros2 after Ctrl-C
