# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
How often transforms come and how late they are: the numbers of ``tf2_monitor``.

This module imports no rclpy. Times are integer nanoseconds.
"""

from collections import deque
from collections.abc import Iterable, Mapping, Sequence

from amr_description.clock import NANOSECONDS

UNKNOWN = '<no authority available>'
"""What tf2_monitor prints for a publisher that it does not know."""

_NAMED = 3  # nodes
_REMEMBERED = 1000  # messages, as in tf2
_OTHER_CLOCK = 1e8  # s: three years late is not late, it is another clock


class Delays:
    """When something came and how old it was, over its last 1000 times."""

    def __init__(self) -> None:
        self._arrivals: deque[int] = deque(maxlen=_REMEMBERED)
        self._delays: deque[float] = deque(maxlen=_REMEMBERED)

    def add(self, now: int, delay: float) -> None:
        """Take note that something ``delay`` s old came at ``now``, ns."""
        self._arrivals.append(now)
        self._delays.append(delay)

    @property
    def average(self) -> float:
        """The average delay, s."""
        return sum(self._delays) / len(self._delays) if self._delays else 0.0

    @property
    def maximum(self) -> float:
        """The longest delay, s; not below 0: a stamp of the future is not late."""
        return max((*self._delays, 0.0))

    @property
    def frequency(self) -> float:
        """How often it came, Hz; 0 when it came but once."""
        if len(self._arrivals) < 2 or self._arrivals[-1] == self._arrivals[0]:
            return 0.0
        return (len(self._arrivals) - 1) * NANOSECONDS / (self._arrivals[-1] - self._arrivals[0])


class TransformStatistics:
    """
    All that was heard, by frame and by topic. What is static is never late and has no rate.

    The original tells a static transform to be as late as its listener, and counts the average of
    a chain up from 0 over minutes.
    """

    def __init__(self) -> None:
        self._frames: dict[str, Delays] = {}
        self._topic_of: dict[str, str] = {}
        self._topics: dict[str, Delays] = {}
        self._way = Delays()

    def hear(
        self, topic: str, transforms: Iterable[tuple[str, int]], now: int, *, static: bool
    ) -> None:
        """Take note of a message: the child and the stamp of each transform."""
        delays = []
        arrival = 0 if static else now  # what is said once, has no rate
        for child, stamp in transforms:
            delay = 0.0 if static else (now - stamp) / NANOSECONDS
            delays.append(delay)
            self._frames.setdefault(child, Delays()).add(arrival, delay)
            self._topic_of[child] = topic
        average = sum(delays) / max(1, len(delays))
        self._topics.setdefault(topic, Delays()).add(arrival, average)

    def note_way(self, stamp: int, now: int) -> None:
        """Take note of the latest common time of the chain that is watched; 0: all is static."""
        self._way.add(now, (now - stamp) / NANOSECONDS if stamp else 0.0)

    def report(
        self, publishers: Mapping[str, Sequence[str]], chain: Sequence[str] | None = None
    ) -> str:
        """
        Write it all as tf2_monitor does, with the names of the nodes that publish each topic.

        ``chain``: from the one watched frame to the other; None: all frames.
        """
        lines = ['', '', '']
        if chain is None:
            lines.append('RESULTS: for all Frames')
        else:
            lines += [
                f'RESULTS: for {chain[0]} to {chain[-1]}',
                f'Chain is: {" -> ".join(chain)}',
                f'Net delay     avg = {self._way.average:g}: max = {self._way.maximum:g}',
            ]
        frames = sorted(self._frames if chain is None else self._frames.keys() & {*chain})
        lines += ['', 'Frames:', *(self._frame_line(name, publishers) for name in frames)]
        lines += ['', 'All Broadcasters:']
        for topic, delays in sorted(self._topics.items()):
            lines.append(
                f'Node: {broadcaster(publishers.get(topic, ()))} {delays.frequency:g} Hz, '
                f'Average Delay: {delays.average:g} Max Delay: {delays.maximum:g}'
            )
        if any(delays.maximum > _OTHER_CLOCK for delays in self._topics.values()):
            lines.append(
                'The stamps are of another clock. Of simulated time? Then add '
                '--ros-args -p use_sim_time:=true'
            )
        return '\n'.join(lines)

    def _frame_line(self, name: str, publishers: Mapping[str, Sequence[str]]) -> str:
        delays = self._frames[name]
        return (
            f'Frame: {name}, published by '
            f'{broadcaster(publishers.get(self._topic_of[name], ()))}, '
            f'Average Delay: {delays.average:g}, Max Delay: {delays.maximum:g}, '
            f'Frequency: {delays.frequency:g} Hz'
        )


def broadcaster(nodes: Sequence[str]) -> str:
    """Name who published something on a topic: one of its nodes; no message tells which."""
    more = len(nodes) - _NAMED
    return ' or '.join([*nodes[:_NAMED], *([f'{more} more'] if more > 0 else [])]) or UNKNOWN
