# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
Observes what is outside the stack's processes, the ROS graph and files, while a condition asks.

The ROS graph is observed by a child process, ``nodes/graph_watch.py``, so that the supervisor
loads no DDS; it runs only while a condition on the graph is pending. Files are polled ten times a
second, since the standard library has no file notifications.
"""

from collections.abc import Callable, Iterable
import os
from pathlib import Path
import signal
from typing import TypeAlias

from amr_description.bringup.conditions import Condition, PathState, RosGraph
from amr_description.bringup.graph_conditions import GraphCondition, PathExists
from amr_description.bringup.process import RunningProcess
from amr_description.entry import python_command

GRAPH_WATCH = 'graph_watch'
COMMAND = python_command(
    'from amr_description.entry import nodes; sys.exit(nodes.graph_watch.main())'
)
"""Through ``entry.py``, so that an early SIGINT ends it without a traceback."""
_POLL_PERIOD = 0.1  # s
_FIRST_DELAY, _MAX_DELAY = 1.0, 30.0  # s before the process is started again

Spawn: TypeAlias = Callable[[Callable[[str], None]], RunningProcess]
"""Starts the process; takes the callback for the lines of its output."""


class GraphWatch:
    """The child process that observes the ROS graph, and the graph as its output describes it."""

    def __init__(self, spawn: Spawn, wake: Callable[[], None], log: Callable[[str], None]) -> None:
        """
        Start nothing yet.

        Args:
            spawn: starts the process; may raise OSError.
            wake: called when the graph has changed.
            log: called with each line that is meant for a person.
        """
        self._spawn = spawn
        self._wake = wake
        self._log = log
        self._entries: set[str] = set()
        self._delay = _FIRST_DELAY
        self._start_at: float | None = None
        self.process: RunningProcess | None = None

    @property
    def graph(self) -> RosGraph:
        """The graph as last reported."""
        found: dict[str, set[str]] = {'service': set(), 'node': set()}
        topics: dict[str, set[str]] = {}
        for entry in self._entries:
            kind, name, *types = entry.split(' ')
            if kind == 'topic':
                topics.setdefault(name, set()).update(types)
            else:
                found[kind].add(name)
        return RosGraph(topics, frozenset(found['service']), frozenset(found['node']))

    def set_wanted(self, wanted: bool, now: float) -> float | None:
        """Start or stop the process; return the time of its next start, s, if one is planned."""
        self._handle_exit(now)
        if not wanted:
            self.send(signal.SIGINT)
            self._start_at = None
        elif self.process is None and now >= (self._start_at or now):
            self._start(now)
        return self._start_at

    def send(self, number: signal.Signals) -> None:
        """Send a signal to the process, unless it was the last one sent."""
        if self.process is not None and self.process.sent != number:
            self.process.send(number)

    def poll(self) -> bool:
        """Return whether the process is running."""
        return self.process is not None and not self.process.poll()

    def _start(self, now: float) -> None:
        self._start_at = None
        self._entries.clear()
        try:
            self.process = self._spawn(self._on_line)
        except OSError as error:
            self._plan_start(now, f'could not be started: {error}')

    def _handle_exit(self, now: float) -> None:
        if self.process is None or not self.process.poll():
            return
        process, self.process = self.process, None
        process.close()
        self._entries.clear()
        if process.sent is None:
            self._plan_start(now, f'ended with exit code {process.returncode}')

    def _plan_start(self, now: float, reason: str) -> None:
        self._log(f'{reason}; the ROS graph is not seen; next start in {self._delay:g} s')
        self._start_at = now + self._delay
        self._delay = min(2 * self._delay, _MAX_DELAY)

    def _on_line(self, line: str) -> None:
        sign, _, entry = line.partition(' ')
        if sign not in ('+', '-') or entry.partition(' ')[0] not in ('topic', 'service', 'node'):
            self._log(line)
            return
        change = self._entries.add if sign == '+' else self._entries.discard
        change(entry)
        self._wake()


class ExternalState:
    """The ROS graph and the paths that pending conditions ask about."""

    def __init__(self, watch: GraphWatch) -> None:
        """Observe nothing yet."""
        self.watch = watch
        self.graph = RosGraph()
        self.paths: dict[str, PathState] = {}
        self.next_time: float | None = None
        """When to call :meth:`update` again although nothing happened, s; None: not needed."""

    def update(self, conditions: Iterable[Condition], now: float) -> None:
        """
        Observe what the conditions ask about.

        Args:
            conditions: all pending ones, with their parts.
            now: s, of a monotonic clock.
        """
        pending = list(conditions)
        on_graph = any(isinstance(each, GraphCondition) for each in pending)
        paths = {each.path for each in pending if isinstance(each, PathExists)}
        times = [self.watch.set_wanted(on_graph, now), now + _POLL_PERIOD if paths else None]
        if on_graph:
            self.graph = self.watch.graph
        self.paths |= {path: path_state(Path(path)) for path in paths}
        self.next_time = min((time for time in times if time is not None), default=None)


def path_state(path: Path) -> PathState:
    """Return whether a path exists and, if not, what is in the folder it would be in."""
    if path.exists():
        return PathState(True)
    try:
        return PathState(False, frozenset(os.listdir(path.parent)))
    except OSError:
        return PathState(False)
