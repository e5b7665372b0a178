# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
The binary frames: what ``web/src/protocol.ts`` calls a state, filled in place.

::

    0  u8 1 │ 1  u8 0 │ 2  u16 layout │ 4  u32 number │ 8  f64 time │ 16  f32 …

The f32 are, for each frame its pose (7), then for each robot the positions of its joints, their
velocities, the velocities that they are commanded, odometry (9), truth (9), command (2), wheels
(4 each). NaN: not known.
"""

from dataclasses import dataclass
import struct

import numpy as np

from amr_description.viewer.protocol import Layout, RobotLayout

HEADER = struct.Struct('<BBHId')
KIND = 1
POSE_FLOATS = 7
JOINT_FLOATS = 3
MOTION_FLOATS = 9
COMMAND_FLOATS = 2
WHEEL_FLOATS = 4
LAYOUTS = 2**16
"""Ids of layouts go from 0 to below this."""
_NUMBERS = 2**32

type Floats = np.ndarray
"""float32, a view into the frame: what is written there is sent."""


@dataclass(frozen=True, slots=True)
class RobotFloats:
    """The part of one robot."""

    positions: Floats
    velocities: Floats
    commanded: Floats
    odometry: Floats
    truth: Floats
    command: Floats
    wheels: Floats


class StateFrame:
    """One frame of a layout, filled again and again."""

    def __init__(self, layout: Layout) -> None:
        self.layout = layout
        count = sum(map(_size, layout.robots))
        size = POSE_FLOATS * len(layout.frames) + count
        self._data = bytearray(HEADER.size + 4 * size)
        floats = np.frombuffer(self._data, np.dtype('<f4'), offset=HEADER.size)
        floats.fill(np.nan)
        end = POSE_FLOATS * len(layout.frames)
        self.poses: Floats = floats[:end].reshape(-1, POSE_FLOATS)
        """x y z qx qy qz qw of each frame in its parent."""
        self.robots: tuple[RobotFloats, ...] = ()
        for robot in layout.robots:
            begin, end = end, end + _size(robot)
            self.robots += (_parts(floats[begin:end], robot),)

    def encode(self, number: int, time: float) -> bytes:
        """Return the frame as it is now; ``time``: s."""
        HEADER.pack_into(self._data, 0, KIND, 0, self.layout.id, number % _NUMBERS, time)
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
    *parts, wheels = np.split(floats, np.cumsum(lengths))
    return RobotFloats(*parts, wheels.reshape(-1, WHEEL_FLOATS))
