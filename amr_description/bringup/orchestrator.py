# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
Runs a stack: starts its processes in order, watches them, and ends them all.

One thread, one event loop. It is woken when a child has ended (SIGCHLD) or has written a line that
fulfils a condition, when the ROS graph has changed, when the stack is asked to stop (SIGINT,
SIGTERM, SIGHUP, or a screen that nobody reads any more), and at the times that the scheduler asks
for: starts, polls of files and timeouts.

The exit code is that of the required node that failed first (128 + signal if a signal ended it),
or 124 after a timeout. It is 0 if the stack ended by itself and if it was stopped by a signal:
Ctrl-C is its ordinary end.
"""

import asyncio
from collections.abc import Callable, Collection, Iterator, Mapping, Sequence
import contextlib
import functools
import os
import signal
import time
from typing import Protocol

from amr_description.bringup.command_line import ProcessSpec
from amr_description.bringup.console import Console
from amr_description.bringup.description import Node, Stack
from amr_description.bringup.diagnosis import Diagnosis, is_unexplained, NOT_STARTED, TIMEOUT
from amr_description.bringup.environment import child_environment
from amr_description.bringup.fork_server import ForkServer
from amr_description.bringup.graph_watcher import COMMAND, ExternalState, GraphWatch
from amr_description.bringup.handlers import describe_failure, lines_of, Stopping
from amr_description.bringup.lifeline import Lifeline
from amr_description.bringup.process import Child, RunningProcess, signal_blocked
from amr_description.bringup.reporter import Reporter
from amr_description.bringup.run_log import EventLog
from amr_description.bringup.scheduler import Scheduler
from amr_description.bringup.terminal import TerminalChild
from amr_description.errors import BringupError

CANNOT_START = 126  # the exit code that shells give a program that cannot be executed
_NOBODY_READS = 128 + signal.SIGPIPE  # as of a program that wrote into a closed pipe

_GUARDIAN_TIMEOUT = 5.0  # s; it gives up after four
# (signal, s to wait before the next one; None: as long as it takes)
_ESCALATION = ((signal.SIGINT, 5.0), (signal.SIGTERM, 5.0), (signal.SIGKILL, None))


class Observer(Protocol):
    """
    A program that runs a stack beside other things, as a test does, and is told what happens.

    Signals and other children of its process are its own: :meth:`Orchestrator.stop` ends the
    stack. All is called on the event loop, which may be that of any thread.
    """

    def started(self, node: Node, command: Sequence[str], pid: int) -> None:
        """Note that a process was started."""
        ...

    def output(self, node: Node, line: str) -> None:
        """Note a line of its output; one of stderr is an :class:`~.process.ErrorLine`."""
        ...

    def ended(self, node: Node, returncode: int) -> None:
        """Note that it has ended, or could not be started: all its lines were given."""
        ...


class Orchestrator:
    """Runs one stack, once."""

    def __init__(
        self,
        stack: Stack,
        specs: Sequence[ProcessSpec],
        console: Console,
        run_name: str,
        environment: Mapping[str, str],
        events: EventLog,
        observer: Observer | None = None,
    ) -> None:
        """
        Prepare a run.

        Args:
            stack: what to run.
            specs: its nodes, made by :func:`command_line.process_specs`.
            console: where lines for a person go.
            run_name: unique on this machine.
            environment: the environment variables of the children.
            events: where events for programs go.
            observer: who runs it beside other things; None: the process is there for it alone.
        """
        self._observer = observer
        self._specs: dict[Node, ProcessSpec] = {spec.node: spec for spec in specs}
        self._run_name = run_name
        self._environment = environment
        self._reporter = Reporter(stack, specs, console, events)
        self._scheduler = Scheduler(stack, time.monotonic())
        self._children: dict[Node, RunningProcess] = {}  # in the order of their start
        self._last_lines: dict[Node, Collection[str]] = {}
        self._wake = asyncio.Event()
        watch = GraphWatch(
            self._spawn_graph_watch, self._wake.set, self._reporter.graph_watch_output
        )
        self._external = ExternalState(watch)
        self._diagnosis: Diagnosis | None = None
        self._stop_handlers = stack.stop_handlers
        self._stop_requests = 0
        self._stop_reason = ''
        self._exit_code = 0
        console.on_reader_gone(self._on_reader_gone)

    async def run(self) -> int:
        """Run the stack to its end; return the exit code. No process is left when it returns."""
        with self._signal_handlers():
            self._lifeline = Lifeline(self._run_name, adopts=self._observer is None)
            self._wake_at_end(self._lifeline.guardian_pid)
            self._fork_server = self._start_fork_server()
            try:
                await self._fork_server_is_ready()
                await self._run_until_over()
                await self._diagnose()
            finally:
                await self._stop_all()
                await self._end_the_rest()
        found = self._diagnosis.text if self._diagnosis else ''
        self._reporter.failure(self._scheduler, self._last_lines, found)
        return self._result

    @property
    def _result(self) -> int:
        """The exit code, as far as it is known."""
        reason = self._scheduler.failure or self._scheduler.shutdown
        return self._exit_code if reason is None else reason.exit_code

    def stop(self, reason: str) -> None:
        """End the stack; call it on the event loop."""
        self._stop_reason = reason
        self._request_stop()

    def _wake_at_end(self, pid: int) -> None:
        """Be woken when a process ends, where SIGCHLD is another's."""
        if self._observer is None:
            return
        loop, descriptor = asyncio.get_running_loop(), os.pidfd_open(pid)

        def on_end() -> None:
            loop.remove_reader(descriptor)
            os.close(descriptor)
            self._wake.set()

        loop.add_reader(descriptor, on_end)

    @contextlib.contextmanager
    def _signal_handlers(self) -> Iterator[None]:
        if self._observer is not None:
            yield
            return
        loop = asyncio.get_running_loop()
        # SIGHUP stays ignored under nohup. SIGINT is handled even where it was ignored (a job in
        # the background of a script): whoever sends it wants the stack to stop.
        stops = [signal.SIGINT, signal.SIGTERM]
        if signal.getsignal(signal.SIGHUP) is not signal.SIG_IGN:
            stops.append(signal.SIGHUP)
        for number in stops:
            loop.add_signal_handler(number, self._on_stop_signal, number)
        loop.add_signal_handler(signal.SIGCHLD, self._wake.set)
        try:
            yield
        finally:
            for number in (*stops, signal.SIGCHLD):
                loop.remove_signal_handler(number)

    def _on_stop_signal(self, number: signal.Signals) -> None:
        self._reporter.stop_requested(number, again=self._stop_requests > 0)
        ctrl_c = number == signal.SIGINT
        self._stop_reason = f'{"ctrl-c" if ctrl_c else "stopped"} ({number.name})'
        self._request_stop()

    def _on_reader_gone(self) -> None:
        self._exit_code = _NOBODY_READS
        self._request_stop()

    def _request_stop(self) -> None:
        self._stop_requests += 1
        self._scheduler.over = True
        self._wake.set()

    def _start_fork_server(self) -> ForkServer | None:
        """Start what starts executables of this package; None: there are less than two."""
        specs = [spec for spec in self._specs.values() if spec.is_forkable]
        if len(specs) < 2 or self._observer is not None:  # it needs what adopts orphans
            return None
        names = dict.fromkeys(spec.node.executable for spec in specs)
        environment = child_environment(specs[0].executable, self._environment)
        with contextlib.suppress(OSError):
            return ForkServer(names, environment | self._lifeline.variables, self._lifeline.reader)
        return None

    async def _fork_server_is_ready(self) -> None:
        """Wait until it is ready, or has ended, or the stack is over."""
        server = self._fork_server
        if server is None:
            return
        loop = asyncio.get_running_loop()
        loop.add_reader(server, self._wake.set)
        try:
            await self._event(None)
        finally:
            loop.remove_reader(server)
        if not self._scheduler.over:
            server.take_ready()

    async def _run_until_over(self) -> None:
        while not self._scheduler.over:
            self._observe()
            self._reporter.lines(self._scheduler)
            while not self._scheduler.over and (nodes := self._scheduler.startable()):
                self._start(nodes[0])
            self._reporter.progress(self._scheduler)
            if not self._scheduler.over:
                await self._event(self._time_left())
            self._handle_exits()
        self._reporter.lines(self._scheduler)
        if self._scheduler.shutdown:
            self._stop_reason = self._scheduler.shutdown.reason
            self._reporter.shutdown(self._scheduler.shutdown)
        for handler in self._stop_handlers:
            try:
                returned = handler(Stopping(self._result, self._stop_reason))
                self._scheduler.lines += lines_of(returned)
            except (Exception, SystemExit) as error:  # must not keep processes alive
                self._reporter.handler_failed(describe_failure('on_shutdown', error))
        self._reporter.lines(self._scheduler)

    def _observe(self) -> None:
        """Give the scheduler the time, the ROS graph and the files."""
        now = time.monotonic()
        self._external.update(self._scheduler.pending_conditions(), now)
        self._scheduler.observe(graph=self._external.graph, paths=self._external.paths)
        self._scheduler.advance_to(now)

    def _time_left(self) -> float | None:
        """Return the s until something is due although no event comes; None: nothing is."""
        times = [self._scheduler.next_time(), self._external.next_time]
        earliest = min((each for each in times if each is not None), default=None)
        return None if earliest is None else max(0.0, earliest - time.monotonic())

    async def _event(self, timeout: float | None) -> bool:
        """Wait for the next event, at most ``timeout`` s; return whether there was one."""
        try:
            await asyncio.wait_for(self._wake.wait(), timeout)
        except TimeoutError:
            return False
        self._wake.clear()
        return True

    def _start(self, node: Node) -> None:
        spec = self._specs[node]
        try:
            environment = child_environment(spec.executable, spec.variables(self._environment))
            spec.write_parameter_files()
            child = self._spawn(spec, environment | self._lifeline.variables)
        except (OSError, BringupError) as error:
            why = spec.explain(error) if isinstance(error, OSError) else str(error)
            reason = f'{NOT_STARTED}{why}'
            self._reporter.not_started(node, reason)
            self._last_lines[node] = [reason]
            self._scheduler.on_no_start(node, CANNOT_START, [reason])
            if self._observer is not None:
                self._observer.ended(node, CANNOT_START)
            self._reporter.respawn(node, self._scheduler.state, [reason])
            self._wake.set()
            return
        if node in self._children:  # a respawn
            self._children.pop(node).close()
        self._children[node] = child
        self._last_lines[node] = child.last_lines
        self._scheduler.on_start(node)
        self._reporter.started(node, child.pid)
        self._wake_at_end(child.pid)
        if self._observer is not None:
            self._observer.started(node, spec.command, child.pid)

    def _spawn(self, spec: ProcessSpec, environment: Mapping[str, str]) -> RunningProcess:
        reader, reporter = self._lifeline.reader, self._reporter
        with signal_blocked(signal.SIGINT) if spec.unblocks_sigint else contextlib.nullcontext():
            if not spec.node.terminal:
                on_line = functools.partial(self._on_line, spec.node)
                server = self._fork_server if spec.is_forkable else None
                folder = spec.node.folder
                splits = self._observer is not None
                return Child(spec.command, environment, reader, on_line, server, folder, splits)
            self._scheduler.expect_start(spec.node)
            reporter.progress(self._scheduler)  # while all of it can still be seen
            reporter.lending_terminal(spec.node)
            try:
                return TerminalChild(spec.command, environment, reader, reporter.terminal_lent)
            except OSError:
                reporter.terminal_lent(False)
                raise

    def _on_line(self, node: Node, line: str) -> None:
        self._reporter.output(node, line)
        if self._observer is not None:
            self._observer.output(node, line)
        if self._scheduler.on_line(node, line):
            self._wake.set()

    def _spawn_graph_watch(self, on_line: Callable[[str], None]) -> Child:
        return self._spawn_own(COMMAND, on_line)

    def _spawn_own(self, command: Sequence[str], on_line: Callable[[str], None]) -> Child:
        """Start a program of the bring-up itself."""
        environment = {**self._environment, 'PYTHONUNBUFFERED': '1', **self._lifeline.variables}
        with signal_blocked(signal.SIGINT):
            child = Child(command, environment, self._lifeline.reader, on_line)
        self._wake_at_end(child.pid)
        return child

    async def _diagnose(self) -> None:
        """Have the doctor look for the cause of a start that failed, while the rest runs."""
        scheduler = self._scheduler
        has_ros = any(self._specs[node].unblocks_sigint for node in self._children)
        if scheduler.ready or self._stop_requests or not has_ros:
            return
        if not is_unexplained(scheduler.failure, self._last_lines):
            return
        self._diagnosis = diagnosis = Diagnosis(self._spawn_own)
        deadline = time.monotonic() + TIMEOUT
        while not diagnosis.is_over() and not self._stop_requests:
            left = deadline - time.monotonic()
            if left <= 0.0 or not await self._event(left):
                break
            self._handle_exits()
        while not diagnosis.is_over():
            diagnosis.kill()
            await self._event(None)
        diagnosis.close()

    def _handle_exits(self) -> None:
        """Give the scheduler all processes that have ended."""
        self._scheduler.set_time(time.monotonic())
        for node, child in self._running().items():
            if child.poll():
                self._reporter.ended(node, child)
                if node.terminal and child.died_of_ctrl_c:  # only its process group gets that one
                    self._on_stop_signal(signal.SIGINT)
                self._scheduler.on_exit(node, child.returncode, list(child.last_lines))
                if self._observer is not None:
                    self._observer.ended(node, child.returncode)
                self._reporter.respawn(node, self._scheduler.state, child.last_lines)
        if self._lifeline.revive_guardian():
            self._wake_at_end(self._lifeline.guardian_pid)
            self._reporter.guardian_replaced()
        self._lifeline.reap_adopted(self._running_pids())

    def _running(self) -> dict[Node, RunningProcess]:
        return {n: child for n, child in self._children.items() if child.returncode is None}

    def _running_pids(self) -> set[int]:
        watch = self._external.watch.process
        doctor = self._diagnosis.process if self._diagnosis else None
        others = (watch, self._fork_server, doctor)
        return {each.pid for each in (*self._running().values(), *others) if each}

    async def _stop_all(self) -> None:
        """Signal all processes in the reverse order of their start, then escalate."""
        begin = time.monotonic()
        before: signal.Signals | None = None
        for number, timeout in _ESCALATION:
            running = self._running()
            for node, child in reversed(running.items()):
                elapsed = time.monotonic() - begin
                self._reporter.signal_sent(node, child.pid, number, before, elapsed)
                child.send(number)
            self._external.watch.send(number)
            await self._until_all_ended(timeout)
            before = number

    async def _until_all_ended(self, timeout: float | None) -> None:
        """Wait until all have ended, at most ``timeout`` s, or until a further stop request."""
        deadline = None if timeout is None else time.monotonic() + timeout
        requests = self._stop_requests
        while self._stop_requests == requests and (self._running() or self._external.watch.poll()):
            left = None if deadline is None else max(0.0, deadline - time.monotonic())
            if not await self._event(left):
                return
            self._handle_exits()

    async def _end_the_rest(self) -> None:
        """Have the guardian end what the children left behind."""
        if self._fork_server:
            self._fork_server.end()
        self._lifeline.cut()
        deadline = time.monotonic() + _GUARDIAN_TIMEOUT
        while not self._lifeline.is_over():
            left = deadline - time.monotonic()
            if left <= 0.0:
                self._reporter.guardian_killed(_GUARDIAN_TIMEOUT)
                self._lifeline.kill_guardian()
                left = _GUARDIAN_TIMEOUT
            await self._event(left)
            self._lifeline.reap_adopted(self._running_pids())
        for child in self._children.values():
            child.close()
