# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
Run tests in several processes that are forked once all of them are collected.

Each worker takes one file after the other, or several that belong together, the next ones as soon
as it begins its last test, until none are left. To import and collect all tests takes ten seconds
of processor time where their compiled files are not there yet, and four where they are; so it is
done once, not in each worker.

pytest-xdist (``-n 2 --dist loadfile``) needs more for the same on two quiet cores: 91 instead of
75 s for ``test/unit``, 102 instead of 46 s for ``test/ros``.

A worker writes no report. It sends what its tests report to the process that it was forked from,
whose plugins hear of it as if the tests ran there; of a test that failed once it was looked at
again (``second_look.py``), in a worker of its own after all others.
"""

from collections import deque
from collections.abc import Callable, Iterable, Sequence
import contextlib
from multiprocessing import connection, Pipe
from multiprocessing.connection import Connection
import os
from pathlib import Path
import pickle
import signal
import sys
import threading
import time
import traceback
from typing import Any
import warnings

import pytest
from support.second_look import SecondLook

from amr_description.forking import ForkTracing

END_TIMEOUT = 10.0
"""s that the workers have for what their tests tear down, when the run is interrupted."""

_REQUEST = 'next'
_IS_OVER = 'is over'


class ForkedWorkers:
    """
    A plugin of pytest: it runs the collected tests in workers.

    Args:
        count: How many.
        begin: Called in each worker before its first test, with the worker's number from 0.
        end: Called in each after its last test.
        groups_of: Says what each test belongs to. What belongs together runs in one worker.
        longest: s that one test may take; one that takes longer waits for ever: it fails, and
            where each of its threads stands is written to stderr. None: no bound.
        second_look: For tests that fail; None: they have failed.
    """

    def __init__(
        self,
        count: int,
        begin: Callable[[int], object],
        end: Callable[[], object],
        groups_of: Callable[[Sequence[pytest.Item]], Iterable[object]],
        longest: float | None = None,
        second_look: SecondLook | None = None,
    ) -> None:
        self._count = count
        self._second_look = second_look
        self._longest = longest
        self._groups_of = groups_of
        self._begin = begin
        self._end = end
        self._workers: dict[Connection, _Worker] = {}
        self._groups: deque[list[int]] = deque()
        self._tell: Callable[[int, list[pytest.TestReport]], None] = lambda *_: None
        self._tracing: ForkTracing | None = None

    @pytest.hookimpl(tryfirst=True)
    def pytest_runtestloop(self, session: pytest.Session) -> bool | None:
        """Run all tests, in the place of pytest's own loop."""
        option = session.config.option
        if option.collectonly or session.testsfailed and not option.continue_on_collection_errors:
            return None  # pytest itself does, and says, what is to be done
        self._run_all(session)
        if session.shouldfail:
            raise session.Failed(session.shouldfail)
        if session.shouldstop:
            raise session.Interrupted(session.shouldstop)
        return True

    def run_alone(self, session: pytest.Session, index: int) -> list[pytest.TestReport]:
        """
        Run a test once more, in a new worker, and return what it reports.

        Of a file that is marked ``in_order`` what stands before it runs before it. To be called
        when no other test runs.
        """
        reports: list[pytest.TestReport] = []

        def collect(place: int, found: list[pytest.TestReport]) -> None:
            if place == index:
                reports.extend(found)

        self._groups.append(built_upon(session.items, index))
        self._run_groups(session, collect)
        return reports

    def _run_groups(
        self, session: pytest.Session, tell: Callable[[int, list[pytest.TestReport]], None]
    ) -> None:
        """Run the groups that wait; ``tell`` takes the place of each test and its reports."""
        self._tell = tell
        self._tracing = self._tracing or ForkTracing()
        for number in range(min(self._count, len(self._groups))):
            self._fork(session, number)
        while self._workers:
            for each in connection.wait([*self._workers], self._longest):
                assert isinstance(each, Connection)
                self._workers[each].heard_at = time.monotonic()
                self._hear(session, self._workers[each])
            self._abort_silent()

    def _run_all(self, session: pytest.Session) -> None:
        """Run all tests, and those that fail once more; have the plugins hear of what counts."""
        hook, second_look = session.config.hook, self._second_look
        reporter = session.config.pluginmanager.get_plugin('terminalreporter')
        if reporter is not None:
            reporter.showfspath = False  # tests of several files come in turn

        def tell(index: int, reports: list[pytest.TestReport]) -> None:
            nodeid, location = session.items[index].nodeid, session.items[index].location
            hook.pytest_runtest_logstart(nodeid=nodeid, location=location)
            if second_look is not None and second_look.withholds(index, reports):
                if reporter is not None:
                    reporter.ensure_newline()
                    reporter.write_line(f'{nodeid} failed; it will run once more, alone')
            else:
                for report in reports:
                    hook.pytest_runtest_logreport(report=report)
            hook.pytest_runtest_logfinish(nodeid=nodeid, location=location)

        self._groups.extend(together(self._groups_of(session.items)))
        try:
            self._run_groups(session, tell)
            again = second_look.to_look_at() if second_look is not None else []
            if again and reporter is not None:
                reporter.ensure_newline()
                reporter.write_line(f'{len(again)} failed; each runs once more, alone')
            for index in again:
                if session.shouldfail or session.shouldstop:
                    break
                second_look.note(index, self.run_alone(session, index))
        finally:
            self._end_all()
            for report in second_look.results() if second_look is not None else ():
                hook.pytest_runtest_logreport(report=report)

    def _fork(self, session: pytest.Session, number: int) -> None:
        ours, theirs = Pipe()
        assert self._tracing is not None
        # Until it is a worker, which ends at Ctrl-C, a fork would go on as this process does.
        signal.pthread_sigmask(signal.SIG_BLOCK, [signal.SIGINT])
        self._tracing.before_fork()
        with warnings.catch_warnings():
            # The threads that this warning is about are those of LTTng, which no test needs.
            warnings.filterwarnings('ignore', 'This process .* is multi-threaded')
            pid = os.fork()
        if pid == 0:
            self._tracing.after_fork_in_child()
            for other in (ours, *self._workers):
                other.close()  # else nobody notices the end of this one's parent
            _be_worker(session, theirs, lambda: self._begin(number), self._end)
        self._tracing.after_fork_in_parent()
        theirs.close()
        worker = _Worker(number, pid, ours)
        self._workers[ours] = worker
        signal.pthread_sigmask(signal.SIG_UNBLOCK, [signal.SIGINT])
        self._hand_out(session, worker)

    def _hand_out(self, session: pytest.Session, worker: '_Worker') -> None:
        """Give a worker its next tests; none is the end."""
        is_over = session.shouldfail or session.shouldstop or not self._groups
        indices = [] if is_over else self._groups.popleft()
        worker.outstanding.extend(indices)
        with contextlib.suppress(OSError):  # it has ended; the next that is heard of it is that
            worker.connection.send(indices)

    def _hear(self, session: pytest.Session, worker: '_Worker') -> None:
        """Take what a worker has sent, or note its end."""
        try:
            message = worker.connection.recv()
        except (EOFError, OSError):
            self._note_end(session, worker)
            return
        if message == _REQUEST:
            self._hand_out(session, worker)
            return
        for name, arguments in message:
            self._take(session, worker, name, arguments)

    def _take(
        self, session: pytest.Session, worker: '_Worker', name: str, arguments: dict[str, Any]
    ) -> None:
        """Take a part of what a worker has reported; a test is told when it is over."""
        hook = session.config.hook
        if name == 'pytest_runtest_logreport':
            worker.reports.append(
                hook.pytest_report_from_serializable(config=session.config, data=arguments)
            )
        elif name == 'pytest_warning_recorded':
            text, category, filename, lineno = arguments.pop('warning')
            record = warnings.WarningMessage(category(text), category, filename, lineno)
            arguments['warning_message'] = record
            hook.pytest_warning_recorded.call_historic(kwargs=arguments)
        elif name == _IS_OVER:
            self._tell(worker.outstanding.popleft(), worker.take_reports())

    def _note_end(self, session: pytest.Session, worker: '_Worker') -> None:
        """Reap a worker; one that has left tests behind has failed one, another does the rest."""
        del self._workers[worker.connection]
        worker.connection.close()
        _, status = os.waitpid(worker.pid, 0)
        for pid in worker.left:
            with contextlib.suppress(ProcessLookupError):
                os.kill(pid, signal.SIGKILL)
        code = os.waitstatus_to_exitcode(status)
        if session.shouldfail or session.shouldstop or not (worker.outstanding or code):
            return
        if not worker.outstanding:
            raise RuntimeError(f'worker {worker.number} {_how_ended(code)}')
        index = worker.outstanding.popleft()
        item = session.items[index]
        report = pytest.TestReport(
            item.nodeid,
            item.location,
            {},
            'failed',
            f'the process that ran {item.nodeid} {_how_ended(code)}',
            '???',  # nobody knows
        )
        self._tell(index, [*worker.take_reports(), report])
        if worker.outstanding:
            self._groups.appendleft([*worker.outstanding])
        if self._groups:
            self._fork(session, worker.number)

    def _abort_silent(self) -> None:
        """End the workers whose test takes too long, by the signal at which pytest says where."""
        now = time.monotonic()
        for worker in self._workers.values():
            if self._longest is not None and now - worker.heard_at > self._longest:
                worker.heard_at = now
                worker.left = _descendants(worker.pid)  # it will not see to their end
                os.kill(worker.pid, signal.SIGABRT)

    def _end_all(self) -> None:
        """Interrupt the workers that are left, and wait for them."""
        for worker in self._workers.values():
            os.kill(worker.pid, signal.SIGINT)
        timer = threading.Timer(END_TIMEOUT, self._kill_all)
        timer.daemon = True
        timer.start()
        for each in [*self._workers]:
            with contextlib.suppress(EOFError, OSError):
                while True:
                    each.recv()
            os.waitpid(self._workers.pop(each).pid, 0)
        timer.cancel()

    def _kill_all(self) -> None:
        for worker in [*self._workers.values()]:
            with contextlib.suppress(ProcessLookupError):
                os.kill(worker.pid, signal.SIGKILL)


class _Worker:
    """What the parent knows of a worker; ``outstanding``: the tests that it has yet to finish."""

    def __init__(self, number: int, pid: int, link: Connection) -> None:
        self.number = number
        self.pid = pid
        self.connection = link
        self.heard_at = time.monotonic()
        self.outstanding: deque[int] = deque()
        self.left: list[int] = []
        """The processes that it had when it was aborted."""
        self.reports: list[pytest.TestReport] = []
        """Of the test that runs."""

    def take_reports(self) -> list[pytest.TestReport]:
        """Return what the test that is over has reported."""
        reports, self.reports = self.reports, []
        return reports


def built_upon(items: Sequence[pytest.Item], index: int) -> list[int]:
    """Return the places of what has to run for a test: it alone, or its file up to it."""
    item = items[index]
    if item.get_closest_marker('in_order') is None:
        return [index]
    return [place for place in range(index + 1) if items[place].path == item.path]


def together(groups: Iterable[object]) -> list[list[int]]:
    """Return the places of what is in each group, in the order in which the groups come."""
    places: dict[object, list[int]] = {}
    for place, group in enumerate(groups):
        places.setdefault(group, []).append(place)
    return [*places.values()]


def _descendants(pid: int) -> list[int]:
    found = []
    for path in Path(f'/proc/{pid}/task').glob('*/children'):
        for child in map(int, path.read_text().split()):
            found += [child, *_descendants(child)]
    return found


def _how_ended(code: int) -> str:
    return f'was killed by {signal.Signals(-code).name}' if code < 0 else f'ended with {code}'


def _be_worker(
    session: pytest.Session,
    link: Connection,
    begin: Callable[[], object],
    end: Callable[[], object],
) -> None:
    """Run what the parent sends, and end this process; called in a fork."""
    code = 1
    try:
        signal.pthread_sigmask(signal.SIG_UNBLOCK, [signal.SIGINT])
        _leave_streams_to_the_parent(session.config)
        begin()
        try:
            _run(session, link)
        except BaseException:
            # A second Ctrl-C is not to keep what has been started from its end.
            signal.signal(signal.SIGINT, signal.SIG_IGN)
            raise
        finally:
            # Of all that pytest does at the end of a session, what is for its tests.
            session.config.pluginmanager.get_plugin('runner').pytest_sessionfinish(session)
            end()
        code = 0
    except (EOFError, BrokenPipeError, KeyboardInterrupt, pytest.exit.Exception):
        pass  # the parent has ended, or ends
    except BaseException:
        traceback.print_exc()
    finally:
        with contextlib.suppress(OSError, ValueError):
            sys.stderr.flush()
        os._exit(code)


class _Colours:
    """In place of what reports in the terminal."""

    def __init__(self, writer: Any) -> None:
        self._tw = writer


def _leave_streams_to_the_parent(config: pytest.Config) -> None:
    """Capture output in files of this process, and report to nobody but the parent."""
    plugins = config.pluginmanager
    if (reporter := plugins.get_plugin('terminalreporter')) is not None:
        plugins.unregister(reporter)
        # pytest 8 asks it how to colour what an assertion says, and dies where it is not there.
        plugins.register(_Colours(reporter._tw), 'terminalreporter')
    nothing = os.open(os.devnull, os.O_RDONLY)
    os.dup2(nothing, 0)
    os.close(nothing)
    capturing = plugins.get_plugin('capturemanager')
    capturing.stop_global_capturing()
    capturing.start_global_capturing()
    capturing.suspend_global_capture()


def _run(session: pytest.Session, link: Connection) -> None:
    """Run one test after the other."""
    reporting = _Reporting(session.config, link)
    session.config.pluginmanager.register(reporting)
    # Of what the parent has heard before this worker was forked it is told anew, as the hook of
    # warnings is historic: sent back, that would be twice as much with each worker.
    reporting.forget()
    try:
        _run_all(session, link)
    finally:
        reporting.send_all()  # of a test that was interrupted


def _run_all(session: pytest.Session, link: Connection) -> None:
    indices: deque[int] = deque(link.recv())
    while indices and not (session.shouldfail or session.shouldstop):
        item = session.items[indices.popleft()]
        if not indices:
            link.send(_REQUEST)
            indices.extend(link.recv())
        item.config.hook.pytest_runtest_protocol(
            item=item, nextitem=session.items[indices[0]] if indices else None
        )


class _Reporting:
    """
    A plugin of a worker: it sends to the parent what the parent's plugins want to hear of.

    All of a test at once: to wake the parent five times for each takes more time than most tests.
    """

    def __init__(self, config: pytest.Config, link: Connection) -> None:
        self._config = config
        self._link = link
        self._reports: list[tuple[str, dict[str, Any]]] = []

    def pytest_runtest_logreport(self, report: pytest.TestReport) -> None:
        data = self._config.hook.pytest_report_to_serializable(config=self._config, report=report)
        self._reports.append(('pytest_runtest_logreport', data))

    def pytest_runtest_logfinish(self) -> None:
        self._send(_IS_OVER)
        self.send_all()

    def pytest_warning_recorded(
        self,
        warning_message: warnings.WarningMessage,
        when: str,
        nodeid: str,
        location: tuple[str, int, str] | None,
    ) -> None:
        category = warning_message.category
        try:
            pickle.dumps(category)
            category('')
        except Exception:  # of a module that only this worker has, or one that wants more words
            category = UserWarning
        self._send(
            'pytest_warning_recorded',
            warning=(
                str(warning_message.message),
                category,
                warning_message.filename,
                warning_message.lineno,
            ),
            when=when,
            nodeid=nodeid,
            location=location,
        )

    def forget(self) -> None:
        """Send nothing of what has been reported so far."""
        self._reports = []

    def _send(self, hook: str, **arguments: object) -> None:
        self._reports.append((hook, arguments))

    def send_all(self) -> None:
        """Send what has been reported since the last time."""
        if self._reports:
            self._link.send(self._reports)
            self._reports = []
