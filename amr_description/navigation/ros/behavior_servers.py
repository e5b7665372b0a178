# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
The actions of Nav2's behavior server: ``spin``, ``backup``, ``drive_on_heading``, ``wait``,
``assisted_teleop``.

Assisted teleop takes velocities from ``cmd_vel_teleop``, of the type of ``cmd_vel``, and ends well
with a message (``std_msgs/msg/Empty``) on ``preempt_teleop``.
"""

from collections.abc import Callable
import math
from typing import Any

from builtin_interfaces.msg import Duration as DurationMessage
from geometry_msgs.msg import Twist, TwistStamped
from nav2_msgs.action import AssistedTeleop, BackUp, DriveOnHeading, Spin, Wait
from rclpy.duration import Duration
from rclpy.node import Node
from rclpy.qos import qos_profile_system_default
from std_msgs.msg import Empty

from amr_description.errors import NavigationError
from amr_description.maps.pose import Pose
from amr_description.navigation import behaviors
from amr_description.navigation.behaviors import Behavior, BehaviorDrive, RecoverySettings
from amr_description.navigation.footprint import Points
from amr_description.navigation.ros.goals import NavigationGoal, NavigationGoalServer

_INVALID_BACK_UP, _INVALID_HEADING = 713, 724
_LONGEST = float(2**31 - 1)
"""s that a duration of a message has room for."""


class BehaviorServers:
    """The servers, of a node that steps what they begin."""

    def __init__(
        self,
        node: Node,
        outline: Points,
        settings: Callable[[], RecoverySettings],
        start: Callable[[NavigationGoal, BehaviorDrive, str], object],
        *,
        is_stamped: bool,
    ) -> None:
        """
        Serve.

        Args:
            node: Has the actions.
            outline: (n, 2), m, of the robot.
            settings: Returns the present ones.
            start: Called with each goal, what it begins, and a line for the log.
            is_stamped: Whether ``cmd_vel_teleop`` has TwistStamped.
        """
        self._outline, self._settings, self._start = outline, settings, start
        self._teleop = (0.0, 0.0)
        self._is_preempted = False
        command = TwistStamped if is_stamped else Twist
        node.create_subscription(
            command, 'cmd_vel_teleop', self._take_command, qos_profile_system_default
        )
        node.create_subscription(
            Empty, 'preempt_teleop', self._preempt, qos_profile_system_default
        )
        self.servers = [
            NavigationGoalServer(node, Spin, 'spin', self._spin),
            NavigationGoalServer(node, BackUp, 'backup', self._back_up),
            NavigationGoalServer(node, DriveOnHeading, 'drive_on_heading', self._drive_on_heading),
            NavigationGoalServer(node, Wait, 'wait', self._wait),
            NavigationGoalServer(node, AssistedTeleop, 'assisted_teleop', self._assist),
        ]

    def _begin(
        self, goal: NavigationGoal, text: str, kind: Callable[..., Behavior], **options: Any
    ) -> None:
        settings = self._settings()

        def make(pose: Pose, now: float) -> Behavior:
            return kind(settings, self._outline, pose, now, **options)

        self._start(goal, BehaviorDrive(make), text)

    def _spin(self, goal: NavigationGoal) -> None:
        request = goal.request
        angle = _finite(request.target_yaw, 'target_yaw', behaviors.Spin.CODE)
        self._begin(
            goal,
            f'Turning {angle:0.2f} for spin behavior.',
            behaviors.Spin,
            angle=angle,
            allowance=seconds_of(request.time_allowance),
        )

    def _back_up(self, goal: NavigationGoal) -> None:
        distance, speed = _straight(goal.request, _INVALID_BACK_UP)
        self._begin(
            goal,
            f'backing up {abs(distance):.2f} m',
            behaviors.BackUp,
            distance=distance,
            speed=speed,
            allowance=seconds_of(goal.request.time_allowance),
        )

    def _drive_on_heading(self, goal: NavigationGoal) -> None:
        distance, speed = _straight(goal.request, _INVALID_HEADING)
        if distance * speed < 0.0:
            raise NavigationError(
                _INVALID_HEADING,
                f'speed and command sign did not match: target.x {distance:g}, speed {speed:g}',
            )
        self._begin(
            goal,
            f'driving {distance:.2f} m straight on',
            behaviors.DriveOnHeading,
            distance=distance,
            speed=speed,
            allowance=seconds_of(goal.request.time_allowance),
        )

    def _wait(self, goal: NavigationGoal) -> None:
        seconds = seconds_of(goal.request.time)
        self._begin(goal, f'waiting {seconds:g} s', behaviors.Wait, seconds=seconds)

    def _assist(self, goal: NavigationGoal) -> None:
        self._teleop, self._is_preempted = (0.0, 0.0), False
        self._begin(
            goal,
            'driving as cmd_vel_teleop says, into nothing',
            behaviors.AssistedTeleop,
            command=lambda: None if self._is_preempted else self._teleop,
            allowance=seconds_of(goal.request.time_allowance),
        )

    def _take_command(self, message: Twist | TwistStamped) -> None:
        twist = message.twist if isinstance(message, TwistStamped) else message
        wanted = (twist.linear.x, twist.angular.z)
        self._teleop = wanted if all(map(math.isfinite, wanted)) else (0.0, 0.0)

    def _preempt(self, _: Empty) -> None:
        self._is_preempted = True


def feedback_of(kind: Any, behavior: Behavior) -> dict[str, Any]:
    """Return the fields of the feedback of an action."""
    if kind is Spin:
        return {'angular_distance_traveled': behavior.done}
    if kind is AssistedTeleop:
        return {'current_teleop_duration': duration(behavior.done)}
    if isinstance(behavior, behaviors.Wait):
        return {'time_left': duration(behavior.seconds - behavior.done)}
    return {'distance_traveled': behavior.done}


def duration(seconds: float) -> DurationMessage:
    """Return s as a message, from 0 to the longest that there is."""
    return Duration(seconds=min(max(seconds, 0.0), _LONGEST)).to_msg()


def seconds_of(message: DurationMessage) -> float:
    """Return a duration in s."""
    return float(message.sec) + float(message.nanosec) * 1e-9


def _straight(request: Any, code: int) -> tuple[float, float]:
    """Return distance, m, and speed, m/s. Raises NavigationError: they are none."""
    target = request.target
    if target.y or target.z:
        raise NavigationError(
            code, 'backing up and driving on in Y and Z not supported, will only move in X'
        )
    distance = _finite(target.x, 'target.x', code)
    speed = _finite(request.speed, 'speed', code)
    if not speed:
        raise NavigationError(code, 'the speed is 0: the robot would never arrive')
    return distance, speed


def _finite(value: float, name: str, code: int) -> float:
    if not math.isfinite(value):
        raise NavigationError(code, f'{name} is {value}; a finite number is needed')
    return float(value)
