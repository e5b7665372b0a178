# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
The engine: start the processes of a stack in order, watch them, end them all.

One thread, one event loop. Three kinds of events wake it: a child ended (SIGCHLD), somebody wants
the stack to stop (SIGINT, SIGTERM, SIGHUP or a screen that nobody reads), a patience is over.

The exit code is that of the required node that failed first (128 + signal if it died of one). It
is 0 if the stack ended by itself, and if it was stopped by a signal: Ctrl-C is its ordinary end.
"""

import asyncio
from collections.abc import Iterator, Sequence
import contextlib
import os
import signal
import time

from amr_description.bringup.child import Child
from amr_description.bringup.console import Console, LAUNCH
from amr_description.bringup.description import Node, Stack
from amr_description.bringup.environment import child_environment
from amr_description.bringup.job import Job
from amr_description.bringup.lifeline import Lifeline
from amr_description.bringup.post_mortem import post_mortem
from amr_description.bringup.progress import Progress

CANNOT_START = 126  # the exit code that shells give a program that cannot be executed
_NOBODY_READS = 128 + signal.SIGPIPE  # as of a program that wrote into a closed pipe

# (signal, s to wait for the end before the next; None: as long as it takes)
_ESCALATION = ((signal.SIGINT, 5.0), (signal.SIGTERM, 5.0), (signal.SIGKILL, None))


class Orchestrator:
    """Runs one stack, once."""

    def __init__(self, stack: Stack, jobs: Sequence[Job], console: Console, run_name: str) -> None:
        """``jobs``: the nodes of the stack, made ready by :func:`job.jobs_of`."""
        self._stack = stack
        self._jobs: dict[Node, Job] = {job.node: job for job in jobs}
        self._console = console
        self._run_name = run_name
        self._progress = Progress(stack)
        self._children: dict[Node, Child] = {}  # in the order of their start
        self._unstarted: dict[Node, str] = {}  # why, of those that could not be
        self._wake = asyncio.Event()
        self._stop_requests = 0
        self._told_ready = False
        self._told_unreachable: set[Node] = set()
        self._exit_code = 0
        console.on_screen_lost = self._on_screen_lost

    async def run(self) -> int:
        """Run the stack to its end and return the exit code; nothing is left when it returns."""
        self._begin = time.monotonic()
        with self._signal_handlers():
            self._lifeline = Lifeline(self._run_name)
            try:
                await self._until_over()
            finally:
                await self._stop_all()
                await self._end_the_rest()
        self._tell_failure()
        failure = self._progress.failure
        return failure.exit_code if failure else self._exit_code

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
        again = ' again: not waiting any longer' if self._stop_requests else ''
        how = 'user interrupted with ctrl-c (SIGINT)' if number == signal.SIGINT else number.name
        self._console.say('WARNING', LAUNCH, how + again)
        self._request_stop()

    def _on_screen_lost(self) -> None:
        self._exit_code = _NOBODY_READS
        self._request_stop()

    def _request_stop(self) -> None:
        self._stop_requests += 1
        self._progress.over = True
        self._wake.set()

    async def _until_over(self) -> None:
        while not self._progress.over:
            while not self._progress.over and (nodes := self._progress.startable()):
                self._start(nodes[0])
            self._tell_progress()
            await self._event(None)
            self._collect()

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
        environment = child_environment(job.executable, os.environ) | self._lifeline.variables
        self._progress.start(node)
        try:
            job.write_parameter_files()
            child = Child(
                job.command,
                environment,
                self._lifeline.reader,
                lambda line: self._console.output(job.name, line),
            )
        except OSError as error:
            self._unstarted[node] = f'could not be started: {error}'
            self._console.say('ERROR', job.name, f'process {self._unstarted[node]}')
            self._progress.end(node, CANNOT_START)
            self._wake.set()
            return
        self._children[node] = child
        self._console.say('INFO', job.name, f'process started with pid [{child.pid}]')

    def _collect(self) -> None:
        """Take note of all processes that have ended."""
        for node, child in self._running().items():
            if child.poll():
                self._tell_end(self._jobs[node], child)
                self._progress.end(node, child.returncode)
        if self._lifeline.revive():
            self._console.say('WARNING', LAUNCH, 'somebody ended the guardian; started it anew')
        self._lifeline.reap_adopted(self._running_pids())

    def _running(self) -> dict[Node, Child]:
        return {n: child for n, child in self._children.items() if child.returncode is None}

    def _running_pids(self) -> set[int]:
        return {child.pid for child in self._running().values()}

    async def _stop_all(self) -> None:
        """Signal all at once in the reverse order of their start, and again where that fails."""
        begin = time.monotonic()
        before: signal.Signals | None = None
        for number, patience in _ESCALATION:
            running = self._running()
            for node, child in reversed(running.items()):
                self._tell_signal(self._jobs[node].name, number, before, time.monotonic() - begin)
                child.send(number)
            await self._until_ended(patience)
            before = number

    async def _until_ended(self, patience: float | None) -> None:
        """Wait for the end of all, at most ``patience`` s, or for somebody who is in a hurry."""
        deadline = None if patience is None else time.monotonic() + patience
        requests = self._stop_requests
        while self._running() and self._stop_requests == requests:
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

    def _tell_progress(self) -> None:
        name_of = self._name_of
        for node in self._progress.unreachable():
            if node not in self._told_unreachable and not self._progress.over:
                self._told_unreachable.add(node)
                reason = node.start_when.describe(name_of)
                self._console.say('WARNING', name_of(node), f'never starts: needs that {reason}')
        if self._progress.ready and not self._told_ready:
            self._told_ready = True
            steps = f': {self._stack.next_steps}' if self._stack.next_steps else ''
            took = time.monotonic() - self._begin
            self._console.say('INFO', LAUNCH, f'ready in {took:.1f} s{steps}')

    def _tell_end(self, job: Job, child: Child) -> None:
        if child.returncode == 0:
            text = f'process has finished cleanly [pid {child.pid}]'
            self._console.say('INFO', job.name, text)
            return
        text = (
            f'process has died [pid {child.pid}, exit code {child.returncode}, '
            f"cmd '{' '.join(job.command)}']."
        )
        self._console.say('ERROR', job.name, text)

    def _tell_signal(
        self, name: str, number: signal.Signals, before: signal.Signals | None, elapsed: float
    ) -> None:
        if before is None:
            text = f"sending signal '{number.name}' to process[{name}]"
            self._console.say('INFO', name, text)
            return
        seconds = f'{elapsed:.1f}'.removesuffix('.0')
        text = (
            f"process[{name}] failed to terminate '{seconds}' seconds after receiving "
            f"'{before.name}', escalating to '{number.name}'"
        )
        self._console.say('ERROR', name, text)

    def _tell_failure(self) -> None:
        failure = self._progress.failure
        if failure is None:
            return
        child = self._children.get(failure.node)
        lines = list(child.last_lines) if child else [self._unstarted[failure.node]]
        waiting = [self._name_of(node) for node in self._progress.waiting()]
        for text in post_mortem(self._name_of(failure.node), failure, lines, waiting):
            self._console.say('ERROR', LAUNCH, text)

    def _name_of(self, node: Node) -> str:
        return self._jobs[node].name
