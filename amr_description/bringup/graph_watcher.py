# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
What is seen of the world outside of a stack's processes, while a condition asks for it.

The ROS graph is seen by a process of its own, ``nodes/graph_watch.py``, which runs only as long as
somebody waits for something on the graph. Files are looked at ten times a second; the standard
library offers no way to be told of them.
"""

from collections.abc import Callable, Iterable
import os
from pathlib import Path
import signal
import sys

from amr_description.bringup.conditions import Condition, Graph, PathLook
from amr_description.bringup.graph_conditions import OnGraph, PathExists
from amr_description.bringup.process import RunningProcess

GRAPH_WATCH = 'graph_watch'
COMMAND = (
    sys.executable,
    '-P',
    '-c',
    'import sys; from amr_description.entry import nodes; sys.exit(nodes.graph_watch.main())',
)
"""By way of entry.py, so that an early SIGINT ends it without a word."""
_LOOK_PERIOD = 0.1  # s
_FIRST_DELAY, _LONGEST_DELAY = 1.0, 30.0  # s before the watch is started again

type Spawn = Callable[[Callable[[str], None]], RunningProcess]
"""Starts the watch; it is given who takes the lines that the watch writes."""


class GraphWatch:
    """The process that sees the ROS graph, and what it has told."""

    def __init__(self, spawn: Spawn, wake: Callable[[], None], say: Callable[[str], None]) -> None:
        """
        Start nothing yet.

        :param wake: Called when something on the graph has changed.
        :param say: Takes what a person should know: lines that are no news of the graph.
        """
        self._spawn = spawn
        self._wake = wake
        self._say = say
        self._entries: set[str] = set()
        self._delay = _FIRST_DELAY
        self._start_at: float | None = None
        self.process: RunningProcess | None = None

    @property
    def graph(self) -> Graph:
        """What is there."""
        found: dict[str, set[str]] = {'service': set(), 'node': set()}
        topics: dict[str, set[str]] = {}
        for entry in self._entries:
            kind, name, *types = entry.split(' ')
            if kind == 'topic':
                topics.setdefault(name, set()).update(types)
            else:
                found[kind].add(name)
        return Graph(topics, frozenset(found['service']), frozenset(found['node']))

    def want(self, wanted: bool, now: float) -> float | None:
        """Have it run, or not; return the time, s, of the next start if it waits for that."""
        self._take_end(now)
        if not wanted:
            self.send(signal.SIGINT)
            self._start_at = None
        elif self.process is None and now >= (self._start_at or now):
            self._start(now)
        return self._start_at

    def send(self, number: signal.Signals) -> None:
        """Signal it, each signal once."""
        if self.process is not None and self.process.sent != number:
            self.process.send(number)

    def poll(self) -> bool:
        """Return whether it still runs; its end is taken note of."""
        return self.process is not None and not self.process.poll()

    def _start(self, now: float) -> None:
        self._start_at = None
        self._entries.clear()
        try:
            self.process = self._spawn(self._hear)
        except OSError as error:
            self._plan_start(now, f'could not be started: {error}')

    def _take_end(self, now: float) -> None:
        if self.process is None or not self.process.poll():
            return
        process, self.process = self.process, None
        process.close()
        self._entries.clear()
        if process.sent is None:
            self._plan_start(now, f'ended with exit code {process.returncode}')

    def _plan_start(self, now: float, reason: str) -> None:
        self._say(f'{reason}; the ROS graph is not seen; next start in {self._delay:g} s')
        self._start_at = now + self._delay
        self._delay = min(2 * self._delay, _LONGEST_DELAY)

    def _hear(self, line: str) -> None:
        sign, _, entry = line.partition(' ')
        if sign not in ('+', '-') or entry.partition(' ')[0] not in ('topic', 'service', 'node'):
            self._say(line)
            return
        change = self._entries.add if sign == '+' else self._entries.discard
        change(entry)
        self._wake()


class ExternalState:
    """All that conditions may want to know of the world outside."""

    def __init__(self, watch: GraphWatch) -> None:
        """Look at nothing yet."""
        self.watch = watch
        self.graph = Graph()
        self.paths: dict[str, PathLook] = {}
        self.next_time: float | None = None
        """s; when to look again, if nothing happens before."""

    def look(self, conditions: Iterable[Condition], now: float) -> None:
        """See what the conditions ask for."""
        asked = list(conditions)
        on_graph = any(isinstance(each, OnGraph) for each in asked)
        paths = {each.path for each in asked if isinstance(each, PathExists)}
        times = [self.watch.want(on_graph, now), now + _LOOK_PERIOD if paths else None]
        if on_graph:
            self.graph = self.watch.graph
        self.paths |= {path: look_at(Path(path)) for path in paths}
        self.next_time = min((time for time in times if time is not None), default=None)


def look_at(path: Path) -> PathLook:
    """Look at a path and, if there is nothing, at the folder that it would be in."""
    if path.exists():
        return PathLook(True)
    try:
        return PathLook(False, frozenset(os.listdir(path.parent)))
    except OSError:
        return PathLook(False)
