# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""/tf and /tf_static, as the tree of frames and their poses that a page draws."""

from rclpy.node import Node
from rclpy.qos import DurabilityPolicy, QoSProfile
from tf2_msgs.msg import TFMessage

from amr_description.nodes.polled_topic import PolledTopic
from amr_description.viewer.protocol import FrameInfo

type Pose = tuple[float, float, float, float, float, float, float]
"""x y z qx qy qz qw, m."""

_STATIC_QOS = QoSProfile(depth=100, durability=DurabilityPolicy.TRANSIENT_LOCAL)


class Frames:
    """Made and destroyed on the ROS thread, read on the server's."""

    def __init__(self, node: Node) -> None:
        self._topics = (
            PolledTopic(node, TFMessage, '/tf_static', qos=_STATIC_QOS),
            PolledTopic(node, TFMessage, '/tf', depth=100),
        )
        self._poses: dict[str, Pose] = {}
        self._parents: dict[str, str] = {}

    def destroy(self) -> None:
        """Listen no more."""
        for topic in self._topics:
            topic.destroy()

    def take(self) -> tuple[set[str], bool]:
        """Look at the topics; return the frames that have moved, and whether the tree changed."""
        moved: set[str] = set()
        is_changed = False
        for topic in self._topics:
            while (message := topic.take()) is not None:
                for each in message.transforms:
                    name, parent = each.child_frame_id, each.header.frame_id
                    is_changed |= self._parents.get(name) != parent
                    t, q = each.transform.translation, each.transform.rotation
                    self._parents[name] = parent
                    self._poses[name] = (t.x, t.y, t.z, q.x, q.y, q.z, q.w)
                    moved.add(name)
        return moved, is_changed

    def pose(self, name: str) -> Pose:
        """Return the last pose of a frame in its parent."""
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
