# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""Executables of this package as real processes, for tests."""

from collections.abc import Sequence
from contextlib import contextmanager
import os
import signal
import subprocess
import sys

from support import preloaded
from support.paths import ROOT
from support.running_programs import REMARK

PATIENCE = 30.0
"""s: how long a test waits for what should take a second, on a busy machine."""


def command(executable: str, *arguments: str) -> list[str]:
    """The command line of a node of this source tree."""
    return [sys.executable, '-m', f'amr_description.nodes.{executable}', *arguments]


def run(executable: str, *arguments: str) -> subprocess.CompletedProcess:
    """Run a node that ends by itself; what it says, but Fast DDS, is in ``stderr``."""
    result = preloaded.run(command(executable, *arguments), timeout=PATIENCE, env=environment())
    result.stderr = REMARK.sub('', result.stderr)
    return result


@contextmanager
def running(executable: str, *arguments: str, until: str):
    """A node that has said ``until``; it is interrupted at the end, and must leave with 0."""
    process = preloaded.Popen(
        command(executable, *arguments),
        stderr=subprocess.PIPE,
        text=True,
        env=environment(),
        start_new_session=True,
    )
    try:
        wait_for_line(process, until)
        yield process
        process.send_signal(signal.SIGINT)
        _, rest = process.communicate(timeout=PATIENCE)
        assert process.returncode == 0, rest
    finally:
        if process.poll() is None:
            process.kill()
        process.communicate()


def wait_for_line(process: subprocess.Popen, text: str) -> str:
    """Read what the process says up to the line that holds ``text``."""
    said: Sequence[str] = []
    for line in process.stderr:
        said = [*said, line]
        if text in line:
            return line
    raise AssertionError(
        f'it ended ({process.wait()}) without {text!r}, and said: {"".join(said)}'
    )


def environment() -> dict[str, str]:
    """That of the test run, with this source tree first."""
    path = os.environ.get('PYTHONPATH', '')
    return os.environ | {'PYTHONPATH': f'{ROOT}{os.pathsep}{path}', 'PYTHONUNBUFFERED': '1'}
