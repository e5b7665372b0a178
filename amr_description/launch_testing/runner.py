# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""A run of a launch test: its processes, the tests beside them, and those after them."""

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
import threading
from typing import Any
import unittest

from amr_description.launch_api.events import (
    ProcessEvent,
    ProcessExited,
    ProcessIO,
    ProcessStarted,
)
from amr_description.launch_api.service import LaunchService
from amr_description.launch_testing.handlers import ActiveIoHandler, ActiveProcInfoHandler
from amr_description.launch_testing.loading import TestRun

_STOPPED_EARLY = 'the processes under test ended before the tests did'


@dataclass
class RunResult:
    """How a run went."""

    run: TestRun
    results: Sequence[unittest.TestResult] = ()
    failure: str = ''
    """Why it could not go to its end; '': it did."""
    skipped: str = ''
    """Why it was skipped; '': it was not."""

    @property
    def is_successful(self) -> bool:
        """Whether nothing has failed."""
        return not self.failure and all(each.wasSuccessful() for each in self.results)

    @property
    def failures(self) -> Iterator[tuple[str, str]]:
        """Yield the name and the traceback of each test that failed."""
        if self.failure:
            yield self.run.name, self.failure
        for result in self.results:
            for test, text in [*result.errors, *result.failures]:
                yield test.id(), text
            for unexpected in result.unexpectedSuccesses:
                yield unexpected.id(), 'a success that was not expected'


class LaunchProgress:
    """How far a launch is, by its own thread."""

    def __init__(self) -> None:
        self.may_begin = self.has_ended = False
        self.awake = threading.Event()
        """Set when one of them is true."""

    def begin(self) -> None:
        """Have the tests begin."""
        self.may_begin = True
        self.awake.set()

    def end(self) -> None:
        """Note that no process is left."""
        self.has_ended = True
        self.awake.set()


class ProcessLog:
    """What is known of the processes of a service, for its tests."""

    def __init__(self, service: LaunchService) -> None:
        self.info, self.output = ActiveProcInfoHandler(), ActiveIoHandler()
        service.listeners.append(self._take)

    def _take(self, event: ProcessEvent) -> None:
        if isinstance(event, ProcessIO):
            self.output.append(event)
            return
        if isinstance(event, ProcessStarted):
            self.output.track(event.process_name)
        self.info.append(event)

    def early_ends(self) -> str:
        """Return what the processes that failed have written, for a report."""
        lines = []
        for event in self.info:
            if isinstance(event, ProcessExited) and event.returncode != 0:
                lines.append(f'{event.process_name} exited with code {event.returncode}')
                if event.action in self.output.processes():
                    texts = (
                        line.text.decode(errors='replace') for line in self.output[event.action]
                    )
                    lines.append(''.join(texts))
        return '\n'.join(lines)


def run_tests(run: TestRun, arguments: Mapping[str, str], *, verbosity: int = 2) -> RunResult:
    """
    Do one run.

    Args:
        run: What is to be run, and tested.
        arguments: Launch configurations; tests have them as ``test_args``.
        verbosity: As of unittest.

    Raises:
        LaunchTestError, BringupError: it is not as it has to be.
    """
    progress = LaunchProgress()
    try:
        description = run.describe(progress.begin)
    except unittest.SkipTest as skip:
        return RunResult(run, skipped=str(skip) or 'no reason is given')
    service = LaunchService()
    recorder = ProcessLog(service)
    objects: dict[str, Any] = {**description.context, **run.parameters, 'test_args': arguments}
    active = {
        'launch_service': service, 'proc_info': recorder.info, 'proc_output': recorder.output
    }  # fmt: skip
    run.bind(run.beside, {**objects, **active})
    grown = {'proc_info': recorder.info.grown, 'proc_output': recorder.output.grown}
    run.bind(run.after, {**objects, **grown})
    service.include_launch_description(description.launch, arguments)
    service.on_end = progress.end
    service.start(shutdown_when_idle=not run.keeps_alive)
    results = []
    failure = ''
    try:
        progress.awake.wait(run.start_timeout)
        if progress.may_begin:
            results.append(unittest.TextTestRunner(verbosity=verbosity).run(run.beside))
        elif not progress.has_ended:
            failure = f'ReadyToTest did not come in {run.start_timeout:g} s'
        if progress.has_ended and run.beside.countTestCases():
            failure = _STOPPED_EARLY
    finally:
        service.shutdown(force_sync=True)
    if failure:
        return RunResult(run, results, failure='\n'.join([failure, recorder.early_ends()]))
    results.append(unittest.TextTestRunner(verbosity=verbosity).run(run.after))
    return RunResult(run, results)
