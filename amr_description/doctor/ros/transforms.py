# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""Listens to ``/tf`` and ``/tf_static``, of all namespaces."""

from dataclasses import dataclass, field
import math
import time

from geometry_msgs.msg import TransformStamped
from rclpy.qos import DurabilityPolicy, QoSProfile
from tf2_msgs.msg import TFMessage

from amr_description.doctor.observations.transforms import Edge, ObservedTransforms, Tree
from amr_description.doctor.ros.probe_context import ProbeContext, RobotTime
from amr_description.doctor.ros.topic_probe import TopicProbe
from amr_description.model.frames import Quaternion
from amr_description.ros.messages import nanoseconds

_TYPE = 'tf2_msgs/msg/TFMessage'
_MOVING, _STATIC = '/tf', '/tf_static'
_STATIC_QOS = QoSProfile(depth=100, durability=DurabilityPolicy.TRANSIENT_LOCAL)
_LEAST, _MOST = 1.0, 2.3
"""s that is listened; longer, where nothing has come of a publisher: some send once a second."""


class TransformsProbe:
    """Observes ``transforms``."""

    def __init__(self) -> None:
        self._probes: dict[tuple[str, bool], TopicProbe] = {}
        self._seen: dict[tuple[str, str, str, bool, bytes], _Seen] = {}

    def begin(self, context: ProbeContext) -> None:
        """Subscribe to all topics of transforms."""
        node = context.node
        self._began = time.monotonic()
        self._time = RobotTime(context)
        for topic, types in node.get_topic_names_and_types():
            is_static = topic.endswith(_STATIC)
            if _TYPE not in types or not (is_static or topic.endswith(_MOVING)):
                continue
            namespace = topic.removesuffix(_STATIC if is_static else _MOVING)
            qos = _STATIC_QOS if is_static else None
            probe = TopicProbe(node, TFMessage, topic, depth=200, qos=qos)
            self._probes[namespace, is_static] = probe

    @property
    def is_done(self) -> bool:
        """Whether what is published often has come; of two trees, what may connect them."""
        self._take()
        if time.monotonic() - self._began < _LEAST or not self._time.is_known:
            return False
        if time.monotonic() - self._began < _MOST and not self._has_heard_all():
            return False
        children = {(key[0], key[2]) for key in self._seen}
        roots = {(space, parent) for space, parent, *_ in self._seen} - children
        return len({space for space, _ in roots}) == len(roots)

    def observe(self) -> ObservedTransforms:
        """Return what was seen of publishers that are still there."""
        self._take()
        names = {key: each.publishers() for key, each in self._probes.items()}
        trees: dict[str, list[Edge]] = {}
        for (namespace, parent, child, is_static, gid), each in self._seen.items():
            if gid not in names[namespace, is_static]:
                continue
            ages = [
                age
                for stamp, received in each.times
                if (age := self._time.age(stamp, received)) is not None and not is_static
            ]
            trees.setdefault(namespace, []).append(
                Edge(
                    parent=parent,
                    child=child,
                    publisher=names[namespace, is_static][gid],
                    is_static=is_static,
                    has_slash=each.has_slash,
                    youngest=min(ages, default=None),
                    oldest=max(ages, default=None),
                    rotation=each.rotation,
                    translation=each.translation,
                )
            )
        return ObservedTransforms(
            trees=tuple(
                Tree(
                    namespace=namespace,
                    edges=tuple(edges),
                    is_complete=self._has_all_static(namespace),
                )
                for namespace, edges in sorted(trees.items())
            ),
            is_simulated=self._time.is_simulated,
        )

    def _has_heard_all(self) -> bool:
        """Return whether something has come of each who publishes transforms."""
        received = {(namespace, is_static, gid) for namespace, *_, is_static, gid in self._seen}
        return all(
            (*key, gid) in received
            for key, each in self._probes.items()
            for gid in each.publishers()
        )

    def _has_all_static(self, namespace: str) -> bool:
        probe = self._probes.get((namespace, True))
        said = {key[4] for key in self._seen if key[0] == namespace and key[3]}
        return probe is not None and probe.publishers().keys() <= said

    def _take(self) -> None:
        for (namespace, is_static), probe in self._probes.items():
            for message, received, gid in probe.messages():
                for each in message.transforms:
                    parent = each.header.frame_id.removeprefix('/')
                    child = each.child_frame_id.removeprefix('/')
                    key = (namespace, parent, child, is_static, gid)
                    self._seen.setdefault(key, _Seen()).note(each, received)
        self._time.take()


@dataclass
class _Seen:
    """What one publisher has said of one frame."""

    has_slash: bool = False
    times: list[tuple[int, int]] = field(default_factory=list)
    """Stamp and reception of each."""
    rotation: Quaternion = (0.0, 0.0, 0.0, 1.0)
    translation: tuple[float, float, float] = (0.0, 0.0, 0.0)

    def note(self, message: TransformStamped, received: int) -> None:
        self.has_slash |= message.header.frame_id[:1] == '/' or message.child_frame_id[:1] == '/'
        self.times.append((nanoseconds(message.header.stamp), received))
        if not _is_rotation(self.rotation):
            return  # what is wrong now and then is to be seen
        turn, shift = message.transform.rotation, message.transform.translation
        self.rotation = (turn.x, turn.y, turn.z, turn.w)
        self.translation = (shift.x, shift.y, shift.z)


def _is_rotation(rotation: Quaternion) -> bool:
    return abs(math.hypot(*rotation) - 1.0) < 0.01  # also False for NaN
