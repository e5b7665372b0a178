# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
The beginning of a serialized ``sensor_msgs/JointState``: its stamp and joints.

Who thins joint states out needs no more of most of them, and decoding a whole one takes rclpy a
hundred times as long. This module imports no rclpy.

The layout is that of CDR (DDS-XTypes 1.3, 7.4.1): four bytes of which the second names the byte
order (0 big, 1 little), then, numbers aligned to their size from here on, int32 sec,
uint32 nanosec, the string ``frame_id``, the sequence of strings ``name``. Strings and sequences
begin with their length as uint32; that of a string counts the zero at its end.
"""

from dataclasses import dataclass
import struct
from struct import Struct


@dataclass(frozen=True, slots=True)
class _Order:
    """How numbers are written."""

    stamp: Struct
    length: Struct


_ORDERS = {
    b'\x00\x00': _Order(Struct('>iI'), Struct('>I')),
    b'\x00\x01': _Order(Struct('<iI'), Struct('<I')),
}
_STAMP, _AFTER_STAMP = 4, 12
# Sources of joint states that are told apart at no cost; a robot has one or two.
_REMEMBERED = 8


@dataclass(frozen=True, slots=True)
class JointStateHead:
    """Stamp (ns) and joint names of a message."""

    stamp: int
    names: tuple[str, ...]


class HeadReader:
    """
    Reads heads, and remembers what comes after the stamp: the messages of a source are alike.

    A robot's joints are decoded once then, and compared afterwards.
    """

    def __init__(self) -> None:
        self._known: list[tuple[bytes, tuple[str, ...]]] = []

    def read(self, data: bytes) -> JointStateHead:
        """Return the head of a message. Raises ValueError: these bytes are none in plain CDR."""
        order = _ORDERS.get(data[:2])
        if order is None or len(data) < _AFTER_STAMP:
            raise ValueError(f'no JointState in plain CDR: {data[:_AFTER_STAMP].hex(" ")}')
        sec, nanosec = order.stamp.unpack_from(data, _STAMP)
        stamp = sec * 1_000_000_000 + nanosec
        # No two byte orders write the lengths in a beginning alike.
        for beginning, names in self._known:
            if data.startswith(beginning, _AFTER_STAMP):
                return JointStateHead(stamp, names)
        names, end = _read_names(data, order.length)
        self._known.insert(0, (data[_AFTER_STAMP:end], names))
        del self._known[_REMEMBERED:]
        return JointStateHead(stamp, names)


def _read_names(data: bytes, length: Struct) -> tuple[tuple[str, ...], int]:
    """Return the joint names, and where they end. Raises ValueError."""
    try:
        _, at = _read_string(data, _AFTER_STAMP, length)
        at = -(-at // 4) * 4
        (count,) = length.unpack_from(data, at)
        at += 4
        names = []
        for _ in range(count):
            name, at = _read_string(data, -(-at // 4) * 4, length)
            names.append(name)
        return tuple(names), at
    except struct.error as cause:
        raise ValueError(f'a JointState of {len(data)} bytes ends within its names') from cause


def _read_string(data: bytes, at: int, length: Struct) -> tuple[str, int]:
    (size,) = length.unpack_from(data, at)
    begin, end = at + length.size, at + length.size + size
    if end > len(data):
        raise ValueError(f'a string of {size} bytes in a JointState of {len(data)}')
    return data[begin : end - 1].decode(), end
