# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
Repeat tests beside a load, and say how often and where they fail: ``scripts/flaky``.

Each run is a new process with a domain of its own, like the second look of ``second_look.py``.
What a failed run left is kept in ``build/tests/flaky/``, by its number.
"""

from collections import Counter, defaultdict
from collections.abc import Iterator
import contextlib
import os
import shutil
import subprocess
import sys

import pytest
from support import failures, second_look
from support.forked_workers import ForkedWorkers

_USE_TIME = """
import os
parent = os.getppid()
while os.getppid() == parent:
    sum(range(100_000))
"""


class Repeating:
    """A plugin of pytest: it runs the collected tests a number of times, in the place of once."""

    def __init__(self, workers: ForkedWorkers, runs: int, load: int) -> None:
        """``load``: how many processes use all the processor time that they get meanwhile."""
        self._workers = workers
        self._runs = runs
        self._load = load
        self._done: Counter[str] = Counter()
        self._falls: defaultdict[str, Counter[str]] = defaultdict(Counter)

    @pytest.hookimpl(tryfirst=True)
    def pytest_runtestloop(self, session: pytest.Session) -> bool:
        """Run all tests, then all of them again, as often as was asked for."""
        with busy_processes(self._load):
            for run in range(1, self._runs + 1):
                for index, item in enumerate(session.items):
                    reports = self._workers.run_alone(session, index)
                    for report in reports:
                        session.config.hook.pytest_runtest_logreport(report=report)
                    if failed := [report for report in reports if report.failed]:
                        self._note_fall(run, failed[0])  # its tear-down may fail after it
                    self._done[item.nodeid] += 1
        return True

    def _note_fall(self, run: int, report: pytest.TestReport) -> None:
        self._falls[report.nodeid][place_of(report)] += 1
        left = failures.folder_of(report.nodeid)
        kept = second_look.FLAKY / left.name / f'run-{run}'
        with contextlib.suppress(OSError):  # a full disk is no reason to stop
            shutil.rmtree(kept, ignore_errors=True)
            kept.parent.mkdir(parents=True, exist_ok=True)
            shutil.move(left, kept)

    def pytest_terminal_summary(self, terminalreporter: pytest.TerminalReporter) -> None:
        """Say how often each test fell, and where."""
        for nodeid, runs in self._done.items():
            falls = self._falls[nodeid]
            terminalreporter.write_line(f'{nodeid}: fell {falls.total()} of {runs} times')
            for place, count in falls.most_common():
                terminalreporter.write_line(f'    {count} × {place}')
        if any(self._falls.values()):
            terminalreporter.write_line(f'what they said: {second_look.FLAKY}')


def place_of(report: pytest.TestReport) -> str:
    """Return where a test failed and the first line of how, in one line."""
    crash = getattr(report.longrepr, 'reprcrash', None)
    if crash is None:
        return str(report.longrepr).strip().partition('\n')[0]
    return f'{os.path.relpath(crash.path)}:{crash.lineno}: {crash.message.partition(chr(10))[0]}'


@contextlib.contextmanager
def busy_processes(count: int) -> Iterator[None]:
    """Have processes use all the time of a processor that they get; they end with this one."""
    command = [sys.executable, '-SEc', _USE_TIME]
    # In a session of their own: Ctrl-C is for the tests, which end them.
    processes = [subprocess.Popen(command, start_new_session=True) for _ in range(count)]
    try:
        yield
    finally:
        for process in processes:
            process.kill()
            process.wait()
