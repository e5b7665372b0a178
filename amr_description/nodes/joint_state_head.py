# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
The beginning of a serialized ``sensor_msgs/JointState``: its stamp and joints.

Who thins joint states out needs no more of most of them, and decoding a whole one takes rclpy a
hundred times as long. This module imports no rclpy.
"""

from dataclasses import dataclass

from amr_description.nodes.cdr import Reader

_AFTER_STAMP = 12
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
        reader = Reader(data)
        stamp = reader.stamp()
        # No two byte orders write the lengths in a beginning alike.
        for beginning, names in self._known:
            if data.startswith(beginning, _AFTER_STAMP):
                return JointStateHead(stamp, names)
        reader.text()
        names = tuple(reader.texts())
        self._known.insert(0, (data[_AFTER_STAMP : reader.at], names))
        del self._known[_REMEMBERED:]
        return JointStateHead(stamp, names)
