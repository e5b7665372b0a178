# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
/tf and /tf_static, as the tree of frames and their poses that a page draws.

Robots that have a TF of their own, such as ``/robot1/tf``, call their frames all the same: the
page's are called ``robot1/odom`` and so on, as they would be on one ``/tf``.
"""

from collections.abc import Sequence

from rclpy.node import Node
from rclpy.qos import DurabilityPolicy, QoSProfile
from tf2_msgs.msg import TFMessage

from amr_description.nodes.cdr import read_transforms
from amr_description.nodes.polled_topic import PolledTopic
from amr_description.viewer.protocol import FrameInfo

_STATIC = QoSProfile(depth=100, durability=DurabilityPolicy.TRANSIENT_LOCAL)


class Frames:
    """Made and destroyed on the ROS thread, read on the server's."""

    def __init__(self, node: Node, trees: Sequence[str] = ()) -> None:
        """``trees``: namespaces with a TF of their own."""
        self._topics = [
            (f'{place[1:]}/' if place else '', topic)
            for place in ('', *trees)
            for topic in (
                PolledTopic(node, TFMessage, f'{place}/tf_static', read_transforms, qos=_STATIC),
                PolledTopic(node, TFMessage, f'{place}/tf', read_transforms, depth=100),
            )
        ]
        self._poses: dict[str, tuple[float, ...]] = {}
        self._parents: dict[str, str] = {}

    def destroy(self) -> None:
        """Listen no more."""
        for _, topic in self._topics:
            topic.destroy()

    def take(self) -> tuple[set[str], bool]:
        """Look at the topics; return the frames that have moved, and whether the tree changed."""
        moved: set[str] = set()
        is_changed = False
        for prefix, topic in self._topics:
            while (transforms := topic.take()) is not None:
                for each in transforms:
                    name, parent = _within(prefix, each.name), _within(prefix, each.parent)
                    is_changed |= self._parents.get(name) != parent
                    self._parents[name] = parent
                    self._poses[name] = each.pose
                    moved.add(name)
        return moved, is_changed

    def pose(self, name: str) -> tuple[float, ...]:
        """Return the last pose of a frame in its parent, x y z qx qy qz qw, m."""
        return self._poses[name]

    def tree(self) -> tuple[FrameInfo, ...]:
        """Return the frames, parents before children; what hangs in a loop is left out."""
        children: dict[str, list[str]] = {}
        for name, parent in self._parents.items():
            children.setdefault(parent, []).append(name)
        pending = sorted(parent for parent in children if parent not in self._parents)
        frames: list[FrameInfo] = []
        while pending:
            parent = pending.pop(0)
            below = sorted(children.get(parent, ()))
            frames += [FrameInfo(name, parent) for name in below]
            pending += below
        return tuple(frames)


def _within(prefix: str, name: str) -> str:
    return name if name.startswith(prefix) else f'{prefix}{name}'
