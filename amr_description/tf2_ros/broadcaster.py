# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""Publishers of transforms, with the interface of ``tf2_ros``."""

from collections.abc import Iterable

from geometry_msgs.msg import TransformStamped
from rclpy.node import Node
from rclpy.qos import QoSProfile
from tf2_msgs.msg import TFMessage

from amr_description.ros.qos import LATCHED


class TransformBroadcaster:
    """
    Publishes transforms that change, on ``/tf``.

    Args:
        node: whose publisher it is.
        qos: a profile, or a depth.
    """

    def __init__(self, node: Node, qos: QoSProfile | int = 100) -> None:
        self.pub_tf = node.create_publisher(TFMessage, '/tf', qos)

    def sendTransform(  # noqa: N802 - the name is tf2's
        self, transform: TransformStamped | Iterable[TransformStamped]
    ) -> None:
        """Publish one transform, or several."""
        self.pub_tf.publish(TFMessage(transforms=_as_list(transform)))


class StaticTransformBroadcaster:
    """
    Publishes transforms that do not change, on ``/tf_static``, also to later subscribers.

    Later subscribers get the last message only. It holds all transforms that this object has
    sent, as in the C++ tf2_ros; in the Python tf2_ros it holds those of the last call, and the
    others are lost to them.

    Args:
        node: whose publisher it is.
        qos: a profile, or a depth; None: reliable, transient local, depth 1.
    """

    def __init__(self, node: Node, qos: QoSProfile | int | None = None) -> None:
        self.pub_tf = node.create_publisher(
            TFMessage, '/tf_static', LATCHED if qos is None else qos
        )
        self._sent: dict[str, TransformStamped] = {}

    def sendTransform(  # noqa: N802
        self, transform: TransformStamped | Iterable[TransformStamped]
    ) -> None:
        """Publish one transform, or several; each replaces the former one of its child."""
        self._sent |= {one.child_frame_id: one for one in _as_list(transform)}
        self.pub_tf.publish(TFMessage(transforms=list(self._sent.values())))


def _as_list(transform: TransformStamped | Iterable[TransformStamped]) -> list[TransformStamped]:
    return [transform] if isinstance(transform, TransformStamped) else list(transform)
