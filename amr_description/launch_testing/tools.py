# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
What tests do with processes: start one themselves, wait for its start, its output and its end.

What waits stands twice, as in launch_pytest: for tests that are coroutines, and for those that are
functions. Timeouts are in s; None: as long as it takes. The context is taken as in the original,
and not needed.
"""

import asyncio
from collections.abc import Callable, Coroutine, Iterator
from contextlib import contextmanager
import functools
from typing import Any, TypeAlias

from amr_description.launch_api.descriptions import LaunchDescription
from amr_description.launch_api.events import (
    IncludeRequest,
    ProcessExited,
    ProcessStarted,
    ShutdownProcess,
)
from amr_description.launch_api.processes import ExecuteProcess, ProcessRecord
from amr_description.launch_api.service import LaunchService
from amr_description.launch_testing.handlers import ActiveIoHandler, ActiveProcInfoHandler
from amr_description.launch_testing.text import (
    basic_output_filter,
    expect_output,
    expected_output_from_file,
    Filter,
)

Validator: TypeAlias = Callable[[str], object]


class ProcessProxy:
    """What a test sees of such a process."""

    def __init__(
        self,
        process_action: ExecuteProcess,
        proc_info: ActiveProcInfoHandler,
        proc_output: ActiveIoHandler,
        *,
        output_filter: Filter | None = None,
    ) -> None:
        self._action, self._info, self._output = process_action, proc_info, proc_output
        self._filter = output_filter or (lambda text: text)

    @property
    def target_process_action(self) -> ExecuteProcess:
        """The action that starts it."""
        return self._action

    @property
    def stdout(self) -> str:
        """What it has written so far."""
        return self._text('stdout')

    @property
    def stderr(self) -> str:
        """What it has written to stderr so far."""
        return self._text('stderr')

    @property
    def output(self) -> str:
        """Both, in the order in which they came."""
        return self._text('stdout', 'stderr')

    @property
    def running(self) -> bool:
        """Whether it was started, and has not ended."""
        return isinstance(self._last_event(), ProcessStarted)

    @property
    def terminated(self) -> bool:
        """Whether it has ended."""
        return isinstance(self._last_event(), ProcessExited)

    @property
    def exit_code(self) -> int | None:
        """How it has ended."""
        return self._action.return_code

    def wait_for_shutdown(self, timeout: float | None = None) -> bool:
        """Wait until it has ended; return whether it has. ``timeout``: s."""
        return self._info.wait_until(lambda: self.terminated, timeout)

    def wait_for_output(
        self, condition: Callable[[str], object] | None = None, timeout: float | None = None
    ) -> bool:
        """Wait until its output is as a function wants it; None: until there is any."""
        if condition is not None and not callable(condition):
            raise TypeError(f'condition={condition!r}: it takes a function')
        return self._output.wait_until(lambda: (condition or bool)(self.output), timeout)

    def _last_event(self) -> object:
        known = self._action in self._info.processes()
        return self._info[self._action] if known else None

    def _text(self, *streams: str) -> str:
        return self._filter(
            ''.join(
                event.text.decode()
                for event in self._output[self._action]
                if ('stderr' if event.from_stderr else 'stdout') in streams
            )
        )


@contextmanager
def launch_process(
    launch_service: LaunchService,
    process_action: ExecuteProcess,
    proc_info: ActiveProcInfoHandler,
    proc_output: ActiveIoHandler,
    **kwargs: Any,
) -> Iterator[ProcessProxy]:
    """Run a process within the context; what has not ended behind it is ended."""
    description = LaunchDescription([process_action])
    launch_service.emit_event(IncludeRequest(description))
    proxy = ProcessProxy(process_action, proc_info, proc_output, **kwargs)
    try:
        yield proxy
    finally:
        if not proxy.terminated:
            launch_service.emit_event(ShutdownProcess(lambda each: each is process_action))


def _holds(validate: Validator, stream: str) -> Callable[[ProcessRecord], bool]:
    def is_valid(record: ProcessRecord) -> bool:
        return bool(validate(record.output[stream]))

    return is_valid


def _asserts(validate: Validator, stream: str) -> Callable[[ProcessRecord], bool]:
    def is_valid(record: ProcessRecord) -> bool:
        try:
            validate(record.output[stream])
        except AssertionError:
            return False
        return True

    return is_valid


def _wait(action: ExecuteProcess, stream: str, validate: Validator, timeout: float | None) -> bool:
    return action.record.wait_for(_holds(validate, stream), timeout)


def _assert(
    action: ExecuteProcess, stream: str, validate: Validator, timeout: float | None
) -> bool:
    if not action.record.wait_for(_asserts(validate, stream), timeout):
        validate(action.record.output[stream])
    return True


def wait_for_output_sync(
    launch_context: object,
    execute_process_action: ExecuteProcess,
    validate_output: Validator,
    timeout: float | None = None,
) -> bool:
    """Return whether a function of what was written to stdout gets true."""
    return _wait(execute_process_action, 'stdout', validate_output, timeout)


def wait_for_stderr_sync(
    launch_context: object,
    execute_process_action: ExecuteProcess,
    validate_output: Validator,
    timeout: float | None = None,
) -> bool:
    """Return whether a function of what was written to stderr gets true."""
    return _wait(execute_process_action, 'stderr', validate_output, timeout)


def assert_output_sync(
    launch_context: object,
    execute_process_action: ExecuteProcess,
    validate_output: Validator,
    timeout: float | None = None,
) -> bool:
    """Wait until a function of what was written to stdout asserts it; raise what it raises."""
    return _assert(execute_process_action, 'stdout', validate_output, timeout)


def assert_stderr_sync(
    launch_context: object,
    execute_process_action: ExecuteProcess,
    validate_output: Validator,
    timeout: float | None = None,
) -> bool:
    """Wait until a function of what was written to stderr asserts it; raise what it raises."""
    return _assert(execute_process_action, 'stderr', validate_output, timeout)


def wait_for_start_sync(
    launch_context: object, execute_process_action: ExecuteProcess, timeout: float | None = None
) -> bool:
    """Return whether a process starts in time."""
    return execute_process_action.record.wait_for(lambda record: record.details, timeout)


def wait_for_exit_sync(
    launch_context: object, execute_process_action: ExecuteProcess, timeout: float | None = None
) -> bool:
    """Return whether a process ends in time."""
    record = execute_process_action.record
    return record.wait_for(lambda each: each.return_code is not None, timeout)


def _as_coroutine(function: Callable[..., bool]) -> Callable[..., Coroutine[Any, Any, bool]]:
    @functools.wraps(function)
    async def wait(*args: Any, **kwargs: Any) -> bool:
        return await asyncio.to_thread(function, *args, **kwargs)

    return wait


wait_for_output = _as_coroutine(wait_for_output_sync)
wait_for_stderr = _as_coroutine(wait_for_stderr_sync)
assert_output = _as_coroutine(assert_output_sync)
assert_stderr = _as_coroutine(assert_stderr_sync)
wait_for_start = _as_coroutine(wait_for_start_sync)
wait_for_exit = _as_coroutine(wait_for_exit_sync)

__all__ = [
    'ProcessProxy',
    'assert_output',
    'assert_output_sync',
    'assert_stderr',
    'assert_stderr_sync',
    'basic_output_filter',
    'expect_output',
    'expected_output_from_file',
    'launch_process',
    'wait_for_exit',
    'wait_for_exit_sync',
    'wait_for_output',
    'wait_for_output_sync',
    'wait_for_start',
    'wait_for_start_sync',
    'wait_for_stderr',
    'wait_for_stderr_sync',
]
