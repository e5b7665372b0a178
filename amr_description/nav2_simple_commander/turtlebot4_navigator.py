# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""``turtlebot4_navigation``: BasicNavigator with directions in degrees, a dock, and progress."""

# ruff: noqa: N802 (the original's names)

from collections.abc import Callable, Sequence
from enum import IntEnum
import math
from threading import Thread
from typing import Any

from action_msgs.msg import GoalStatus
from geometry_msgs.msg import Pose, PoseStamped, PoseWithCovarianceStamped
from irobot_create_msgs.action import Dock, Undock
from irobot_create_msgs.msg import DockStatus
import rclpy
from rclpy.action import ActionClient
from rclpy.duration import Duration
from rclpy.qos import qos_profile_sensor_data, qos_profile_system_default
from rclpy.task import Future

from amr_description.nav2_simple_commander.robot_navigator import BasicNavigator, TaskResult

_LOOK = 0.1
"""s for which a question waits before the next one."""
_PATIENCE = 50
"""Questions between two lines about what is not there."""
_EACH = 5
"""Of so many feedbacks one is printed."""
_TIMEOUT = 600.0
"""s after which a goal is cancelled."""
_ENDS = {
    TaskResult.SUCCEEDED: 'Goal succeeded!',
    TaskResult.CANCELED: 'Goal was canceled!',
    TaskResult.FAILED: 'Goal failed!',
}


class TurtleBot4Directions(IntEnum):
    """Degrees, to the left; north is the x axis of the map."""

    NORTH = 0
    NORTH_WEST = 45
    WEST = 90
    SOUTH_WEST = 135
    SOUTH = 180
    SOUTH_EAST = 225
    EAST = 270
    NORTH_EAST = 315


class TurtleBot4Navigator(BasicNavigator):
    """Drives a TurtleBot4: onto its dock and off it, and to poses until it is there."""

    def __init__(self) -> None:
        super().__init__()
        self.is_docked: bool | None = None
        self.creating_path = False
        self.new_pose: Pose | None = None
        self.create_subscription(
            DockStatus, 'dock_status', self._dockCallback, qos_profile_sensor_data
        )
        self.create_subscription(
            PoseWithCovarianceStamped,
            'initialpose',
            self._poseEstimateCallback,
            qos_profile_system_default,
        )
        self.undock_action_client = ActionClient(self, Undock, 'undock')
        self.dock_action_client = ActionClient(self, Dock, 'dock')
        self.undock_result_future: Future | None = None
        self.dock_result_future: Future | None = None

    # --- poses --------------------------------------------------------------------------------

    def getPoseStamped(self, position: Sequence[float], rotation: float) -> PoseStamped:
        """Return a pose on the map: x and y in m, degrees to the left."""
        pose = Pose()
        pose.position.x, pose.position.y = float(position[0]), float(position[1])
        half = math.radians(rotation) / 2
        pose.orientation.z, pose.orientation.w = math.sin(half), math.cos(half)
        return self.stampPose(pose)

    def stampPose(self, pose: Pose) -> PoseStamped:
        """Return a pose on the map, of now."""
        stamped = PoseStamped(pose=pose)
        stamped.header.frame_id = 'map'
        stamped.header.stamp = self.get_clock().now().to_msg()
        return stamped

    def createPath(self) -> list[PoseStamped]:
        """Return the poses that are given on ``/initialpose`` until Enter is pressed."""
        self.info('Creating a path. Press Enter to finish.')
        self.info('Use the "2D Pose Estimate" tool in Rviz to add a pose to the path.')
        keyboard = Thread(target=input, daemon=True)
        keyboard.start()
        poses: list[PoseStamped] = []
        self.new_pose, self.creating_path = None, True
        while keyboard.is_alive():
            rclpy.spin_once(self, timeout_sec=_LOOK)
            if self.new_pose is not None:
                self.info('Pose added.')
                poses.append(self.stampPose(self.new_pose))
                self.new_pose = None
                self.clearAllCostmaps()
        self.creating_path = False
        if poses:
            self.info('Path created.')
        for index, stamped in enumerate(poses):
            at, turned = stamped.pose.position, stamped.pose.orientation
            self.info(
                f'Pose {index} [x,y]=[{at.x:.3f},{at.y:.3f}][x,y,z,w]='
                f'[{turned.x:.3f},{turned.y:.3f},{turned.z:.3f},{turned.w:.3f}]'
            )
        return poses

    def _poseEstimateCallback(self, message: PoseWithCovarianceStamped) -> None:
        if self.creating_path:
            self.new_pose = message.pose.pose

    # --- the dock -----------------------------------------------------------------------------

    def _dockCallback(self, message: DockStatus) -> None:
        self.is_docked = message.is_docked

    def getDockedStatus(self) -> bool:
        """Return whether the robot is docked; waits until its base has said so."""
        rclpy.spin_once(self, timeout_sec=_LOOK)
        asked = 0
        while self.is_docked is None:
            rclpy.spin_once(self, timeout_sec=_LOOK)
            asked += 1
            if asked % _PATIENCE == 0:
                self.info("Waiting for 'dock_status', which the base of a TurtleBot4 publishes...")
        return self.is_docked

    def dock(self) -> None:
        """Drive onto the dock, and wait until that has ended."""
        self.info('Docking...')
        self.dock_send_goal()
        while not self.isDockComplete():
            pass  # that waits itself

    def undock(self) -> None:
        """Drive off the dock, and wait until that has ended."""
        self.info('Undocking...')
        self.undock_send_goal()
        while not self.isUndockComplete():
            pass  # that waits itself

    def dock_send_goal(self) -> None:
        """Begin to drive onto the dock."""
        self.dock_result_future = self._send(self.dock_action_client, Dock.Goal(), 'Dock')

    def undock_send_goal(self) -> None:
        """Begin to drive off the dock."""
        self.undock_result_future = self._send(self.undock_action_client, Undock.Goal(), 'Undock')

    def isDockComplete(self) -> bool:
        """Return whether the robot has ended to dock; waits 0.1 s for that."""
        return self._is_complete(self.dock_result_future, 'Dock')

    def isUndockComplete(self) -> bool:
        """Return whether the robot has ended to undock; waits 0.1 s for that."""
        return self._is_complete(self.undock_result_future, 'Undock')

    def _send(self, client: ActionClient, goal: Any, name: str) -> Future | None:
        while not client.wait_for_server(_LOOK * _PATIENCE):
            self.info(f"Waiting for the action '{name.lower()}' of the base of a TurtleBot4...")
        sent = client.send_goal_async(goal)
        rclpy.spin_until_future_complete(self, sent)
        handle = sent.result()
        if not handle.accepted:
            self.error(f'{name} goal rejected')
            return None
        result: Future = handle.get_result_async()
        return result

    def _is_complete(self, result: Future | None, name: str) -> bool:
        if result is None:
            return True
        rclpy.spin_until_future_complete(self, result, timeout_sec=_LOOK)
        if not result.done():
            return False
        status = result.result().status
        if status == GoalStatus.STATUS_SUCCEEDED:
            self.info(f'{name} succeeded')
        else:
            self.info(f'{name} failed with status code: {status}')
        return True

    # --- goals, until they have ended ---------------------------------------------------------

    def startToPose(self, pose: PoseStamped) -> None:
        """Drive to a pose, print when it will be there, and wait until it is."""
        if self.goToPose(pose):
            self._wait(self._print_time)

    def startThroughPoses(self, poses: Sequence[PoseStamped]) -> None:
        """Drive through poses, print when it will be there, and wait until it is."""
        if self.goThroughPoses(poses):
            self._wait(self._print_time)

    def startFollowWaypoints(self, poses: Sequence[PoseStamped]) -> None:
        """Drive to one pose after the other, print which, and wait until it is at the last."""
        if self.followWaypoints(poses):
            self._wait(lambda feedback: self._print_waypoint(feedback, len(poses)))

    def _wait(self, show: Callable[[Any], None]) -> None:
        asked = 0
        while not self.isTaskComplete():
            asked += 1
            feedback = self.getFeedback()
            if feedback and asked % _EACH == 0:
                show(feedback)
        self.info(_ENDS.get(self.getResult(), 'Goal has an invalid return status!'))

    def _print_time(self, feedback: Any) -> None:
        left = Duration.from_msg(feedback.estimated_time_remaining).nanoseconds / 1e9
        print(f'Estimated time of arrival: {left:.0f}{" seconds.":<20}', end='\r')
        if Duration.from_msg(feedback.navigation_time) > Duration(seconds=_TIMEOUT):
            self.cancelTask()

    @staticmethod
    def _print_waypoint(feedback: Any, count: int) -> None:
        print(f'Executing current waypoint: {feedback.current_waypoint + 1}/{count:<5}', end='\r')
