# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
How often transforms arrive, and with which delay: the numbers of ``tf2_monitor``.

Times are integer nanoseconds.
"""

from collections import deque
from collections.abc import Iterable, Mapping, Sequence

from amr_description.clock import NANOSECONDS

UNKNOWN = '<no authority available>'
"""What tf2_monitor prints for a publisher that it does not know."""

_NAMED = 3  # nodes of a topic
_REMEMBERED = 1000  # messages, as in tf2
_OTHER_CLOCK = 1e8  # s: a delay of three years means another clock


class DelayStatistics:
    """The arrival times and delays of the last 1000 messages of one kind."""

    def __init__(self) -> None:
        self._arrivals: deque[int] = deque(maxlen=_REMEMBERED)
        self._delays: deque[float] = deque(maxlen=_REMEMBERED)

    def add(self, now: int, delay: float) -> None:
        """Record a message that arrived at ``now``, ns, with a delay in s."""
        self._arrivals.append(now)
        self._delays.append(delay)

    @property
    def average(self) -> float:
        """The average delay, s; 0 without a message."""
        return sum(self._delays) / len(self._delays) if self._delays else 0.0

    @property
    def maximum(self) -> float:
        """The longest delay, s; not below 0, which stamps of the future would give."""
        return max((*self._delays, 0.0))

    @property
    def frequency(self) -> float:
        """The average frequency, Hz; 0 if there was only one message."""
        if len(self._arrivals) < 2 or self._arrivals[-1] == self._arrivals[0]:
            return 0.0
        return (len(self._arrivals) - 1) * NANOSECONDS / (self._arrivals[-1] - self._arrivals[0])


class TransformStatistics:
    """
    The delays of all transforms, by frame and by topic; static ones have no delay and no rate.

    In the original a static transform is as late as its listener was started, and the average of
    a chain climbs from 0 for minutes.
    """

    def __init__(self) -> None:
        self._frames: dict[str, DelayStatistics] = {}
        self._topic_of: dict[str, str] = {}
        self._topics: dict[str, DelayStatistics] = {}
        self._chain = DelayStatistics()

    def add_message(
        self, topic: str, transforms: Iterable[tuple[str, int]], now: int, *, static: bool
    ) -> None:
        """Record a message by the child and the stamp of each of its transforms."""
        delays = []
        arrival = 0 if static else now  # what is published once has no rate
        for child, stamp in transforms:
            delay = 0.0 if static else (now - stamp) / NANOSECONDS
            delays.append(delay)
            self._frames.setdefault(child, DelayStatistics()).add(arrival, delay)
            self._topic_of[child] = topic
        average = sum(delays) / max(1, len(delays))
        self._topics.setdefault(topic, DelayStatistics()).add(arrival, average)

    def add_chain_delay(self, stamp: int, now: int) -> None:
        """Record the latest common time of the monitored chain; 0: all of it is static."""
        self._chain.add(now, (now - stamp) / NANOSECONDS if stamp else 0.0)

    def report(
        self, publishers: Mapping[str, Sequence[str]], chain: Sequence[str] | None = None
    ) -> str:
        """
        Return the lines that tf2_monitor prints.

        Args:
            publishers: the full names of the nodes that publish each topic.
            chain: the frames from the one monitored frame to the other; None: all frames.
        """
        lines = ['', '', '']
        if chain is None:
            lines.append('RESULTS: for all Frames')
        else:
            lines += [
                f'RESULTS: for {chain[0]} to {chain[-1]}',
                f'Chain is: {" -> ".join(chain)}',
                f'Net delay     avg = {self._chain.average:g}: max = {self._chain.maximum:g}',
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
    """Return the nodes that may have published on a topic; messages do not say which did."""
    more = len(nodes) - _NAMED
    return ' or '.join([*nodes[:_NAMED], *([f'{more} more'] if more > 0 else [])]) or UNKNOWN
