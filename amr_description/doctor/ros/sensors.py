# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""Listens to sensors, joint states, and odometry beside the truth of a simulator."""

from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass, field
import math
import time
from typing import Any, TypeVar

from nav_msgs.msg import Odometry
import numpy as np
from sensor_msgs.msg import CameraInfo, Image, Imu, JointState, LaserScan

from amr_description.doctor.observations import sensors as seen
from amr_description.doctor.ros.probe_context import ProbeContext, RobotTime
from amr_description.doctor.ros.topic_probe import TopicProbe
from amr_description.model.frames import yaw_of
from amr_description.ros.messages import nanoseconds

Seen = TypeVar('Seen')

_TRUTH = 'ground_truth/odom'
_MESSAGES: Mapping[str, Any] = {
    'sensor_msgs/msg/LaserScan': LaserScan,
    'sensor_msgs/msg/Imu': Imu,
    'sensor_msgs/msg/Image': Image,
    'sensor_msgs/msg/CameraInfo': CameraInfo,
    'sensor_msgs/msg/JointState': JointState,
    'nav_msgs/msg/Odometry': Odometry,
}
_DEPTHS = {Image: 1, CameraInfo: 1, Odometry: 100}
_STANDING = 0.02
"""m/s and rad/s, below which nothing is learnt of odometry."""
_LEAST = 0.3
"""s that a second publisher of joint states is waited for."""


@dataclass
class _SensorTopic:
    """A topic, and the last message of each of its publishers."""

    kind: Any
    probe: TopicProbe
    last: dict[bytes, tuple[Any, int]] = field(default_factory=dict)
    all: list[tuple[Any, int]] = field(default_factory=list)
    """Of odometry."""


class SensorsProbe:
    """Observes ``sensors``."""

    def __init__(self, *, only_subscribed: bool = False) -> None:
        """``only_subscribed``: leave alone what has no other subscriber, and would be measured."""
        self._only_subscribed = only_subscribed
        self._topics: dict[str, _SensorTopic] = {}

    def begin(self, context: ProbeContext) -> None:
        """
        Subscribe to sensors.

        Pictures are taken only if somebody else does, too: to render and to send them takes long.
        """
        node = context.node
        self._began = time.monotonic()
        self._node = node
        self._time = RobotTime(context)
        found = {
            topic: _MESSAGES[types[0]]
            for topic, types in node.get_topic_names_and_types()
            if len(types) == 1 and types[0] in _MESSAGES and node.count_publishers(topic)
        }
        for topic, kind in found.items():
            is_sensor = kind not in (JointState, Odometry)
            is_dear = kind in (Image, CameraInfo) or (self._only_subscribed and is_sensor)
            if is_dear and not self._has_subscribers(topic, found):
                continue
            if kind is Odometry and not any(each.endswith(_TRUTH) for each in found):
                continue
            probe = TopicProbe(node, kind, topic, depth=_DEPTHS.get(kind, 10))
            self._topics[topic] = _SensorTopic(kind, probe)

    def _has_subscribers(self, topic: str, found: Iterable[str]) -> bool:
        """Return whether a topic has subscribers, or the pictures that its camera_info is of."""
        images = [each for each in found if each != topic and _info_of(each) == topic]
        return any(self._node.count_subscribers(each) > 0 for each in (topic, *images))

    @property
    def is_done(self) -> bool:
        """Whether each topic has been received, of joint states each publisher; and it stands."""
        self._take()
        topics = self._topics.values()
        if not self._time.is_known or not all(each.last for each in topics):
            return False
        joints = [each for each in topics if each.kind is JointState]
        if any(len(each.last) < len(each.probe.publishers()) for each in joints):
            return False
        if self._is_moving():
            return False
        return time.monotonic() - self._began >= _LEAST

    def observe(self) -> seen.ObservedSensors:
        """Return what was seen."""
        self._take()
        found = seen.ObservedSensors(
            scans=tuple(self._each(LaserScan, _scan)),
            images=tuple(self._images()),
            imus=tuple(self._each(Imu, _imu)),
            joints=tuple(self._joints()),
            travels=tuple(self._travels()),
        )
        return found

    def _take(self) -> None:
        for topic in self._topics.values():
            for message, received, gid in topic.probe.messages():
                topic.last[gid] = (message, received)
                if topic.kind is Odometry:
                    topic.all.append((message, received))
        self._time.take()

    def _is_moving(self) -> bool:
        for name, topic in self._topics.items():
            if name.endswith(_TRUTH):
                for message, _ in topic.last.values():
                    twist = message.twist.twist
                    speed = math.hypot(twist.linear.x, twist.linear.y)
                    if max(speed, abs(twist.angular.z)) > _STANDING:
                        return True
        return False

    def _source(self, topic: _SensorTopic, message: Any, received: int) -> dict[str, Any]:
        names = tuple(topic.probe.publishers().values())
        return {
            'topic': topic.probe.topic,
            'publishers': tuple(name or 'a node without a name' for name in names),
            'frame': message.header.frame_id,
            'age': self._time.age(nanoseconds(message.header.stamp), received),
        }

    def _each(self, kind: Any, make: Callable[..., Seen]) -> Iterable[Seen]:
        for topic in self._topics.values():
            if topic.kind is kind and topic.last:
                message, received = [*topic.last.values()][-1]
                yield make(message, **self._source(topic, message, received))

    def _images(self) -> Iterable[seen.ObservedImage]:
        for topic in self._topics.values():
            if topic.kind is not Image or not topic.last:
                continue
            message, received = [*topic.last.values()][-1]
            info = self._topics.get(_info_of(topic.probe.topic))
            told = [*info.last.values()][-1][0] if info is not None and info.last else None
            yield seen.ObservedImage(
                **self._source(topic, message, received),
                width=message.width,
                height=message.height,
                step=message.step,
                encoding=message.encoding,
                size=len(message.data),
                info_topic=_info_of(topic.probe.topic),
                info_publishers=tuple(info.probe.publishers().values()) if info else (),
                info_size=(told.width, told.height) if told is not None else None,
                focal_length=told.k[0] if told is not None else None,
            )

    def _joints(self) -> Iterable[seen.ObservedJoints]:
        for topic in self._topics.values():
            names = topic.probe.publishers() if topic.kind is JointState else {}
            for gid, (message, received) in topic.last.items() if names else ():
                if gid not in names:
                    continue
                pairs = zip(message.name, message.position, strict=False)
                yield seen.ObservedJoints(
                    **self._source(topic, message, received),
                    publisher=names[gid] or 'a node without a name',
                    names=tuple(message.name),
                    positions=len(message.position),
                    not_numbers=tuple(name for name, value in pairs if not math.isfinite(value)),
                )

    def _travels(self) -> Iterable[seen.ObservedTravel]:
        odometry = {n: each for n, each in self._topics.items() if each.kind is Odometry}
        truths = {
            n.removesuffix(_TRUTH): each for n, each in odometry.items() if n.endswith(_TRUTH)
        }
        for name, topic in odometry.items():
            inside = [space for space in truths if name.startswith(space)]
            if len(inside) != 1 or name.endswith(_TRUTH) or len(topic.last) != 1:
                continue  # of several robots it is not known whose it is
            truth = truths[inside[0]]
            both = _same_span(topic.all, truth.all)
            if both is None:
                continue
            said, true = both
            message, received = topic.all[-1]
            yield seen.ObservedTravel(
                **self._source(topic, message, received),
                distance=_distance(said),
                true_distance=_distance(true),
                turn=_turn(said),
                true_turn=_turn(true),
                seconds=(_stamp(said[-1]) - _stamp(said[0])) / 1e9,
            )


def _info_of(image: str) -> str:
    """Return the topic of ``camera_info`` that image_transport takes for a topic of pictures."""
    return f'{image.rpartition("/")[0]}/camera_info'


def _scan(message: LaserScan, **source: Any) -> seen.ObservedScan:
    ranges = np.asarray(message.ranges, dtype=np.float32)
    finite = ranges[np.isfinite(ranges)]
    lower, upper = np.float32(message.range_min), np.float32(message.range_max)
    return seen.ObservedScan(
        **source,
        angle_min=message.angle_min,
        angle_max=message.angle_max,
        angle_increment=message.angle_increment,
        count=len(ranges),
        hits=int(((finite >= lower) & (finite <= upper) & (finite > 0.0)).sum()),
        infinite=int(np.isposinf(ranges).sum()),
        zeros=int((ranges == 0.0).sum()),
        invalid=int(np.isnan(ranges).sum()),
    )


def _imu(message: Imu, **source: Any) -> seen.Imu:
    turn, push = message.orientation, message.linear_acceleration
    return seen.Imu(
        **source,
        orientation=(turn.x, turn.y, turn.z, turn.w),
        has_orientation=message.orientation_covariance[0] != -1.0,
        acceleration=(push.x, push.y, push.z),
    )


def _stamp(message: Odometry) -> int:
    return nanoseconds(message.header.stamp)


def _same_span(
    said: list[tuple[Odometry, int]], true: list[tuple[Odometry, int]]
) -> tuple[list[Odometry], list[Odometry]] | None:
    """Return the messages of both between stamps that both have; None: too few."""
    one, other = [each for each, _ in said], [each for each, _ in true]
    if not one or not other:
        return None
    first = max(_stamp(one[0]), _stamp(other[0]))
    last = min(_stamp(one[-1]), _stamp(other[-1]))
    inside = [[each for each in found if first <= _stamp(each) <= last] for found in (one, other)]
    return (inside[0], inside[1]) if min(map(len, inside)) > 1 else None


def _distance(messages: list[Odometry]) -> float:
    first, last = messages[0].pose.pose.position, messages[-1].pose.pose.position
    return math.hypot(last.x - first.x, last.y - first.y)


def _turn(messages: list[Odometry]) -> float:
    """Return by how much a robot has turned, rad, more than once around, too."""
    turns = [each.pose.pose.orientation for each in messages]
    yaws = [yaw_of((each.x, each.y, each.z, each.w)) for each in turns]
    unwrapped = np.unwrap(yaws)
    return float(unwrapped[-1] - unwrapped[0])
