# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""Signals that ask for the end before the orchestrator listens to them: xacro may be running."""

from collections.abc import Iterator
from contextlib import contextmanager
import signal
import sys
import threading


@contextmanager
def ended_by_signals() -> Iterator[None]:
    """
    Have SIGTERM and SIGHUP unwind this block, as Ctrl-C does, with the exit code that shells give.

    An ignored one stays so (nohup). The orchestrator's own handlers replace these.
    """
    if threading.current_thread() is not threading.main_thread():  # Python handles none there
        yield
        return
    before = {number: signal.getsignal(number) for number in (signal.SIGTERM, signal.SIGHUP)}
    for number, handler in before.items():
        if handler is signal.SIG_DFL:
            signal.signal(number, _leave)
    try:
        yield
    finally:
        for number, handler in before.items():
            signal.signal(number, handler)


def _leave(number: int, _frame: object) -> None:
    sys.exit(128 + number)
