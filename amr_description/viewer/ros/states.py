# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
States: all that moves, put together when the page's server asks for it.

The ROS thread hands over a :class:`Scene`, in one assignment, whenever the graph has changed; the
server's thread reads its topics. So ROS callbacks cost nothing sixty times a second, and nothing
is locked.
"""

from collections import deque
from collections.abc import Callable, Sequence
from dataclasses import dataclass
import time

import numpy as np
from rclpy.node import Node
from rclpy.qos import QoSProfile, ReliabilityPolicy
from rosgraph_msgs.msg import Clock

from amr_description.clock import NANOSECONDS
from amr_description.ros.cdr import read_clock
from amr_description.ros.polled_topic import PolledTopic
from amr_description.viewer.protocol import Layout, ServerMessage, TimeReset
from amr_description.viewer.ros.robot_topics import Frames, RobotTopics
from amr_description.viewer.states import LAYOUTS, StateFrame

_WINDOW = 1.0
"""s of the wall clock over which the real-time factor is measured."""


class RosClock:
    """The time of /clock, where there is one."""

    def __init__(self, node: Node) -> None:
        qos = QoSProfile(depth=1, reliability=ReliabilityPolicy.BEST_EFFORT)
        self._topic = PolledTopic(node, Clock, '/clock', read_clock, qos=qos)
        self._heard: deque[tuple[float, int]] = deque()
        self._is_back = False
        self._last: int | None = None
        self.time: int | None = None
        """ns; None: nobody tells the time, or no longer, as the ROS thread may say."""

    def destroy(self) -> None:
        """Listen no more."""
        self._topic.destroy()

    def take(self) -> bool:
        """Look at the topic; True: time went back since the last call."""
        self.look()
        is_back, self._is_back = self._is_back, False
        return is_back

    def look(self) -> None:
        """Have :attr:`time` as of now."""
        heard = self._topic.take()
        if heard is None:
            return
        before, self.time, self._last = self._last, heard, heard
        if before is not None and heard < before:
            self._is_back = True
            self._heard.clear()
        now = time.monotonic()
        self._heard.append((now, heard))
        while now - self._heard[0][0] > _WINDOW and len(self._heard) > 2:  # noqa: PLR2004
            self._heard.popleft()

    @property
    def factor(self) -> float | None:
        """Simulated seconds per second of the wall clock; None: not known yet."""
        if len(self._heard) < 2:  # noqa: PLR2004
            return None
        (wall_0, time_0), (wall_1, time_1) = self._heard[0], self._heard[-1]
        elapsed = wall_1 - wall_0
        return (time_1 - time_0) / NANOSECONDS / elapsed if elapsed else None


@dataclass(frozen=True, slots=True)
class Scene:
    """What is looked at; made and destroyed on the ROS thread."""

    clock: RosClock
    frames: Frames
    robots: tuple[RobotTopics, ...]


class States:
    """On the server's thread, but for :attr:`scene`, which any thread may set."""

    def __init__(self, machine_time: Callable[[], float] = time.time) -> None:
        self.scene: Scene | None = None
        self._machine_time = machine_time
        self._seen: Scene | None = None
        self._wheels: tuple[object, ...] = ()
        self._frame: StateFrame | None = None
        self._indices: dict[str, int] = {}
        self._layouts = self._number = 0
        self._last: int | None = None

    def take(self) -> tuple[Sequence[ServerMessage], bytes | None]:
        """Return what is new: messages, then a state."""
        scene = self.scene
        if scene is None:
            return (), None
        messages: list[ServerMessage] = []
        if scene.clock.take():
            messages.append(TimeReset((scene.clock.time or 0) / NANOSECONDS))
        moved, tree_changed = scene.frames.take()
        new = [robot.take() for robot in scene.robots]
        layouts = tuple(robot.layout for robot in scene.robots)
        if tree_changed or scene is not self._seen or layouts != self._wheels:
            self._seen, self._wheels = scene, layouts
            messages.append(self._lay_out(scene))
        elif moved or any(new):
            self._write(scene, moved, new)
        elif scene.clock.time == self._last:
            return messages, None
        self._last = scene.clock.time
        assert self._frame is not None, 'there is a layout as soon as there is a scene'
        self._number += 1
        return messages, self._frame.encode(self._number, self._time(scene))

    def _lay_out(self, scene: Scene) -> Layout:
        self._layouts = (self._layouts + 1) % LAYOUTS
        tree = scene.frames.tree()
        layout = Layout(self._layouts, tree, tuple(robot.layout for robot in scene.robots))
        self._frame = StateFrame(layout)
        self._indices = {frame.name: index for index, frame in enumerate(tree)}
        self._write(scene, self._indices, [None] * len(scene.robots))
        return layout

    @np.errstate(over='ignore')  # what is too large for float32 is infinite then
    def _write(self, scene: Scene, moved: object, new: Sequence[Sequence[str] | None]) -> None:
        """Write frames by name, and of each robot these parts; None: all."""
        frame = self._frame
        assert frame is not None, 'it is made with the first layout'
        for name in moved:  # type: ignore[attr-defined]
            index = self._indices.get(name)
            if index is not None:
                frame.poses[index] = scene.frames.pose(name)
        for robot, floats, parts in zip(scene.robots, frame.robots, new, strict=True):
            robot.write(floats, parts)

    def _time(self, scene: Scene) -> float:
        stamp = scene.clock.time
        return self._machine_time() if stamp is None else stamp / NANOSECONDS
