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
``compute_path_through_poses``          ComputePath…           planner_server
``smooth_path``                         SmoothPath             smoother_server
``follow_path``                         FollowPath             controller_server
``follow_waypoints``                    FollowWaypoints        waypoint_follower
``spin``, ``backup``,                   Spin, BackUp,          behavior_server
``drive_on_heading``, ``wait``,         DriveOnHeading, Wait,
``assisted_teleop``                     AssistedTeleop
======================================  =====================  ===================================

Goals of ``follow_gps_waypoints``, ``dock_robot`` and ``undock_robot`` are refused at once.

======================================  ==========================================================
services
======================================  ==========================================================
``bt_navigator/get_state`` …            active once it can drive; of each of these servers
``…_costmap/clear_…``                   forgets what scans have seen; of the global and local one
``…_costmap/get_costmap``               the costs; local: 3 m x 3 m around the robot
======================================  ==========================================================

======================================  =====================  ===================================
subscribes to                           type                   QoS
======================================  =====================  ===================================
``goal_pose``                           PoseStamped            reliable, as from RViz
``map``                                 OccupancyGrid          reliable, transient local, depth 1
``scan``                                LaserScan              best effort, depth 5
``odom``                                Odometry               reliable
``/tf``, ``/tf_static``                 TFMessage              as tf2_ros has it
``cmd_vel_teleop``, ``preempt_teleop``  as cmd_vel, Empty      for ``assisted_teleop``
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
    ComputePathThroughPoses,
    ComputePathToPose,
    DockRobot,
    FollowGPSWaypoints,
    FollowPath,
    FollowWaypoints,
    NavigateThroughPoses,
    NavigateToPose,
    SmoothPath,
    UndockRobot,
)
from nav2_msgs.msg import MissedWaypoint
from nav_msgs.msg import OccupancyGrid as OccupancyGridMessage, Path
import numpy as np
from rclpy.node import Node
from std_msgs.msg import Header

from amr_description.errors import NavigationError
from amr_description.maps.grid import OccupancyGrid, UNKNOWN
from amr_description.maps.pose import Pose
from amr_description.navigation import planner
from amr_description.navigation.behaviors import BehaviorDrive, DriveStatus, WheelCommand
from amr_description.navigation.costmap import Costmap, INSCRIBED, LETHAL, NO_INFORMATION
from amr_description.navigation.drive import NavigationDrive, NavigationDriveSettings
from amr_description.navigation.footprint import (
    inscribed_radius,
    outline,
    placed,
    Points,
    read_footprint,
)
from amr_description.navigation.plugins import find_follower, find_planner
from amr_description.navigation.ros.behavior_servers import BehaviorServers, duration, feedback_of
from amr_description.navigation.ros.costmap_services import CostmapServices
from amr_description.navigation.ros.goals import (
    NavigationGoal,
    NavigationGoalServer,
    UNKNOWN_ERROR,
)
from amr_description.navigation.ros.managed_names import ManagedNames
from amr_description.navigation.ros.messages import grid_message, pose_message
from amr_description.navigation.ros.surroundings import (
    Surroundings,
    SurroundingsSettings,
    TF_ERROR,
)
from amr_description.navigation.waypoints import WaypointDrive, WaypointSettings
from amr_description.parameters import group, parameter
from amr_description.ros.firewall import reason_of
from amr_description.ros.node_help import print_help
from amr_description.ros.parameters import add_validation_callback, declare, values
from amr_description.ros.qos import LATCHED
from amr_description.ros.runtime import run

_PURPOSE = (
    'Drive to goals around what map and scan show: /navigate_to_pose, /goal_pose. There are no '
    'behavior trees, docks or GPS: such goals are refused. There is one planner, smoother and '
    'follower: their ids in goals make no difference.'
)
_PATIENCE = 5.0
"""s without a usable pose or scan before a goal is given up."""
_FEEDBACK_PERIOD = 0.1
_COSTMAP_PERIOD = 1.0
_CIRCLE = 16
"""Corners of the footprint of a robot that is given by its radius, as in nav2_costmap_2d."""
_OUTLINE_SPACING = 0.025
_INVALID_PATH, _NOTHING_TO_SMOOTH, _NO_VIAPOINTS, _BAD_WAYPOINTS = 103, 505, 309, 600
_THROUGH = 100
"""Codes of ComputePathThroughPoses are those of ComputePathToPose and this."""
_SERVERS = (
    'bt_navigator',
    'planner_server',
    'controller_server',
    'smoother_server',
    'behavior_server',
    'waypoint_follower',
)
"""Nodes of Nav2 in whose place it is."""
_ABSENT = {
    'follow_gps_waypoints': (
        FollowGPSWaypoints,
        'there is no GPS here that the map is bound to; follow_waypoints takes poses of the map',
    ),
    'dock_robot': (DockRobot, 'there are no docks here; navigate_to_pose drives to a pose'),
    'undock_robot': (UndockRobot, 'there are no docks here; backup drives straight back'),
}
"""Actions of which all goals are refused, for clients that wait until there is a server."""


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
    waypoint_follower: WaypointSettings = group('waypoint_follower', WaypointSettings)


class NavigatorNode(Node):
    """The node."""

    def __init__(self) -> None:
        super().__init__('navigator')
        self._settings = declare(self, NavigatorParameters)
        find_planner(self._settings.planner)  # which are refused now, or never
        find_follower(self._settings.pursuit)
        self._corners = self._footprint()
        self._outline = outline(self._corners, _OUTLINE_SPACING)
        self._surroundings = Surroundings(self, self._settings, inscribed_radius(self._corners))
        self._publish_to()
        self._goal: NavigationGoal | None = None
        self._drive: NavigationDrive | WaypointDrive | BehaviorDrive | None = None
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
            NavigationGoalServer(
                self, ComputePathThroughPoses, 'compute_path_through_poses', self._compute_through
            ),
            NavigationGoalServer(self, SmoothPath, 'smooth_path', self._smooth),
            NavigationGoalServer(self, FollowPath, 'follow_path', self._begin_follow),
            NavigationGoalServer(self, FollowWaypoints, 'follow_waypoints', self._begin_waypoints),
            *(
                NavigationGoalServer(self, kind, name, self._refuse_all, absent=why)
                for name, (kind, why) in _ABSENT.items()
            ),
            *BehaviorServers(
                self,
                self._outline,
                lambda: self._settings.recoveries,
                self._start,
                is_stamped=self._settings.enable_stamped_cmd_vel,
            ).servers,
        ]
        self._names = ManagedNames(self, _SERVERS, lambda: not self._surroundings.fault())
        self._costmap_services = CostmapServices(
            self, self._surroundings, self._settings.global_frame
        )
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
        self._start_to(goal, NavigationDrive(self._settings, self._outline, goals))

    def _begin_follow(self, goal: NavigationGoal) -> None:
        poses = self._poses_of(goal.request.path)
        if not poses:
            raise NavigationError(_INVALID_PATH, 'the path has no poses')
        self._start_to(
            goal, NavigationDrive(self._settings, self._outline, [poses[-1]], given_path=poses)
        )

    def _begin_waypoints(self, goal: NavigationGoal) -> None:
        request = goal.request
        waypoints = [self._surroundings.goal(each) for each in request.poses]
        if request.goal_index >= len(waypoints):
            raise NavigationError(
                _BAD_WAYPOINTS,
                f'there are {len(waypoints)} waypoints, and it is to begin with number '
                f'{request.goal_index}, counted from 0',
            )

        def make(target: Pose) -> NavigationDrive:
            return NavigationDrive(self._settings, self._outline, [target])

        drive = WaypointDrive(
            self._settings.waypoint_follower,
            waypoints,
            make,
            index=request.goal_index,
            loops=request.number_of_loops,
        )
        self._start(
            goal, drive, f'Received follow waypoint request with {len(waypoints)} waypoints.'
        )

    def _start_to(self, goal: NavigationGoal, drive: NavigationDrive) -> None:
        target = drive.goals[-1]
        text = f'Begin navigating to ({target.x:.2f}, {target.y:.2f}), yaw {target.yaw:.2f}'
        self._start(goal, drive, text)

    def _start(
        self,
        goal: NavigationGoal,
        drive: NavigationDrive | WaypointDrive | BehaviorDrive,
        text: str,
    ) -> None:
        if self._drive is not None:
            self._end_drive(None)
        self._goal, self._drive = goal, drive
        self._plans = 0
        self._stopped_since = None
        self._last = -math.inf
        self.get_logger().info(text)

    def _refuse(self, goal: NavigationGoal, error: NavigationError) -> None:
        self.get_logger().error(f'{error} (error code {error.error_code})')
        goal.abort(error)

    def _refuse_all(self, goal: NavigationGoal) -> None:
        raise NavigationError(UNKNOWN_ERROR, 'it is not here')

    def _poses_of(self, path: Path) -> list[Pose]:
        """Return the poses of a path in the frame of the map. Raises NavigationError."""
        poses = []
        for each in path.poses:
            each.header.frame_id = each.header.frame_id or path.header.frame_id
            poses.append(self._surroundings.goal(each))
        return poses

    # --- paths, without driving ---------------------------------------------------------------

    def _compute_path(self, goal: NavigationGoal) -> None:
        """Plan and answer; the robot does not move."""
        began = self.get_clock().now()
        path = self._plan(goal.request, [goal.request.goal])
        self._answer_path(goal, path, planning_time=(self.get_clock().now() - began).to_msg())

    def _compute_through(self, goal: NavigationGoal) -> None:
        began = self.get_clock().now()
        if not goal.request.goals:
            raise NavigationError(_NO_VIAPOINTS, 'there are no poses to plan through')
        try:
            path = self._plan(goal.request, goal.request.goals)
        except NavigationError as error:
            raise NavigationError(error.error_code + _THROUGH, str(error)) from error
        self._answer_path(goal, path, planning_time=(self.get_clock().now() - began).to_msg())

    def _plan(self, request: Any, targets: list[PoseStamped]) -> list[Pose]:
        """Return a path from start to the last of these. Raises NavigationError."""
        costmap = self._costmap()
        start = (
            self._surroundings.goal(request.start)
            if request.use_start
            else self._surroundings.pose()
        )
        path: list[Pose] = []
        plan = find_planner(self._settings.planner)
        for target in targets:
            end = self._surroundings.goal(target)
            path += plan(costmap, start, end)
            start = end
        return path

    def _smooth(self, goal: NavigationGoal) -> None:
        began = self.get_clock().now()
        poses = self._poses_of(goal.request.path)
        if not poses:
            raise NavigationError(_NOTHING_TO_SMOOTH, 'the path has no poses')
        path = planner.smoothed(self._costmap(), poses, self._settings.planner)
        took = (self.get_clock().now() - began).to_msg()
        self._answer_path(goal, path, smoothing_duration=took, was_completed=True)

    def _answer_path(self, goal: NavigationGoal, path: list[Pose], **fields: Any) -> None:
        message = self._path_message(path)
        self._paths.publish(message)
        goal.succeed(path=message, **fields)

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
            goal.cancel(**self._result(drive))
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
            goal.succeed(**self._result(drive))
        else:
            if error is not None:
                self.get_logger().error(f'Goal failed: {error} (error code {error.error_code})')
            goal.abort(error, **self._result(drive))

    def _result(self, drive: NavigationDrive | WaypointDrive | BehaviorDrive) -> dict[str, Any]:
        """Return the fields of the result, beside those of an error."""
        if isinstance(drive, BehaviorDrive):
            now = self._surroundings.now
            return {
                'total_elapsed_time': duration(
                    0.0 if drive.started is None else now - drive.started
                )
            }
        if not isinstance(drive, WaypointDrive):
            return {}
        header = self._header()
        missed = [
            MissedWaypoint(
                index=index,
                goal=PoseStamped(header=header, pose=pose_message(drive.waypoints[index])),
                error_code=error.error_code,
            )
            for index, error in drive.missed
        ]
        return {'missed_waypoints': missed}

    def _report(
        self,
        drive: NavigationDrive | WaypointDrive | BehaviorDrive,
        goal: NavigationGoal,
        now: float,
        pose: Pose,
    ) -> None:
        """Publish the path if it is new, and feedback ten times a second."""
        if drive.plans != self._plans:
            self._plans = drive.plans
            self._paths.publish(self._path_message(drive.path))
        if 0.0 <= now - self._said < _FEEDBACK_PERIOD - 1e-6 or goal.server is None:
            return
        self._said = now
        if isinstance(drive, BehaviorDrive):
            if drive.behavior is not None:
                goal.feed(**feedback_of(goal.server.type, drive.behavior))
        elif isinstance(drive, WaypointDrive):
            goal.feed(current_waypoint=drive.index)
        else:
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
            'navigation_time': duration(now - began),
            'estimated_time_remaining': duration(left / max(self._surroundings.speed[0], 0.1)),
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
