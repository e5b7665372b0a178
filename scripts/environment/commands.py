# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""Run the programs that do the work: quietly as long as they succeed, but for signs of life."""

from collections.abc import Callable, Iterator, Mapping, Sequence
from contextlib import contextmanager, suppress
import os
from pathlib import Path
import threading
from typing import TYPE_CHECKING

from . import causes, progress, SetupError

if TYPE_CHECKING:  # imported where there is something to do, which is seldom
    import subprocess

SHOWN_LINES = 15
"""Of a program that failed, where no first cause is known."""
HEARTBEAT = 10.0
"""s between two lines about a program that goes on."""
WIDTH = 70
"""Characters of its last line that are shown."""

_running: 'set[subprocess.Popen[str]]' = set()
_stopping = threading.Event()
"""What runs is to end, and nothing more to start."""


def run(
    command: Sequence[str | os.PathLike],
    environment: Mapping[str, str],
    what: str,
    folder: Path | None = None,
    count: Callable[[Sequence[str]], str] | None = None,
) -> None:
    """
    Run ``command`` in ``folder``; while it runs, say every ten seconds how far it is.

    The checkout's lock is handed on (``close_fds``), see :func:`.checkout.one_at_a_time`.

    Args:
        command: the program and its arguments.
        environment: its variables.
        what: it does, for messages.
        folder: where it runs.
        count: of its lines so far, how far it is; None, or where it returns '': its last line.

    Raises:
        SetupError: it failed: the first cause, or its last lines.
    """
    import subprocess

    if _stopping.is_set():
        raise SetupError(f'{what}: not begun')
    lines: list[str] = []
    with subprocess.Popen(
        list(map(os.fspath, command)),
        env={**environment, 'PYTHONUNBUFFERED': '1'},
        cwd=folder,
        close_fds=False,
        stdin=subprocess.DEVNULL,
        stdout=subprocess.PIPE,
        stderr=subprocess.STDOUT,
        text=True,
        errors='replace',
    ) as process:
        assert process.stdout
        _running.add(process)
        if _stopping.is_set():  # since it was asked above
            process.kill()
        reader = threading.Thread(target=lines.extend, args=(process.stdout,), daemon=True)
        reader.start()
        try:
            while reader.is_alive():
                reader.join(HEARTBEAT)
                if reader.is_alive():
                    progress(f'  {what}: {(count and count(lines)) or _last(lines)}')
        except BaseException:  # Ctrl-C
            process.kill()
            raise
        finally:
            _running.discard(process)
    if process.returncode != 0:
        if cause := causes.first_cause(lines):
            raise SetupError(f'{what} failed: {cause}')
        tail = '\n'.join(f'  | {line.rstrip()}' for line in lines[-SHOWN_LINES:])
        raise SetupError(f'{what} failed (exit code {process.returncode}):\n{tail}')


@contextmanager
def beside(work: Callable[[], object]) -> Iterator[None]:
    """
    Do ``work``, which runs commands, in a thread while inside; its failure comes at the end.

    A failure inside, or Ctrl-C, ends what it runs.
    """
    from concurrent.futures import ThreadPoolExecutor

    with ThreadPoolExecutor(1) as pool:
        future = pool.submit(work)
        try:
            yield
            future.result()
        except BaseException:
            _stopping.set()
            for process in tuple(_running):
                process.kill()
            with suppress(BaseException):
                future.result()
            _stopping.clear()
            raise


def _last(lines: Sequence[str]) -> str:
    """Return the last line that says something, as far as it fits."""
    for line in reversed(lines):
        if text := ' '.join(line.split()):
            return text if len(text) <= WIDTH else f'{text[: WIDTH - 3]}...'
    return 'at work'
