# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""Transforms ↔ ROS messages."""

from builtin_interfaces.msg import Time as TimeMessage
from geometry_msgs.msg import TransformStamped
from rclpy.time import Time

from amr_description.model.frames import Transform
from amr_description.model.transform_cache import SECOND
from amr_description.model.transform_input import StampedTransform


def stamped_transform(message: TransformStamped) -> StampedTransform:
    """Read a message; ``frame_id`` is the parent."""
    place, turn = message.transform.translation, message.transform.rotation
    return StampedTransform(
        message.header.frame_id,
        message.child_frame_id,
        nanoseconds(message.header.stamp),
        Transform((place.x, place.y, place.z), (turn.x, turn.y, turn.z, turn.w)),
    )


def transform_message(stamped: StampedTransform) -> TransformStamped:
    """Make a message."""
    message = TransformStamped()
    stamp = message.header.stamp
    stamp.sec, stamp.nanosec = divmod(stamped.time, SECOND)
    message.header.frame_id = stamped.parent
    message.child_frame_id = stamped.child
    place, turn = message.transform.translation, message.transform.rotation
    place.x, place.y, place.z = stamped.transform.translation
    turn.x, turn.y, turn.z, turn.w = stamped.transform.rotation
    return message


def nanoseconds(time: Time | TimeMessage) -> int:
    """Return a time of rclpy, or a stamp, in ns."""
    return time.nanoseconds if isinstance(time, Time) else time.sec * SECOND + time.nanosec
