# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
LaunchService: descriptions run by a program that does other things meanwhile, as a test does.

Each description becomes a stack when it is included, so what is wrong with it is raised there. The
stacks run on one thread with an event loop of its own; signals and the other children of the
process are the program's. ``ros2 launch`` needs none of it: its process is there for the stack.
"""

import asyncio
from collections.abc import Callable, Mapping, Sequence
from contextlib import suppress
from datetime import datetime
from functools import partial
import os
import sys
import threading
from typing import Any

from amr_description.bringup.arguments import parse
from amr_description.bringup.command_line import process_specs
from amr_description.bringup.console import Console, LAUNCH, wants_colour
from amr_description.bringup.description import Node as StackNode
from amr_description.bringup.orchestrator import Orchestrator
from amr_description.bringup.process import ErrorLine
from amr_description.bringup.run_log import EventLog, log_base, LogFolder, run_name
from amr_description.errors import AmrError, BringupError
from amr_description.launch_api import including
from amr_description.launch_api.context import LaunchContext
from amr_description.launch_api.counterparts import folders_of_known_packages
from amr_description.launch_api.descriptions import LaunchDescription
from amr_description.launch_api.events import (
    Event,
    IncludeRequest,
    ProcessEvent,
    ProcessExited,
    ProcessStarted,
    Shutdown,
    ShutdownProcess,
)
from amr_description.launch_api.handling import io_event
from amr_description.launch_api.processes import ExecuteProcess, ProcessRecord
from amr_description.launch_api.translation import Translation

_GRACE = 0.05
"""s to the first signal: what has just written its last line ends by itself."""
Listener = Callable[[ProcessEvent], None]


class LaunchService:
    """As in launch: includes descriptions, and runs them until they end or it is shut down."""

    def __init__(
        self,
        *,
        argv: Sequence[str] | None = None,
        noninteractive: bool = False,
        debug: bool = False,
    ) -> None:
        """
        Run nothing yet.

        Args:
            argv: ``name:=value``: launch configurations of all descriptions.
            noninteractive: as in launch: it asks nothing in any case.
            debug: as in launch; it has no more to say.
        """
        self.context = LaunchContext(argv=list(argv or ()), noninteractive=noninteractive)
        self.listeners: list[Listener] = []
        """Called on the thread that runs the stacks, with all that happens to processes."""
        self.event_loop: asyncio.AbstractEventLoop | None = None
        """That of the thread; None: it does not run."""
        self.on_end: Callable[[], None] = lambda: None
        """Called on the thread when it is over."""
        self._given = parse(list(argv or ()))
        self._next = 1
        """The number of the next process, in its name."""
        self._waiting: list[_Run] = []
        self._running: dict[_Run, asyncio.Task[int]] = {}
        self._lock = threading.Lock()
        self._thread: threading.Thread | None = None
        self._changed: asyncio.Event | None = None
        self._is_stopped = False
        self._code = 0

    def include_launch_description(
        self, description: LaunchDescription, arguments: Mapping[str, str] | None = None
    ) -> None:
        """
        Have a description run: now, or once the service runs.

        Args:
            description: What to run.
            arguments: Launch configurations beside those of the service.

        Raises:
            BringupError: it is not understood, with the place.
        """
        run = _Run(description, {**self._given, **(arguments or {})}, self._tell)
        with self._lock:
            run.first, self._next = self._next, self._next + run.size
            if self.event_loop is None:
                self._waiting.append(run)
            elif not self._is_stopped:
                self.event_loop.call_soon_threadsafe(self._begin, run)

    def emit_event(self, event: Event) -> None:
        """Do what an event asks for. Raises BringupError: it is not understood here."""
        match event:
            case IncludeRequest():
                self.include_launch_description(event.launch_description)
            case Shutdown():
                self.shutdown()
            case ShutdownProcess():
                self._call(partial(self._stop_processes, event))
            case _:
                raise BringupError(f'the event {type(event).__name__} is not understood here')

    def start(self, *, shutdown_when_idle: bool = True) -> None:
        """Begin to run on a thread of its own, at once; again, when it was over."""
        self._is_stopped, self._code = False, 0
        has_begun = threading.Event()
        run = partial(self._run_on_thread, has_begun, shutdown_when_idle)
        self._thread = threading.Thread(target=run, name='launch', daemon=True)
        self._thread.start()
        has_begun.wait()

    def wait(self) -> int:
        """Wait until it is over; return the exit code."""
        if self._thread is not None:
            self._thread.join()
        return self._code

    def run(self, *, shutdown_when_idle: bool = True) -> int:
        """Run to the end, or to Ctrl-C; return the exit code."""
        self.start(shutdown_when_idle=shutdown_when_idle)
        try:
            return self.wait()
        except KeyboardInterrupt:
            self.shutdown()
            return self.wait()

    async def run_async(self, *, shutdown_when_idle: bool = True) -> int:
        """As :meth:`run`, beside other tasks of an event loop."""
        self.start(shutdown_when_idle=shutdown_when_idle)
        try:
            return await asyncio.to_thread(self.wait)
        finally:
            self.shutdown()

    def shutdown(self, force_sync: bool = False) -> None:
        """End all processes; ``force_sync``: and return when they have ended."""
        with self._lock:
            self._is_stopped = True
            self._waiting.clear()
        self._call(self._stop_soon)
        if force_sync:
            self.wait()

    def _is_idle(self) -> bool:
        """Return whether nothing runs; upstream's tests ask for it by this name."""
        return not self._running and not self._waiting

    def _call(self, function: Callable[[], None]) -> None:
        """Have a function called on the thread, if it runs."""
        loop = self.event_loop
        if loop is not None:
            with suppress(RuntimeError):  # it has ended just now
                loop.call_soon_threadsafe(function)

    def _run_on_thread(self, has_begun: threading.Event, shutdown_when_idle: bool) -> None:
        try:
            self._code = asyncio.run(self._main(has_begun, shutdown_when_idle))
        finally:
            self.event_loop = None
            has_begun.set()
            self.on_end()

    async def _main(self, has_begun: threading.Event, shutdown_when_idle: bool) -> int:
        self._changed = asyncio.Event()
        with self._lock:
            self.event_loop = asyncio.get_running_loop()
            waiting, self._waiting = self._waiting, []
        for run in waiting:
            self._begin(run)
        has_begun.set()
        codes = []
        while self._running or not (shutdown_when_idle or self._is_stopped):
            await self._changed.wait()
            self._changed.clear()
            for run in [run for run, task in self._running.items() if task.done()]:
                codes.append(self._running.pop(run).result())
        return next(filter(None, codes), 0)

    def _begin(self, run: '_Run') -> None:
        assert self._changed is not None, 'the loop runs'
        if not self._is_stopped:
            self._running[run] = task = asyncio.ensure_future(run.to_its_end())
            changed = self._changed
            task.add_done_callback(lambda _: changed.set())

    def _stop_soon(self) -> None:
        assert self.event_loop is not None, 'it is called there'
        self.event_loop.call_later(_GRACE if self._running else 0.0, self._stop)

    def _stop(self) -> None:
        for run in self._running:
            run.stop()
        if self._changed is not None:
            self._changed.set()

    def _stop_processes(self, event: ShutdownProcess) -> None:
        for run in self._running:
            if any(map(event.process_matcher, run.actions.values())):
                run.stop()

    def _tell(self, event: ProcessEvent) -> None:
        for listener in self.listeners:
            listener(event)


class _Run:
    """One description, as a stack; the observer of its processes."""

    def __init__(
        self, description: LaunchDescription, configurations: Mapping[str, str], tell: Listener
    ) -> None:
        """Translate it. Raises BringupError."""
        context = LaunchContext()
        context.launch_configurations.update(configurations)
        including.forget_open_files()
        with folders_of_known_packages():
            translation = Translation(context)
            translation.visit([description])
            translation.handle()
        self._stack = translation.stack()
        self.actions: dict[StackNode, ExecuteProcess] = {
            made.node: action
            for action, made in translation.started.items()
            if isinstance(action, ExecuteProcess) and isinstance(made.node, StackNode)
        }
        self._tell = tell
        self._names: dict[StackNode, str] = {}
        self._orchestrator: Orchestrator | None = None
        self._is_stopped = False
        self.first = 1
        """The number of its first process."""
        self.size = len(translation.nodes)

    async def to_its_end(self) -> int:
        """Run it; return the exit code. No process is left then."""
        run = run_name(datetime.now())
        folder = LogFolder(log_base(os.environ), run)
        try:
            console = Console(sys.stdout, folder, colour=wants_colour(sys.stdout, os.environ))
            try:
                specs = process_specs(self._stack, folder.path, first=self.first)
            except AmrError as error:
                console.log('ERROR', LAUNCH, str(error))
                return error.exit_code
            for level, text in self._stack.all_notes:
                console.log(level, LAUNCH, text)
            self._names = {spec.node: spec.name for spec in specs}
            variables = {**os.environ, 'ROS_LOG_DIR': str(folder.path)}
            self._orchestrator = Orchestrator(
                self._stack, specs, console, run, variables, EventLog(), self
            )
            return 0 if self._is_stopped else await self._orchestrator.run()
        finally:
            folder.close()

    def stop(self) -> None:
        """End it."""
        self._is_stopped = True
        if self._orchestrator is not None:
            self._orchestrator.stop('the test is over')

    def started(self, node: StackNode, command: Sequence[str], pid: int) -> None:
        """As the observer of an orchestrator."""
        action = self.actions.get(node)
        if action is None:
            return
        name = self._names[node]
        details = {'name': name, 'cmd': [*command], 'cwd': node.folder, 'env': None, 'pid': pid}

        def change(record: ProcessRecord) -> None:
            record.details, record.return_code = details, None

        action.record.change(change)
        self._tell(ProcessStarted(action, name, command, pid))

    def output(self, node: StackNode, line: str) -> None:
        """As the observer of an orchestrator."""
        action = self.actions.get(node)
        if action is None:
            return
        stream = 'stderr' if isinstance(line, ErrorLine) else 'stdout'

        def change(record: ProcessRecord) -> None:
            record.output[stream] += f'{line}\n'

        action.record.change(change)
        self._tell(io_event(action, self._names[node], line))

    def ended(self, node: StackNode, returncode: int) -> None:
        """As the observer of an orchestrator."""
        action = self.actions.get(node)
        if action is None:
            return

        def change(record: ProcessRecord) -> None:
            record.return_code = returncode

        action.record.change(change)
        details: Mapping[str, Any] = action.process_details or {}
        command, pid = details.get('cmd', ()), details.get('pid')
        event = ProcessExited(action, self._names[node], command, pid, returncode=returncode)
        self._tell(event)
