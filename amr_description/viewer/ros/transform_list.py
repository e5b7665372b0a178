# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
The TF tree with rates and ages, for pages that show it; on the ROS thread.

It has subscriptions of its own: states need the latest poses only, and as little as possible.
"""

from collections import deque
from collections.abc import Sequence
import time

from rclpy.node import Node
from tf2_msgs.msg import TFMessage

from amr_description.clock import NANOSECONDS
from amr_description.ros.endpoints import endpoint_node
from amr_description.ros.polled_topic import PolledTopic
from amr_description.ros.qos import TF_STATIC
from amr_description.ros.readers import TRANSFORMS
from amr_description.viewer.introspection import FrameStatus, Transforms

_WINDOW = 3.0
"""s over which rates are measured, and for which a parent counts."""
_MOST = 1000
"""Messages of a topic between two calls."""


class _Frame:
    """A frame that is a child: of whom, for good and for as long as that goes on coming."""

    def __init__(self) -> None:
        self.static: dict[str, str] = {}
        """The topic of each parent, the latest at the end."""
        self.moving: dict[str, str] = {}
        self._came: dict[str, float] = {}
        """When each moving parent came last."""
        self._times: deque[float] = deque()

    def add(self, parent: str, topic: str, at: float, *, is_static: bool) -> None:
        parents = self.static if is_static else self.moving
        parents.pop(parent, None)
        parents[parent] = topic
        if not is_static:
            self._came[parent] = at
            self._times.append(at)

    def status(self, name: str, now: float) -> FrameStatus:
        while len(self._times) > 1 and now - self._times[0] > _WINDOW:
            self._times.popleft()
        moving = {each: by for each, by in self.moving.items() if now - self._came[each] < _WINDOW}
        is_static = not moving and bool(self.static)
        of_kind = self.static if is_static else self.moving
        parent = next(reversed(of_kind))
        all_of_them = self.static | moving
        return FrameStatus(
            name,
            parent,
            (parent, *sorted(all_of_them.keys() - {parent})),
            is_static,
            None if is_static else self._rate(),
            None if is_static else max(0.0, now - self._times[-1]),
            tuple(dict.fromkeys((of_kind[parent], *all_of_them.values()))),
        )

    def _rate(self) -> float | None:
        span = self._times[-1] - self._times[0]
        return (len(self._times) - 1) / span if span > 0 else None


class TransformList:
    """Subscribes to all TF topics; poll it often enough that none of them overflows."""

    def __init__(self, node: Node, namespaces: Sequence[str]) -> None:
        """Subscribe; ``namespaces``: those with a TF of their own."""
        self._node = node
        self._frames: dict[str, _Frame] = {}
        self._topics: list[tuple[str, bool, PolledTopic[bytes]]] = []
        for namespace in ('', *namespaces):
            prefix = f'{namespace[1:]}/' if namespace else ''
            static = PolledTopic(node, TFMessage, f'{namespace}/tf_static', bytes, qos=TF_STATIC)
            moving = PolledTopic(node, TFMessage, f'{namespace}/tf', bytes, depth=_MOST)
            self._topics += [(prefix, True, static), (prefix, False, moving)]

    def destroy(self) -> None:
        """Unsubscribe."""
        for _, _, topic in self._topics:
            topic.destroy()

    def poll(self) -> Transforms:
        """Return the tree of now."""
        for prefix, is_static, topic in self._topics:
            self._take(prefix, topic, is_static=is_static)
        now = time.time()
        publishers = {
            topic.topic: tuple(
                sorted(
                    endpoint_node(each) or '?'
                    for each in self._node.get_publishers_info_by_topic(topic.topic)
                )
            )
            for _, _, topic in self._topics
        }
        return Transforms(
            tuple(frame.status(name, now) for name, frame in sorted(self._frames.items())),
            {topic: nodes for topic, nodes in publishers.items() if nodes},
        )

    def _take(self, prefix: str, topic: PolledTopic[bytes], *, is_static: bool) -> None:
        for _ in range(_MOST):
            if (message := topic.take_numbered()) is None:
                return
            try:
                transforms = TRANSFORMS.read(message.data)
            except ValueError:
                continue
            for each in transforms:
                name, parent = _prefixed(prefix, each.name), _prefixed(prefix, each.parent)
                frame = self._frames.setdefault(name, _Frame())
                at = message.received / NANOSECONDS
                frame.add(parent, topic.topic, at, is_static=is_static)


def _prefixed(prefix: str, name: str) -> str:
    return name if name.startswith(prefix) else f'{prefix}{name}'
