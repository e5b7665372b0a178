# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
What a localizer says and hears, with the topics and QoS of amcl.

===============  =========================  ====================================================
topic            type                       QoS
===============  =========================  ====================================================
``/tf``          TFMessage                  reliable, depth 100: map → odom
``amcl_pose``    PoseWithCovarianceStamped  reliable, transient local, depth 1
``initialpose``  PoseWithCovarianceStamped  subscribed: reliable, depth 10
===============  =========================  ====================================================
"""

from collections.abc import Callable, Iterable

from geometry_msgs.msg import PoseWithCovarianceStamped
import numpy as np
from numpy.typing import NDArray
from rclpy.clock import Clock, ClockType
from rclpy.node import Node

from amr_description.clock import NANOSECONDS
from amr_description.maps.pose import Pose
from amr_description.model.frames import quaternion_from_yaw, Transform
from amr_description.navigation.ros.managed_names import ManagedNames
from amr_description.navigation.ros.messages import is_place, pose_message
from amr_description.ros.messages import fill_stamp
from amr_description.ros.qos import LATCHED
from amr_description.tf2_ros.broadcaster import TransformBroadcaster
from amr_description.tf2_ros.buffer import transform_message
from amr_description.tf2_ros.time_cache import StampedTransform

_AXES = (0, 1, 5)
"""x, y and yaw among the six axes of a covariance."""


class LocalizerTopics:
    """The publishers of a localizer, and its subscription to initial poses."""

    def __init__(
        self,
        node: Node,
        map_frame: str,
        *,
        tolerance: float,
        broadcasts: bool,
        on_initial_pose: Callable[[PoseWithCovarianceStamped], object],
    ) -> None:
        """
        Make them.

        Args:
            node: Has them.
            map_frame: The frame of the poses.
            tolerance: A transform is stamped so many s later than the pose that it follows from,
                until when it is taken as valid.
            broadcasts: Whether map → odom is published.
            on_initial_pose: Called with each initial pose in the frame of the map.
        """
        self._logger = node.get_logger()
        self._map_frame = map_frame
        self._tolerance = round(tolerance * NANOSECONDS)
        self._broadcasts = broadcasts
        self._broadcaster = TransformBroadcaster(node)
        self._pose = node.create_publisher(PoseWithCovarianceStamped, 'amcl_pose', LATCHED)
        self._names = ManagedNames(node, ['amcl'], lambda: True)
        self._on_initial_pose = on_initial_pose
        node.create_subscription(PoseWithCovarianceStamped, 'initialpose', self._hear, 10)
        self._latest = -1

    def send_transform(self, stamp: int, map_to_odom: Pose, odom_frame: str) -> None:
        """
        Publish map → odom, unless it is that of the instant before: tf2 warns of such.

        Args:
            stamp: Of the pose that it follows from, ns.
            map_to_odom: Pose of the frame of odometry in that of the map.
            odom_frame: Its name.
        """
        if not self._broadcasts or stamp == self._latest:
            return
        self._latest = stamp
        self._broadcaster.sendTransform(
            transform_message(
                StampedTransform(
                    self._map_frame,
                    odom_frame,
                    stamp + self._tolerance,
                    Transform(
                        (map_to_odom.x, map_to_odom.y, 0.0), quaternion_from_yaw(map_to_odom.yaw)
                    ),
                )
            )
        )

    def send_pose(self, stamp: int, pose: Pose, covariance: NDArray[np.float64]) -> None:
        """
        Publish the pose of the robot.

        Args:
            stamp: ns.
            pose: In the frame of the map.
            covariance: (3, 3), of x, y and yaw, m² and rad².
        """
        message = PoseWithCovarianceStamped()
        message.header.frame_id = self._map_frame
        fill_stamp(stamp, message.header.stamp)
        message.pose.pose = pose_message(pose)
        whole = np.zeros((6, 6))
        whole[np.ix_(_AXES, _AXES)] = covariance
        message.pose.covariance = whole.ravel()
        self._pose.publish(message)

    def _hear(self, message: PoseWithCovarianceStamped) -> None:
        frame = message.header.frame_id.removeprefix('/')
        if not frame:
            self._logger.warning(
                'Received initial pose with empty frame_id. You should always supply a frame_id: '
                f'"{self._map_frame}"'
            )
        elif frame != self._map_frame:
            self._logger.warning(
                f'Ignoring initial pose in frame "{frame}"; initial poses must be in the global '
                f'frame, "{self._map_frame}"'
            )
        elif not _is_finite(message):
            self._logger.warning(
                'Ignoring initial pose: its position or orientation is not a finite number'
            )
        elif not is_place(message.pose.pose):
            place = message.pose.pose.position
            self._logger.warning(
                f'Ignoring initial pose: it is at ({place.x:g}, {place.y:g}), which is no place'
            )
        else:
            self._on_initial_pose(message)


def plane_covariance(message: PoseWithCovarianceStamped) -> NDArray[np.float64]:
    """Return the covariance of x, y and yaw, (3, 3), of a pose."""
    whole = np.asarray(message.pose.covariance, dtype=np.float64).reshape(6, 6)
    return whole[np.ix_(_AXES, _AXES)]


def after(node: Node, seconds: float, call: Callable[[], None]) -> None:
    """Call something once, after so many s of the wall clock."""

    def once() -> None:
        timer.cancel()
        call()

    timer = node.create_timer(seconds, once, clock=Clock(clock_type=ClockType.STEADY_TIME))


def listed(names: Iterable[str]) -> str:
    """Return names for a line of the log; ``none`` if there is none."""
    return ', '.join(sorted(names)) or 'none'


def _is_finite(message: PoseWithCovarianceStamped) -> bool:
    position, turn = message.pose.pose.position, message.pose.pose.orientation
    values = (position.x, position.y, position.z, turn.x, turn.y, turn.z, turn.w)
    return bool(np.isfinite((*values, *message.pose.covariance)).all())
