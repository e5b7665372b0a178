# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
``navigator``: drive to goals around what map and scan show, where Nav2 itself is not there.

::

    ros2 run amr_description navigator --ros-args --params-file navigator.yaml
    ros2 action send_goal /navigate_to_pose nav2_msgs/action/NavigateToPose \
        "{pose: {header: {frame_id: map}, pose: {position: {x: 2.0, y: 1.0}}}}" --feedback

Names and types are those of Nav2's servers, so that what talks to those talks to this.

======================================  =====================  ===================================
actions                                 ``nav2_msgs/action``   of Nav2's
======================================  =====================  ===================================
``navigate_to_pose``                    NavigateToPose         bt_navigator
``navigate_through_poses``              NavigateThroughPoses   bt_navigator
``compute_path_to_pose``                ComputePathToPose      planner_server
``follow_path``                         FollowPath             controller_server
======================================  =====================  ===================================

======================================  =====================  ===================================
subscribes to                           type                   QoS
======================================  =====================  ===================================
``goal_pose``                           PoseStamped            reliable, as from RViz
``map``                                 OccupancyGrid          reliable, transient local, depth 1
``scan``                                LaserScan              best effort, depth 5
``odom``                                Odometry               reliable
``/tf``, ``/tf_static``                 TFMessage              as tf2_ros has it
======================================  =====================  ===================================

======================================  =====================  ===================================
publishes                               type
======================================  =====================  ===================================
``cmd_vel``                             Twist, or TwistStamped with ``enable_stamped_cmd_vel``
``plan``                                nav_msgs/Path          each new path
``lookahead_point``                     PointStamped           what it drives to
``global_costmap/costmap``              OccupancyGrid          latched, once a second
``local_costmap/published_footprint``   PolygonStamped         where the robot is
======================================  =====================  ===================================

The robot stands still (a command of zeros) when a goal ends, however it does, while the pose, the
scan or the map is missing or too old, and when the program ends.
"""

from dataclasses import dataclass
import math
from typing import Any

from geometry_msgs.msg import (
    Point32,
    PointStamped,
    PolygonStamped,
    PoseStamped,
    Twist,
    TwistStamped,
)
from nav2_msgs.action import (
    ComputePathToPose,
    FollowPath,
    NavigateThroughPoses,
    NavigateToPose,
)
from nav_msgs.msg import OccupancyGrid as OccupancyGridMessage, Path
import numpy as np
from rclpy.duration import Duration
from rclpy.node import Node
from std_msgs.msg import Header

from amr_description.errors import NavigationError
from amr_description.maps.grid import OccupancyGrid, UNKNOWN
from amr_description.maps.pose import Pose
from amr_description.navigation import planner
from amr_description.navigation.costmap import Costmap, INSCRIBED, LETHAL, NO_INFORMATION
from amr_description.navigation.drive import (
    DriveStatus,
    NavigationDrive,
    NavigationDriveSettings,
    WheelCommand,
)
from amr_description.navigation.footprint import (
    inscribed_radius,
    outline,
    placed,
    Points,
    read_footprint,
)
from amr_description.navigation.ros.goals import (
    NavigationGoal,
    NavigationGoalServer,
    UNKNOWN_ERROR,
)
from amr_description.navigation.ros.messages import grid_message, pose_message
from amr_description.navigation.ros.surroundings import (
    Surroundings,
    SurroundingsSettings,
    TF_ERROR,
)
from amr_description.parameters import parameter
from amr_description.ros.firewall import reason_of
from amr_description.ros.node_help import print_help
from amr_description.ros.parameters import add_validation_callback, declare, values
from amr_description.ros.qos import LATCHED
from amr_description.ros.runtime import run

_PURPOSE = 'Drive to goals around what map and scan show: /navigate_to_pose, /goal_pose.'
_PATIENCE = 5.0
"""s without a usable pose or scan before a goal is given up."""
_FEEDBACK_PERIOD = 0.1
_LONGEST = float(2**31 - 1)
"""s that a duration of a message has room for."""
_COSTMAP_PERIOD = 1.0
_CIRCLE = 16
"""Corners of the footprint of a robot that is given by its radius, as in nav2_costmap_2d."""
_OUTLINE_SPACING = 0.025
_INVALID_PATH = 103


@dataclass(frozen=True)
class NavigatorParameters(SurroundingsSettings, NavigationDriveSettings):
    """All parameters."""

    enable_stamped_cmd_vel: bool = parameter(
        False, 'Publish TwistStamped on cmd_vel, not Twist', read_only=True
    )
    footprint: str = parameter(
        '[]', 'Corners of the robot, m: "[[0.3, 0.2], …]"; []: robot_radius', read_only=True
    )
    robot_radius: float = parameter(0.1, 'Of a round robot', unit='m', above=0.0, read_only=True)


class NavigatorNode(Node):
    """The node."""

    def __init__(self) -> None:
        super().__init__('navigator')
        self._settings = declare(self, NavigatorParameters)
        self._corners = self._footprint()
        self._outline = outline(self._corners, _OUTLINE_SPACING)
        self._surroundings = Surroundings(self, self._settings, inscribed_radius(self._corners))
        self._publish_to()
        self._goal: NavigationGoal | None = None
        self._drive: NavigationDrive | None = None
        self._stopped_since: float | None = None
        self._said = self._last = -math.inf
        self._plans = 0
        self._servers = [
            NavigationGoalServer(self, NavigateToPose, 'navigate_to_pose', self._begin_to_pose),
            NavigationGoalServer(
                self, NavigateThroughPoses, 'navigate_through_poses', self._begin_through
            ),
            NavigationGoalServer(
                self, ComputePathToPose, 'compute_path_to_pose', self._compute_path
            ),
            NavigationGoalServer(self, FollowPath, 'follow_path', self._begin_follow),
        ]
        self.create_subscription(PoseStamped, 'goal_pose', self._hear_goal, 10)
        self.create_timer(1.0 / self._settings.controller_frequency, self._step)
        self.create_timer(_COSTMAP_PERIOD, self._publish_costmap)
        add_validation_callback(self, NavigatorParameters)
        self.add_post_set_parameters_callback(lambda _changed: self._configure())
        topic = self.resolve_topic_name('map')
        self.get_logger().info(f'Drives to goals of navigate_to_pose, on the map of {topic}')

    def _configure(self) -> None:
        """Take parameters that have been set, for the goal that is driven to, too."""
        self._settings = values(self, NavigatorParameters)
        self._surroundings.configure(self._settings)
        if self._drive is not None:
            self._drive.configure(self._settings)

    def destroy_node(self) -> None:
        """Stop the robot, and end the goal."""
        if self._drive is not None:
            self._end_drive(NavigationError(0, 'the navigator was asked to end'))
        for server in self._servers:
            server.close()
        super().destroy_node()

    def _footprint(self) -> Points:
        """Return the corners of the robot, m. Raises ParameterError: they are not."""
        if self._settings.footprint.strip() not in ('', '[]'):
            return read_footprint(self._settings.footprint)
        angles = np.arange(_CIRCLE) * math.tau / _CIRCLE
        # The polygon is around the circle, so that its inscribed radius is that of the robot.
        radius = self._settings.robot_radius / math.cos(math.pi / _CIRCLE)
        return radius * np.stack((np.cos(angles), np.sin(angles)), axis=1)

    def _publish_to(self) -> None:
        command = TwistStamped if self._settings.enable_stamped_cmd_vel else Twist
        self._commands = self.create_publisher(command, 'cmd_vel', 1)
        self._paths = self.create_publisher(Path, 'plan', 1)
        self._lookaheads = self.create_publisher(PointStamped, 'lookahead_point', 1)
        self._costmaps = self.create_publisher(
            OccupancyGridMessage, 'global_costmap/costmap', LATCHED
        )
        self._footprints = self.create_publisher(
            PolygonStamped, 'local_costmap/published_footprint', 1
        )

    # --- goals --------------------------------------------------------------------------------

    def _hear_goal(self, message: PoseStamped) -> None:
        self._begin(NavigationGoal(None, None, message), [message])

    def _begin_to_pose(self, goal: NavigationGoal) -> None:
        self._begin(goal, [goal.request.pose])

    def _begin_through(self, goal: NavigationGoal) -> None:
        self._begin(goal, goal.request.poses)

    def _begin(self, goal: NavigationGoal, messages: list[PoseStamped]) -> None:
        """Drive to these, and no longer to those before."""
        try:
            if not messages:
                raise NavigationError(_INVALID_PATH, 'there are no poses to drive to')
            goals = [self._surroundings.goal(each) for each in messages]
        except NavigationError as error:
            self._refuse(goal, error)
            return
        self._start(goal, NavigationDrive(self._settings, self._outline, goals))

    def _begin_follow(self, goal: NavigationGoal) -> None:
        try:
            path = goal.request.path
            poses = []
            for each in path.poses:
                each.header.frame_id = each.header.frame_id or path.header.frame_id
                poses.append(self._surroundings.goal(each))
            if not poses:
                raise NavigationError(_INVALID_PATH, 'the path has no poses')
        except NavigationError as error:
            self._refuse(goal, error)
            return
        self._start(
            goal, NavigationDrive(self._settings, self._outline, [poses[-1]], given_path=poses)
        )

    def _start(self, goal: NavigationGoal, drive: NavigationDrive) -> None:
        if self._drive is not None:
            self._end_drive(None)
        self._goal, self._drive = goal, drive
        self._plans = 0
        self._stopped_since = None
        self._last = -math.inf
        target = drive.goals[-1]
        self.get_logger().info(
            f'Begin navigating to ({target.x:.2f}, {target.y:.2f}), yaw {target.yaw:.2f}'
        )

    def _refuse(self, goal: NavigationGoal, error: NavigationError) -> None:
        self.get_logger().error(f'{error} (error code {error.error_code})')
        goal.abort(error)

    def _compute_path(self, goal: NavigationGoal) -> None:
        """Plan and answer; the robot does not move."""
        request = goal.request
        began = self.get_clock().now()
        try:
            costmap = self._costmap()
            start = (
                self._surroundings.goal(request.start)
                if request.use_start
                else self._surroundings.pose()
            )
            target = self._surroundings.goal(request.goal)
            path = planner.plan(costmap, start, target, self._settings.planner)
        except NavigationError as error:
            self._refuse(goal, error)
            return
        message = self._path_message(path)
        self._paths.publish(message)
        goal.succeed(path=message, planning_time=(self.get_clock().now() - began).to_msg())

    def _costmap(self) -> Costmap:
        """Return the costmap. Raises NavigationError: there is no map."""
        if self._surroundings.costmap is None:
            raise NavigationError(TF_ERROR, self._surroundings.fault())
        return self._surroundings.costmap

    # --- driving ------------------------------------------------------------------------------

    def _step(self) -> None:
        try:
            self._drive_on()
        except Exception as error:  # whatever was heard: the robot stops, the client hears of it
            self._end_drive(NavigationError(UNKNOWN_ERROR, reason_of(error)))
            raise

    def _drive_on(self) -> None:
        self._surroundings.take_scan()
        self._publish_footprint()
        drive, goal = self._drive, self._goal
        if drive is None or goal is None:
            return
        now = self._surroundings.now
        if goal.is_cancel_requested:
            self._command(WheelCommand())
            self._drive = None
            goal.cancel()
            self.get_logger().info('Goal canceled')
            return
        if now < self._last:
            self._end_drive(NavigationError(TF_ERROR, 'time has jumped back: the goal has ended'))
            return
        self._last = now
        fault = self._surroundings.fault()
        if fault:
            self._stand_still(now, fault)
            return
        self._stopped_since = None
        pose = self._surroundings.pose()
        command = drive.step(now, pose, self._surroundings.speed, self._costmap())
        self._command(command)
        self._report(drive, goal, now, pose)
        if drive.status is not DriveStatus.RUNNING:
            self._end_drive(drive.error)

    def _stand_still(self, now: float, fault: str) -> None:
        """Stop while something is missing; give the goal up if that lasts."""
        self._command(WheelCommand())
        if self._stopped_since is None:
            self._stopped_since = now
            self.get_logger().warning(f'the robot stands still: {fault}')
        elif now - self._stopped_since > _PATIENCE:
            self._end_drive(NavigationError(TF_ERROR, fault))

    def _end_drive(self, error: NavigationError | None) -> None:
        """Stop, and end the goal; ``error`` None: it was reached, or another one has come."""
        drive, goal = self._drive, self._goal
        self._command(WheelCommand())
        self._drive = self._goal = None
        if drive is None or goal is None:
            return
        if drive.status is DriveStatus.SUCCEEDED:
            self.get_logger().info('Goal succeeded')
            goal.succeed()
        else:
            if error is not None:
                self.get_logger().error(f'Goal failed: {error} (error code {error.error_code})')
            goal.abort(error)

    def _report(
        self, drive: NavigationDrive, goal: NavigationGoal, now: float, pose: Pose
    ) -> None:
        """Publish the path if it is new, and feedback ten times a second."""
        if drive.plans != self._plans:
            self._plans = drive.plans
            self._paths.publish(self._path_message(drive.path))
        if 0.0 <= now - self._said < _FEEDBACK_PERIOD - 1e-6 or goal.server is None:
            return
        self._said = now
        goal.feed(**self._feedback(drive, goal.server.type, now, pose))

    def _feedback(
        self, drive: NavigationDrive, kind: Any, now: float, pose: Pose
    ) -> dict[str, Any]:
        left = drive.remaining(pose)
        if kind is FollowPath:
            return {'distance_to_goal': left, 'speed': self._surroundings.speed[0]}
        current = PoseStamped(header=self._header(), pose=pose_message(pose))
        began = now if drive.started is None else drive.started
        fields = {
            'current_pose': current,
            'navigation_time': Duration(seconds=now - began).to_msg(),
            'estimated_time_remaining': Duration(
                seconds=min(left / max(self._surroundings.speed[0], 0.1), _LONGEST)
            ).to_msg(),
            'number_of_recoveries': drive.recoveries,
            'distance_remaining': left,
        }
        if kind is NavigateThroughPoses:
            fields['number_of_poses_remaining'] = drive.goals_left
        return fields

    # --- messages -----------------------------------------------------------------------------

    def _header(self) -> Header:
        stamp = self.get_clock().now().to_msg()
        return Header(stamp=stamp, frame_id=self._settings.global_frame)

    def _command(self, command: WheelCommand) -> None:
        twist = Twist()
        twist.linear.x, twist.angular.z = command.linear, command.angular
        if not self._settings.enable_stamped_cmd_vel:
            self._commands.publish(twist)
        else:
            header = Header(
                stamp=self.get_clock().now().to_msg(), frame_id=self._settings.robot_base_frame
            )
            self._commands.publish(TwistStamped(header=header, twist=twist))
        if command.lookahead is not None:
            point = PointStamped(header=self._header())
            point.point.x, point.point.y = command.lookahead.x, command.lookahead.y
            self._lookaheads.publish(point)

    def _path_message(self, path: list[Pose]) -> Path:
        header = self._header()
        poses = [PoseStamped(header=header, pose=pose_message(each)) for each in path]
        return Path(header=header, poses=poses)

    def _publish_footprint(self) -> None:
        if self._footprints.get_subscription_count() == 0:
            return
        try:
            corners = placed(self._corners, self._surroundings.pose())
        except NavigationError:
            return  # who drives is told; who watches sees no footprint
        message = PolygonStamped(header=self._header())
        message.polygon.points = [Point32(x=float(x), y=float(y)) for x, y in corners]
        self._footprints.publish(message)

    def _publish_costmap(self) -> None:
        costmap = self._surroundings.costmap
        if costmap is None or self._costmaps.get_subscription_count() == 0:
            return
        message = grid_message(_as_percent(costmap), self._settings.global_frame)
        message.header.stamp = self.get_clock().now().to_msg()
        self._costmaps.publish(message)


def _as_percent(costmap: Costmap) -> OccupancyGrid:
    """Return costs as Costmap2DPublisher does: 0 to 98, 99 inscribed, 100 lethal, -1 unknown."""
    table = np.zeros(256, dtype=np.int8)
    table[1:INSCRIBED] = 1 + 97 * (np.arange(1, INSCRIBED) - 1) // 251
    table[INSCRIBED], table[LETHAL], table[NO_INFORMATION] = 99, 100, UNKNOWN
    return OccupancyGrid(table[costmap.costs], costmap.resolution, costmap.grid.origin)


def main(args: list[str] | None = None) -> int:
    """Navigate until asked to stop."""
    if print_help(args, 'navigator', _PURPOSE, NavigatorParameters):
        return 0
    return run(NavigatorNode, args)


if __name__ == '__main__':
    raise SystemExit(main())
