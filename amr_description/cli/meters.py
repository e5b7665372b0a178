# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
The measurements of ``ros2 topic hz``, ``delay`` and ``bw``, over a window of messages.

Times are in ns as they arrive, and in s in reports; the text of a report is what the verb prints.
"""

from collections import deque
from collections.abc import Callable, Collection, Iterator
from contextlib import contextmanager
from dataclasses import dataclass, field
from math import sqrt
from typing import Any, ParamSpec, Self

from rclpy.clock import Clock, ClockType
from rclpy.experimental import EventsExecutor
from rclpy.qos import qos_profile_sensor_data

from amr_description.cli import graph
from amr_description.cli.names import full_name
from amr_description.cli.session import open_session, Session
from amr_description.clock import NANOSECONDS
from amr_description.ros.message_types import message_type

Arguments = ParamSpec('Arguments')

_PERIOD = 1.0  # s


@dataclass(frozen=True)
class MeasuredTopic:
    """A topic of the graph; ``name`` is absolute."""

    session: Session
    name: str
    message_class: Any
    failures: list[OSError] = field(default_factory=list)
    """Of writing, as after ``| head``: EventsExecutor would log each exception of a callback."""

    def subscribe(self, receive: Callable[[Any], None], *, raw: bool = True) -> None:
        """Call ``receive`` with each message, or with its bytes if ``raw``."""
        self.session.node.create_subscription(
            self.message_class, self.name, self._noting(receive), qos_profile_sensor_data, raw=raw
        )

    def every_second(self, report: Callable[[], None]) -> None:
        """Call ``report`` once per second, also while simulation time is stopped."""
        clock = Clock(clock_type=ClockType.STEADY_TIME)
        self.session.node.create_timer(_PERIOD, self._noting(report), clock=clock)

    def serve(self) -> None:
        """Run callbacks until Ctrl-C. Raises OSError: the output cannot be written."""
        self.session.serve(lambda: bool(self.failures))
        if self.failures:
            raise self.failures[0]

    def _noting(self, callback: Callable[Arguments, None]) -> Callable[Arguments, None]:
        def call(*args: Arguments.args, **kwargs: Arguments.kwargs) -> None:
            try:
                callback(*args, **kwargs)
            except OSError as error:
                self.failures.append(error)

        return call


@contextmanager
def measured_topic(name: str, *, use_sim_time: bool) -> Iterator[MeasuredTopic]:
    """
    Yield a topic once it is there, then run callbacks until Ctrl-C.

    Raises:
        AmrError: It is not there.
        OSError: The output cannot be written.
    """
    with open_session(use_sim_time=use_sim_time, executor=EventsExecutor) as session:
        topic = full_name(session.node, name)
        message_class = message_type(graph.wait_for_type(session, topic))
        measured = MeasuredTopic(session, topic, message_class)
        yield measured
        measured.serve()


_REPORT_PERIOD = NANOSECONDS  # of the rate
# (least bytes per second, divisor, decimals, name); 1 KB is 1000 B.
_UNITS = ((1e6, 1e6, 2, 'MB'), (1e3, 1e3, 2, 'KB'), (0.0, 1.0, 0, 'B'))


@dataclass(frozen=True)
class Bandwidth:
    """Bytes per second, and the sizes of the messages of a window, in bytes."""

    rate: float
    mean: float
    smallest: int
    largest: int
    window: int

    def __str__(self) -> str:
        """Return the two lines that ``ros2 topic bw`` prints, all in the unit of the rate."""
        _, divisor, decimals, unit = next(row for row in _UNITS if self.rate >= row[0])
        rate, mean, smallest, largest = (
            f'{count / divisor:.{decimals}f} {unit}'
            for count in (self.rate, self.mean, self.smallest, self.largest)
        )
        return (
            f'{rate}/s from {self.window} messages\n'
            f'\tMessage size mean: {mean} min: {smallest} max: {largest}'
        )


class BandwidthMeter:
    """Measures bandwidth, from the sizes of messages and the times at which they arrived."""

    def __init__(self, window: int) -> None:
        """Keep the last ``window`` messages."""
        self._messages: deque[tuple[int, int]] = deque(maxlen=window)

    def add(self, now: int, size: int) -> None:
        """Add a message: its time, ns, and its serialized size, bytes."""
        self._messages.append((now, size))

    def report(self, now: int) -> Bandwidth | None:
        """
        Return the bandwidth since the first message of the window; None: fewer than two messages.

        The window is cleared if time has jumped back.
        """
        if len(self._messages) < 2:
            return None
        start = self._messages[0][0]
        if now <= start:
            self._messages.clear()
            return None
        sizes = [size for _, size in self._messages]
        return Bandwidth(
            rate=sum(sizes) / (now - start) * NANOSECONDS,
            mean=sum(sizes) / len(sizes),
            smallest=min(sizes),
            largest=max(sizes),
            window=len(sizes),
        )


@dataclass(frozen=True)
class WindowStatistics:
    """
    Statistics of the durations of a window, s.

    ``deviation`` = sqrt(mean((duration - mean)²)), the population's, as in the original.
    """

    mean: float
    shortest: float
    longest: float
    deviation: float
    window: int

    @classmethod
    def of(cls, durations: Collection[int]) -> Self:
        """Return the statistics of at least one duration, ns."""
        mean = sum(durations) / len(durations)
        variance = sum((duration - mean) ** 2 for duration in durations) / len(durations)
        return cls(
            mean=mean / NANOSECONDS,
            shortest=min(durations) / NANOSECONDS,
            longest=max(durations) / NANOSECONDS,
            deviation=sqrt(variance) / NANOSECONDS,
            window=len(durations),
        )

    def __str__(self) -> str:
        """Return the second line that ``ros2 topic hz`` and ``delay`` print."""
        return (
            f'\tmin: {self.shortest:.3f}s max: {self.longest:.3f}s '
            f'std dev: {self.deviation:.5f}s window: {self.window}'
        )


class DelayStatistics(WindowStatistics):
    """The delays of the messages of a window, s."""

    def __str__(self) -> str:
        """Return the two lines that ``ros2 topic delay`` prints."""
        return f'average delay: {self.mean:.3f}\n{super().__str__()}'


class DelayMeter:
    """Measures delays, from the stamps of messages and the times at which they arrived."""

    def __init__(self, window: int) -> None:
        """Keep the last ``window`` delays."""
        self._delays: deque[int] = deque(maxlen=window)
        self._last = 0
        self._has_new = False

    def add(self, now: int, stamp: int) -> bool:
        """
        Add a message; return False, and clear the window, if time has jumped back.

        At time 0 simulation time has not started, and the delay is unknown.
        """
        jumped_back = now < self._last
        if jumped_back:
            self._delays.clear()
            self._has_new = False
        self._last = now
        if now > 0:
            self._delays.append(now - stamp)
            self._has_new = True
        return not jumped_back

    @property
    def started(self) -> bool:
        """Whether the window has any delay, reported or not."""
        return bool(self._delays)

    def report(self) -> DelayStatistics | None:
        """Return the delays if there are messages since the last report, else None."""
        if not self._has_new:
            return None
        self._has_new = False
        return DelayStatistics.of(self._delays)


class RateStatistics(WindowStatistics):
    """The intervals between the messages of a window, s."""

    @property
    def rate(self) -> float:
        """1 / mean, Hz."""
        return 1.0 / self.mean if self.mean > 0.0 else 0.0

    def __str__(self) -> str:
        """Return the two lines that ``ros2 topic hz`` prints."""
        return f'average rate: {self.rate:.3f}\n{super().__str__()}'


class RateMeter:
    """Measures rates, from the times at which messages arrived; reports once per second."""

    def __init__(self, window: int) -> None:
        """Keep the last ``window`` intervals."""
        self._intervals: deque[int] = deque(maxlen=window)
        self._last: int | None = None
        self._reported: int | None = None

    def add(self, now: int) -> bool:
        """Add a message; return False, and clear the window, if time has jumped back."""
        if self._last is not None and now < self._last:
            self._intervals.clear()
            self._last, self._reported = now, None
            return False
        if self._last is not None:
            self._intervals.append(now - self._last)
        self._last = now
        return True

    def report(self) -> RateStatistics | None:
        """Return the rate if messages span a second since the last report, else None."""
        if self._last is None or not self._intervals:
            return None
        if self._reported is None:
            self._reported = self._last
        if self._last < self._reported + _REPORT_PERIOD:
            return None
        self._reported = self._last
        return RateStatistics.of(self._intervals)
