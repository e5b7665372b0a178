# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
Serialized messages, read without making messages of them.

rclpy builds a Python object for every field: 60 µs for an Odometry, of which a picture needs nine
numbers. These readers take 3 to 10 µs. They know plain CDR (DDS-XTypes 1.3, 7.4.1), which every
vendor of DDS sends for ROS: four bytes of which the second names the byte order (0 big, 1 little)
and the last two are options, then the fields, numbers aligned to their size from there on; strings
and sequences begin with their length as uint32, that of a string counts the zero at its end. What
follows the last field is padding. Bytes that end too early raise ValueError.

:class:`HeadReader` reads only the beginning of a ``sensor_msgs/JointState``, its stamp and joints:
who thins joint states out needs no more of most of them.

This module imports no rclpy.
"""

from dataclasses import dataclass, field
import struct
from typing import TypeAlias

from amr_description.clock import NANOSECONDS

_BEGIN = 4
_POSE_COVARIANCE = 36
_ORDERS = tuple((each, struct.Struct(f'{each}I'), struct.Struct(f'{each}iI')) for each in '><')
"""By the second byte: how numbers are written, with the structs of a length and of a time."""

Motion: TypeAlias = tuple[float, ...]
"""x y z qx qy qz qw of a pose, linear x, angular z, linear y: m, m/s, rad/s, m/s."""


class Reader:
    """Reads one field after the other."""

    def __init__(self, data: bytes) -> None:
        if len(data) < _BEGIN or data[0] != 0 or data[1] > 1:
            raise ValueError(f'no plain CDR: {data[:_BEGIN].hex(" ")}')
        self._data = data
        self._order, self._length, self._stamp = _ORDERS[data[1]]
        self.at = _BEGIN
        """Where the next field begins, or the bytes that align it."""

    def count(self) -> int:
        """Read a uint32."""
        return self._unpack(self._length)[0]

    def stamp(self) -> int:
        """Read a time, ns."""
        seconds, nanoseconds = self._unpack(self._stamp)
        return seconds * NANOSECONDS + nanoseconds

    def text(self) -> str:
        """Read a string."""
        size = self.count()
        begin, self.at = self.at, self.at + size
        if self.at > len(self._data):
            raise ValueError(f'{len(self._data)} bytes end within a string of {size}')
        return self._data[begin : self.at].removesuffix(b'\0').decode()

    def octets(self, count: int) -> bytes:
        """Read so many bytes."""
        begin, self.at = self.at, self.at + count
        if self.at > len(self._data):
            raise ValueError(f'{len(self._data)} bytes end within {count} octets')
        return self._data[begin : self.at]

    def texts(self) -> list[str]:
        """Read a sequence of strings."""
        return [self.text() for _ in range(self.count())]

    def doubles(self, count: int) -> tuple[float, ...]:
        """Read so many float64."""
        at = self._skip_to(count)
        return struct.unpack_from(f'{self._order}{count}d', self._data, at)

    def skip_doubles(self, count: int) -> None:
        """Pass over so many float64."""
        self._skip_to(count)

    def some_doubles(self) -> tuple[float, ...]:
        """Read a sequence of float64."""
        count = self.count()
        return self.doubles(count) if count else ()

    def _unpack(self, kind: struct.Struct) -> tuple[int, ...]:
        at = self.at + 3 & ~3
        self.at = at + kind.size
        if self.at > len(self._data):
            raise ValueError(f'{len(self._data)} bytes end within a number')
        return kind.unpack_from(self._data, at)

    def _skip_to(self, count: int) -> int:
        at = (self.at - _BEGIN + 7 & ~7) + _BEGIN
        self.at = at + 8 * count
        if self.at > len(self._data):
            raise ValueError(f'{len(self._data)} bytes end within {count} numbers')
        return at


@dataclass(frozen=True, slots=True)
class JointValues:
    """Of a JointState; ``positions`` and ``velocities`` may be empty."""

    names: list[str]
    positions: tuple[float, ...]
    velocities: tuple[float, ...]


@dataclass(frozen=True, slots=True)
class InterfaceValues:
    """Of a DynamicJointState: for each joint, values by interface."""

    names: list[str]
    values: list[dict[str, float]]


@dataclass(frozen=True, slots=True)
class StatisticNames:
    """Of StatisticsNames."""

    names: list[str]
    version: int


@dataclass(frozen=True, slots=True)
class StatisticValues:
    """Of StatisticsValues, in the order of the names of the same version."""

    values: tuple[float, ...]
    version: int


@dataclass(frozen=True, slots=True)
class FramePose:
    """Of a TFMessage: where a frame is in its parent, x y z qx qy qz qw, m."""

    name: str
    parent: str
    pose: tuple[float, ...]


def read_clock(data: bytes) -> int:
    """``rosgraph_msgs/msg/Clock``: ns."""
    return Reader(data).stamp()


def read_transforms(data: bytes) -> list[FramePose]:
    """``tf2_msgs/msg/TFMessage``."""
    reader = Reader(data)
    return [_read_transform(reader) for _ in range(reader.count())]


def read_stamped_transforms(data: bytes) -> list[tuple[int, FramePose]]:
    """``tf2_msgs/msg/TFMessage``, with the stamps, ns."""
    reader = Reader(data)
    return [(reader.stamp(), _read_frame_pose(reader)) for _ in range(reader.count())]


def read_joint_state(data: bytes) -> JointValues:
    """``sensor_msgs/msg/JointState``."""
    reader = _after_header(data)
    return JointValues(reader.texts(), reader.some_doubles(), reader.some_doubles())


def read_odometry(data: bytes) -> Motion:
    """``nav_msgs/msg/Odometry``."""
    reader = _after_header(data)
    reader.text()
    pose = reader.doubles(7)
    reader.skip_doubles(_POSE_COVARIANCE)
    return pose + _planar(reader)


def read_dynamic_joint_state(data: bytes) -> InterfaceValues:
    """``control_msgs/msg/DynamicJointState``."""
    reader = _after_header(data)
    names = reader.texts()
    values = [
        dict(zip(reader.texts(), reader.some_doubles(), strict=False))
        for _ in range(reader.count())
    ]
    return InterfaceValues(names, values)


def read_statistics_names(data: bytes) -> StatisticNames:
    """``pal_statistics_msgs/msg/StatisticsNames``."""
    reader = _after_header(data)
    return StatisticNames(reader.texts(), reader.count())


def read_statistics_values(data: bytes) -> StatisticValues:
    """``pal_statistics_msgs/msg/StatisticsValues``."""
    reader = _after_header(data)
    return StatisticValues(reader.some_doubles(), reader.count())


def read_twist(data: bytes) -> tuple[float, ...]:
    """``geometry_msgs/msg/Twist``: linear x, m/s, angular z, rad/s, and linear y, m/s."""
    return _planar(Reader(data))


def read_twist_stamped(data: bytes) -> tuple[float, ...]:
    """``geometry_msgs/msg/TwistStamped``: as :func:`read_twist`."""
    return _planar(_after_header(data))


def _after_header(data: bytes) -> Reader:
    reader = Reader(data)
    reader.stamp()
    reader.text()
    return reader


def _read_transform(reader: Reader) -> FramePose:
    reader.stamp()
    return _read_frame_pose(reader)


def _read_frame_pose(reader: Reader) -> FramePose:
    parent = reader.text()
    return FramePose(reader.text(), parent, reader.doubles(7))


def _planar(reader: Reader) -> tuple[float, ...]:
    values = reader.doubles(6)
    return (values[0], values[5], values[1])


_AFTER_STAMP = 12
# Sources of joint states that are told apart at no cost; a robot has one or two.
_REMEMBERED = 8


@dataclass(frozen=True, slots=True)
class JointStateHead:
    """Stamp (ns) and joint names of a message."""

    stamp: int
    names: tuple[str, ...]
    end: int = field(default=0, compare=False)
    """Where the positions begin, or the bytes that align them."""


class HeadReader:
    """
    Reads heads, and remembers what comes after the stamp: the messages of a source are alike.

    A robot's joints are decoded once then, and compared afterwards.
    """

    def __init__(self) -> None:
        self._known: list[tuple[bytes, tuple[str, ...]]] = []

    def read(self, data: bytes) -> JointStateHead:
        """Return the head of a message. Raises ValueError: these bytes are none in plain CDR."""
        # No two byte orders write the lengths in a beginning alike.
        for beginning, names in self._known:
            if data.startswith(beginning, _AFTER_STAMP) and data[1] <= 1 and not data[0]:
                seconds, nanoseconds = _ORDERS[data[1]][2].unpack_from(data, _BEGIN)
                return JointStateHead(
                    seconds * NANOSECONDS + nanoseconds, names, _AFTER_STAMP + len(beginning)
                )
        reader = Reader(data)
        stamp = reader.stamp()
        reader.text()
        names = tuple(reader.texts())
        self._known.insert(0, (data[_AFTER_STAMP : reader.at], names))
        del self._known[_REMEMBERED:]
        return JointStateHead(stamp, names, reader.at)


def read_positions(data: bytes, head: JointStateHead) -> tuple[float, ...]:
    """Read the positions of a JointState, rad or m, whose head has been read."""
    reader = Reader(data)
    reader.at = head.end
    return reader.some_doubles()


class JointStateReader:
    """:func:`read_joint_state` of a topic, twice as fast while its names stay the same."""

    def __init__(self) -> None:
        self._heads = HeadReader()

    def __call__(self, data: bytes) -> JointValues:
        """Read a message. Raises ValueError."""
        head = self._heads.read(data)
        reader = Reader(data)
        reader.at = head.end
        return JointValues(list(head.names), reader.some_doubles(), reader.some_doubles())


class DynamicJointStateReader:
    """:func:`read_dynamic_joint_state` of a topic, twice as fast while its names stay the same."""

    def __init__(self) -> None:
        self._beginning = b''
        """What came after the stamp, until the names of the first joint's interfaces."""
        self._names: list[str] = []
        self._interfaces: list[tuple[bytes, list[str]]] = []
        """Of each joint: the bytes of the names of its interfaces, and these."""

    def __call__(self, data: bytes) -> InterfaceValues:
        """Read a message. Raises ValueError."""
        reader = Reader(data)
        if self._beginning and data.startswith(self._beginning, _AFTER_STAMP):
            reader.at = _AFTER_STAMP + len(self._beginning)
            values = []
            for names, interfaces in self._interfaces:
                if not data.startswith(names, reader.at):
                    return self._read(data)
                reader.at += len(names)
                values.append(dict(zip(interfaces, reader.some_doubles(), strict=False)))
            return InterfaceValues(self._names, values)
        return self._read(data)

    def _read(self, data: bytes) -> InterfaceValues:
        """Read all of it, and remember what numbers are not."""
        self._beginning = b''
        reader = _after_header(data)
        names = reader.texts()
        count = reader.count()
        beginning = data[_AFTER_STAMP : reader.at]
        known, values = [], []
        for _ in range(count):
            begin = reader.at
            interfaces = reader.texts()
            known.append((data[begin : reader.at], interfaces))
            values.append(dict(zip(interfaces, reader.some_doubles(), strict=False)))
        self._beginning, self._names, self._interfaces = beginning, names, known
        return InterfaceValues(names, values)
