# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
A robot with a map, a path and somebody who hears goals: topics alone, as Nav2 has them.

Its frames: ``earth`` → ``map`` → ``odom`` → ``base_footprint``; the map lies turned in ``earth``,
so that one who takes the one for the other is found out.
"""

from math import pi
import threading

from fixtures.sim.driving import AMR
from geometry_msgs.msg import PoseStamped, PoseWithCovarianceStamped, TransformStamped
from nav2_msgs.action import NavigateToPose
from nav_msgs.msg import OccupancyGrid, Path
import numpy as np
from rclpy.action import ActionServer, CancelResponse, GoalResponse
from rclpy.callback_groups import ReentrantCallbackGroup
from rclpy.context import Context
from rclpy.executors import MultiThreadedExecutor
from rclpy.node import Node
from rclpy.qos import DurabilityPolicy, QoSProfile
from std_msgs.msg import String
from support.running_programs import PATIENCE
from support.serving import serving
from support.waiting import until
from tf2_msgs.msg import TFMessage

from amr_description.model.frames import Transform
from amr_description.ros.messages import fill_pose

LATCHED = QoSProfile(depth=1, durability=DurabilityPolicy.TRANSIENT_LOCAL)
STATIC = QoSProfile(depth=10, durability=DurabilityPolicy.TRANSIENT_LOCAL)
IN_EARTH = (10.0, -4.0, pi / 2)
"""Where the map is: x, y (m), yaw."""
IN_MAP = (1.0, 2.0, pi / 2)
"""Where the robot is."""
SIZE = (8.0, 6.0)
"""m"""
RESOLUTION = 0.05
"""m"""
PERIOD = 0.05
"""s between two transforms of the odometry."""


class NavigatedRobot(Node):
    """The robot; ``goals`` and ``poses`` are the messages that it has heard."""

    def __init__(self, context):
        super().__init__('navigator', context=context)
        self.goals, self.poses = [], []
        self._static = self.create_publisher(TFMessage, '/tf_static', STATIC)
        self._description = self.create_publisher(String, '/robot_description', LATCHED)
        self.map = self.create_publisher(OccupancyGrid, '/map', LATCHED)
        self.plan = self.create_publisher(Path, '/plan', LATCHED)
        self._static.publish(
            TFMessage(
                transforms=[
                    transform('earth', 'map', IN_EARTH),
                    transform('map', 'odom', (0.5, 0.0, 0.0)),
                ]
            )
        )
        self._moving = self.create_publisher(TFMessage, '/tf', 10)
        self.create_timer(PERIOD, self._tell)
        self._description.publish(String(data=AMR))
        self.map.publish(grid())
        self.plan.publish(path([(IN_MAP[0], y) for y in np.arange(2.0, 5.0, 0.05)]))
        self.hear()

    def hear(self):
        """Hear goals and poses."""
        self._ends = [
            self.create_subscription(PoseStamped, '/goal_pose', self.goals.append, 10),
            self.create_subscription(
                PoseWithCovarianceStamped, '/initialpose', self.poses.append, 10
            ),
        ]

    def _tell(self):
        here = transform('odom', 'base_footprint', (IN_MAP[0] - 0.5, *IN_MAP[1:]))
        here.header.stamp = self.get_clock().now().to_msg()
        self._moving.publish(TFMessage(transforms=[here]))

    def go_deaf(self):
        """Hear goals and poses no more."""
        for each in self._ends:
            self.destroy_subscription(each)


class NavigationServer:
    """A navigator that drives nowhere until it is told how that ends."""

    def __init__(self, node, action):
        self.goals = []
        self.accepts = self.cancels = True
        self.ends = threading.Event()
        self.outcome = 'succeed'
        self._is_heard = lambda: node.count_subscribers(f'{action}/_action/feedback')
        self._action = ActionServer(
            node,
            NavigateToPose,
            action,
            execute_callback=self._execute,
            goal_callback=lambda _: GoalResponse.ACCEPT if self.accepts else GoalResponse.REJECT,
            cancel_callback=lambda _: (
                CancelResponse.ACCEPT if self.cancels else CancelResponse.REJECT
            ),
            callback_group=ReentrantCallbackGroup(),
        )

    def _execute(self, handle):
        self.goals.append(handle)
        feedback = NavigateToPose.Feedback(distance_remaining=3.24, number_of_recoveries=2)
        feedback.estimated_time_remaining.sec = 8
        until(self._is_heard)  # the goal may come before the node knows who hears its feedback
        handle.publish_feedback(feedback)
        assert self.ends.wait(PATIENCE)
        self.ends.clear()
        result = NavigateToPose.Result()
        if handle.is_cancel_requested:
            handle.canceled()
        elif self.outcome == 'succeed':
            handle.succeed()
        else:
            result.error_code = 9000
            handle.abort()
        return result

    def destroy(self):
        action, self._action = self._action, None
        if action is not None:
            action.destroy()


class Navigating:
    """A context manager: the robot, served by a thread of its own."""

    def __enter__(self):
        self._context = Context()
        self._context.init([])
        self.robot = NavigatedRobot(self._context)
        executor = MultiThreadedExecutor(3, context=self._context)
        executor.add_node(self.robot)
        self._service = serving(executor)
        self._service.__enter__()
        return self.robot

    def __exit__(self, *_):
        self._service.__exit__(None, None, None)
        self.robot.destroy_node()
        self._context.try_shutdown()


def transform(parent, child, place):
    """Return a transform in the plane: m, m, rad."""
    x, y, yaw = place
    message = TransformStamped()
    message.header.frame_id, message.child_frame_id = parent, child
    message.transform.translation.x, message.transform.translation.y = x, y
    (
        message.transform.rotation.x,
        message.transform.rotation.y,
        message.transform.rotation.z,
        message.transform.rotation.w,
    ) = Transform.from_xyz_rpy((0.0, 0.0, 0.0), (0.0, 0.0, yaw)).rotation
    return message


def cells():
    """Return a room with walls, a shelf, and what lies beyond the walls not known; int8."""
    rows, columns = round(SIZE[1] / RESOLUTION), round(SIZE[0] / RESOLUTION)
    found = np.zeros((rows, columns), np.int8)
    found[:10, :] = found[-10:, :] = -1
    found[:, :10] = found[:, -10:] = -1
    found[10:12, 10:-10] = found[-12:-10, 10:-10] = 100
    found[10:-10, 10:12] = found[10:-10, -12:-10] = 100
    found[60:66, 80:130] = 100
    return found


def grid():
    """Return the map as a message; its first cell is 2 m behind and to the right of the origin."""
    message = OccupancyGrid()
    message.header.frame_id = 'map'
    found = cells()
    message.info.height, message.info.width = found.shape
    message.info.resolution = RESOLUTION
    fill_pose(Transform.from_xyz_rpy((-2.0, 0.0, 0.0), (0.0, 0.0, 0.0)), message.info.origin)
    message.data.frombytes(found.tobytes())
    return message


def path(points):
    """Return a path through points of the map, m."""
    message = Path()
    message.header.frame_id = 'map'
    for x, y in points:
        pose = PoseStamped()
        pose.header.frame_id = 'map'
        pose.pose.position.x, pose.pose.position.y = float(x), float(y)
        message.poses.append(pose)
    return message
