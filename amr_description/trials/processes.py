# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
Runs in processes of this machine, each of which may hang or die without harm to the others.

Each is a :class:`~concurrent.futures.ProcessPoolExecutor` of one worker, so that it is known whose
run was lost when one breaks, and which process is to be killed when a run takes too long.
"""

from collections.abc import Callable, Generator, Iterable, Iterator
from concurrent.futures import FIRST_COMPLETED, Future, ProcessPoolExecutor, wait
from concurrent.futures.process import BrokenProcessPool
from contextlib import contextmanager, suppress
from dataclasses import dataclass
import math
import multiprocessing
from multiprocessing.connection import wait as wait_for_sentinels
from multiprocessing.process import BaseProcess
import os
import signal
import sys
import threading
import time
import types

from amr_description.entry import use_one_blas_thread
from amr_description.errors import TrialsError
from amr_description.trials.one_run import Ending, run_task, Task, TrialRun

_PRELOADED = ['amr_description.trials.one_run']
_START_TIMEOUT = 120.0
"""s; a process has imported the engine by then, on the busiest machine."""
_KILL = getattr(signal, 'SIGKILL', signal.SIGTERM)  # Windows has but the latter, which is the same


@dataclass(frozen=True)
class Lost:
    """A run that has told nothing."""

    kind: Ending
    message: str


class RunnerProcesses:
    """Processes that run tasks; ``with`` ends them."""

    def __init__(self, count: int, timeout: float) -> None:
        """
        Start none yet.

        Args:
            count: How many at once.
            timeout: s that a run may take.
        """
        self._count, self._timeout = count, timeout
        self._workers: list[_Worker] = []

    def __enter__(self) -> 'RunnerProcesses':
        return self

    def __exit__(self, *of_error: object) -> None:
        for worker in self._workers:
            worker.end()

    def run(self, tasks: Iterable[Task]) -> Generator[tuple[Task, TrialRun | Lost], None, None]:
        """
        Run tasks; yield each with what became of it, as they are done.

        Raises:
            TrialsError: No process starts.
        """
        waiting = iter(tasks)
        busy: list[_Worker] = []
        for task in waiting:
            while len(busy) >= self._count:
                yield from self._done(busy)
            worker = next((each for each in self._workers if each not in busy), None)
            if worker is None:
                worker = _Worker()
                self._workers.append(worker)
            worker.begin(task)
            busy.append(worker)
        while busy:
            yield from self._done(busy)

    def _done(self, busy: 'list[_Worker]') -> 'Iterator[tuple[Task, TrialRun | Lost]]':
        """Wait for one at least; those that are done are busy no more."""
        first = min(worker.begun for worker in busy) + self._timeout - time.monotonic()
        patience = None if math.isinf(first) else max(0.0, first)
        wait([worker.future for worker in busy], patience, FIRST_COMPLETED)
        for worker in tuple(busy):
            hangs = time.monotonic() >= worker.begun + self._timeout
            if worker.future.done() or hangs:
                busy.remove(worker)
                result = worker.result(self._timeout)
                if isinstance(result, Lost):
                    self._workers.remove(worker)
                yield worker.task, result


class _Worker:
    """A process, and what it does."""

    def __init__(self) -> None:
        """Start it. Raises TrialsError."""
        self.task: Task
        self.begun = 0.0
        """When it was given its task, by ``time.monotonic``."""
        self.future: Future[TrialRun]
        known = {each.pid for each in multiprocessing.active_children()}
        with _without_main():
            context = _context()
            self._pool = ProcessPoolExecutor(1, mp_context=context, initializer=_prepare)
            ready = self._pool.submit(os.getpid)
        try:
            self._pid = ready.result(_START_TIMEOUT)
        except (BrokenProcessPool, TimeoutError) as error:
            self._pool.shutdown(wait=False, cancel_futures=True)
            raise TrialsError(f'a process for trials does not start: {error}') from error
        self._process: BaseProcess | None = next(
            (each for each in multiprocessing.active_children() if each.pid == self._pid), None
        )
        assert self._pid not in known, 'it is a new one'

    def begin(self, task: Task) -> None:
        """Give it a task."""
        self.task, self.begun = task, time.monotonic()
        self.future = self._pool.submit(run_task, task)

    def result(self, timeout: float) -> TrialRun | Lost:
        """Return what became of its task, which is done or hangs; then it is killed."""
        if not self.future.done():
            self._kill()
            self.end()
            return Lost(Ending.HUNG, f'not done after {timeout:g} s')
        try:
            return self.future.result()
        except BrokenProcessPool:
            self.end()
            return Lost(Ending.DIED, self._how_it_ended())

    def end(self) -> None:
        """End it, at once if it is in a run."""
        if hasattr(self, 'future') and not self.future.done():
            self._kill()
        self._pool.shutdown(wait=True, cancel_futures=True)

    def _kill(self) -> None:
        with suppress(ProcessLookupError):
            os.kill(self._pid, _KILL)

    def _how_it_ended(self) -> str:
        code = None
        if self._process is not None:
            self._process.join(1.0)
            code = self._process.exitcode
        if code is None:
            return 'its process ended'
        if code < 0:
            return f'its process ended by {signal.Signals(-code).name}'
        return f'its process ended with exit code {code}'


def _context() -> multiprocessing.context.BaseContext:
    """
    Return how processes start: forked from a process that has only imported, where there is that.

    A fork of this one would have its locks, without the threads that hold them.
    """
    use_one_blas_thread()
    if 'forkserver' not in multiprocessing.get_all_start_methods():
        return multiprocessing.get_context('spawn')
    context = multiprocessing.get_context('forkserver')
    context.set_forkserver_preload(_PRELOADED)
    return context


@contextmanager
def _without_main() -> Iterator[None]:
    """
    Have a new process not run the script again, as multiprocessing does.

    A trial in it is found by its file; so the script need not ask whether it is ``__main__``.
    """
    main = sys.modules['__main__']
    sys.modules['__main__'] = types.ModuleType('__main__')
    try:
        yield
    finally:
        sys.modules['__main__'] = main


def _prepare() -> None:
    """Begin a process: Ctrl-C is for who started it, and it does not outlive that one."""
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    parent = multiprocessing.parent_process()
    if parent is not None:
        threading.Thread(target=_end_with, args=(parent.sentinel,), daemon=True).start()


def _end_with(sentinel: int) -> None:
    wait_for_sentinels([sentinel])
    os._exit(1)


def in_executor(
    submit: Callable[[Callable[[Task], TrialRun], Task], 'Future[TrialRun]'],
    tasks: Iterable[Task],
    most: int,
) -> Iterator[tuple[Task, TrialRun | Lost]]:
    """
    Run tasks where an executor says; yield each with what became of it, as they are done.

    Args:
        submit: Of the executor.
        tasks: To be run.
        most: That are submitted at once.
    """
    pending: dict[Future[TrialRun], Task] = {}
    try:
        for task in tasks:
            try:
                future = submit(run_task, task)
            except Exception as error:  # broken, or shut down
                yield task, Lost(Ending.DIED, _said(error))
                continue
            pending[future] = task
            if len(pending) >= most:
                yield from _completed(pending)
        while pending:
            yield from _completed(pending)
    finally:
        for future in pending:
            future.cancel()


def _completed(pending: 'dict[Future[TrialRun], Task]') -> Iterator[tuple[Task, TrialRun | Lost]]:
    done, _ = wait(pending, return_when=FIRST_COMPLETED)
    for future in done:
        task = pending.pop(future)
        error = future.exception()
        yield task, future.result() if error is None else Lost(Ending.DIED, _said(error))


def _said(error: BaseException) -> str:
    """Return what an executor says of a run that it has lost, in one line."""
    return f'its worker ended: {type(error).__name__}: {" ".join(str(error).split())}'[:300]
