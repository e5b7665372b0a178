# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
The lines of /rosout: the last warnings and errors are kept while any page is open, so that what
happened before somebody looks is there; all new lines are for pages that show the log.

A bring-up has no node. What it has warned of until the first page is there is read from its log,
see :mod:`amr_description.launch_log`.
"""

from collections import deque
import os
from typing import Any, Literal, TypeAlias

from rcl_interfaces.msg import Log as LogMessage
from rclpy.node import Node
from rclpy.qos import DurabilityPolicy, QoSProfile, ReliabilityPolicy

from amr_description.clock import NANOSECONDS
from amr_description.launch_log import LAUNCH_LOG, launch_warnings
from amr_description.ros.polled_topic import PolledTopic
from amr_description.ros.readers import Row
from amr_description.viewer.introspection import LogLine

MOST_KEPT = 500
"""Warnings and errors."""
_MOST = 1000
"""Lines between two calls; nodes that say more lose the oldest."""
_LONGEST = 4000
"""Characters of a line."""
_WARNING = 30

Level: TypeAlias = Literal['debug', 'info', 'warning', 'error', 'fatal']
_LEVELS: tuple[tuple[int, Level], ...] = (
    (50, 'fatal'),
    (40, 'error'),
    (_WARNING, 'warning'),
    (20, 'info'),
)


class RosoutLines:
    """Subscribes to /rosout; on the ROS thread, but for :attr:`kept`, which is replaced."""

    def __init__(self, node: Node) -> None:
        """Subscribe, and keep what the bring-up has warned of until now."""
        qos = QoSProfile(
            depth=_MOST,
            reliability=ReliabilityPolicy.RELIABLE,
            durability=DurabilityPolicy.TRANSIENT_LOCAL,
        )
        self._topic = PolledTopic(node, LogMessage, '/rosout', bytes, qos=qos)
        self._kept: deque[LogLine] = deque(maxlen=MOST_KEPT)
        self._kept.extend(launch_lines(os.environ.get(LAUNCH_LOG, '')))
        self._count = len(self._kept)
        self.kept: tuple[LogLine, ...] = tuple(self._kept)
        """The last warnings and errors, the oldest first."""

    def destroy(self) -> None:
        """Unsubscribe."""
        self._topic.destroy()

    def take(self) -> tuple[LogLine, ...]:
        """Return the lines that came since the last call."""
        lines = []
        for _ in range(_MOST):
            if (data := self._topic.take()) is None:
                break
            self._count += 1
            try:
                lines.append(read_line(data, self._count))
            except ValueError:  # it is broken
                continue
        worth = [each for each in lines if each.level not in ('debug', 'info')]
        if worth:
            self._kept.extend(worth)
            self.kept = tuple(self._kept)
        return tuple(lines)


def launch_lines(file: str) -> list[LogLine]:
    """Return the last warnings and errors of a bring-up, by its ``launch.log``."""
    return [
        LogLine(
            number,
            each.stamp,
            'error' if each.is_error else 'warning',
            each.source,
            each.text[:_LONGEST],
            '',
        )
        for number, each in enumerate(launch_warnings(file)[-MOST_KEPT:], 1)
    ]


_LOG: Row[tuple[Any, ...]] = Row(
    'rcl_interfaces/msg/Log',
    ('stamp.sec', 'stamp.nanosec', 'level', 'name', 'msg', 'file', 'function', 'line'),
    lambda *values: values,
)


def read_line(data: bytes, number: int) -> LogLine:
    """Read a ``rcl_interfaces/msg/Log``. Raises ValueError."""
    seconds, nanoseconds, severity, *texts, line = _LOG.read(data)
    level: Level = next((name for least, name in _LEVELS if severity >= least), 'debug')
    node, text, file, function = (each[:_LONGEST] for each in texts)
    place = f'{function} ({file.rpartition("/")[2]}:{line})' if file else function
    stamp = (seconds * NANOSECONDS + nanoseconds) / NANOSECONDS
    return LogLine(number, stamp, level, node, text, place)
