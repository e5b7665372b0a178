# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""``/clock``, who can let it go on, and the stamps of messages that are small."""

import re
import struct
import time

from rcl_interfaces.msg import Log
from rclpy.qos import DurabilityPolicy, QoSProfile

from amr_description.clock import NANOSECONDS
from amr_description.doctor.observations.clock import Clock, StampSeen, TimeSource
from amr_description.doctor.ros.probe_context import CLOCK_TOPIC, ProbeContext
from amr_description.doctor.ros.queries import ParameterQuery
from amr_description.doctor.ros.topic_probe import TopicProbe
from amr_description.doctor.rules.clock import LEAST_FACTOR_SHARE
from amr_description.errors import AmrError
from amr_description.ros.endpoints import endpoint_node
from amr_description.ros.message_types import message_type

LISTEN = 1.0
"""s for which ``/clock`` is listened to."""

SURE = 2.4
"""s of a factor that is too low: other programs may take the processor for a moment."""

_SILENCE = 1.5
"""s without a message on ``/clock``, after which it is silent."""
_STAMP_PATIENCE = 1.5
"""s for a first message on a topic; a broken one may never come."""
_REPORT_PATIENCE = 0.5
_REPORT = re.compile(r'real time is not kept: .*?(Of the time goes to .*?)(?:\. Results|$)')
_ROSOUT = QoSProfile(depth=1000, durability=DurabilityPolicy.TRANSIENT_LOCAL)
_DEPTH = 5
_FACTOR = 'real_time_factor'
_BUCKET = 60 * NANOSECONDS
_MOST_TOPICS = 30
_STAMP = 4
"""Bytes before the first field of a message: its encapsulation (DDSI-RTPS 2.5, 10)."""
_TRANSFORM_STAMP = 8
"""… before the stamp of the first of several transforms: their number too."""
_HEADERS = {
    'geometry_msgs/msg/PoseWithCovarianceStamped': _STAMP,
    'nav_msgs/msg/Odometry': _STAMP,
    'sensor_msgs/msg/Imu': _STAMP,
    'sensor_msgs/msg/JointState': _STAMP,
    'sensor_msgs/msg/LaserScan': _STAMP,
    'tf2_msgs/msg/TFMessage': _TRANSFORM_STAMP,
}
"""Messages that begin with a stamp; large ones, as pictures, are left out."""
_STATIC = '/tf_static'
_RESUMES = {
    'simulation_interfaces/srv/SetSimulationState': '"{state: {state: 1}}"',
    'rosbag2_interfaces/srv/Resume': '"{}"',
}
"""The services that let time go on, and their requests."""


class ClockProbe:
    """Observes time."""

    def begin(self, context: ProbeContext) -> None:
        """Listen to ``/clock``, and to topics whose messages are stamped."""
        self._context, self._node = context, context.node
        node = context.node
        self._began = time.monotonic()
        self._publishers = tuple(
            endpoint_node(each) or 'a node'
            for each in node.get_publishers_info_by_topic(CLOCK_TOPIC)
        )
        if self._publishers:
            self._context.listen()
        self._probes: dict[str, TopicProbe] = {}
        self._offsets: dict[str, int] = {}
        self._stamps: dict[str, dict[tuple[bytes, int], tuple[int, int]]] = {}
        self._listen_to_stamps()
        self._resumes = self._find_sources()
        self._factors: dict[str, ParameterQuery] = {
            name: self._context.ask(name, [_FACTOR]) for name, _ in self._resumes
        }
        self._reports: dict[str, str] = {}
        self._log: TopicProbe | None = None
        self._log_began = 0.0

    @property
    def is_done(self) -> bool:
        """Whether enough was received."""
        self._take()
        waited = time.monotonic() - self._began
        has_answers = all([each.response is not None for each in self._factors.values()])
        has_stamps = all(self._stamps.values()) or waited > _STAMP_PATIENCE
        if not self._publishers:
            return has_stamps
        listened = self._context.seconds
        is_received = listened >= LISTEN if self._context.ticks else listened >= _SILENCE
        if not (has_answers and has_stamps and is_received):
            return False
        return self._has_reports()

    def observe(self) -> Clock:
        """Return what was received."""
        self._take()
        shared = self._context
        stamps = tuple(
            StampSeen(
                topic=topic,
                publishers=self._publishers_of(topic, gid),
                stamp=stamp,
                received=arrival,
                time=shared.time_at(arrival) if self._publishers else None,
            )
            for topic, found in self._stamps.items()
            for (gid, _), (stamp, arrival) in found.items()
            if not self._publishers or shared.ticks
        )
        clock = Clock(
            publishers=self._publishers,
            ticks=tuple(shared.ticks),
            seconds=shared.seconds,
            sources=tuple(self._source(name, resume) for name, resume in self._resumes),
            stamps=stamps,
        )
        for each in (*self._probes.values(), self._log):
            if each is not None:
                each.destroy()
        return clock

    # --- sources ------------------------------------------------------------------------------

    def _find_sources(self) -> list[tuple[str, str]]:
        """Return the nodes that can let time go on, and the commands that make them do so."""
        found = []
        for service, types in self._node.get_service_names_and_types():
            node = service.rpartition('/')[0]
            for kind, request in _RESUMES.items():
                if kind in types and node in self._publishers:
                    found.append((node, f'ros2 service call {service} {kind} {request}'))
        return found

    def _source(self, name: str, resume: str) -> TimeSource:
        value = (self._factors[name].values or {}).get(_FACTOR)
        is_number = isinstance(value, int | float)
        return TimeSource(
            node=name,
            resume=resume,
            asked_factor=float(value) if isinstance(value, int | float) else None,
            speed_parameter=_FACTOR if is_number else '',
            report=self._reports.get(name, ''),
        )

    def _has_reports(self) -> bool:
        """Look what the simulator has logged, if it is slow; return whether that has come."""
        if self._log is not None:
            return time.monotonic() - self._log_began > _REPORT_PATIENCE
        clock = Clock(ticks=tuple(self._context.ticks))
        asked = [
            value
            for each in self._factors.values()
            if isinstance(value := (each.values or {}).get(_FACTOR), int | float)
        ]
        factor = clock.factor
        if factor is None or not asked or factor >= LEAST_FACTOR_SHARE * max(asked):
            return True
        if self._context.seconds < SURE:
            return False
        self._log_began = time.monotonic()
        self._log = TopicProbe(self._node, Log, '/rosout', depth=1000, qos=_ROSOUT)
        return False

    def _take_log(self) -> None:
        for message, _, _ in self._log.messages() if self._log is not None else ():
            # The latest counts: what was logged long ago comes first, as the topic is latched.
            if found := _REPORT.search(message.msg):
                text = found[1]
                self._reports[f'/{message.name.replace(".", "/")}'] = text[0].lower() + text[1:]

    # --- stamps -------------------------------------------------------------------------------

    def _listen_to_stamps(self) -> None:
        node = self._node
        for name, types in sorted(node.get_topic_names_and_types()):
            kinds = [kind for kind in types if kind in _HEADERS]
            if name == _STATIC or len(types) != 1 or not kinds or not node.count_publishers(name):
                continue
            if len(self._stamps) >= _MOST_TOPICS:
                return
            self._listen_to(name, kinds[0])

    def _listen_to(self, topic: str, kind: str) -> None:
        try:
            probe = TopicProbe(self._node, message_type(kind), topic, depth=_DEPTH)
        except (AmrError, RuntimeError):  # the type is not installed; another one is used here
            return
        self._probes[topic], self._offsets[topic], self._stamps[topic] = probe, _HEADERS[kind], {}

    def _take(self) -> None:
        """Take what has come: of each publisher and minute, the latest stamp."""
        self._context.receive()
        self._take_log()
        for topic, probe in self._probes.items():
            for taken in probe.take_bytes():
                stamp = stamp_in(taken.data, self._offsets[topic])
                if stamp is not None:
                    key = taken.gid, stamp // _BUCKET
                    self._stamps[topic][key] = stamp, taken.received

    def _publishers_of(self, topic: str, gid: bytes) -> tuple[str, ...]:
        """Return the node of a publisher; one that is gone may be any that is there."""
        found = self._probes[topic].publishers()
        return (found[gid],) if found.get(gid) else tuple(dict.fromkeys(found.values()))


def stamp_in(data: bytes, offset: int) -> int | None:
    """
    Return the stamp in a serialized message, ns.

    Args:
        data: CDR, with its encapsulation.
        offset: of the stamp; behind a number of elements, if there are 4 bytes more.

    Returns:
        None: the message is too short, or a sequence without elements.
    """
    order = '<' if len(data) > 1 and data[1] & 1 else '>'
    try:
        if offset == _TRANSFORM_STAMP and not struct.unpack_from(f'{order}I', data, _STAMP)[0]:
            return None
        seconds, nanoseconds = struct.unpack_from(f'{order}iI', data, offset)
    except struct.error:
        return None
    return int(seconds) * NANOSECONDS + int(nanoseconds)
