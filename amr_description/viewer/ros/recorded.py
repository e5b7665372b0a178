# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
What a bag says of robots, read once: who is there, and what moved when.

Where everything was at a time is then found by bisection, forwards and backwards alike. Pictures,
scans and all other topics stay in the files: of them the times of the messages are known.
"""

from collections import deque
from collections.abc import Callable, Iterable, Iterator, Mapping
import math
import threading
from typing import TypeAlias

from rclpy.serialization import deserialize_message
from std_msgs.msg import String
from visualization_msgs.msg import MarkerArray

from amr_description.bag.reader import BagReader
from amr_description.bag.storage import TopicMetadata
from amr_description.clock import NANOSECONDS
from amr_description.model.robot import Joint
from amr_description.ros.readers import (
    CLOCK,
    DYNAMIC_JOINT_STATE,
    FramePose,
    JOINT_STATE,
    ODOMETRY,
    TRANSFORMS,
    TWIST,
    TWIST_STAMPED,
)
from amr_description.viewer.description import describe_robot, DescribedRobot
from amr_description.viewer.graph import (
    discover,
    DiscoveredGraph,
    FoundRobot,
    GraphNames,
    MARKERS,
    robot_of,
    TF,
    TWISTS,
)
from amr_description.viewer.introspection import LogLine
from amr_description.viewer.protocol import FrameInfo, RobotLayout, World
from amr_description.viewer.ros.command_topic import DEFAULT_TIMEOUT
from amr_description.viewer.ros.log_lines import read_line
from amr_description.viewer.ros.markers import shapes_of
from amr_description.viewer.ros.robot_topics import WHEEL_VALUES
from amr_description.viewer.states import (
    COMMAND_FLOATS,
    MOTION_FLOATS,
    POSE_FLOATS,
    RobotFloats,
    WHEEL_FLOATS,
)
from amr_description.viewer.tracks import Changes, Times, Track

_BEGINNING = 3 * NANOSECONDS
_IN_FORCE = round(DEFAULT_TIMEOUT * NANOSECONDS)
_MOST_LINES = 2000
"""Of the log: as many as a page keeps."""
_LOG = 'rcl_interfaces/msg/Log'
_CLOCK = 'rosgraph_msgs/msg/Clock'

Take: TypeAlias = Callable[[int, bytes], None]
"""Takes a message in: the time at which it was received, ns, and what it is on the wire."""


class RecordedFrames:
    """The TF tree; frames of robots with a TF of their own get their namespace as a prefix."""

    def __init__(self) -> None:
        self._poses: dict[str, Track] = {}
        self._parents: dict[str, Changes[str]] = {}
        self._topics: dict[str, str] = {}
        self._changes = Times()
        self._versions: dict[int, int] = {}
        """By the number of changes before: trees that are the same have one."""
        self._trees: dict[tuple[FrameInfo, ...], int] = {}
        self._lock = threading.Lock()  # of both

    def takes(self, topic: str) -> Take:
        """Return what takes the messages of a topic."""
        namespace = topic.rpartition('/')[0].lstrip('/')
        prefix = f'{namespace}/' if namespace else ''

        read = TRANSFORMS.reader()

        def take(time: int, data: bytes) -> None:
            for each in read(data):
                self._add(time, prefix, each, topic)

        return take

    def _add(self, time: int, prefix: str, each: FramePose, topic: str) -> None:
        name, parent = _prefixed(prefix, each.name), _prefixed(prefix, each.parent)
        if name not in self._poses:
            self._poses[name], self._parents[name] = Track(POSE_FLOATS), Changes()
        before = len(self._parents[name])
        self._poses[name].add(time, each.pose)
        self._parents[name].add(time, parent)
        self._topics[name] = topic
        if before and len(self._parents[name]) > before:
            self._changes.add(time)

    def complete(self, time: int, namespace: str, fixed: Iterable[Joint]) -> None:
        """
        Add links of a robot that no transform of the bag is of, where its description has them.

        A simulator that records itself hears no robot_state_publisher.
        """
        prefix = f'{namespace.strip("/")}/'
        if not any(name.startswith(prefix) for name in self._poses):
            prefix = ''
        for each in fixed:
            if _prefixed(prefix, each.child) not in self._poses:
                origin = each.origin
                pose = FramePose(each.child, each.parent, (*origin.translation, *origin.rotation))
                self._add(time, prefix, pose, f'{namespace.rstrip("/")}/tf_static')

    def version(self, time: int) -> int:
        """Return which of its trees it was at a time: they differ in who is whose parent."""
        index = self._changes.index(time)
        with self._lock:
            if index not in self._versions:
                tree = tuple(self._sorted(time))
                self._versions[index] = self._trees.setdefault(tree, len(self._trees))
            return self._versions[index]

    def tree(self, time: int) -> tuple[FrameInfo, ...]:
        """Return all frames of the bag, parents before children, without those in a loop."""
        version = self.version(time)
        with self._lock:
            return next(tree for tree, each in self._trees.items() if each == version)

    def _sorted(self, time: int) -> Iterator[FrameInfo]:
        children: dict[str, list[str]] = {}
        for name, parents in self._parents.items():
            children.setdefault(parents.at(time) or '', []).append(name)
        pending = sorted(parent for parent in children if parent not in self._parents)
        while pending:
            parent = pending.pop(0)
            below = sorted(children.get(parent, ()))
            yield from (FrameInfo(name, parent) for name in below)
            pending += below

    def is_static(self, name: str) -> bool:
        """Whether it came by /tf_static."""
        return self.topic(name).endswith('/tf_static')

    def topic(self, name: str) -> str:
        """Return the topic that it came by last."""
        return self._topics[name]

    @property
    def begins(self) -> list[int]:
        """When the first pose of each frame came, ns."""
        return [each.begin for each in self._poses.values() if each.begin is not None]

    def pose(self, name: str, time: int) -> object:
        """Return where a frame was: x y z (m), qx qy qz qw; NaN: not known yet."""
        found = self._poses[name].at(time, or_first=self.is_static(name))
        return math.nan if found is None else found


class RecordedRobot:
    """A robot: its description, and what of it moved."""

    def __init__(self, found: FoundRobot, command: TopicMetadata | None) -> None:
        self.found = found
        self.described: DescribedRobot | None = None
        """By the last description of the bag."""
        self._command = command
        self._odometry, self._truth = Track(MOTION_FLOATS), Track(MOTION_FLOATS)
        self._commands = Track(COMMAND_FLOATS)
        self._joints: dict[str, Track] = {}
        self._wheels: dict[str, Track] = {}

    def takes(self) -> Mapping[str, Take]:
        """Return what takes its messages, by their topics."""
        found, command = self.found, self._command
        takes: dict[str, Take] = {found.description: self._describe}
        if found.joint_states is not None:
            takes[found.joint_states] = self._joint_taker()
        if found.odometry is not None:
            takes[found.odometry] = _taker(self._odometry, ODOMETRY.reader())
        if found.truth is not None:
            takes[found.truth] = _taker(self._truth, ODOMETRY.reader())
        if found.wheels is not None:
            takes[found.wheels] = self._wheel_taker()
        if command is not None:
            row = TWIST_STAMPED if command.type == TWISTS[0] else TWIST
            takes[command.name] = _taker(self._commands, row.reader())
        return takes

    def _describe(self, _: int, data: bytes) -> None:
        text = deserialize_message(data, String).data
        if self.described is None or self.described.message.urdf != text:
            self.described = describe_robot(self.found.id, text)

    def _joint_taker(self) -> Take:
        read = JOINT_STATE.reader()

        def take(time: int, data: bytes) -> None:
            values = read(data)
            missing = [math.nan] * len(values.names)
            velocities = values.velocities or missing
            for name, pair in zip(
                values.names,
                zip(values.positions or missing, velocities, strict=False),
                strict=False,
            ):
                track = self._joints.get(name)
                if track is None:
                    track = self._joints[name] = Track(2)
                track.add(time, pair)

        return take

    def _wheel_taker(self) -> Take:
        read = DYNAMIC_JOINT_STATE.reader()

        def take(time: int, data: bytes) -> None:
            found = read(data)
            for name, values in zip(found.names, found.values, strict=False):
                track = self._wheels.setdefault(name, Track(WHEEL_FLOATS))
                track.add(time, [values.get(each, math.nan) for each in WHEEL_VALUES])

        return take

    @property
    def begins(self) -> list[int]:
        """When the first of each of its motions came, ns."""
        tracks = (self._odometry, self._truth, *self._joints.values())
        return [each.begin for each in tracks if each.begin is not None]

    def layout(self) -> RobotLayout:
        """Return its joints and wheels, in the order of :meth:`write`."""
        joints = self.described.joints if self.described is not None else ()
        return RobotLayout(self.found.id, joints, tuple(self._wheels))

    def write(self, floats: RobotFloats, time: int) -> None:
        """Write what was at a time; NaN: not known."""
        for index, name in enumerate(self.layout().joints):
            track = self._joints.get(name)
            row = None if track is None else track.at(time)
            floats.positions[index], floats.velocities[index] = row or (math.nan, math.nan)
        for track, target, within in (
            (self._odometry, floats.odometry, None),
            (self._truth, floats.truth, None),
            (self._commands, floats.command, _IN_FORCE),
        ):
            row = track.at(time, within=within)
            target[:] = math.nan if row is None else row
        for index, track in enumerate(self._wheels.values()):
            row = track.at(time)
            floats.wheels[index] = math.nan if row is None else row


def _taker(track: Track, read: Callable[[bytes], tuple[float, ...]]) -> Take:
    return lambda time, data: track.add(time, read(data))


class Recorded:
    """All that a bag says, but for the messages that pages are shown one by one."""

    def __init__(self, reader: BagReader) -> None:
        """Read a bag. Raises BagError: it cannot be read."""
        self.topics: Mapping[str, TopicMetadata] = reader.topics
        self.times: dict[str, Times] = {name: Times() for name in self.topics}
        """When the messages of each topic were received."""
        published = {name: (each.type,) for name, each in self.topics.items()}
        self.graph: DiscoveredGraph = discover(GraphNames(published))
        commands = self._commands()
        self.frames = RecordedFrames()
        self.robots = [RecordedRobot(each, commands.get(each.id)) for each in self.graph.robots]
        self.worlds: dict[str, Changes[World]] = {}
        self.log: deque[LogLine] = deque(maxlen=_MOST_LINES)
        self.broken = 0
        """Messages that are not what their type says."""
        self._clock = Changes[int]()
        self.begin = self.end = 0
        self._read(reader)

    def _read(self, reader: BagReader) -> None:
        takes = self._takes()
        times = self.times
        first = last = None
        for topic, data, received, _ in reader.messages():
            first = received if first is None else first
            last = received
            times[topic].add(received)
            take = takes.get(topic)
            if take is not None:
                try:
                    take(received, data)
                except (ValueError, RuntimeError):  # the latter of deserialize_message
                    self.broken += 1
        self.begin, self.end = first or 0, last or 0
        for robot in self.robots:
            if robot.described is not None:
                self.frames.complete(self.begin, robot.found.id, robot.described.fixed)

    def _takes(self) -> Mapping[str, Take]:
        takes: dict[str, Take] = {}
        for name, topic in self.topics.items():
            if topic.type == TF and name.rpartition('/')[2] in ('tf', 'tf_static'):
                takes[name] = self.frames.takes(name)
            elif topic.type == _CLOCK and name == '/clock':
                takes[name] = lambda time, data: self._clock.add(time, CLOCK.read(data))
            elif topic.type == _LOG and name == '/rosout':
                takes[name] = self._add_line
            elif topic.type == MARKERS and name.endswith('/world'):
                takes[name] = self._world_taker(name.rpartition('/')[0])
        for robot in self.robots:
            takes |= robot.takes()
        return takes

    def _add_line(self, _: int, data: bytes) -> None:
        self.log.append(read_line(data, self.log[-1].number + 1 if self.log else 1))

    def _world_taker(self, simulator: str) -> Take:
        worlds = self.worlds[simulator] = Changes[World]()
        last = b''

        def take(time: int, data: bytes) -> None:
            nonlocal last
            if data != last:
                worlds.add(
                    time, World(simulator, shapes_of(deserialize_message(data, MarkerArray)))
                )
                last = data

        return take

    def _commands(self) -> Mapping[str, TopicMetadata]:
        """Return the topic of velocity commands of each robot: by its name, else the shortest."""
        ids = [each.id for each in self.graph.robots]
        found: dict[str, TopicMetadata] = {}
        for topic in sorted(self.topics.values(), key=_preference):
            robot = robot_of(topic.name, ids)
            if topic.type in TWISTS and robot is not None:
                found.setdefault(robot, topic)
        return found

    @property
    def ready(self) -> int:
        """
        The time from which on all that moves is known, ns; at most a few seconds after the begin.

        A recorder subscribes to one topic after the other.
        """
        begins = [*self.frames.begins, *(each for robot in self.robots for each in robot.begins)]
        soon = [each for each in begins if each - self.begin <= _BEGINNING]
        return max(soon, default=self.begin)

    def time(self, at: int) -> float:
        """Return the time of a state, s: that of the last /clock, else when it was received."""
        clock = self._clock.at(at)  # 0 is a time: that of a simulation that has just begun
        return (at if clock is None else clock) / NANOSECONDS


def _preference(topic: TopicMetadata) -> tuple[bool, int, str]:
    return not topic.name.endswith('/cmd_vel'), len(topic.name), topic.name


def _prefixed(prefix: str, name: str) -> str:
    return name if name.startswith(prefix) else f'{prefix}{name}'
