# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
Reports the events of a stack: to the console in launch's words, and to the log of events.

While a stack starts, :class:`StartStatus` shows what it waits for: on a terminal in one line that
is rewritten a few times a second and erased when the stack is up, elsewhere in a line every few
seconds. After a failure, :func:`failure_report` or :func:`timeout_report` is printed last of all,
where it is read. All of it runs on the orchestrator's event loop.
"""

import asyncio
from collections.abc import Callable, Collection, Mapping, Sequence
import re
import signal
import time

from amr_description.bringup.command_line import ProcessSpec
from amr_description.bringup.conditions import (
    Condition,
    may_never_hold,
    NameOf,
    NodeRef,
    StackState,
)
from amr_description.bringup.console import Console, LAUNCH, LAUNCH_USER
from amr_description.bringup.description import Node, Stack
from amr_description.bringup.graph_watcher import GRAPH_WATCH
from amr_description.bringup.handlers import Shutdown
from amr_description.bringup.process import RunningProcess
from amr_description.bringup.run_log import EventLog
from amr_description.bringup.scheduler import Expired, Failure, Scheduler, Wait
from amr_description.text import shorten

_REFRESH_PERIOD = 0.25  # s between two states of the line on a terminal
_LINE_PERIOD = 5.0  # s between two lines elsewhere
_MAX_REASON = 500  # characters
_MAX_STEPS = 6  # in a line
_ROS_LOG_PREFIX = re.compile(r'\[[A-Z]+\] \[[\d.]+\] \[\S+\]: ')
_POLITE = (signal.SIGINT, signal.SIGTERM)  # by which a program may end without handling them


class Reporter:
    """Reports each event of one run once."""

    def __init__(
        self, stack: Stack, specs: Sequence[ProcessSpec], console: Console, events: EventLog
    ) -> None:
        """
        Log that all nodes wait.

        Args:
            stack: what is run.
            specs: its nodes.
            console: where lines for a person go.
            events: where events for programs go.
        """
        self._stack = stack
        self._specs: dict[NodeRef, ProcessSpec] = {spec.node: spec for spec in specs}
        self._console = console
        self._events = events
        self._start_status = StartStatus(console, self._name_of)
        self._started_at: dict[Node, float] = {}
        self._steps: dict[str, float] = {}  # nodes that ended well, and how long they ran, s
        for node in self._specs:
            self._note('waiting', node, condition=self._condition_of(node))
        self._begin = time.monotonic()
        self._readiness_reported = False
        self._never_starting: set[Node] = set()  # those reported
        self._met: set[Node] = set()  # those whose condition was reported to hold

    def output(self, node: Node, line: str) -> None:
        """Show a line of a node's output."""
        self._console.output(self._name_of(node), line)

    def started(self, node: Node, pid: int) -> None:
        """Report that the process of a node was started."""
        self._started_at[node] = time.monotonic()
        self._condition_held(node)
        self._note('started', node, pid=pid)
        self._console.log('INFO', self._name_of(node), f'process started with pid [{pid}]')

    def not_started(self, node: Node, reason: str) -> None:
        """Report that the process of a node could not be started."""
        self._condition_held(node)
        self._note('not_started', node, reason=reason)
        self._console.log('ERROR', self._name_of(node), f'process {reason}')

    def ended(self, node: Node, process: RunningProcess) -> None:
        """Report how a process ended: as an error, like launch, unless it was asked to end."""
        name, code = self._name_of(node), process.returncode
        self._note('exited', node, pid=process.pid, **_exit_fields(code))
        if code == 0:
            self._steps[name] = time.monotonic() - self._started_at[node]
            text = f'process has finished cleanly [pid {process.pid}]'
            self._console.log('INFO', name, text)
        elif process.sent in _POLITE and code in (-process.sent, 128 + process.sent):
            text = f'process has ended on {process.sent.name} [pid {process.pid}]'
            self._console.log('INFO', name, text)
        else:
            command = ' '.join(self._specs[node].command)
            text = f"process has died [pid {process.pid}, exit code {code}, cmd '{command}']."
            self._console.log('ERROR', name, text)

    def respawn(self, node: Node, state: StackState, last_lines: Sequence[str]) -> None:
        """
        Report when the process of a node that has ended is started again, or that it is no more.

        Args:
            node: has ended.
            state: of the stack, now.
            last_lines: of its output: the last one is the reason, as a rule.
        """
        own, rule = state.nodes[node], node.respawn
        if rule is None:
            return
        reason = f'; its last line: {shorten(last_lines[-1])}' if last_lines else ''
        if own.restart_at is None:
            if rule.limit is not None and own.restarts >= rule.limit:
                text = f'process is not started again, as it has ended {own.restarts + 1} times'
                self._console.log('ERROR', self._name_of(node), f'{text} in a row{reason}')
            return
        of = f' of {rule.limit}' if rule.limit is not None else ''
        delay = own.restart_at - state.time
        self._note('respawn', node, seconds=round(delay, 3), restarts=own.restarts)
        text = f'process is started again in {delay:.1f} s ({own.restarts}{of}){reason}'
        self._console.log('WARNING', self._name_of(node), text)

    def lines(self, scheduler: Scheduler) -> None:
        """Show the lines that handlers have returned."""
        while scheduler.lines:
            line = scheduler.lines.popleft()
            self._console.log(line.level, LAUNCH_USER, line.text)

    def progress(self, scheduler: Scheduler) -> None:
        """Report that the stack is ready, what it waits for, and what can never start."""
        self.lines(scheduler)
        self._start_status.follow(scheduler)
        for expired in scheduler.abandoned:
            self._never_starts(expired.node, expired.text(self._name_of))
        if not scheduler.over:
            for node in scheduler.unreachable():
                if not may_never_hold(scheduler.condition_of(node)):
                    self._never_starts(node, f'needs that {self._condition_of(node)}')
            self._never_ready(scheduler.never_ready)
        if scheduler.ready and scheduler.failure is None and not self._readiness_reported:
            self._ready()

    def stop_requested(self, number: signal.Signals, again: bool) -> None:
        """Report a signal that asks to stop the stack; ``again``: it is not the first one."""
        self._note('stop_requested', signal=number.name)
        self._start_status.end()
        how = 'user interrupted with ctrl-c (SIGINT)' if number == signal.SIGINT else number.name
        suffix = ' again: not waiting any longer' if again else ''
        self._console.log('WARNING', LAUNCH, how + suffix)

    def shutdown(self, shutdown: Shutdown) -> None:
        """Report why a handler stops the stack."""
        self._note('shutdown', reason=shutdown.reason)
        level = 'ERROR' if shutdown.exit_code else 'INFO'
        self._console.log(level, LAUNCH, f'stopping: {shutdown.reason}')

    def signal_sent(
        self,
        node: Node,
        pid: int,
        number: signal.Signals,
        before: signal.Signals | None,
        elapsed: float,
    ) -> None:
        """
        Report that a process is sent a signal.

        Args:
            node: whose process it is.
            pid: its process id.
            number: the signal.
            before: the signal on which it did not end, or None.
            elapsed: s since the first signal.
        """
        name = self._name_of(node)
        self._start_status.end()
        self._note('signal_sent', node, pid=pid, signal=number.name)
        if before is None:
            self._console.log('INFO', name, f"sending signal '{number.name}' to process[{name}]")
            return
        seconds = f'{elapsed:.1f}'.removesuffix('.0')
        text = (
            f"process[{name}] failed to terminate '{seconds}' seconds after receiving "
            f"'{before.name}', escalating to '{number.name}'"
        )
        self._console.log('ERROR', name, text)

    def failure(
        self, scheduler: Scheduler, last_lines: Mapping[Node, Collection[str]], found: str = ''
    ) -> None:
        """
        Report, last of all, what stopped the stack, if it was a failure.

        Args:
            scheduler: its state.
            last_lines: of the output of each node.
            found: what the doctor has found; empty: nothing.
        """
        failure, shutdown = scheduler.failure, scheduler.shutdown
        if failure is None:
            if shutdown and shutdown.exit_code:
                self._console.log('ERROR', LAUNCH, f'stopped because {shutdown.reason}')
            return
        if isinstance(failure, Expired):
            texts = timeout_report(failure, self._name_of, last_lines)
        else:
            name = self._name_of(failure.node)
            never_started = [self._name_of(node) for node in scheduler.waiting()]
            texts = failure_report(name, failure, last_lines[failure.node], never_started)
        self._note('failure', failure.node, reason=texts[-1])
        for text in [*texts, *([f'ros2 doctor finds: {found}'] if found else [])]:
            self._console.log('ERROR', LAUNCH, text)

    def handler_failed(self, text: str) -> None:
        """Report the exception of a handler."""
        self._console.log('ERROR', LAUNCH, text)

    def graph_watch_output(self, line: str) -> None:
        """Show what the process that observes the ROS graph logs."""
        self._console.output(GRAPH_WATCH, line)

    def guardian_replaced(self) -> None:
        """Report that the guardian had ended."""
        self._console.log('WARNING', LAUNCH, 'somebody ended the guardian; started it anew')

    def guardian_killed(self, seconds: float) -> None:
        """Report that the guardian does not end."""
        text = f'the guardian has not ended after {seconds:g} s (was it stopped?): killed it'
        self._console.log('ERROR', LAUNCH, text)

    def lending_terminal(self, node: Node) -> None:
        """Report that from here on the screen belongs to the process of a node."""
        log = self._console.log_path(LAUNCH)
        text = f'has the terminal; what the others say goes to {log}, their warnings also here'
        self._console.log('INFO', self._name_of(node), text)
        self._console.set_lent(True)

    def terminal_lent(self, is_lent: bool) -> None:
        """Note whether the process of a node has the terminal."""
        self._console.set_lent(is_lent)

    def _condition_held(self, node: Node) -> None:
        """Note that the condition of a node held, at its first start."""
        condition = self._condition_of(node)
        if condition and node not in self._met:
            self._met.add(node)
            self._note('condition_held', node, condition=condition)

    def _ready(self) -> None:
        self._readiness_reported = True
        self._start_status.end()
        seconds = time.monotonic() - self._begin
        self._note('ready', seconds=round(seconds, 3))
        if self._steps:
            self._console.log('INFO', LAUNCH, steps_text(self._steps))
        next_steps = self._stack.all_next_steps
        suffix = f': {next_steps}' if next_steps else ''
        self._console.log('INFO', LAUNCH, f'ready in {seconds:.1f} s{suffix}')

    def _never_starts(self, node: NodeRef, why: str) -> None:
        if node not in self._never_starting:
            self._never_starting.add(node)
            self._note('never', node, condition=self._condition_of(node))
            self._console.log('WARNING', self._name_of(node), f'never starts: {why}')

    def _never_ready(self, condition: Condition | None) -> None:
        if condition is not None and not self._readiness_reported:
            self._readiness_reported = True
            text = condition.describe(self._name_of)
            self._note('never_ready', condition=text)
            self._console.log('WARNING', LAUNCH, f'never gets ready: needs that {text}')
            self._start_status.end()

    def _note(self, event: str, node: NodeRef | None = None, **more: object) -> None:
        self._events.note(event, self._name_of(node) if node else None, **more)

    def _condition_of(self, node: NodeRef) -> str | None:
        condition = self._specs[node].resolved.start_when
        return condition.describe(self._name_of) if condition else None

    def _name_of(self, node: NodeRef) -> str:
        return self._specs[node].name


class StartStatus:
    """Shows what a stack waits for, until it is up or over."""

    def __init__(
        self, console: Console, name_of: NameOf, clock: Callable[[], float] = time.monotonic
    ) -> None:
        """
        Show nothing yet.

        Args:
            console: where to show it.
            name_of: returns the name of a node.
            clock: returns s; never goes back.
        """
        self._console = console
        self._name_of = name_of
        self._clock = clock
        self._begin = clock()
        self._since: dict[Node | None, float] = {}
        self._timer: asyncio.TimerHandle | None = None

    def follow(self, scheduler: Scheduler) -> None:
        """Show it from now on; called after each event, so that the start of waits is known."""
        if _is_done(scheduler):
            return
        self._update(scheduler)
        if self._timer is None:
            self._schedule(scheduler)

    def end(self) -> None:
        """Stop, and erase the line."""
        if self._timer is not None:
            self._timer.cancel()
            self._timer = None
        self._console.status('')

    def text(self, scheduler: Scheduler) -> str:
        """Return the line; empty if no wait can end next."""
        waits = self._update(scheduler)
        if not waits:
            return ''
        now = self._clock()
        node, condition = waits[0]
        who = self._name_of(node) if node else 'the stack'
        more = f' and {len(waits) - 1} more' if len(waits) > 1 else ''
        return (
            f'{now - self._begin:.1f} s: {who} waits until {condition.describe(self._name_of)} '
            f'({now - self._since[node]:.1f} s){more}'
        )

    def _update(self, scheduler: Scheduler) -> list[Wait]:
        """Return the waits that can end next, and note since when they are pending."""
        nodes = scheduler.state.nodes
        waits = [
            (node, condition)
            for node, condition in scheduler.waits()
            if all(nodes[other].started for other in condition.nodes)
        ]
        now = self._clock()
        self._since = {node: self._since.get(node, now) for node, _ in waits}
        return waits

    def _schedule(self, scheduler: Scheduler) -> None:
        period = _REFRESH_PERIOD if self._console.erases else _LINE_PERIOD
        loop = asyncio.get_running_loop()
        self._timer = loop.call_later(period, self._show, scheduler)

    def _show(self, scheduler: Scheduler) -> None:
        if _is_done(scheduler):
            self.end()
            return
        text = self.text(scheduler)
        if self._console.erases:
            self._console.status(text)
        elif text:
            self._console.log('INFO', LAUNCH, text)
        self._schedule(scheduler)


def _is_done(scheduler: Scheduler) -> bool:
    return scheduler.ready or scheduler.over


def steps_text(steps: Mapping[str, float]) -> str:
    """Return how long each step took, s, in their order; of many only the longest ones."""
    shown = sorted(steps, key=steps.__getitem__, reverse=True)[:_MAX_STEPS]
    texts = [f'{name} {took:.1f} s' for name, took in steps.items() if name in shown]
    more = f' and {len(steps) - len(shown)} shorter ones' if len(steps) > len(shown) else ''
    return f'steps: {", ".join(texts)}{more}'


def failure_report(
    name: str, failure: Failure, last_lines: Collection[str], never_started: Sequence[str]
) -> list[str]:
    """
    Return the messages about a node that failed: its last lines, then one line with the reason.

    Args:
        name: the node.
        failure: how its process ended.
        last_lines: the last lines of its output.
        never_started: the nodes that were not started because of it.
    """
    messages = [_last_lines_of(name, last_lines)] if len(last_lines) > 1 else []
    written = [_ROS_LOG_PREFIX.sub('', line.strip()) for line in last_lines if line.strip()]
    reason = f': {written[-1][:_MAX_REASON]}' if written else ', without a word'
    missing = f' (never started: {", ".join(never_started)})' if never_started else ''
    return [*messages, f'stopped because {name} {_how_it_ended(failure)}{missing}{reason}']


def timeout_report(
    expired: Expired, name_of: NameOf, last_lines: Mapping[Node, Collection[str]]
) -> list[str]:
    """
    Return the messages about a timeout: the last lines of the awaited nodes, then one line.

    Args:
        expired: the wait.
        name_of: returns the name of a node.
        last_lines: the last lines of the output of each node.
    """
    awaited = [node for node in expired.condition.nodes if expired.state.nodes[node].running]
    lines_of = {name_of(node): last_lines.get(node) for node in awaited}
    messages = [_last_lines_of(name, lines) for name, lines in lines_of.items() if lines]
    return [*messages, f'stopped because {expired.text(name_of)}']


def _last_lines_of(name: str, lines: Collection[str]) -> str:
    return '\n    '.join([f'the last lines of {name}:', *lines])


def _how_it_ended(failure: Failure) -> str:
    again = f', as did {failure.restarts} new starts' if failure.restarts else ''
    if failure.returncode >= 0:
        return f'ended with exit code {failure.returncode}{again}'
    return f'died of {_signal_name(-failure.returncode)}{again}'


def _exit_fields(returncode: int) -> dict[str, object]:
    """Return how a process ended, for the log of events."""
    if returncode >= 0:
        return {'exit_code': returncode}
    return {'signal': _signal_name(-returncode)}


def _signal_name(number: int) -> str:
    try:
        return signal.Signals(number).name
    except ValueError:  # a real-time signal
        return f'signal {number}'
