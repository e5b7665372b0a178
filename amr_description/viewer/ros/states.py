# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
States: everything that moves, assembled when the page's server asks for it.

Whenever the graph has changed, the ROS thread assigns a new :class:`StateSources`; the server's
thread polls its topics. So there are no callbacks at the rate of the topics, and no locks.
"""

from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass
import time

import numpy as np
from rclpy.node import Node
from rosgraph_msgs.msg import Clock

from amr_description.clock import NANOSECONDS
from amr_description.ros.polled_topic import PolledTopic
from amr_description.ros.qos import CLOCK
from amr_description.ros.readers import CLOCK as CLOCK_ROW
from amr_description.viewer.protocol import Ages, Layout, ServerMessage, TimeReset
from amr_description.viewer.real_time import RealTimeFactor, STALE
from amr_description.viewer.ros.robot_topics import hundredths, RobotTopics, TransformTopics
from amr_description.viewer.states import LAYOUTS, StateFrame


class RosClock:
    """The time of /clock, and the real-time factor."""

    def __init__(self, node: Node) -> None:
        self._topic = PolledTopic(node, Clock, '/clock', CLOCK_ROW.reader(), qos=CLOCK)
        self._factor = RealTimeFactor()
        self._jumped_back = False
        self._last: int | None = None
        self._heard = 0.0  # wall time of the latest message, s
        self.time: int | None = None
        """ns; None: not published. The ROS thread sets it to None when the publisher is gone."""

    def destroy(self) -> None:
        """Unsubscribe."""
        self._topic.destroy()

    def take(self) -> bool:
        """Poll the topic; return whether time has jumped back since the last call."""
        self.poll()
        jumped_back, self._jumped_back = self._jumped_back, False
        return jumped_back

    def poll(self) -> None:
        """Update :attr:`time`."""
        latest = self._topic.take()
        if latest is None:
            return
        before, self.time, self._last = self._last, latest, latest
        if before is not None and latest < before:
            self._jumped_back = True
            self._factor.clear()
        self._heard = time.monotonic()
        self._factor.take(self._heard, latest)

    @property
    def factor(self) -> float | None:
        """Simulated seconds per second of wall-clock time; None: not known, time stands still."""
        age = self.age
        return None if age is None or age > STALE else self._factor.value

    @property
    def age(self) -> float | None:
        """Return that of the latest message, s of wall time; None: nobody publishes it."""
        return None if self.time is None else time.monotonic() - self._heard


@dataclass(frozen=True, slots=True)
class StateSources:
    """What a state is assembled from; created and destroyed on the ROS thread."""

    clock: RosClock
    transforms: TransformTopics
    robots: tuple[RobotTopics, ...]


class StateAssembler:
    """
    Assembles states on the server's thread; any thread may assign :attr:`sources`.

    ``system_time`` returns the time of a state without /clock, s.
    """

    def __init__(self, system_time: Callable[[], float] = time.time) -> None:
        self.sources: StateSources | None = None
        self._system_time = system_time
        self._laid_out: StateSources | None = None
        self._robots: tuple[object, ...] = ()
        self._frame: StateFrame | None = None
        self._indices: dict[str, int] = {}
        self._layout_id = self._number = 0
        self._last: int | None = None

    def take(self) -> tuple[Sequence[ServerMessage], bytes | None]:
        """Return what is new: messages, then a state."""
        sources = self.sources
        if sources is None:
            return (), None
        messages: list[ServerMessage] = []
        if sources.clock.take():
            messages.append(TimeReset((sources.clock.time or 0) / NANOSECONDS))
        moved, tree_changed = sources.transforms.take()
        stamp = sources.clock.time
        now = self._now() if stamp is None else stamp
        new = [robot.take(now) for robot in sources.robots]
        layouts = tuple(robot.layout for robot in sources.robots)
        if tree_changed or sources is not self._laid_out or layouts != self._robots:
            self._laid_out, self._robots = sources, layouts
            messages.append(self._lay_out(sources))
        elif moved or any(new):
            self._write(sources, moved, new)
        elif sources.clock.time == self._last:
            return messages, None
        self._last = sources.clock.time
        assert self._frame is not None, 'made with the first layout'
        self._number += 1
        return messages, self._frame.encode(self._number, self._time(sources))

    def time_at(self, system_time: int) -> float:
        """Return the time that a state had, or would have had, at a system time, ns: s."""
        sources = self.sources
        if sources is None or sources.clock.time is None:
            return system_time / NANOSECONDS
        passed = self._system_time() - system_time / NANOSECONDS
        factor = sources.clock.factor
        return sources.clock.time / NANOSECONDS - passed * (1.0 if factor is None else factor)

    def _lay_out(self, sources: StateSources) -> Layout:
        self._layout_id = (self._layout_id + 1) % LAYOUTS
        tree = sources.transforms.tree()
        layout = Layout(self._layout_id, tree, tuple(robot.layout for robot in sources.robots))
        self._frame = StateFrame(layout)
        self._indices = {frame.name: index for index, frame in enumerate(tree)}
        self._write(sources, self._indices, [None] * len(sources.robots))
        return layout

    @np.errstate(over='ignore')  # values too large for float32 become infinite
    def _write(
        self,
        sources: StateSources,
        moved: Iterable[str],
        new: Sequence[Sequence[str] | None],
    ) -> None:
        """Write the poses of these frames, and these parts of each robot; None: all."""
        frame = self._frame
        assert frame is not None, 'made with the first layout'
        for name in moved:
            index = self._indices.get(name)
            if index is not None:
                frame.poses[index] = sources.transforms.pose(name)
        for robot, floats, parts in zip(sources.robots, frame.robots, new, strict=True):
            robot.write(floats, parts)

    def _time(self, sources: StateSources) -> float:
        stamp = sources.clock.time
        return self._system_time() if stamp is None else stamp / NANOSECONDS

    def _now(self) -> int:
        return round(self._system_time() * NANOSECONDS)

    def ages(self) -> Ages | None:
        """Return how old is what states say; None: nothing is connected."""
        sources = self.sources
        if sources is None:
            return None
        now = time.monotonic()
        clock, transforms = sources.clock.age, sources.transforms.age(now)
        robots = tuple(robot.ages(now) for robot in sources.robots)
        return Ages(hundredths(clock), hundredths(transforms), robots)
