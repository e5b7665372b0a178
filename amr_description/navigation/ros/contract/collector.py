# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
Subscriptions with the QoS of Nav2 and slam_toolbox (Jazzy), until enough has come.

==============  ==================================================================================
topic           QoS, and whose it is
==============  ==================================================================================
``/clock``      best effort: rclcpp's time source (``ClockQoS``)
``/tf``         reliable, depth 100; ``/tf_static`` transient local too: ``tf2_ros``
``odom``        reliable: ``OdomSmoother`` of nav2_util
``scan``        best effort: slam_toolbox, AMCL, obstacle layers (``SensorDataQoS``)
``map``         reliable, transient local: static layer, AMCL
==============  ==================================================================================

Depths are larger than theirs where messages are counted, so that a busy machine loses none.
"""

from collections.abc import Callable, Sequence
from dataclasses import replace
import time
from typing import Any, TypeAlias

from nav_msgs.msg import OccupancyGrid, Odometry
import numpy as np
from rclpy.node import Node
from rclpy.qos import DurabilityPolicy, QoSProfile, ReliabilityPolicy
from rosgraph_msgs.msg import Clock
from sensor_msgs.msg import LaserScan
from std_msgs.msg import String
from tf2_msgs.msg import TFMessage

from amr_description.ament_index import resolve_uri
from amr_description.clock import NANOSECONDS
from amr_description.errors import AmrError, DescriptionError, TransformException
from amr_description.model.footprint import footprint
from amr_description.model.frames import yaw_of
from amr_description.model.robot import Robot
from amr_description.model.urdf import parse
from amr_description.navigation.contract.frame_rules import TF_TIMEOUT
from amr_description.navigation.contract.observations import (
    Body,
    ContractFrames,
    ContractObservations,
    MapSeen,
    ODOMETRY_TYPE,
    OdometrySeen,
    Phase,
    RangeCounts,
    SCAN_TYPE,
    ScanGeometry,
    ScanSeen,
    Tick,
    TransformSeen,
)
from amr_description.navigation.ros.contract.graph import (
    command_topics,
    ParameterReader,
    topic_of,
    topics_elsewhere,
)
from amr_description.ros.messages import nanoseconds, transform_of_message
from amr_description.ros.qos import LATCHED, TF_STATIC
from amr_description.tf2_ros.buffer_core import BufferCore
from amr_description.tf2_ros.time_cache import StampedTransform


def with_lookups(
    scans: Sequence[ScanSeen], transforms: Sequence[TransformSeen], target: str
) -> tuple[ScanSeen, ...]:
    """
    Return scans with the time from each one's reception until ``target`` ← its frame was known.

    It looks up exactly at the stamp, as ``tf2_ros::MessageFilter`` does: nothing is extrapolated.

    Args:
        scans: in the order of their reception.
        transforms: all that came, in the order of their reception.
        target: the frame that scans are transformed to.
    """
    buffer = BufferCore()
    done: dict[int, ScanSeen] = {}
    waiting: dict[int, ScanSeen] = {}

    def look(place: int, scan: ScanSeen, now: int) -> None:
        try:
            buffer.lookup_transform(target, scan.frame, scan.stamp)
        except TransformException as error:
            waiting[place] = replace(scan, error=str(error))
        else:
            waiting.pop(place, None)
            done[place] = replace(scan, wait=max(0, now - scan.received))

    rest = list(enumerate(scans))[::-1]
    for each in transforms:
        while rest and rest[-1][1].received < each.received:
            place, scan = rest.pop()
            look(place, scan, scan.received)
        stamped = StampedTransform(each.parent, each.child, each.stamp, each.transform)
        buffer.set_transform(stamped, static=each.is_static)
        for place, scan in list(waiting.items()):
            look(place, scan, each.received)
    for place, scan in reversed(rest):
        look(place, scan, scan.received)
    return tuple(scan for _, scan in sorted((done | waiting).items()))


CLOCK_TOPIC, TF_TOPIC, TF_STATIC_TOPIC = '/clock', '/tf', '/tf_static'
ODOM_TOPIC, SCAN_TOPIC, MAP_TOPIC = 'odom', 'scan', 'map'
COMMAND_TOPIC, POSE_TOPIC, DESCRIPTION_TOPIC = 'cmd_vel', 'initialpose', 'robot_description'

TICKS, SCANS = 100, 20
ENOUGH = {ODOM_TOPIC: 20, SCAN_TOPIC: SCANS, TF_TOPIC: 30}
"""So many messages are; where there is a clock, so many ticks besides."""

_MANY = 1000
_CLOCK_QOS = QoSProfile(depth=_MANY, reliability=ReliabilityPolicy.BEST_EFFORT)
_TF_QOS = QoSProfile(depth=_MANY)
_ODOM_QOS = QoSProfile(depth=_MANY, reliability=ReliabilityPolicy.RELIABLE)
_SCAN_QOS = QoSProfile(depth=50, reliability=ReliabilityPolicy.BEST_EFFORT)
_MAP_QOS = QoSProfile(
    depth=1,
    reliability=ReliabilityPolicy.RELIABLE,
    durability=DurabilityPolicy.TRANSIENT_LOCAL,
)
_RESET_BEFORE = NANOSECONDS
"""ns of simulated time: where it goes back to less, the simulation was reset."""
_DISCOVERY = 2.0
"""s after which who is not in the graph is taken to be absent, where it may be."""
_SILENCE = 1.0
"""s without a transform, after which none is taken to be on its way."""
_LOOK_PERIOD = 0.25
"""s between two looks at the graph."""

_Info: TypeAlias = dict[str, int]


class Collector:
    """Listens from its making on; whoever has it spins the node."""

    def __init__(self, node: Node, frames: ContractFrames, *, is_stamped: bool) -> None:
        """
        Subscribe.

        Args:
            node: its topics are those of the robot, after its namespace and remapping.
            frames: that Nav2 and slam_toolbox are configured for.
            is_stamped: Nav2 is configured with ``enable_stamped_cmd_vel``.
        """
        self.node = node
        self._frames = frames
        self._is_stamped = is_stamped
        self._began = time.monotonic()
        self._looked = -_LOOK_PERIOD
        self._parameters = ParameterReader(node)
        self._ticks: list[Tick] = []
        self._transforms: list[TransformSeen] = []
        self._static: list[TransformSeen] = []
        self.odometry: list[OdometrySeen] = []
        self._scans: list[ScanSeen] = []
        self._moving = 0
        self._heard_tf, self._latest_tf = -_SILENCE, 0
        self._resets = 0
        self._map: MapSeen | None = None
        self._body: Body | None = None
        self.drive: tuple[Phase, ...] = ()
        self.not_driven = ''
        subscriptions: tuple[tuple[Any, str, Callable[[Any, _Info], None], QoSProfile], ...] = (
            (Clock, CLOCK_TOPIC, self._on_clock, _CLOCK_QOS),
            (TFMessage, TF_TOPIC, self._on_tf, _TF_QOS),
            (TFMessage, TF_STATIC_TOPIC, self._on_tf_static, TF_STATIC),
            (Odometry, ODOM_TOPIC, self._on_odometry, _ODOM_QOS),
            (LaserScan, SCAN_TOPIC, self._on_scan, _SCAN_QOS),
            (OccupancyGrid, MAP_TOPIC, self._on_map, _MAP_QOS),
            (String, DESCRIPTION_TOPIC, self._on_description, LATCHED),
        )
        for kind, topic, callback, qos in subscriptions:
            node.create_subscription(kind, topic, callback, qos)

    @property
    def seconds(self) -> float:
        """How long it has listened, s."""
        return time.monotonic() - self._began

    @property
    def counts(self) -> dict[str, int]:
        """Return how many messages were heard, by the topic's name before remapping."""
        return {
            CLOCK_TOPIC: len(self._ticks),
            TF_TOPIC: self._moving,
            ODOM_TOPIC: len(self.odometry),
            SCAN_TOPIC: len(self._scans),
        }

    def awaited(self) -> list[str]:
        """Return of what not enough has come yet, in words; empty: all is known."""
        node, seconds = self.node, self.seconds
        if seconds - self._looked >= _LOOK_PERIOD:
            self._looked = seconds
            self._parameters.ask()
        counts = self.counts
        missing = [
            f'{node.resolve_topic_name(name)} ({counts[name]} of {enough})'
            for name, enough in ENOUGH.items()
            if counts[name] < enough
        ]
        if missing:
            return missing
        if counts[CLOCK_TOPIC] < TICKS and node.count_publishers(CLOCK_TOPIC):
            return [f'{CLOCK_TOPIC} ({counts[CLOCK_TOPIC]} of {TICKS})']
        if seconds < _DISCOVERY:
            return ['the graph']
        if self._map is None and node.count_publishers(MAP_TOPIC):
            return [node.resolve_topic_name(MAP_TOPIC)]
        if not self._parameters.has_all:
            return ['use_sim_time of the nodes']
        settled = self._scans[SCANS - 1].received + TF_TIMEOUT < self._ended
        return [] if settled else ['transforms of the last scan']

    def observations(self) -> ContractObservations:
        """Return what was seen until now."""
        node = self.node
        transforms = sorted((*self._static, *self._transforms), key=lambda each: each.received)
        clock = topic_of(node, CLOCK_TOPIC)
        commands = topic_of(node, COMMAND_TOPIC)
        values: dict[str, Any] = {'not_driven': self.not_driven} if self.not_driven else {}
        return ContractObservations(
            clock=clock,
            tf=topic_of(node, TF_TOPIC),
            odom=topic_of(node, ODOM_TOPIC),
            scan=topic_of(node, SCAN_TOPIC),
            cmd_vel=commands,
            map=topic_of(node, MAP_TOPIC),
            initial_pose=topic_of(node, POSE_TOPIC),
            frames=self._frames,
            seconds=self.seconds,
            is_stamped=self._is_stamped,
            ended=self._ended,
            resets=self._resets,
            ticks=tuple(self._ticks),
            transforms=tuple(transforms),
            odometry=tuple(self.odometry),
            scans=with_lookups(self._scans, transforms, self._frames.odom),
            map_seen=self._map,
            body=self._body,
            use_sim_time=self._parameters.use_sim_time(clock.publishers),
            silent_nodes=self._parameters.silent(),
            parameters=self._parameters.special(),
            drive=self.drive,
            elsewhere=topics_elsewhere(node, ODOMETRY_TYPE, SCAN_TYPE),
            other_command_topics=command_topics(node, commands.name),
            **values,
        )

    @property
    def _ended(self) -> int:
        """
        Until when transforms are known, as ``received``.

        A busy process may not have looked yet at some that have come already.
        """
        is_silent = time.monotonic() - self._heard_tf > _SILENCE
        return time.time_ns() if is_silent else self._latest_tf

    # --- callbacks ----------------------------------------------------------------------------

    def _on_clock(self, message: Clock, info: _Info) -> None:
        time = nanoseconds(message.clock)
        if self._ticks and time < self._ticks[-1].time and time < _RESET_BEFORE:
            self._begin_anew()
        self._ticks.append(Tick(time, _received(info)))

    def _begin_anew(self) -> None:
        """Forget what was seen before the simulation was reset; what is static stays."""
        self._resets += 1
        self._moving = 0
        for each in (self._ticks, self._transforms, self.odometry, self._scans):
            each.clear()

    def _on_tf(self, message: TFMessage, info: _Info) -> None:
        found = _transforms(message, info, is_static=False)
        self._transforms += found
        self._moving += any(each.parent == self._frames.odom for each in found)
        self._heard_tf, self._latest_tf = time.monotonic(), _received(info)

    def _on_tf_static(self, message: TFMessage, info: _Info) -> None:
        self._static += _transforms(message, info, is_static=True)

    def _on_odometry(self, message: Odometry, info: _Info) -> None:
        pose, twist = message.pose.pose, message.twist.twist
        turn = pose.orientation
        position, speed = message.pose.covariance, message.twist.covariance
        self.odometry.append(
            OdometrySeen(
                nanoseconds(message.header.stamp),
                _received(info),
                message.header.frame_id,
                message.child_frame_id,
                pose.position.x,
                pose.position.y,
                yaw_of((turn.x, turn.y, turn.z, turn.w)),
                (twist.linear.x, twist.linear.y),
                twist.angular.z,
                # The diagonal of (x, y, z, roll, pitch, yaw), row by row.
                (position[0], position[7], position[35], speed[0], speed[35]),
            )
        )

    def _on_scan(self, message: LaserScan, info: _Info) -> None:
        geometry = ScanGeometry(
            message.angle_min,
            message.angle_max,
            message.angle_increment,
            message.range_min,
            message.range_max,
            len(message.ranges),
        )
        stamp = nanoseconds(message.header.stamp)
        counts = counts_of(message)
        self._scans.append(
            ScanSeen(stamp, _received(info), message.header.frame_id, geometry, counts)
        )

    def _on_map(self, message: OccupancyGrid, _info: _Info) -> None:
        size = message.info
        self._map = MapSeen(
            message.header.frame_id, size.width, size.height, size.resolution, len(message.data)
        )

    def _on_description(self, message: String, _info: _Info) -> None:
        try:
            robot = parse(message.data)
        except DescriptionError as error:
            self.node.get_logger().warning(f'robot_description cannot be read: {error}')
            return
        self._body = body_of(robot, self._frames.base.rpartition('/')[2])


def body_of(robot: Robot, base: str) -> Body:
    """Return the shape of a robot in its base, or in its root if it has no such link."""
    moving = frozenset(joint.child for _, joint in robot.walk() if joint.is_moving)
    try:
        found = footprint(robot, resolve_uri, frame=base if robot.has_link(base) else None)
    except AmrError as error:
        return Body(moving, fault=str(error))
    return Body(moving, found.circumscribed_radius, found.corners)


def counts_of(message: LaserScan) -> RangeCounts:
    """Return how many ranges of a scan are what."""
    ranges = np.asarray(message.ranges, dtype=np.float32)
    finite = ranges[np.isfinite(ranges)]
    lower, upper = np.float32(message.range_min), np.float32(message.range_max)
    beyond, nearer = int((finite > upper).sum()), int((finite < lower).sum())
    return RangeCounts(
        hits=len(finite) - beyond - nearer,
        beyond=beyond,
        nearer=nearer,
        infinite=int(np.isposinf(ranges).sum()),
        invalid=int(np.isnan(ranges).sum()),
    )


def _transforms(message: TFMessage, info: _Info, *, is_static: bool) -> list[TransformSeen]:
    received, sequence = _received(info), info.get('publication_sequence_number') or 0
    found = []
    for each in message.transforms:
        pose = transform_of_message(each.transform)
        found.append(
            TransformSeen(
                # tf2 drops a leading slash, of which messages of ROS 1 have some.
                each.header.frame_id.removeprefix('/'),
                each.child_frame_id.removeprefix('/'),
                nanoseconds(each.header.stamp),
                received,
                is_static,
                pose,
                sequence,
            )
        )
    return found


def _received(info: _Info) -> int:
    """Return when DDS got a message, not when this process had time for it."""
    return info.get('received_timestamp') or time.time_ns()
