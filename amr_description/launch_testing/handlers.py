# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
What tests are given as ``proc_info`` and ``proc_output``: what processes write, and how they end.

The active ones are filled by the thread of the processes while tests read them, and can wait.
"""

# ruff: noqa: N802 - names of the original

from collections.abc import Callable, Collection, Iterator
import threading
from typing import Any, Generic, Protocol, TypeVar

from amr_description.launch_api.events import ProcessEvent, ProcessExited, ProcessIO
from amr_description.launch_api.processes import ExecuteProcess
from amr_description.launch_testing.asserts import assertInStream
from amr_description.launch_testing.text import Expected
from amr_description.launch_testing.util import NoMatchingProcessException, resolveProcesses

E = TypeVar('E', bound=ProcessEvent)
V = TypeVar('V')
V_co = TypeVar('V_co', covariant=True)
Process = ExecuteProcess | str | None


class IoHandler:
    """What processes have written, in the order in which it came."""

    def __init__(self) -> None:
        self._events: list[ProcessIO] = []
        self._by_name: dict[str, list[ProcessIO]] = {}

    def track(self, process_name: str) -> None:
        """Know a process that has written nothing yet."""
        self._by_name.setdefault(process_name, [])

    def append(self, event: ProcessIO) -> None:
        """Add a line."""
        self._events.append(event)
        self._by_name.setdefault(event.process_name, []).append(event)

    def __iter__(self) -> Iterator[ProcessIO]:
        return iter(list(self._events))

    def processes(self) -> list[ExecuteProcess]:
        """Return those that have written something."""
        found = (events[0].action for events in self._by_name.values() if events)
        return [each for each in found if isinstance(each, ExecuteProcess)]

    def process_names(self) -> list[str]:
        """Return the names of those that are known."""
        return list(self._by_name)

    def __getitem__(self, key: ExecuteProcess | str) -> list[ProcessIO]:
        name = key if isinstance(key, str) else (key.process_details or {}).get('name', '')
        return list(self._by_name[name])


class ProcInfoHandler:
    """The last that happened to each process: its start, or its end."""

    def __init__(self) -> None:
        self._by_action: dict[Any, ProcessEvent] = {}

    def append(self, event: ProcessEvent) -> None:
        """Add a start or an end."""
        self._by_action[event.action] = event

    def __iter__(self) -> Iterator[ProcessEvent]:
        return iter(list(self._by_action.values()))

    def processes(self) -> list[ExecuteProcess]:
        """Return those that were started."""
        return list(self._by_action)

    def process_names(self) -> list[str]:
        """Return their names."""
        return [event.process_name for event in self._by_action.values()]

    def __getitem__(self, key: ExecuteProcess | str) -> ProcessEvent:
        if not isinstance(key, str):
            return self._by_action[key]
        for event in self._by_action.values():
            if key in event.process_name:
                return event
        raise KeyError(key)


class _Handler(Protocol[E, V_co]):
    def append(self, event: E) -> None: ...
    def __iter__(self) -> Iterator[E]: ...
    def processes(self) -> Collection[ExecuteProcess]: ...
    def process_names(self) -> Collection[str]: ...
    def __getitem__(self, key: ExecuteProcess | str) -> V_co: ...


class _Active(Generic[E, V]):
    """One of these that grows meanwhile."""

    def __init__(self, handler: _Handler[E, V]) -> None:
        self.grown: _Handler[E, V] = handler
        """For tests that come when all is over."""
        self._changed = threading.Condition()

    def append(self, event: E) -> None:
        """Add an event, and wake who waits."""
        with self._changed:
            self.grown.append(event)
            self._changed.notify_all()

    def __iter__(self) -> Iterator[E]:
        with self._changed:
            return iter(list(self.grown))

    def processes(self) -> list[ExecuteProcess]:
        """Return those of which something is known."""
        with self._changed:
            return list(self.grown.processes())

    def process_names(self) -> list[str]:
        """Return the names of those that are known."""
        with self._changed:
            return list(self.grown.process_names())

    def __getitem__(self, key: ExecuteProcess | str) -> V:
        with self._changed:
            return self.grown[key]

    def wait_until(self, predicate: Callable[[], object], timeout: float | None) -> bool:
        """Wait, at most this time, s; return whether it is true. It is asked at each event."""

        def holds() -> bool:
            try:
                return bool(predicate())
            except (NoMatchingProcessException, KeyError):  # not yet
                return False

        with self._changed:
            return self._changed.wait_for(holds, timeout)


class ActiveIoHandler(_Active[ProcessIO, list[ProcessIO]]):
    """What processes write."""

    def __init__(self) -> None:
        self._handler = IoHandler()
        super().__init__(self._handler)

    @property
    def io_event(self) -> threading.Condition:
        """Notified at each line."""
        return self._changed

    def track(self, process_name: str) -> None:
        """Know a process that has written nothing yet."""
        with self._changed:
            self._handler.track(process_name)

    def waitFor(
        self,
        expected_output: Expected,
        process: Process = None,
        cmd_args: Any = None,
        *,
        strict_proc_matching: bool = True,
        output_filter: Any = None,
        timeout: float | None = 10,
        strip_ansi_escape_sequences: bool = True,
        stream: str = 'stderr',
    ) -> bool:
        """
        Wait until a text was written; return whether it was.

        Args:
            expected_output: What is to be found.
            process: Who is to write it; None: anyone.
            cmd_args: As for :func:`resolveProcesses`, where it is a name.
            strict_proc_matching: The same.
            output_filter: Applied to the output before.
            timeout: s.
            strip_ansi_escape_sequences: Whether colours do not count.
            stream: Where it is to be written; logs of nodes are on stderr.

        Raises:
            NoMatchingProcessException: the process was not started, or wrote nothing.
        """

        def is_there() -> bool:
            try:
                assertInStream(
                    self._handler,
                    expected_output,
                    process,
                    cmd_args,
                    output_filter=output_filter,
                    strict_proc_matching=strict_proc_matching,
                    strip_ansi_escape_sequences=strip_ansi_escape_sequences,
                    stream=stream,
                )
            except AssertionError:
                return False
            return True

        found = self.wait_until(is_there, timeout)
        if not found:  # a process that never was is another fault than a text that did not come
            resolveProcesses(self, process=process, cmd_args=cmd_args, strict_proc_matching=False)
        return found

    def assertWaitFor(self, expected_output: Expected, *args: Any, **kwargs: Any) -> None:
        """Assert that a text is written in time, as :meth:`waitFor` waits for it."""
        found = self.waitFor(expected_output, *args, **kwargs)
        assert found, f'{expected_output!r} was not written in time'


class ActiveProcInfoHandler(_Active[ProcessEvent, ProcessEvent]):
    """Starts and ends of processes."""

    def __init__(self) -> None:
        super().__init__(ProcInfoHandler())

    @property
    def proc_event(self) -> threading.Condition:
        """Notified at each start and end."""
        return self._changed

    def assertWaitForStartup(
        self, process: Process, cmd_args: Any = None, *, timeout: float | None = 10
    ) -> None:
        """Assert that a process starts in time, s."""
        has_started = self.wait_until(lambda: self._one(process, cmd_args), timeout)
        assert has_started, f'{_named(process)} did not start in {timeout} s'

    def assertWaitForShutdown(
        self, process: Process, cmd_args: Any = None, *, timeout: float | None = 10
    ) -> None:
        """Assert that a process ends in time, s."""

        def has_ended() -> bool:
            return isinstance(self._one(process, cmd_args), ProcessExited)

        found = self.wait_until(has_ended, timeout)
        assert found, f'{_named(process)} did not end in {timeout} s'

    def _one(self, process: Process, cmd_args: Any) -> ProcessEvent:
        found = resolveProcesses(self.grown, process=process, cmd_args=cmd_args)
        return self.grown[found[0]]


def _named(process: Process) -> str:
    if isinstance(process, ExecuteProcess):
        return f"the process '{(process.process_details or {'name': '?'})['name']}'"
    return f"the process '{process}'"
