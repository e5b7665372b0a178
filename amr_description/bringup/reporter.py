# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
What the orchestrator says of a stack: to a person, as launch does, and to programs.

What a stack waits for while it starts, told to who waits with it.

On a terminal that is one line, written anew a few times a second and gone when the stack is up;
elsewhere a line every few seconds, if it takes so long.

What is said about the failure that stopped a stack, last of all, where it is read.
"""

import asyncio
from collections.abc import Callable, Collection, Mapping, Sequence
import re
import signal
import time

from amr_description.bringup.command_line import ProcessSpec
from amr_description.bringup.conditions import Condition, may_never_hold, NameOf, StackState
from amr_description.bringup.console import Console, LAUNCH
from amr_description.bringup.description import Node, Stack
from amr_description.bringup.graph_watcher import GRAPH_WATCH
from amr_description.bringup.handlers import Shutdown
from amr_description.bringup.process import RunningProcess
from amr_description.bringup.run_log import EventLog
from amr_description.bringup.scheduler import Expired, Failure, Scheduler, Wait

_REFRESH = 0.25  # s between two states of the line on a terminal
_PATIENCE = 5.0  # s between two lines elsewhere


class StartStatus:
    """Looks at the progress again and again until the stack is up, or over."""

    def __init__(
        self, console: Console, name_of: NameOf, clock: Callable[[], float] = time.monotonic
    ) -> None:
        """``clock``: s; never goes back."""
        self._console = console
        self._name_of = name_of
        self._clock = clock
        self._begin = clock()
        self._since: dict[Node | None, float] = {}
        self._timer: asyncio.TimerHandle | None = None

    def follow(self, progress: Scheduler) -> None:
        """Tell of it from here on; called after each event, so that it is known since when."""
        if _is_done(progress):
            return
        self._look(progress)
        if self._timer is None:
            self._plan(progress)

    def end(self) -> None:
        """Tell no more."""
        if self._timer is not None:
            self._timer.cancel()
            self._timer = None
        self._console.status('')

    def text(self, progress: Scheduler) -> str:
        """Return the line; empty: nothing is waited for that could happen next."""
        waits = self._look(progress)
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

    def _look(self, progress: Scheduler) -> list[Wait]:
        """Return the waits that can be over next; note since when they are."""
        states = progress.situation.states
        waits = [
            (node, condition)
            for node, condition in progress.waits()
            if all(states[other].started for other in condition.nodes)
        ]
        now = self._clock()
        self._since = {node: self._since.get(node, now) for node, _ in waits}
        return waits

    def _plan(self, progress: Scheduler) -> None:
        period = _REFRESH if self._console.erases else _PATIENCE
        loop = asyncio.get_running_loop()
        self._timer = loop.call_later(period, self._tell, progress)

    def _tell(self, progress: Scheduler) -> None:
        if _is_done(progress):
            self.end()
            return
        text = self.text(progress)
        if self._console.erases:
            self._console.status(text)
        elif text:
            self._console.say('INFO', LAUNCH, text)
        self._plan(progress)


def _is_done(progress: Scheduler) -> bool:
    return progress.ready or progress.over


_LONGEST_REASON = 500  # characters
_ROS_LOG_PREFIX = re.compile(r'\[[A-Z]+\] \[[\d.]+\] \[\S+\]: ')


def failure_report(
    name: str, failure: Failure, last_lines: Collection[str], never_started: Sequence[str]
) -> list[str]:
    """
    Return the texts to print: the last lines of the process, then one line that says it all.

    :param last_lines: What the process wrote last.
    :param never_started: The names of the nodes that were not started because of it.
    """
    texts = []
    if len(last_lines) > 1:
        texts.append('\n    '.join([f'the last lines of {name}:', *last_lines]))
    spoken = [_ROS_LOG_PREFIX.sub('', line.strip()) for line in last_lines if line.strip()]
    reason = f': {spoken[-1][:_LONGEST_REASON]}' if spoken else ', without a word'
    missing = f' (never started: {", ".join(never_started)})' if never_started else ''
    return [*texts, f'stopped because {name} {manner(failure)}{missing}{reason}']


def expiry(
    expired: Expired, name_of: NameOf, last_lines: Mapping[Node, Collection[str]]
) -> list[str]:
    """Return the texts to print: the last lines of who was waited for, then one line."""
    awaited = [node for node in expired.condition.nodes if expired.situation.states[node].running]
    told = {name_of(node): last_lines.get(node) for node in awaited}
    texts = [
        '\n    '.join([f'the last lines of {name}:', *lines])
        for name, lines in told.items()
        if lines
    ]
    return [*texts, f'stopped because {expired.text(name_of)}']


def manner(failure: Failure) -> str:
    """Return in words how the process ended."""
    again = f', as did {failure.restarts} new starts' if failure.restarts else ''
    if failure.returncode >= 0:
        return f'ended with exit code {failure.returncode}{again}'
    return f'died of {signal_name(-failure.returncode)}{again}'


def signal_name(number: int) -> str:
    """Return the name of a signal, ``SIGKILL``."""
    try:
        return signal.Signals(number).name
    except ValueError:  # a real-time signal
        return f'signal {number}'


_POLITE = (signal.SIGINT, signal.SIGTERM)  # what a program may leave to its default
_MOST_STEPS = 6  # on a line


class Reporter:
    """Tells each event of a stack once, on the console and to the log of events."""

    def __init__(
        self, stack: Stack, jobs: Sequence[ProcessSpec], console: Console, events: EventLog
    ) -> None:
        """``jobs``: the nodes of the stack."""
        self._stack = stack
        self._jobs = {job.node: job for job in jobs}
        self._console = console
        self._events = events
        self._status = StartStatus(console, self._name_of)
        self._started_at: dict[Node, float] = {}
        self._steps: dict[str, float] = {}  # that came to their end, and how long they took, s
        for node in self._jobs:
            self._note('waiting', node, condition=self._condition_of(node))
        self._begin = time.monotonic()
        self._told: set[object] = set()
        self._held_once: set[Node] = set()

    def output(self, node: Node, line: str) -> None:
        """Show a line that the process of the node wrote."""
        self._console.output(self._name_of(node), line)

    def started(self, node: Node, pid: int) -> None:
        """Say that its process runs."""
        self._started_at[node] = time.monotonic()
        self._held(node)
        self._note('started', node, pid=pid)
        self._console.say('INFO', self._name_of(node), f'process started with pid [{pid}]')

    def not_started(self, node: Node, reason: str) -> None:
        """Say that its process could not be started."""
        self._held(node)
        self._note('not_started', node, reason=reason)
        self._console.say('ERROR', self._name_of(node), f'process {reason}')

    def _held(self, node: Node) -> None:
        """Note that its condition held, at its first start."""
        condition = self._condition_of(node)
        if condition and node not in self._held_once:
            self._held_once.add(node)
            self._note('condition_held', node, condition=condition)

    def ended(self, node: Node, child: RunningProcess) -> None:
        """Say how its process ended; launch calls it an error, too, if it did as it was told."""
        self._note('exited', node, pid=child.pid, **_end(child.returncode))
        if child.returncode == 0:
            self._steps[self._name_of(node)] = time.monotonic() - self._started_at[node]
            text = f'process has finished cleanly [pid {child.pid}]'
            self._console.say('INFO', self._name_of(node), text)
        elif child.sent in _POLITE and child.returncode in (-child.sent, 128 + child.sent):
            text = f'process has ended on {child.sent.name} [pid {child.pid}]'
            self._console.say('INFO', self._name_of(node), text)
        else:
            command = ' '.join(self._jobs[node].command)
            code = f'exit code {child.returncode}'
            text = f"process has died [pid {child.pid}, {code}, cmd '{command}']."
            self._console.say('ERROR', self._name_of(node), text)

    def progress(self, progress: Scheduler) -> None:
        """Say that the stack is ready, what it waits for, and what of it can never start."""
        self._status.follow(progress)
        for expired in progress.gave_up:
            self._never_starts(expired.node, expired.text(self._name_of))
        if not progress.over:
            for node in progress.unreachable():
                if not may_never_hold(progress.waits_for(node)):
                    self._never_starts(node, f'needs that {self._condition_of(node)}')
            self._never_ready(progress.never_ready)
        if progress.ready and progress.failure is None and 'ready' not in self._told:
            self._told.add('ready')
            self._status.end()
            took = time.monotonic() - self._begin
            self._note('ready', seconds=round(took, 3))
            if self._steps:
                self._console.say('INFO', LAUNCH, steps_text(self._steps))
            steps = f': {self._stack.all_next_steps}' if self._stack.all_next_steps else ''
            self._console.say('INFO', LAUNCH, f'ready in {took:.1f} s{steps}')

    def _never_starts(self, node: Node, why: str) -> None:
        if node not in self._told:
            self._told.add(node)
            self._note('never', node, condition=self._condition_of(node))
            self._console.say('WARNING', self._name_of(node), f'never starts: {why}')

    def _never_ready(self, lost: Condition | None) -> None:
        if lost is not None and 'ready' not in self._told:
            self._told.add('ready')
            needs = lost.describe(self._name_of)
            self._note('never_ready', condition=needs)
            self._console.say('WARNING', LAUNCH, f'never gets ready: needs that {needs}')
            self._status.end()

    def lends_terminal(self, node: Node) -> None:
        """Say that from here on the screen is that of its process."""
        log = self._console.log_of(LAUNCH)
        text = f'has the terminal; what the others say goes to {log}, their warnings also here'
        self._console.say('INFO', self._name_of(node), text)
        self._console.lend(True)

    def terminal_lent(self, is_lent: bool) -> None:
        """Note whether a process has the terminal."""
        self._console.lend(is_lent)

    def respawn(self, node: Node, situation: StackState) -> None:
        """Say that its process will be started again, if so."""
        state, rule = situation.states[node], node.respawn
        if state.restart_at is None or rule is None:
            return
        of = f' of {rule.limit}' if rule.limit is not None else ''
        delay = state.restart_at - situation.time
        self._note('respawn', node, seconds=round(delay, 3), restarts=state.restarts)
        text = f'process is started again in {delay:.1f} s ({state.restarts}{of})'
        self._console.say('WARNING', self._name_of(node), text)

    def shutdown(self, shutdown: Shutdown) -> None:
        """Say why a handler wants all to be stopped."""
        self._note('shutdown', reason=shutdown.reason)
        level = 'ERROR' if shutdown.exit_code else 'INFO'
        self._console.say(level, LAUNCH, f'stopping: {shutdown.reason}')

    def handler_failed(self, complaint: str) -> None:
        """Say what became of a handler."""
        self._console.say('ERROR', LAUNCH, complaint)

    def graph_watch_said(self, line: str) -> None:
        """Show what the process that sees the ROS graph has to tell a person."""
        self._console.output(GRAPH_WATCH, line)

    def guardian_replaced(self) -> None:
        """Say that somebody ended the guardian."""
        self._console.say('WARNING', LAUNCH, 'somebody ended the guardian; started it anew')

    def stop_requested(self, number: signal.Signals, again: bool) -> None:
        """Say that a signal asks for the end of all; ``again``: not for the first time."""
        self._note('stop_requested', signal=number.name)
        self._status.end()
        how = 'user interrupted with ctrl-c (SIGINT)' if number == signal.SIGINT else number.name
        suffix = ' again: not waiting any longer' if again else ''
        self._console.say('WARNING', LAUNCH, how + suffix)

    def signalled(
        self,
        node: Node,
        pid: int,
        number: signal.Signals,
        before: signal.Signals | None,
        elapsed: float,
    ) -> None:
        """
        Say that its process is sent a signal.

        :param pid: Its process id.
        :param before: The signal that did not help, or None.
        :param elapsed: s since the first signal.
        """
        name = self._name_of(node)
        self._status.end()
        self._note('signal_sent', node, pid=pid, signal=number.name)
        if before is None:
            self._console.say('INFO', name, f"sending signal '{number.name}' to process[{name}]")
            return
        seconds = f'{elapsed:.1f}'.removesuffix('.0')
        text = (
            f"process[{name}] failed to terminate '{seconds}' seconds after receiving "
            f"'{before.name}', escalating to '{number.name}'"
        )
        self._console.say('ERROR', name, text)

    def failure(self, progress: Scheduler, last_lines: Mapping[Node, Collection[str]]) -> None:
        """Say, last of all, which failure stopped the stack, if one did, and why."""
        failure, wish = progress.failure, progress.shutdown
        if failure is None:
            if wish and wish.exit_code:
                self._console.say('ERROR', LAUNCH, f'stopped because {wish.reason}')
            return
        waiting = [self._name_of(node) for node in progress.waiting()]
        if isinstance(failure, Expired):
            texts = expiry(failure, self._name_of, last_lines)
        else:
            name = self._name_of(failure.node)
            texts = failure_report(name, failure, last_lines[failure.node], waiting)
        self._note('failure', failure.node, reason=texts[-1])
        for text in texts:
            self._console.say('ERROR', LAUNCH, text)

    def _note(self, event: str, node: Node | None = None, **more: object) -> None:
        self._events.note(event, self._name_of(node) if node else None, **more)

    def _condition_of(self, node: Node) -> str | None:
        condition = self._jobs[node].placed.start_when
        return condition and condition.describe(self._name_of)

    def _name_of(self, node: Node) -> str:
        return self._jobs[node].name


def steps_text(steps: Mapping[str, float]) -> str:
    """Return how long each step took, in their order; of many only the longest."""
    shown = sorted(steps, key=steps.__getitem__, reverse=True)[:_MOST_STEPS]
    texts = [f'{name} {took:.1f} s' for name, took in steps.items() if name in shown]
    more = f' and {len(steps) - len(shown)} shorter ones' if len(steps) > len(shown) else ''
    return f'steps: {", ".join(texts)}{more}'


def _end(returncode: int) -> dict[str, object]:
    """Return how a process ended, for the log of events."""
    if returncode >= 0:
        return {'exit_code': returncode}
    return {'signal': signal_name(-returncode)}
