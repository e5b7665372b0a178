# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""Send transforms: ``tf2_ros``' Python interface."""

from collections.abc import Iterable

from geometry_msgs.msg import TransformStamped
from rclpy.node import Node
from rclpy.qos import DurabilityPolicy, QoSProfile
from tf2_msgs.msg import TFMessage


class TransformBroadcaster:
    """
    Sends transforms that change, on ``/tf``.

    :param qos: A profile, or a depth.
    """

    def __init__(self, node: Node, qos: QoSProfile | int = 100) -> None:
        self.pub_tf = node.create_publisher(TFMessage, '/tf', qos)

    def sendTransform(  # noqa: N802 - the name is tf2's
        self, transform: TransformStamped | Iterable[TransformStamped]
    ) -> None:
        """Send one transform, or several."""
        self.pub_tf.publish(TFMessage(transforms=_listed(transform)))


class StaticTransformBroadcaster:
    """
    Sends transforms that do not change, on ``/tf_static``, for those who come later, too.

    They get the last message only. It carries all that was sent through this object, as from
    tf2_ros in C++; from tf2_ros in Python it carries what was sent last, and they never hear of
    the rest.

    :param qos: A profile, or a depth; None: reliable, transient local, depth 1.
    """

    def __init__(self, node: Node, qos: QoSProfile | int | None = None) -> None:
        latched = QoSProfile(depth=1, durability=DurabilityPolicy.TRANSIENT_LOCAL)
        self.pub_tf = node.create_publisher(
            TFMessage, '/tf_static', latched if qos is None else qos
        )
        self._sent: dict[str, TransformStamped] = {}

    def sendTransform(  # noqa: N802
        self, transform: TransformStamped | Iterable[TransformStamped]
    ) -> None:
        """Send one transform, or several; one of the same child replaces the former."""
        self._sent |= {one.child_frame_id: one for one in _listed(transform)}
        self.pub_tf.publish(TFMessage(transforms=list(self._sent.values())))


def _listed(transform: TransformStamped | Iterable[TransformStamped]) -> list[TransformStamped]:
    return [transform] if isinstance(transform, TransformStamped) else list(transform)
