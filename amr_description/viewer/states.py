# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
The binary frames of states, little-endian, filled in place. NaN: not known.

::

     0  u8   1, the kind of the frame
     1  u8   0
     2  u16  id of the layout
     4  u32  number of the state, one more for each, so that gaps can be detected
     8  f64  time, s, of /clock if it is published, else of the system
    16  f32  …

The f32 values are: for each frame of the layout its pose in its parent (x y z qx qy qz qw); then
for each robot of the layout

::

    position of each joint, then the velocity of each,
    then the commanded velocity of each                        3 × joints
    odometry: x y z qx qy qz qw, linear x, angular z, linear y 10, in the frame of the message
    ground truth: the same                                     10, in `world`
    command: linear x, angular z, linear y                     3, the latest on the command topic
    wheels: contact, normal force, slip along, slip across     4 × wheels, see ``Watch``
"""

from dataclasses import dataclass
import struct
from typing import TypeAlias

import numpy as np

from amr_description.viewer.protocol import Layout, RobotLayout

_HEADER = struct.Struct('<BBHId')
HEADER_BYTES = _HEADER.size
STATE_KIND = 1
POSE_FLOATS = 7
JOINT_FLOATS = 3
MOTION_FLOATS = 10
COMMAND_FLOATS = 3
WHEEL_FLOATS = 4
LAYOUTS = 2**16
"""Number of layout ids; they are reused after that."""
_NUMBERS = 2**32

Floats: TypeAlias = np.ndarray
"""float32, a view into the frame: what is written here is sent."""


@dataclass(frozen=True, slots=True)
class RobotFloats:
    """The values of one robot; ``wheels`` has the shape (wheels, 4)."""

    positions: Floats
    velocities: Floats
    commanded: Floats
    odometry: Floats
    truth: Floats
    command: Floats
    wheels: Floats


class StateFrame:
    """The frame of one layout, reused for every state."""

    def __init__(self, layout: Layout) -> None:
        self.layout = layout
        count = sum(map(_size, layout.robots))
        size = POSE_FLOATS * len(layout.frames) + count
        self._data = bytearray(HEADER_BYTES + 4 * size)
        floats = np.frombuffer(self._data, np.dtype('<f4'), offset=HEADER_BYTES)
        floats.fill(np.nan)
        end = POSE_FLOATS * len(layout.frames)
        self.poses: Floats = floats[:end].reshape(-1, POSE_FLOATS)
        """Of each frame in its parent: x y z (m), qx qy qz qw; shape (frames, 7)."""
        self.robots: tuple[RobotFloats, ...] = ()
        for robot in layout.robots:
            begin, end = end, end + _size(robot)
            self.robots += (_parts(floats[begin:end], robot),)

    def encode(self, number: int, time: float) -> bytes:
        """Return the frame as bytes; ``number`` counts states, ``time`` is in s."""
        _HEADER.pack_into(self._data, 0, STATE_KIND, 0, self.layout.id, number % _NUMBERS, time)
        return bytes(self._data)


def _size(robot: RobotLayout) -> int:
    return (
        JOINT_FLOATS * len(robot.joints)
        + 2 * MOTION_FLOATS
        + COMMAND_FLOATS
        + WHEEL_FLOATS * len(robot.wheels)
    )


def _parts(floats: Floats, robot: RobotLayout) -> RobotFloats:
    joints = len(robot.joints)
    lengths = (*[joints] * JOINT_FLOATS, MOTION_FLOATS, MOTION_FLOATS, COMMAND_FLOATS)
    places, speeds, commanded, odometry, truth, command, wheels = np.split(
        floats, np.cumsum(lengths)
    )
    wheels = wheels.reshape(-1, WHEEL_FLOATS)
    return RobotFloats(places, speeds, commanded, odometry, truth, command, wheels)
