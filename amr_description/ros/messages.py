# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
Stamps, poses, velocities and transforms to and from their ROS messages.

``fill_…`` writes into a message that is there already. Times are in ns.
"""

from typing import TYPE_CHECKING

from amr_description.clock import NANOSECONDS
from amr_description.messages.parts import (
    fill_pose as fill_pose,
    fill_stamp as fill_stamp,
    fill_velocity as fill_velocity,
)
from amr_description.model.frames import Transform, Vector

if TYPE_CHECKING:  # geometry_msgs takes its time to import, and many need stamps only
    from builtin_interfaces.msg import Time
    from geometry_msgs.msg import Pose, Transform as TransformMessage, Vector3


def nanoseconds(stamp: 'Time') -> int:
    """Return a stamp as integer nanoseconds."""
    return stamp.sec * NANOSECONDS + stamp.nanosec


def stamp_fault(stamp: 'Time') -> str:
    """
    Return why the stamp of a message of others is no time; empty: it is one.

    rclpy's ``Time.from_msg()`` raises at a negative one. Look before it is called.
    """
    if stamp.sec >= 0 and stamp.nanosec < NANOSECONDS:
        return ''
    return f'its stamp, {stamp.sec} s and {stamp.nanosec} ns, is no time'


def vector_of(vector: 'Vector3') -> Vector:
    """Read three numbers."""
    return (vector.x, vector.y, vector.z)


def transform_of_message(message: 'TransformMessage') -> Transform:
    """Read a transform, its rotation as it is given."""
    shift, turn = message.translation, message.rotation
    return Transform((shift.x, shift.y, shift.z), (turn.x, turn.y, turn.z, turn.w))


def transform_of(pose: 'Pose') -> Transform:
    """Read a pose as a transform; a quaternion of zeros, the default in YAML, is no rotation."""
    position, orientation = pose.position, pose.orientation
    rotation = (orientation.x, orientation.y, orientation.z, orientation.w)
    return Transform(
        (position.x, position.y, position.z),
        rotation if any(rotation) else (0.0, 0.0, 0.0, 1.0),
    )
