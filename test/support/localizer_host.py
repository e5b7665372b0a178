# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""A localizer in this process, over real DDS, and a node that is robot, simulator and user."""

from collections.abc import Callable, Iterator
from contextlib import contextmanager
from typing import Any

from geometry_msgs.msg import PoseWithCovarianceStamped, TransformStamped
from nav_msgs.msg import Odometry
from rcl_interfaces.msg import Log
import rclpy
from rclpy.node import Node
from support.running_programs import PATIENCE
from tf2_msgs.msg import TFMessage

from amr_description.maps.pose import Pose
from amr_description.model.frames import quaternion_from_yaw, Transform
from amr_description.navigation.ros.messages import plane_pose, pose_message, pose_of
from amr_description.ros.messages import fill_stamp, nanoseconds
from amr_description.ros.qos import LATCHED
from amr_description.ros.runtime import spinning
from amr_description.ros.service_calls import wait_until
from amr_description.tf2_ros.broadcaster import StaticTransformBroadcaster, TransformBroadcaster
from amr_description.tf2_ros.buffer import transform_message
from amr_description.tf2_ros.time_cache import StampedTransform

MS = 1_000_000


class Host:
    """The node beside the localizer: what it publishes, and what it has heard."""

    def __init__(self, namespace: str, map_frame: str) -> None:
        self.node = node = Node('host', namespace=namespace)
        self.map_frame = map_frame
        self.transforms: list[TransformStamped] = []
        """map → odom, as they came."""
        self.poses: list[PoseWithCovarianceStamped] = []
        self.log: list[str] = []
        """Warnings and errors."""
        self._dynamic = TransformBroadcaster(node)
        self._static = StaticTransformBroadcaster(node)
        self.truth = node.create_publisher(Odometry, 'ground_truth/odom', 10)
        self._initial_pose = node.create_publisher(PoseWithCovarianceStamped, 'initialpose', 10)
        node.create_subscription(TFMessage, '/tf', self._hear, 100)
        node.create_subscription(
            PoseWithCovarianceStamped, 'amcl_pose', self.poses.append, LATCHED
        )
        node.create_subscription(Log, '/rosout', self._note, 1000)

    def wait(
        self, condition: Callable[[], object], on_wait: Callable[[], object] = lambda: None
    ) -> None:
        """Spin until a condition holds; ``on_wait`` is called every 0.3 s meanwhile."""
        assert wait_until(
            self.node, lambda: condition() or None, on_wait, every=0.3, timeout=PATIENCE
        ), self.log

    def wait_for_subscribers(self, *publishers: Any) -> None:
        """Wait until the localizer is connected to all that is published here."""
        known = [self._initial_pose, *publishers]
        self.wait(lambda: all(each.get_subscription_count() for each in known))
        # Beside that of this node.
        self.wait(lambda: self._dynamic.pub_tf.get_subscription_count() == 2)

    def send_odometry(
        self, stamp: int, pose: Pose, odom: str = 'odom', base: str = 'base_footprint'
    ) -> None:
        self._dynamic.sendTransform(transform(odom, base, stamp, pose))

    def send_static(self, parent: str, child: str, place: Transform) -> None:
        self._static.sendTransform(transform_message(StampedTransform(parent, child, 0, place)))

    def send_truth(self, stamp: int, pose: Pose, frame: str = 'base_footprint') -> None:
        message = Odometry(child_frame_id=frame)
        message.header.frame_id = 'world'
        fill_stamp(stamp, message.header.stamp)
        message.pose.pose = pose_message(pose)
        message.pose.pose.position.z = 0.25
        self.truth.publish(message)

    def send_initial_pose(
        self,
        pose: Pose,
        frame: str = 'map',
        variances: tuple[float, float, float] = (0, 0, 0),
        stamp: int = 0,
    ) -> None:
        message = PoseWithCovarianceStamped()
        fill_stamp(stamp, message.header.stamp)
        message.header.frame_id = frame
        message.pose.pose = pose_message(pose)
        for axis, variance in zip((0, 7, 35), variances, strict=True):
            message.pose.covariance[axis] = float(variance)
        self._initial_pose.publish(message)

    def map_to_odom(self, stamp: int) -> Pose:
        """Wait for the transform with a stamp."""
        found: list[TransformStamped] = []

        def is_there() -> bool:
            found[:] = [t for t in self.transforms if nanoseconds(t.header.stamp) == stamp]
            return bool(found)

        self.wait(is_there)
        return plane_pose(found[-1])

    def pose(self, stamp: int) -> Pose:
        """Wait for the pose with a stamp."""
        found: list[PoseWithCovarianceStamped] = []

        def is_there() -> bool:
            found[:] = [p for p in self.poses if nanoseconds(p.header.stamp) == stamp]
            return bool(found)

        self.wait(is_there)
        return pose_of(found[-1].pose.pose)

    def line(self, text: str) -> str:
        """Wait for a line of the log."""
        self.wait(lambda: any(text in line for line in self.log))
        return next(line for line in self.log if text in line)

    def _hear(self, message: TFMessage) -> None:
        self.transforms += [
            each for each in message.transforms if each.header.frame_id == self.map_frame
        ]

    def _note(self, message: Log) -> None:
        if message.level >= 20:  # Log.INFO, which is bytes in some releases
            self.log.append(message.msg)


@contextmanager
def hosted(
    make_node: Callable[[], Node],
    *arguments: str,
    namespace: str = '',
    map_frame: str = 'map',
    hears_truth: bool = True,
) -> Iterator[Host]:
    """
    Run a localizer beside a host.

    Args:
        make_node: Makes it.
        arguments: After ``--ros-args``.
        namespace: Of the host.
        map_frame: Whose transforms are noted.
        hears_truth: Whether it subscribes to the ground truth.
    """
    rclpy.init(args=['--ros-args', *arguments] if arguments else [])
    try:
        host = Host(namespace, map_frame)
        try:
            with spinning(make_node()):
                host.wait_for_subscribers(*([host.truth] if hears_truth else []))
                yield host
        finally:
            host.node.destroy_node()
    finally:
        rclpy.try_shutdown()


def transform(parent: str, child: str, stamp: int, pose: Pose) -> TransformStamped:
    turn = quaternion_from_yaw(pose.yaw)
    return transform_message(
        StampedTransform(parent, child, stamp, Transform((pose.x, pose.y, 0.0), turn))
    )
