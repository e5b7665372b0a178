# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
``diagnostic_updater``: what a node says of its health on ``/diagnostics``, once in a period.

Ages of stamps are measured by the clock of the node where that is known, and so in simulated time,
too; the original takes the time of the system.
"""

# ruff: noqa: N802, N803

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from threading import Lock
from typing import Any, Protocol

from diagnostic_msgs.msg import DiagnosticArray, DiagnosticStatus, KeyValue
from rclpy.clock import Clock
from rclpy.clock_type import ClockType
from rclpy.node import Node
from rclpy.time import Time

from amr_description.clock import NANOSECONDS

_NO_HARDWARE_ID = (
    'diagnostic_updater: No HW_ID was set. This is probably a bug. Please report it. For devices '
    'that do not have a HW_ID, set this value to none. This warning only occurs once all '
    'diagnostics are OK so it is okay to wait until the device is open before calling '
    'setHardwareID.'
)


class DiagnosticStatusWrapper(DiagnosticStatus):
    """A status that is filled piece by piece."""

    def summary(self, *args: Any) -> None:
        """Set the level and the message: ``summary(level, message)``, or those of a status."""
        self.level, self.message = _level_and_message(args)

    def clearSummary(self) -> None:
        """Set them to OK and nothing."""
        self.summary(DiagnosticStatus.OK, '')

    def mergeSummary(self, *args: Any) -> None:
        """Add a summary: the worse level counts; messages of one kind, good or bad, are joined."""
        level, message = _level_and_message(args)
        if (level > DiagnosticStatus.OK) == (self.level > DiagnosticStatus.OK):
            self.message = f'{self.message}; {message}' if self.message else message
        elif level > self.level:
            self.message = message
        self.level = max(self.level, level)

    def add(self, key: str, val: object) -> None:
        """Add a value."""
        self.values.append(KeyValue(key=key, value=str(val)))


def _level_and_message(args: tuple[Any, ...]) -> tuple[bytes, str]:
    if len(args) == 1:
        return args[0].level, args[0].message
    level, message = args
    return level, str(message)


Filler = Callable[[DiagnosticStatusWrapper], DiagnosticStatusWrapper]
"""Fills a status, and returns it."""


class DiagnosticTask:
    """Base of all tasks: a name, and what fills a status."""

    def __init__(self, name: str) -> None:
        self.name = name

    def getName(self) -> str:
        """Return the name."""
        return self.name

    def run(self, stat: DiagnosticStatusWrapper) -> DiagnosticStatusWrapper:
        """Fill a status, and return it."""
        return stat


class FunctionDiagnosticTask(DiagnosticTask):
    """A function that fills a status."""

    def __init__(self, name: str, fn: Filler) -> None:
        super().__init__(name)
        self.fn = fn

    def run(self, stat: DiagnosticStatusWrapper) -> DiagnosticStatusWrapper:
        """Call the function."""
        return self.fn(stat)


class CompositeDiagnosticTask(DiagnosticTask):
    """Several tasks with one status: the worst level, and the messages of that kind."""

    def __init__(self, name: str) -> None:
        super().__init__(name)
        self.tasks: list[DiagnosticTask] = []

    def addTask(self, t: DiagnosticTask) -> None:
        """Add a task."""
        self.tasks.append(t)

    def run(self, stat: DiagnosticStatusWrapper) -> DiagnosticStatusWrapper:
        """Run all tasks; each is given the summary that this one was given."""
        given, merged = DiagnosticStatusWrapper(), DiagnosticStatusWrapper()
        given.summary(stat)
        for task in self.tasks:
            stat.summary(given)
            stat = task.run(stat)
            merged.mergeSummary(stat)
        stat.summary(merged)
        return stat


class DiagnosticTaskVector:
    """Tasks, by their names."""

    def __init__(self) -> None:
        self.tasks: list[DiagnosticTask] = []
        self.lock = Lock()

    def addedTaskCallback(self, task: DiagnosticTask) -> None:
        """Do something about a task that was added; for subclasses."""

    def add(self, *args: Any) -> None:
        """Add a task: ``add(task)`` or ``add(name, function)``."""
        task = args[0] if len(args) == 1 else FunctionDiagnosticTask(*args)
        with self.lock:
            self.tasks.append(task)
            self.addedTaskCallback(task)

    def removeByName(self, name: str) -> bool:
        """Remove the first task of a name; return whether there was one."""
        with self.lock:
            for task in self.tasks:
                if task.name == name:
                    self.tasks.remove(task)
                    return True
        return False


class Updater(DiagnosticTaskVector):
    """Runs its tasks once in ``diagnostic_updater.period`` s, and publishes their statuses."""

    def __init__(self, node: Node, period: float = 1.0) -> None:
        super().__init__()
        self.node = node
        self.publisher = node.create_publisher(DiagnosticArray, '/diagnostics', 1)
        self.period_parameter = 'diagnostic_updater.period'
        self.use_fqn_parameter = 'diagnostic_updater.use_fqn'
        self._period = float(node.declare_parameter(self.period_parameter, period).value)
        if not node.has_parameter(self.use_fqn_parameter):
            node.declare_parameter(self.use_fqn_parameter, False)
        is_full = node.get_parameter(self.use_fqn_parameter).value
        self.node_name = node.get_fully_qualified_name() if is_full else node.get_name()
        self.timer = node.create_timer(self._period, self.update)
        self.verbose = False
        self.hwid = ''
        self.warn_nohwid_done = False

    @property
    def period(self) -> float:
        """The period, s."""
        return self._period

    @period.setter
    def period(self, period: float) -> None:
        self._period = period
        self.node.destroy_timer(self.timer)
        self.timer = self.node.create_timer(period, self.update)

    def setHardwareID(self, hwid: str) -> None:
        """Say of which device all statuses are."""
        self.hwid = hwid

    def update(self) -> None:
        """Run all tasks, and publish."""
        with self.lock:
            found = [self._run(task) for task in self.tasks]
        is_well = all(each.level == DiagnosticStatus.OK for each in found)
        if not self.hwid and is_well and not self.warn_nohwid_done:
            self.warn_nohwid_done = True
            self.node.get_logger().warning(_NO_HARDWARE_ID)
        self.publish(found)

    def force_update(self) -> None:
        """Publish now, too."""
        self.update()

    def broadcast(self, lvl: bytes, msg: str) -> None:
        """Publish one level and message for all tasks."""
        self.publish([self._status_of(task, lvl, msg) for task in self.tasks])

    def addedTaskCallback(self, task: DiagnosticTask) -> None:
        """Publish that the node starts."""
        self.publish(self._status_of(task, DiagnosticStatus.OK, 'Node starting up'))

    def publish(self, msg: DiagnosticStatus | list[DiagnosticStatus]) -> None:
        """Publish statuses, below the name of the node."""
        statuses = list(msg) if isinstance(msg, list) else [msg]
        for status in statuses:
            status.name = f'{self.node_name}: {status.name}'
        array = DiagnosticArray(status=statuses)
        array.header.stamp = self.node.get_clock().now().to_msg()
        self.publisher.publish(array)

    def _run(self, task: DiagnosticTask) -> DiagnosticStatusWrapper:
        given = self._status_of(task, DiagnosticStatus.ERROR, 'No message was set')
        given.hardware_id = self.hwid
        status = task.run(given)
        if self.verbose and status.level != DiagnosticStatus.OK:
            self.node.get_logger().warning(
                f'Non-zero diagnostic status. Name: {status.name}, status {status.level!r}: '
                f'{status.message}'
            )
        return status

    @staticmethod
    def _status_of(task: DiagnosticTask, level: bytes, text: str) -> DiagnosticStatusWrapper:
        status = DiagnosticStatusWrapper(name=task.name)
        status.summary(level, text)
        return status


@dataclass
class FrequencyStatusParam:
    """
    What frequencies are good.

    Attributes:
        freq_bound: ``min`` and, if there is one, ``max``, Hz; it may be changed later.
        tolerance: The share by which they may be missed.
        window_size: Over how many runs events are counted.
    """

    freq_bound: Mapping[str, float]
    tolerance: float = 0.1
    window_size: int = 5


class FrequencyStatus(DiagnosticTask):
    """How often :meth:`tick` is called."""

    def __init__(self, params: FrequencyStatusParam, name: str = 'FrequencyStatus') -> None:
        super().__init__(name)
        self.params = params
        self.lock = Lock()
        self._clock = Clock(clock_type=ClockType.ROS_TIME)
        self.clear()

    def clear(self) -> None:
        """Begin to count."""
        with self.lock:
            self.count = 0
            now = self._clock.now().nanoseconds
            self._window = [(now, 0)] * self.params.window_size

    def tick(self) -> None:
        """Count an event."""
        with self.lock:
            self.count += 1

    def run(self, stat: DiagnosticStatusWrapper) -> DiagnosticStatusWrapper:
        """Say whether the frequency is as it should be."""
        with self.lock:
            now = self._clock.now().nanoseconds
            begin, count = self._window.pop(0)
            self._window.append((now, self.count))
            events, seconds = self.count - count, (now - begin) / NANOSECONDS
            frequency = events / seconds if seconds > 0.0 else 0.0
            stat.summary(*self._summary(events, frequency))
            stat.add('Events in window', f'{events}')
            stat.add('Events since startup', f'{self.count}')
            stat.add('Duration of window (s)', f'{seconds:f}')
            stat.add('Actual frequency (Hz)', f'{frequency:f}')
            self._add_bounds(stat)
        return stat

    def _summary(self, events: int, frequency: float) -> tuple[bytes, str]:
        low, high = self._bounds
        if not events:
            return DiagnosticStatus.ERROR, 'No events recorded.'
        if frequency < low:
            return DiagnosticStatus.WARN, 'Frequency too low.'
        if high is not None and frequency > high:
            return DiagnosticStatus.WARN, 'Frequency too high.'
        return DiagnosticStatus.OK, 'Desired frequency met'

    @property
    def _bounds(self) -> tuple[float, float | None]:
        bound, tolerance = self.params.freq_bound, self.params.tolerance
        high = bound['max'] * (1 + tolerance) if 'max' in bound else None
        return bound['min'] * (1 - tolerance), high

    def _add_bounds(self, stat: DiagnosticStatusWrapper) -> None:
        bound, (low, high) = self.params.freq_bound, self._bounds
        if bound.get('max') == bound['min']:
            stat.add('Target frequency (Hz)', f'{bound["min"]:f}')
        if bound['min'] > 0:
            stat.add('Minimum acceptable frequency (Hz)', f'{low:f}')
        if high is not None:
            stat.add('Maximum acceptable frequency (Hz)', f'{high:f}')


@dataclass
class TimeStampStatusParam:
    """How old stamps may be, s; below 0: how far in the future."""

    min_acceptable: float = -1
    max_acceptable: float = 5


class TimeStampStatus(DiagnosticTask):
    """How old stamps are when they come."""

    def __init__(
        self,
        params: TimeStampStatusParam | None = None,
        name: str = 'Timestamp Status',
        clock: Clock | None = None,
    ) -> None:
        super().__init__(name)
        self.params = params or TimeStampStatusParam()
        self.lock = Lock()
        self.early_count = self.late_count = self.zero_count = 0
        self._clock = clock or Clock(clock_type=ClockType.ROS_TIME)
        self._ages: list[float] = []
        self._has_zero = False

    def tick(self, stamp: float | Time) -> None:
        """Take a stamp: seconds, or a Time."""
        seconds = stamp if isinstance(stamp, float) else stamp.nanoseconds / NANOSECONDS
        with self.lock:
            if seconds == 0:
                self._has_zero = True
                return
            age = self._clock.now().nanoseconds / NANOSECONDS - seconds
            self._ages = [min([*self._ages, age]), max([*self._ages, age])]

    def run(self, stat: DiagnosticStatusWrapper) -> DiagnosticStatusWrapper:
        """Say whether the stamps since the last run were as they should be."""
        with self.lock:
            least, most = self._ages or (0.0, 0.0)
            stat.summary(DiagnosticStatus.OK, 'Timestamps are reasonable.')
            if not self._ages:
                stat.summary(DiagnosticStatus.WARN, 'No data since last update.')
            else:
                self._judge(stat, least, most)
            for key, value in (
                ('Earliest timestamp delay:', f'{least:f}'),
                ('Latest timestamp delay:', f'{most:f}'),
                ('Earliest acceptable timestamp delay:', f'{self.params.min_acceptable:f}'),
                ('Latest acceptable timestamp delay:', f'{self.params.max_acceptable:f}'),
                ('Late diagnostic update count:', self.late_count),
                ('Early diagnostic update count:', self.early_count),
                ('Zero seen diagnostic update count:', self.zero_count),
            ):
                stat.add(key, value)
            self._ages, self._has_zero = [], False
        return stat

    def _judge(self, stat: DiagnosticStatusWrapper, least: float, most: float) -> None:
        if least < self.params.min_acceptable:
            stat.summary(DiagnosticStatus.ERROR, 'Timestamps too far in future seen.')
            self.early_count += 1
        if most > self.params.max_acceptable:
            stat.summary(DiagnosticStatus.ERROR, 'Timestamps too far in past seen.')
            self.late_count += 1
        if self._has_zero:
            stat.summary(DiagnosticStatus.ERROR, 'Zero timestamp seen.')
            self.zero_count += 1


class Heartbeat(DiagnosticTask):
    """Says that the node is alive."""

    def __init__(self) -> None:
        super().__init__('Heartbeat')

    def run(self, stat: DiagnosticStatusWrapper) -> DiagnosticStatusWrapper:
        """Say so."""
        stat.summary(DiagnosticStatus.OK, 'Alive')
        return stat


class HeaderlessTopicDiagnostic(CompositeDiagnosticTask):
    """How often a topic is published."""

    def __init__(self, name: str, diag: DiagnosticTaskVector, freq: FrequencyStatusParam) -> None:
        super().__init__(f'{name} topic status')
        self.diag = diag
        self.freq = FrequencyStatus(freq)
        self.addTask(self.freq)
        diag.add(self)

    def tick(self) -> None:
        """Count a message."""
        self.freq.tick()

    def clear_window(self) -> None:
        """Begin to count."""
        self.freq.clear()


class TopicDiagnostic(HeaderlessTopicDiagnostic):
    """How often a topic is published, and how old its stamps are."""

    def __init__(
        self,
        name: str,
        diag: DiagnosticTaskVector,
        freq: FrequencyStatusParam,
        stamp: TimeStampStatusParam,
    ) -> None:
        super().__init__(name, diag, freq)
        clock = diag.node.get_clock() if isinstance(diag, Updater) else None
        self.stamp = TimeStampStatus(stamp, clock=clock)
        self.addTask(self.stamp)

    def tick(self, stamp: float | Time) -> None:  # type: ignore[override] # as in the original
        """Count a message of this stamp."""
        self.stamp.tick(stamp)
        super().tick()


class Publishes(Protocol):
    """A publisher of rclpy, or what does as one."""

    topic_name: str

    def publish(self, msg: Any) -> None:
        """Publish a message."""


class DiagnosedPublisher(TopicDiagnostic):
    """A publisher, of whose messages it says how often they are, and how old."""

    def __init__(
        self,
        pub: Publishes,
        diag: DiagnosticTaskVector,
        freq: FrequencyStatusParam,
        stamp: TimeStampStatusParam,
    ) -> None:
        super().__init__(pub.topic_name, diag, freq, stamp)
        self.publisher = pub

    def publish(self, message: Any) -> None:
        """Publish a message with a header."""
        self.tick(Time.from_msg(message.header.stamp))
        self.publisher.publish(message)
