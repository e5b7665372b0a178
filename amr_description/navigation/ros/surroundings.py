# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""What a navigator knows of the world: map, scan, pose and speed, from their topics and TF."""

from dataclasses import dataclass
import math

from geometry_msgs.msg import PoseStamped
from nav_msgs.msg import OccupancyGrid, Odometry
import numpy as np
from rclpy.node import Node
from rclpy.qos import qos_profile_sensor_data, qos_profile_system_default
from rclpy.time import Time
from sensor_msgs.msg import LaserScan

from amr_description.errors import NavigationError, TransformException
from amr_description.maps.pose import Pose
from amr_description.navigation.costmap import Costmap, CostmapSettings
from amr_description.navigation.ros.goals import UNKNOWN_ERROR
from amr_description.navigation.ros.messages import (
    grid_of,
    is_on_map,
    is_place,
    plane_pose,
    pose_of,
)
from amr_description.parameters import group, parameter
from amr_description.ros.messages import nanoseconds, stamp_fault
from amr_description.ros.qos import LATCHED
from amr_description.tf2_ros.buffer import Buffer
from amr_description.tf2_ros.buffer_core import is_unit
from amr_description.tf2_ros.listener import TransformListener

TF_ERROR = 202

_LOG_PERIOD = 5.0
"""s between two warnings of one kind."""


@dataclass(frozen=True)
class SurroundingsSettings:
    """Parameters of frames and topics, by the names of Nav2."""

    global_frame: str = parameter('map', 'Of map, paths and goals', not_empty=True, read_only=True)
    robot_base_frame: str = parameter('base_link', 'Of the robot', not_empty=True, read_only=True)
    odom_topic: str = parameter('odom', 'Its twist is the speed', not_empty=True, read_only=True)
    scan_topic: str = parameter('scan', 'Of the lidar', not_empty=True, read_only=True)
    transform_tolerance: float = parameter(
        0.3, 'A pose older than this stops the robot', unit='s', minimum=0.0
    )
    source_timeout: float = parameter(
        1.0, 'A scan older than this stops the robot; 0: none is needed', unit='s', minimum=0.0
    )
    costmap: CostmapSettings = group('costmap', CostmapSettings)


class Surroundings:
    """Listens; who drives asks."""

    def __init__(
        self, node: Node, settings: SurroundingsSettings, inscribed_radius: float
    ) -> None:
        """``inscribed_radius``: of the robot, m."""
        self._node = node
        self._settings = settings
        self._inscribed_radius = inscribed_radius
        self.buffer = Buffer(node=node)
        self.listener = TransformListener(self.buffer, node)
        self.costmap: Costmap | None = None
        """None before the first map."""
        self.speed = (0.0, 0.0)
        """m/s, rad/s"""
        self._scan: LaserScan | None = None
        self._scan_at = -math.inf
        node.create_subscription(OccupancyGrid, 'map', self._hear_map, LATCHED)
        node.create_subscription(
            Odometry, settings.odom_topic, self._hear_odometry, qos_profile_system_default
        )
        node.create_subscription(
            LaserScan, settings.scan_topic, self._hear_scan, qos_profile_sensor_data
        )

    def configure(self, settings: SurroundingsSettings) -> None:
        """Take other parameters from now on."""
        self._settings = settings
        if self.costmap is not None:
            self.costmap.configure(settings.costmap)

    @property
    def now(self) -> float:
        """Time of the node, s."""
        return float(self._node.get_clock().now().nanoseconds) * 1e-9

    def pose(self) -> Pose:
        """Return where the robot is in the global frame. Raises NavigationError: it is unknown."""
        base = self._settings.robot_base_frame
        return self._look_up(base, f'where {base} is')

    def fault(self) -> str:
        """Return why the robot should not move now; empty if it may."""
        if self.costmap is None:
            return f'no map on {self._node.resolve_topic_name("map")} yet'
        settings = self._settings
        try:
            found = self.buffer.lookup_transform(
                settings.global_frame, settings.robot_base_frame, Time()
            )
        except TransformException as error:
            return f'the pose of the robot is unknown: {error}'
        if not is_on_map(pose := plane_pose(found)):
            return f'the pose of the robot is ({pose.x}, {pose.y}): no place'
        age = self.now - nanoseconds(found.header.stamp) * 1e-9
        if age > settings.transform_tolerance:
            return (
                f'{settings.global_frame} -> {settings.robot_base_frame} is {age:.1f} s old: '
                'localisation, or the odometry of the robot, has ceased'
            )
        age = self.now - self._scan_at
        if settings.source_timeout > 0.0 and age > settings.source_timeout:
            topic = self._node.resolve_topic_name(settings.scan_topic)
            return (
                f'no scan on {topic} yet'
                if math.isinf(age)
                else f'the last scan on {topic} is {age:.1f} s old'
            )
        return ''

    def goal(self, message: PoseStamped) -> Pose:
        """Return a goal in the global frame. Raises NavigationError: it cannot be one."""
        frame = message.header.frame_id
        position, turn = message.pose.position, message.pose.orientation
        if not is_place(message.pose):
            raise NavigationError(
                UNKNOWN_ERROR, f'the goal is at ({position.x}, {position.y}): no place'
            )
        if not is_unit((turn.x, turn.y, turn.z, turn.w)):
            raise NavigationError(
                UNKNOWN_ERROR,
                f'the orientation of the goal is ({turn.x} {turn.y} {turn.z} {turn.w}), which is '
                'no unit quaternion; straight ahead is (0 0 0 1)',
            )
        if frame == self._settings.global_frame:
            return pose_of(message.pose)
        if not frame:
            raise NavigationError(
                TF_ERROR,
                f'the goal has no frame_id: write header.frame_id {self._settings.global_frame}',
            )
        goal = self._look_up(frame, 'the goal').compose(pose_of(message.pose))
        if not is_on_map(goal):
            raise NavigationError(
                TF_ERROR,
                f'the goal, which is in {frame}, is at ({goal.x}, {goal.y}) in '
                f'{self._settings.global_frame}: no place',
            )
        return goal

    def _look_up(self, frame: str, what: str) -> Pose:
        try:
            found = self.buffer.lookup_transform(self._settings.global_frame, frame, Time())
        except TransformException as error:
            raise NavigationError(
                TF_ERROR, f'{what} is not known in {self._settings.global_frame}: {error}'
            ) from None
        pose = plane_pose(found)
        if not is_on_map(pose):
            raise NavigationError(
                TF_ERROR,
                f'{what} is ({pose.x}, {pose.y}) in {self._settings.global_frame}: no place',
            )
        return pose

    def _hear_map(self, message: OccupancyGrid) -> None:
        try:
            grid = grid_of(message)
        except ValueError as error:
            self._node.get_logger().error(f'the map cannot be used: it is of {error}')
            return
        try:
            self.costmap = Costmap(grid, self._inscribed_radius, self._settings.costmap)
        except ValueError as error:
            self._node.get_logger().error(f'the map cannot be used: {error}')

    def _hear_odometry(self, message: Odometry) -> None:
        twist = message.twist.twist
        self.speed = (twist.linear.x, twist.angular.z)

    def _hear_scan(self, message: LaserScan) -> None:
        if fault := stamp_fault(message.header.stamp):
            self._node.get_logger().warning(
                f'a scan is left out: {fault}', throttle_duration_sec=_LOG_PERIOD
            )
            return
        self._scan_at = nanoseconds(message.header.stamp) * 1e-9
        self._scan = message

    def take_scan(self) -> None:
        """Put the latest scan into the costmap, once the transform at its stamp is known."""
        if self._scan is None or self.costmap is None:
            return
        message, stamp = self._scan, Time.from_msg(self._scan.header.stamp)
        try:
            found = self.buffer.lookup_transform(
                self._settings.global_frame, message.header.frame_id, stamp
            )
        except TransformException:
            return  # it is tried again at the next step; a scan that gets too old is a fault
        self._scan = None
        ranges = np.array(message.ranges, dtype=float)
        ranges[(ranges < message.range_min) | (ranges > message.range_max)] = np.nan
        ranges[np.isposinf(np.array(message.ranges))] = np.inf
        angles = message.angle_min + message.angle_increment * np.arange(len(ranges))
        self.costmap.see(plane_pose(found), angles, ranges)
