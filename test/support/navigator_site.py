# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""A navigator in this process, an empty room, a point that drives in it, and its operator."""

from contextlib import contextmanager

from geometry_msgs.msg import Twist
from nav2_msgs import action as actions
from nav_msgs.msg import OccupancyGrid, Odometry
import numpy as np
import rclpy
from rclpy.action import ActionClient
from rclpy.node import Node
from support.running_programs import PATIENCE

from amr_description.maps.grid import OccupancyGrid as Grid
from amr_description.maps.pose import Pose
from amr_description.model.frames import quaternion_from_yaw, Transform
from amr_description.nodes.navigator import NavigatorNode
from amr_description.ros.qos import LATCHED
from amr_description.ros.runtime import spinning
from amr_description.ros.service_calls import wait_until
from amr_description.tf2_ros.broadcaster import TransformBroadcaster
from amr_description.tf2_ros.buffer import transform_message
from amr_description.tf2_ros.time_cache import StampedTransform

ROOM = Grid(np.zeros((120, 120), dtype=np.int8), 0.05, Pose(-3.0, -3.0, 0.0))
PERIOD = 0.02


class Site(Node):
    """A robot that is where its commands have taken it, and its operator."""

    def __init__(self):
        super().__init__('site')
        self.pose, self.command = Pose(0.0, 0.0, 0.0), Twist()
        self.maps = self.create_publisher(OccupancyGrid, 'map', LATCHED)
        self.odometry = self.create_publisher(Odometry, 'odom', 10)
        self.transforms = TransformBroadcaster(self)
        self.create_subscription(Twist, 'cmd_vel', self._take, 10)
        self.create_timer(PERIOD, self._move)

    def _take(self, command):
        self.command = command

    def _move(self):
        step = Pose(self.command.linear.x * PERIOD, 0.0, self.command.angular.z * PERIOD)
        self.pose = self.pose.compose(step)
        stamp = self.get_clock().now().nanoseconds
        place = Transform((self.pose.x, self.pose.y, 0.0), quaternion_from_yaw(self.pose.yaw))
        self.transforms.sendTransform(
            transform_message(StampedTransform('map', 'base_link', stamp, place))
        )
        message = Odometry()
        message.twist.twist = self.command
        self.odometry.publish(message)

    def until(self, condition):
        assert wait_until(self, lambda: condition() or None, every=0.05, timeout=PATIENCE)

    def ask(self, kind, name, **fields):
        """Ask a service; return its response."""
        client = self.create_client(kind, name)
        self.until(client.service_is_ready)
        future = client.call_async(kind.Request(**fields))
        self.until(future.done)
        return future.result()

    def goal(self, name, feedback=None, **fields):
        """Have a goal done; return its status and result, or None where it is refused."""
        kind, path = KINDS[name], name
        client = ActionClient(self, kind, path)
        self.until(client.server_is_ready)
        sent = client.send_goal_async(
            kind.Goal(**fields),
            feedback_callback=None if feedback is None else lambda m: feedback.append(m.feedback),
        )
        self.until(sent.done)
        handle = sent.result()
        if not handle.accepted:
            return None
        future = handle.get_result_async()
        self.until(future.done)
        client.destroy()
        return future.result().status, future.result().result


KINDS = {
    'follow_waypoints': actions.FollowWaypoints,
    'compute_path_to_pose': actions.ComputePathToPose,
    'compute_path_through_poses': actions.ComputePathThroughPoses,
    'smooth_path': actions.SmoothPath,
    'spin': actions.Spin,
    'backup': actions.BackUp,
    'drive_on_heading': actions.DriveOnHeading,
    'wait': actions.Wait,
    'assisted_teleop': actions.AssistedTeleop,
    'follow_gps_waypoints': actions.FollowGPSWaypoints,
    'dock_robot': actions.DockRobot,
    'undock_robot': actions.UndockRobot,
}


@contextmanager
def site_with_a_navigator(**parameters):
    """A :class:`Site` whose navigator has no map yet."""
    given = {'source_timeout': '0.0', 'transform_tolerance': '5.0', **parameters}
    words = [word for name, value in given.items() for word in ('-p', f'{name}:={value}')]
    rclpy.init(args=['--ros-args', *words])
    try:
        navigator = NavigatorNode()
        with spinning(navigator):  # which destroys it, too
            site = Site()
            try:
                yield site
            finally:
                site.destroy_node()
    finally:
        rclpy.shutdown()
