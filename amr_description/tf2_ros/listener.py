# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
``TransformListener``: puts what ``/tf`` and ``/tf_static`` publish into a buffer.

========== =============== =================================================
topic      type            QoS
========== =============== =================================================
/tf        TFMessage       reliable, volatile, depth 100
/tf_static TFMessage       reliable, transient local, depth 100
========== =============== =================================================

A :class:`~amr_description.tf2_ros.buffer.Buffer` gets transforms from the serialized bytes, which
takes less than half the time: a message of rclpy is a Python object for every vector. A buffer or
a listener with methods of its own gets messages.
"""

from collections.abc import Callable
from contextlib import suppress
import threading

from rclpy.callback_groups import ReentrantCallbackGroup
from rclpy.executors import SingleThreadedExecutor
from rclpy.node import Node
from rclpy.parameter import Parameter
from rclpy.qos import QoSProfile
from rclpy.serialization import deserialize_message
from tf2_msgs.msg import TFMessage

from amr_description.model.frames import Transform
from amr_description.ros.endpoints import endpoint_node
from amr_description.ros.qos import TF_STATIC
from amr_description.ros.readers import TRANSFORMS
from amr_description.ros.runtime import spin
from amr_description.tf2_ros.buffer import Buffer
from amr_description.tf2_ros.buffer_core import DEFAULT_AUTHORITY
from amr_description.tf2_ros.time_cache import StampedTransform

DEFAULT_TF_TOPIC = '/tf'
DEFAULT_STATIC_TF_TOPIC = '/tf_static'


class TransformListener:
    """
    Subscribes from construction to :meth:`unregister`.

    Args:
        buffer: gets the transforms: a :class:`Buffer`, or an object with its ``set_transform`` and
            ``set_transform_static``.
        node: subscribes, and must be spun; None: a node of its own, which needs ``spin_thread``.
        spin_thread: spin the node in a thread, as is needed where a callback of the node waits
            for a transform.
        qos: a profile or a depth for ``tf_topic``.
        static_qos: the same for ``tf_static_topic``.
        tf_topic: the topic of moving transforms.
        tf_static_topic: the topic of static transforms.
        static_only: do not subscribe to ``tf_topic``.
    """

    def __init__(
        self,
        buffer: Buffer,
        node: Node | None,
        *,
        spin_thread: bool = False,
        qos: QoSProfile | int | None = None,
        static_qos: QoSProfile | int | None = None,
        tf_topic: str = DEFAULT_TF_TOPIC,
        tf_static_topic: str = DEFAULT_STATIC_TF_TOPIC,
        static_only: bool = False,
    ) -> None:
        self.buffer = buffer
        self.node = node or _own_node(id(self))
        self._topics = [tf_static_topic] if static_only else [tf_topic, tf_static_topic]
        # A callback that waits for a transform must not keep it from being received.
        group = ReentrantCallbackGroup()
        is_raw = self._takes_bytes()
        self._subscriptions = [
            self.node.create_subscription(
                TFMessage,
                tf_static_topic,
                self._take_static if is_raw else self.static_callback,
                TF_STATIC if static_qos is None else static_qos,
                callback_group=group,
                raw=is_raw,
            )
        ]
        if not static_only:
            self._subscriptions.append(
                self.node.create_subscription(
                    TFMessage,
                    tf_topic,
                    self._take if is_raw else self.callback,
                    100 if qos is None else qos,
                    callback_group=group,
                    raw=is_raw,
                )
            )
        if isinstance(buffer, Buffer):
            buffer.publishers = self.publishers
        self._stopped = threading.Event()
        self._executor: SingleThreadedExecutor | None = None
        if spin_thread:
            self._executor = SingleThreadedExecutor(context=self.node.context)
            self._thread = threading.Thread(
                target=self._spin, args=(self._executor,), name='transforms', daemon=True
            )
            self._thread.start()

    def callback(self, data: TFMessage) -> None:
        """Put the moving transforms of a message into the buffer."""
        for transform in data.transforms:
            self.buffer.set_transform(transform, DEFAULT_AUTHORITY)

    def static_callback(self, data: TFMessage) -> None:
        """Put the static transforms of a message into the buffer."""
        for transform in data.transforms:
            self.buffer.set_transform_static(transform, DEFAULT_AUTHORITY)

    def _takes_bytes(self) -> bool:
        """Return whether nobody would notice that no message is made."""
        buffer, listener = type(self.buffer), type(self)
        return (
            isinstance(self.buffer, Buffer)
            and buffer.set_transform is Buffer.set_transform
            and buffer.set_transform_static is Buffer.set_transform_static
            and listener.callback is TransformListener.callback
            and listener.static_callback is TransformListener.static_callback
        )

    def _take(self, data: bytes) -> None:
        self._insert(data, self.callback, is_static=False)

    def _take_static(self, data: bytes) -> None:
        self._insert(data, self.static_callback, is_static=True)

    def _insert(
        self, data: bytes, callback: Callable[[TFMessage], None], *, is_static: bool
    ) -> None:
        try:
            frames = TRANSFORMS.read(data)
        except ValueError:  # not plain CDR, or a name that is no UTF-8
            with suppress(RuntimeError):  # nor a message at all: rclpy drops such, too
                callback(deserialize_message(data, TFMessage))
            return
        for frame in frames:
            x, y, z, qx, qy, qz, qw = frame.pose
            transform = Transform((x, y, z), (qx, qy, qz, qw))
            stamped = StampedTransform(frame.parent, frame.name, frame.stamp, transform)
            self.buffer.insert(stamped, DEFAULT_AUTHORITY, static=is_static)

    def publishers(self) -> dict[str, list[str]]:
        """Return the nodes that publish on each of the topics."""
        return {topic: publishers_of(self.node, topic) for topic in self._topics}

    def unregister(self) -> None:
        """Stop listening."""
        self._stopped.set()
        if self._executor is not None:
            self._executor.wake()
            self._thread.join()
            self._executor = None
        for subscription in self._subscriptions:
            self.node.destroy_subscription(subscription)
        self._subscriptions = []

    def _spin(self, executor: SingleThreadedExecutor) -> None:
        executor.add_node(self.node)
        try:
            spin(executor, self._stopped.is_set)
        finally:
            executor.remove_node(self.node)
            executor.shutdown()


def publishers_of(node: Node, topic: str) -> list[str]:
    """Return the full names of the nodes that publish on a topic, sorted, as far as known yet."""
    return sorted(
        {
            name
            for endpoint in node.get_publishers_info_by_topic(topic)
            if (name := endpoint_node(endpoint)) is not None
        }
    )


def _own_node(number: int) -> Node:
    return Node(
        f'transform_listener_impl_{number:010x}',
        enable_rosout=False,
        start_parameter_services=False,
        parameter_overrides=[Parameter('use_sim_time', value=False)],
    )
