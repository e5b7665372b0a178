# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""Run the programs that do the work, quietly as long as they succeed."""

from collections.abc import Mapping, Sequence
import os
from pathlib import Path
import subprocess

from . import SetupError

SHOWN_LINES = 15


def run(
    command: Sequence[str | os.PathLike],
    environment: Mapping[str, str],
    what: str,
    folder: Path | None = None,
) -> None:
    """
    Run ``command`` in ``folder``; raise :class:`SetupError` with its last lines when it fails.

    The checkout's lock is handed on (``close_fds``), see :func:`.checkout.one_at_a_time`.
    """
    done = subprocess.run(
        list(map(os.fspath, command)),
        env=dict(environment),
        cwd=folder,
        close_fds=False,
        stdin=subprocess.DEVNULL,
        stdout=subprocess.PIPE,
        stderr=subprocess.STDOUT,
        text=True,
        errors='replace',
    )
    if done.returncode != 0:
        tail = '\n'.join(f'  | {line}' for line in done.stdout.splitlines()[-SHOWN_LINES:])
        raise SetupError(f'{what} failed (exit code {done.returncode}):\n{tail}')
