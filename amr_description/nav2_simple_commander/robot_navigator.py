# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
Drive a robot from a program: goals, paths, behaviors, costmaps, by one node.

::

    from nav2_simple_commander.robot_navigator import BasicNavigator, TaskResult

    rclpy.init()
    navigator = BasicNavigator()
    navigator.waitUntilNav2Active()
    navigator.goToPose(pose)
    while not navigator.isTaskComplete():
        print(navigator.getFeedback().distance_remaining)
    print(navigator.getResult())
"""

# ruff: noqa: N802

from collections.abc import Sequence
from enum import Enum
from typing import Any

from action_msgs.msg import GoalStatus
from builtin_interfaces.msg import Duration
from geometry_msgs.msg import Point, PoseStamped, PoseWithCovarianceStamped
from lifecycle_msgs.srv import GetState
from nav2_msgs.action import (
    AssistedTeleop,
    BackUp,
    ComputePathThroughPoses,
    ComputePathToPose,
    DockRobot,
    DriveOnHeading,
    FollowGPSWaypoints,
    FollowPath,
    FollowWaypoints,
    NavigateThroughPoses,
    NavigateToPose,
    SmoothPath,
    Spin,
    UndockRobot,
)
from nav2_msgs.msg import Costmap
from nav2_msgs.srv import (
    ClearCostmapAroundPose,
    ClearCostmapAroundRobot,
    ClearCostmapExceptRegion,
    ClearEntireCostmap,
    GetCostmap,
    LoadMap,
    ManageLifecycleNodes,
)
from nav_msgs.msg import Path
import rclpy
from rclpy.action import ActionClient
from rclpy.action.client import ClientGoalHandle
from rclpy.client import Client
from rclpy.duration import Duration as RosDuration
from rclpy.node import Node
from rclpy.qos import DurabilityPolicy, QoSProfile
from rclpy.task import Future

_PATIENCE = 1.0
"""s between two lines about a server that is not there."""
_LOOK = 0.1
"""s for which isTaskComplete waits for a result."""
_PERIOD = 0.5
"""s between two questions whether a node is active."""
_LATCHED = QoSProfile(depth=1, durability=DurabilityPolicy.TRANSIENT_LOCAL)


class TaskResult(Enum):
    """How a task has ended."""

    UNKNOWN = 0
    SUCCEEDED = 1
    CANCELED = 2
    FAILED = 3


_RESULTS = {
    GoalStatus.STATUS_SUCCEEDED: TaskResult.SUCCEEDED,
    GoalStatus.STATUS_ABORTED: TaskResult.FAILED,
    GoalStatus.STATUS_CANCELED: TaskResult.CANCELED,
}


class BasicNavigator(Node):
    """
    A client of Nav2's servers, or of the navigator in their place.

    One task at a time: a goal that moves the robot is begun by one call, which returns whether it
    was accepted; :meth:`isTaskComplete` is called until it has ended.
    """

    def __init__(self, node_name: str = 'basic_navigator', namespace: str = '') -> None:
        """Make the node; rclpy has been initialised."""
        super().__init__(node_name=node_name, namespace=namespace)
        self.initial_pose = PoseStamped()
        self.initial_pose.header.frame_id = 'map'
        self.goal_handle: ClientGoalHandle | None = None
        self.result_future: Future | None = None
        self.feedback: Any = None
        self.status: int | None = None
        self.initial_pose_received = False
        self.nav_through_poses_client = ActionClient(
            self, NavigateThroughPoses, 'navigate_through_poses'
        )
        self.nav_to_pose_client = ActionClient(self, NavigateToPose, 'navigate_to_pose')
        self.follow_waypoints_client = ActionClient(self, FollowWaypoints, 'follow_waypoints')
        self.follow_gps_waypoints_client = ActionClient(
            self, FollowGPSWaypoints, 'follow_gps_waypoints'
        )
        self.follow_path_client = ActionClient(self, FollowPath, 'follow_path')
        self.compute_path_to_pose_client = ActionClient(
            self, ComputePathToPose, 'compute_path_to_pose'
        )
        self.compute_path_through_poses_client = ActionClient(
            self, ComputePathThroughPoses, 'compute_path_through_poses'
        )
        self.smoother_client = ActionClient(self, SmoothPath, 'smooth_path')
        self.spin_client = ActionClient(self, Spin, 'spin')
        self.backup_client = ActionClient(self, BackUp, 'backup')
        self.drive_on_heading_client = ActionClient(self, DriveOnHeading, 'drive_on_heading')
        self.assisted_teleop_client = ActionClient(self, AssistedTeleop, 'assisted_teleop')
        self.docking_client = ActionClient(self, DockRobot, 'dock_robot')
        self.undocking_client = ActionClient(self, UndockRobot, 'undock_robot')
        self.localization_pose_sub = self.create_subscription(
            PoseWithCovarianceStamped, 'amcl_pose', self._amclPoseCallback, _LATCHED
        )
        self.initial_pose_pub = self.create_publisher(PoseWithCovarianceStamped, 'initialpose', 10)
        self.change_maps_srv = self.create_client(LoadMap, 'map_server/load_map')
        self.clear_costmap_global_srv = self.create_client(
            ClearEntireCostmap, 'global_costmap/clear_entirely_global_costmap'
        )
        self.clear_costmap_local_srv = self.create_client(
            ClearEntireCostmap, 'local_costmap/clear_entirely_local_costmap'
        )
        self.clear_costmap_except_region_srv = self.create_client(
            ClearCostmapExceptRegion, 'local_costmap/clear_costmap_except_region'
        )
        self.clear_costmap_around_robot_srv = self.create_client(
            ClearCostmapAroundRobot, 'local_costmap/clear_costmap_around_robot'
        )
        self.clear_costmap_around_pose_srv = self.create_client(
            ClearCostmapAroundPose, 'local_costmap/clear_costmap_around_pose'
        )
        self.get_costmap_global_srv = self.create_client(GetCostmap, 'global_costmap/get_costmap')
        self.get_costmap_local_srv = self.create_client(GetCostmap, 'local_costmap/get_costmap')

    def destroyNode(self) -> None:
        """Destroy the node."""
        self.destroy_node()

    def destroy_node(self) -> None:
        """Destroy the node, and its clients of actions."""
        for each in list(vars(self).values()):
            if isinstance(each, ActionClient):
                each.destroy()
        super().destroy_node()

    # --- where it is --------------------------------------------------------------------------

    def setInitialPose(self, initial_pose: PoseStamped) -> None:
        """Tell the localizer where the robot is, now and until it says where it is."""
        self.initial_pose_received = False
        self.initial_pose = initial_pose
        self._setInitialPose()

    def waitUntilNav2Active(
        self, navigator: str = 'bt_navigator', localizer: str = 'amcl'
    ) -> None:
        """Wait until the robot is localized and can be driven; for ever, if it never is."""
        if localizer != 'robot_localization':  # which is no lifecycle node
            self._waitForNodeToActivate(localizer)
        if localizer == 'amcl':
            self._waitForInitialPose()
        self._waitForNodeToActivate(navigator)
        self.info('Nav2 is ready for use!')

    # --- tasks --------------------------------------------------------------------------------

    def goThroughPoses(self, poses: Sequence[PoseStamped], behavior_tree: str = '') -> bool:
        """Drive through these poses; return whether that was accepted."""
        goal = NavigateThroughPoses.Goal(poses=poses, behavior_tree=behavior_tree)
        return self._begin(
            self.nav_through_poses_client,
            goal,
            f'Navigating with {len(poses)} goals....',
            f'Goal with {len(poses)} poses was rejected!',
        )

    def goToPose(self, pose: PoseStamped, behavior_tree: str = '') -> bool:
        """Drive to a pose; return whether that was accepted."""
        place = f'{pose.pose.position.x} {pose.pose.position.y}'
        return self._begin(
            self.nav_to_pose_client,
            NavigateToPose.Goal(pose=pose, behavior_tree=behavior_tree),
            f'Navigating to goal: {place}...',
            f'Goal to {place} was rejected!',
        )

    def followWaypoints(self, poses: Sequence[PoseStamped]) -> bool:
        """Drive to these poses, one after the other; return whether that was accepted."""
        return self._begin(
            self.follow_waypoints_client,
            FollowWaypoints.Goal(poses=poses),
            f'Following {len(poses)} goals....',
            f'Following {len(poses)} waypoints request was rejected!',
        )

    def followGpsWaypoints(self, gps_poses: Sequence[Any]) -> bool:
        """Drive to these ``geographic_msgs/GeoPose``; return whether that was accepted."""
        return self._begin(
            self.follow_gps_waypoints_client,
            FollowGPSWaypoints.Goal(gps_poses=gps_poses),
            f'Following {len(gps_poses)} gps goals....',
            f'Following {len(gps_poses)} gps waypoints request was rejected!',
        )

    def spin(self, spin_dist: float = 1.57, time_allowance: int = 10) -> bool:
        """Turn on the spot, rad; return whether that was accepted."""
        goal = Spin.Goal(target_yaw=spin_dist, time_allowance=Duration(sec=time_allowance))
        return self._begin(
            self.spin_client,
            goal,
            f'Spinning to angle {goal.target_yaw}....',
            'Spin request was rejected!',
        )

    def backup(
        self, backup_dist: float = 0.15, backup_speed: float = 0.025, time_allowance: int = 10
    ) -> bool:
        """Drive straight back, m and m/s; return whether that was accepted."""
        goal = BackUp.Goal(
            target=Point(x=float(backup_dist)),
            speed=float(backup_speed),
            time_allowance=Duration(sec=time_allowance),
        )
        return self._begin(
            self.backup_client,
            goal,
            f'Backing up {goal.target.x} m at {goal.speed} m/s....',
            'Backup request was rejected!',
        )

    def driveOnHeading(
        self, dist: float = 0.15, speed: float = 0.025, time_allowance: int = 10
    ) -> bool:
        """Drive straight on, m and m/s; return whether that was accepted."""
        goal = DriveOnHeading.Goal(
            target=Point(x=float(dist)),
            speed=float(speed),
            time_allowance=Duration(sec=time_allowance),
        )
        return self._begin(
            self.drive_on_heading_client,
            goal,
            f'Drive {goal.target.x} m on heading at {goal.speed} m/s....',
            'Drive On Heading request was rejected!',
        )

    def assistedTeleop(self, time_allowance: int = 30) -> bool:
        """Drive as ``cmd_vel_teleop`` says, but into nothing, for so many s."""
        return self._begin(
            self.assisted_teleop_client,
            AssistedTeleop.Goal(time_allowance=Duration(sec=time_allowance)),
            "Running 'assisted_teleop'....",
            'Assisted Teleop request was rejected!',
        )

    def followPath(self, path: Path, controller_id: str = '', goal_checker_id: str = '') -> bool:
        """Drive along a path; return whether that was accepted."""
        goal = FollowPath.Goal(
            path=path, controller_id=controller_id, goal_checker_id=goal_checker_id
        )
        return self._begin(
            self.follow_path_client, goal, 'Executing path...', 'Follow path was rejected!'
        )

    def dockRobotByPose(
        self, dock_pose: PoseStamped, dock_type: str, nav_to_dock: bool = True
    ) -> bool:
        """Drive into a dock at a pose; return whether that was accepted."""
        goal = DockRobot.Goal(
            use_dock_id=False,
            dock_pose=dock_pose,
            dock_type=dock_type,
            navigate_to_staging_pose=nav_to_dock,
        )
        return self._begin(
            self.docking_client,
            goal,
            f'Docking at pose: {dock_pose}...',
            'Docking request was rejected!',
        )

    def dockRobotByID(self, dock_id: str, nav_to_dock: bool = True) -> bool:
        """Drive into a dock by its name; return whether that was accepted."""
        goal = DockRobot.Goal(
            use_dock_id=True, dock_id=dock_id, navigate_to_staging_pose=nav_to_dock
        )
        return self._begin(
            self.docking_client,
            goal,
            f'Docking at dock ID: {dock_id}...',
            'Docking request was rejected!',
        )

    def undockRobot(self, dock_type: str = '') -> bool:
        """Drive out of a dock; return whether that was accepted."""
        return self._begin(
            self.undocking_client,
            UndockRobot.Goal(dock_type=dock_type),
            f'Undocking from dock of type: {dock_type}...',
            'Undocking request was rejected!',
        )

    def cancelTask(self) -> None:
        """End the task before its time."""
        self.info('Canceling current task.')
        if self.result_future is not None and self.goal_handle is not None:
            rclpy.spin_until_future_complete(self, self.goal_handle.cancel_goal_async())

    def isTaskComplete(self) -> bool:
        """Return whether the task has ended, however; waits 0.1 s for that."""
        if self.result_future is None:
            return True  # there is none, or it was cancelled
        rclpy.spin_until_future_complete(self, self.result_future, timeout_sec=_LOOK)
        found = self.result_future.result()
        if found is None:
            return False
        self.status = found.status
        if self.status == GoalStatus.STATUS_SUCCEEDED:
            self.debug('Task succeeded!')
        else:
            self.debug(f'Task with failed status code: {self.status}')
        return True

    def getFeedback(self) -> Any:
        """Return the latest feedback of the task; None: there was none yet."""
        return self.feedback

    def getResult(self) -> TaskResult:
        """Return how the task has ended."""
        return _RESULTS.get(self.status or 0, TaskResult.UNKNOWN)

    # --- paths --------------------------------------------------------------------------------

    def getPath(
        self,
        start: PoseStamped,
        goal: PoseStamped,
        planner_id: str = '',
        use_start: bool = False,
    ) -> Path | None:
        """Return a path to a pose, from start or, without ``use_start``, from the robot."""
        request = ComputePathToPose.Goal(
            start=start, goal=goal, planner_id=planner_id, use_start=use_start
        )
        return self._path(self.compute_path_to_pose_client, request, 'Getting path')

    def getPathThroughPoses(
        self,
        start: PoseStamped,
        goals: Sequence[PoseStamped],
        planner_id: str = '',
        use_start: bool = False,
    ) -> Path | None:
        """Return a path through poses, as :meth:`getPath`."""
        request = ComputePathThroughPoses.Goal(
            start=start, goals=goals, planner_id=planner_id, use_start=use_start
        )
        return self._path(self.compute_path_through_poses_client, request, 'Getting path')

    def smoothPath(
        self,
        path: Path,
        smoother_id: str = '',
        max_duration: float = 2.0,
        check_for_collision: bool = False,
    ) -> Path | None:
        """Return a path smoothed."""
        request = SmoothPath.Goal(
            path=path,
            smoother_id=smoother_id,
            max_smoothing_duration=RosDuration(seconds=max_duration).to_msg(),
            check_for_collisions=check_for_collision,
        )
        return self._path(self.smoother_client, request, 'Smoothing path')

    # --- maps and costmaps --------------------------------------------------------------------

    def changeMap(self, map_filepath: str) -> bool:
        """Have the map of a file loaded; return whether it was."""
        response = self._ask(
            self.change_maps_srv, LoadMap.Request(map_url=map_filepath), 'change map'
        )
        is_loaded = bool(response.result == LoadMap.Response.RESULT_SUCCESS)
        if is_loaded:
            self.info('Change map request was successful!')
        else:
            self.error('Change map request failed!')
        return is_loaded

    def clearAllCostmaps(self) -> None:
        """Forget what sensors have seen."""
        self.clearLocalCostmap()
        self.clearGlobalCostmap()

    def clearLocalCostmap(self) -> None:
        """Forget what sensors have seen near the robot."""
        request = ClearEntireCostmap.Request()
        self._ask(self.clear_costmap_local_srv, request, 'clear local costmaps')

    def clearGlobalCostmap(self) -> None:
        """Forget what sensors have seen anywhere."""
        request = ClearEntireCostmap.Request()
        self._ask(self.clear_costmap_global_srv, request, 'clear global costmaps')

    def clearCostmapExceptRegion(self, reset_distance: float) -> None:
        """Forget what sensors have seen outside of a square around the robot, its side in m."""
        request = ClearCostmapExceptRegion.Request(reset_distance=reset_distance)
        self._ask(self.clear_costmap_except_region_srv, request, 'ClearCostmapExceptRegion')

    def clearCostmapAroundRobot(self, reset_distance: float) -> None:
        """Forget what sensors have seen in a square around the robot, its side in m."""
        request = ClearCostmapAroundRobot.Request(reset_distance=reset_distance)
        self._ask(self.clear_costmap_around_robot_srv, request, 'ClearCostmapAroundRobot')

    def clearCostmapAroundPose(self, pose: PoseStamped, reset_distance: float) -> None:
        """Forget what sensors have seen in a square around a pose, its side in m."""
        request = ClearCostmapAroundPose.Request(pose=pose, reset_distance=reset_distance)
        self._ask(self.clear_costmap_around_pose_srv, request, 'ClearCostmapAroundPose')

    def getGlobalCostmap(self) -> Costmap:
        """Return the costmap of the whole map."""
        return self._ask(
            self.get_costmap_global_srv, GetCostmap.Request(), 'get global costmaps'
        ).map

    def getLocalCostmap(self) -> Costmap:
        """Return the costmap around the robot."""
        return self._ask(
            self.get_costmap_local_srv, GetCostmap.Request(), 'get local costmaps'
        ).map

    # --- nodes of Nav2 ------------------------------------------------------------------------

    def lifecycleStartup(self) -> None:
        """Have all lifecycle managers start their nodes."""
        self.info('Starting up lifecycle nodes based on lifecycle_manager.')
        self._manage(ManageLifecycleNodes.Request.STARTUP)
        self.info('Nav2 is ready for use!')

    def lifecycleShutdown(self) -> None:
        """Have all lifecycle managers end their nodes."""
        self.info('Shutting down lifecycle nodes based on lifecycle_manager.')
        self._manage(ManageLifecycleNodes.Request.SHUTDOWN)

    def info(self, msg: str) -> None:
        """Log a line."""
        self.get_logger().info(msg)

    def warn(self, msg: str) -> None:
        """Log a warning."""
        self.get_logger().warning(msg)

    def error(self, msg: str) -> None:
        """Log an error."""
        self.get_logger().error(msg)

    def debug(self, msg: str) -> None:
        """Log a line that is mostly not shown."""
        self.get_logger().debug(msg)

    def _manage(self, command: int) -> None:
        for name, (kind, *_) in self.get_service_names_and_types():
            if kind != 'nav2_msgs/srv/ManageLifecycleNodes':
                continue
            client = self.create_client(ManageLifecycleNodes, name)
            self._ask(client, ManageLifecycleNodes.Request(command=command), name)
            self.destroy_client(client)

    def _begin(self, client: ActionClient, goal: Any, doing: str, refused: str) -> bool:
        """Begin a task; return whether it was accepted."""
        self.result_future = self.feedback = self.status = None
        self.goal_handle = self._accepted(client, goal, doing)
        if self.goal_handle is None:
            self.error(refused)
            return False
        self.result_future = self.goal_handle.get_result_async()
        return True

    def _path(self, client: ActionClient, goal: Any, doing: str) -> Path | None:
        handle = self._accepted(client, goal, f'{doing}...')
        if handle is None:
            self.error(f'{doing} was rejected!')
            return None
        future = handle.get_result_async()
        rclpy.spin_until_future_complete(self, future)
        found = future.result()
        self.status = found.status
        if self.status != GoalStatus.STATUS_SUCCEEDED:
            self.warn(f'{doing} failed with status code: {self.status}')
            return None
        return found.result.path

    def _accepted(self, client: ActionClient, goal: Any, doing: str) -> ClientGoalHandle | None:
        """Send a goal, once there is a server; None: it was refused."""
        name = type(goal).__name__.removesuffix('_Goal')
        self.debug(f"Waiting for '{name}' action server")
        while not client.wait_for_server(timeout_sec=_PATIENCE):
            self.info(f"'{name}' action server not available, waiting...")
        self.info(doing)
        future = client.send_goal_async(goal, self._feedbackCallback)
        rclpy.spin_until_future_complete(self, future)
        handle: ClientGoalHandle = future.result()
        return handle if handle.accepted else None

    def _ask(self, client: Client, request: Any, what: str) -> Any:
        """Ask a service, once it is there."""
        while not client.wait_for_service(timeout_sec=_PATIENCE):
            self.info(f'{what} service not available, waiting...')
        future = client.call_async(request)
        rclpy.spin_until_future_complete(self, future)
        return future.result()

    def _waitForNodeToActivate(self, node_name: str) -> None:
        name = f'{node_name}/get_state'
        client = self.create_client(GetState, name)
        try:
            while True:
                state = self._ask(client, GetState.Request(), name).current_state.label
                self.debug(f'Result of get_state: {state}')
                if state == 'active':
                    return
                rclpy.spin_once(self, timeout_sec=_PERIOD)
        finally:
            self.destroy_client(client)

    def _waitForInitialPose(self) -> None:
        while not self.initial_pose_received:
            self.info('Setting initial pose')
            self._setInitialPose()
            self.info('Waiting for amcl_pose to be received')
            rclpy.spin_once(self, timeout_sec=_PATIENCE)

    def _setInitialPose(self) -> None:
        message = PoseWithCovarianceStamped(header=self.initial_pose.header)
        message.pose.pose = self.initial_pose.pose
        self.info('Publishing Initial Pose')
        self.initial_pose_pub.publish(message)

    def _amclPoseCallback(self, _: PoseWithCovarianceStamped) -> None:
        self.debug('Received amcl pose')
        self.initial_pose_received = True

    def _feedbackCallback(self, message: Any) -> None:
        self.feedback = message.feedback
