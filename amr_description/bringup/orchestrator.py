# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
The engine: start the processes of a stack in order, watch them, end them all.

One thread, one event loop. It is woken when a child ended (SIGCHLD) or wrote a line that a
condition asks for, when the ROS graph changed, when somebody wants the stack to stop (SIGINT,
SIGTERM, SIGHUP or a screen that nobody reads), and when it is time: for a start, for a look at a
file, or because a patience is over.

The exit code is that of the required node that failed first (128 + signal if it died of one), and
124 if a wait took too long. It is 0 if the stack ended by itself, and if it was stopped by a
signal: Ctrl-C is its ordinary end.
"""

import asyncio
from collections.abc import Callable, Collection, Iterator, Mapping, Sequence
import contextlib
import functools
import signal
import time

from amr_description.bringup.command_line import ProcessSpec
from amr_description.bringup.console import Console
from amr_description.bringup.description import Node, Stack
from amr_description.bringup.environment import child_environment
from amr_description.bringup.graph_watcher import COMMAND, ExternalState, GraphWatch
from amr_description.bringup.handlers import complaint, Stopping
from amr_description.bringup.lifeline import Lifeline
from amr_description.bringup.process import Child, held_back, RunningProcess
from amr_description.bringup.reporter import Reporter
from amr_description.bringup.run_log import EventLog
from amr_description.bringup.scheduler import Scheduler
from amr_description.bringup.terminal import TerminalChild

CANNOT_START = 126  # the exit code that shells give a program that cannot be executed
_NOBODY_READS = 128 + signal.SIGPIPE  # as of a program that wrote into a closed pipe

# (signal, s to wait for the end before the next; None: as long as it takes)
_ESCALATION = ((signal.SIGINT, 5.0), (signal.SIGTERM, 5.0), (signal.SIGKILL, None))


class Orchestrator:
    """Runs one stack, once."""

    def __init__(
        self,
        stack: Stack,
        jobs: Sequence[ProcessSpec],
        console: Console,
        run_name: str,
        environment: Mapping[str, str],
        events: EventLog,
    ) -> None:
        """
        Take over what is to be run.

        :param jobs: The nodes of the stack, made ready by :func:`job.jobs_of`.
        :param run_name: A name that no other run on this machine has.
        :param environment: The environment variables of the children.
        :param events: Is told all that happens.
        """
        self._jobs: dict[Node, ProcessSpec] = {job.node: job for job in jobs}
        self._run_name = run_name
        self._environment = environment
        self._narrator = Reporter(stack, jobs, console, events)
        self._progress = Scheduler(stack, time.monotonic())
        self._children: dict[Node, RunningProcess] = {}  # in the order of their start
        self._last_lines: dict[Node, Collection[str]] = {}
        self._wake = asyncio.Event()
        watch = GraphWatch(self._spawn_watch, self._wake.set, self._narrator.graph_watch_said)
        self._outlook = ExternalState(watch)
        self._stop_handlers = stack.stop_handlers
        self._stop_requests = 0
        self._exit_code = 0
        console.when_reader_is_gone(self._on_reader_gone)

    async def run(self) -> int:
        """Run the stack to its end and return the exit code; nothing is left when it returns."""
        with self._signal_handlers():
            self._lifeline = Lifeline(self._run_name)
            try:
                await self._until_over()
            finally:
                await self._stop_all()
                await self._end_the_rest()
        self._narrator.failure(self._progress, self._last_lines)
        return self._result

    @property
    def _result(self) -> int:
        """The exit code, as far as it is known."""
        reason = self._progress.failure or self._progress.shutdown
        return self._exit_code if reason is None else reason.exit_code

    @contextlib.contextmanager
    def _signal_handlers(self) -> Iterator[None]:
        loop = asyncio.get_running_loop()
        # nohup's ignored SIGHUP stays ignored; an ignored SIGINT (of a job in the background of a
        # script) does not: whoever sends it means it.
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
        self._narrator.stop_requested(number, again=self._stop_requests > 0)
        self._request_stop()

    def _on_reader_gone(self) -> None:
        self._exit_code = _NOBODY_READS
        self._request_stop()

    def _request_stop(self) -> None:
        self._stop_requests += 1
        self._progress.over = True
        self._wake.set()

    async def _until_over(self) -> None:
        while not self._progress.over:
            self._look()
            while not self._progress.over and (nodes := self._progress.startable()):
                self._start(nodes[0])
            self._narrator.progress(self._progress)
            if not self._progress.over:
                await self._event(self._time_left())
            self._collect()
        if self._progress.shutdown:
            self._narrator.shutdown(self._progress.shutdown)
        for handler in self._stop_handlers:
            try:
                handler(Stopping(self._result))
            except (Exception, SystemExit) as error:  # must not keep processes alive
                self._narrator.handler_failed(complaint('on_shutdown', error))

    def _look(self) -> None:
        """See what the time and the world outside have come to."""
        now = time.monotonic()
        self._outlook.look(self._progress.lookouts(), now)
        self._progress.see(graph=self._outlook.graph, paths=self._outlook.paths)
        self._progress.at(now)

    def _time_left(self) -> float | None:
        """Return the s until there is something to do although nothing happens."""
        times = [self._progress.next_time(), self._outlook.next_time]
        earliest = min((each for each in times if each is not None), default=None)
        return None if earliest is None else max(0.0, earliest - time.monotonic())

    async def _event(self, patience: float | None) -> bool:
        """Wait for the next event, at most ``patience`` s; return whether there was one."""
        try:
            await asyncio.wait_for(self._wake.wait(), patience)
        except TimeoutError:
            return False
        self._wake.clear()
        return True

    def _start(self, node: Node) -> None:
        job = self._jobs[node]
        self._progress.start(node)
        try:
            environment = {**self._environment, **job.environment}
            environment = child_environment(job.executable, environment)
            job.write_parameter_files()
            child = self._child(job, environment | self._lifeline.variables)
        except OSError as error:
            reason = f'could not be started: {job.why_not(error)}'
            self._narrator.not_started(node, reason)
            self._last_lines[node] = [reason]
            self._progress.end(node, CANNOT_START, [reason])
            self._narrator.respawn(node, self._progress.situation)
            self._wake.set()
            return
        if node in self._children:  # it is started again
            self._children.pop(node).close()
        self._children[node] = child
        self._last_lines[node] = child.last_lines
        self._narrator.started(node, child.pid)

    def _child(self, job: ProcessSpec, environment: Mapping[str, str]) -> RunningProcess:
        reader, narrator = self._lifeline.reader, self._narrator
        with held_back(signal.SIGINT) if job.takes_sigint_later else contextlib.nullcontext():
            if not job.node.terminal:
                hear = functools.partial(self._hear, job.node)
                return Child(job.command, environment, reader, hear)
            narrator.progress(self._progress)  # as long as all of it can be seen
            narrator.lends_terminal(job.node)
            try:
                return TerminalChild(job.command, environment, reader, narrator.terminal_lent)
            except OSError:
                narrator.terminal_lent(False)
                raise

    def _hear(self, node: Node, line: str) -> None:
        self._narrator.output(node, line)
        if self._progress.hear(node, line):
            self._wake.set()

    def _spawn_watch(self, on_line: Callable[[str], None]) -> Child:
        environment = {**self._environment, 'PYTHONUNBUFFERED': '1', **self._lifeline.variables}
        with held_back(signal.SIGINT):
            return Child(COMMAND, environment, self._lifeline.reader, on_line)

    def _collect(self) -> None:
        """Take note of all processes that have ended."""
        self._progress.tick(time.monotonic())
        for node, child in self._running().items():
            if child.poll():
                self._narrator.ended(node, child)
                if node.terminal and child.died_of_ctrl_c:  # which it alone has heard
                    self._on_stop_signal(signal.SIGINT)
                self._progress.end(node, child.returncode, list(child.last_lines))
                self._narrator.respawn(node, self._progress.situation)
        if self._lifeline.revive():
            self._narrator.guardian_replaced()
        self._lifeline.reap_adopted(self._running_pids())

    def _running(self) -> dict[Node, RunningProcess]:
        return {n: child for n, child in self._children.items() if child.returncode is None}

    def _running_pids(self) -> set[int]:
        watch = self._outlook.watch.process
        running = [*self._running().values(), *([watch] if watch else [])]
        return {child.pid for child in running}

    async def _stop_all(self) -> None:
        """Signal all at once in the reverse order of their start, and again where that fails."""
        begin = time.monotonic()
        before: signal.Signals | None = None
        for number, patience in _ESCALATION:
            running = self._running()
            for node, child in reversed(running.items()):
                elapsed = time.monotonic() - begin
                self._narrator.signalled(node, child.pid, number, before, elapsed)
                child.send(number)
            self._outlook.watch.send(number)
            await self._until_ended(patience)
            before = number

    async def _until_ended(self, patience: float | None) -> None:
        """Wait for the end of all, at most ``patience`` s, or for somebody who is in a hurry."""
        deadline = None if patience is None else time.monotonic() + patience
        requests = self._stop_requests
        while self._stop_requests == requests and (self._running() or self._outlook.watch.poll()):
            left = None if deadline is None else max(0.0, deadline - time.monotonic())
            if not await self._event(left):
                return
            self._collect()

    async def _end_the_rest(self) -> None:
        """Have the guardian end what the children left behind."""
        self._lifeline.cut()
        while not self._lifeline.is_over():
            await self._event(None)
            self._lifeline.reap_adopted(self._running_pids())
        for child in self._children.values():
            child.close()
