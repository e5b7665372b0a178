# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
The command topic of a robot as pages see it: the command in force, and how often others command.

Created and destroyed on the ROS thread, polled on the server's thread.
"""

from collections import deque
from collections.abc import Callable
import math
from typing import Any, TypeAlias

from rclpy.node import Node

from amr_description.clock import NANOSECONDS
from amr_description.ros.polled_topic import PolledTopic

DEFAULT_TIMEOUT = 0.5
"""s: of diff_drive_controller."""
_QUEUE = 64
_WINDOW = 3.0
"""s over which commands are counted."""
_SILENT = 1.0
"""s without a command after which nobody commands."""

Twist: TypeAlias = tuple[float, ...]
"""m/s ahead, rad/s to the left, m/s to the left."""

NO_TWIST: Twist = (math.nan,) * 3


class CommandTopic:
    """
    Commands, until they expire.

    Pages' own commands come back on the topic: :meth:`sent` is told of them, so that they are not
    taken for those of others.
    """

    def __init__(
        self, node: Node, message_type: Any, topic: str, read: Callable[[bytes], Twist]
    ) -> None:
        self.timeout = DEFAULT_TIMEOUT
        """s of ROS time after which a command is not in force any more; 0: never."""
        self._topic = PolledTopic(node, message_type, topic, read, depth=_QUEUE)
        self._own: deque[Twist] = deque(maxlen=_QUEUE)
        self._others: deque[tuple[float, int]] = deque(maxlen=1024)
        """
        Commands of others: when they were taken, s of a monotonic clock, and received, ns.

        Rates are those of the latter: a poll that comes late takes several at once.
        """
        self._came: int | None = None
        """ROS time of the command in force, ns; None: there is none."""

    def destroy(self) -> None:
        """Unsubscribe."""
        self._topic.destroy()

    def sent(self, twist: Twist) -> None:
        """Take note of a command that this node publishes; on any thread."""
        self._own.append(twist)

    def take(self, time: int, now: float) -> Twist | None:
        """
        Poll the topic.

        Args:
            time: ROS time, ns.
            now: s of a monotonic clock.

        Returns:
            The latest command, or :data:`NO_TWIST` once when it has expired; None: nothing new.
        """
        latest = None
        while (taken := self._topic.take_timed()) is not None:
            latest, received = taken
            if not self._is_own(latest):
                self._others.append((now, received))
        while self._others and now - self._others[0][0] > _WINDOW:
            self._others.popleft()
        if latest is not None:
            self._came = time
            return latest
        if self._came is None:
            return None
        age = time - self._came
        if self.timeout and not 0 <= age <= self.timeout * NANOSECONDS:
            self._came = None
            return NO_TWIST
        return None

    def rate(self, now: float) -> float:
        """Return how many commands per second come from others, as of ``now``."""
        others = self._others
        if not others or now - others[-1][0] > _SILENT:
            return 0.0
        elapsed = others[-1][1] - others[0][1]
        return (len(others) - 1) * NANOSECONDS / elapsed if elapsed > 0 else 1.0 / _WINDOW

    def _is_own(self, twist: Twist) -> bool:
        try:
            index = self._own.index(twist)
        except ValueError:
            return False
        for _ in range(index + 1):
            self._own.popleft()
        return True
