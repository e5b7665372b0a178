# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
Drive to a goal: plan, follow, plan again, get unstuck; as ``navigate_to_pose`` of Nav2 does.

The order is that of ``navigate_w_replanning_and_recovery.xml``: a new path each second, and as
soon as something lies on it; if no path is found, or it cannot be followed, what scans have seen
is forgotten and all is tried again; then, in turn, turn on the spot, wait, back up; after
``number_of_retries`` of them the goal is given up with the error of what failed last.
"""

from collections.abc import Sequence
from dataclasses import dataclass, field
import math

from amr_description.errors import NavigationError
from amr_description.maps.pose import Pose, wrapped
from amr_description.navigation import planner
from amr_description.navigation.behaviors import (
    Behavior,
    DriveStatus,
    RECOVERIES,
    RecoverySettings,
    WheelCommand,
)
from amr_description.navigation.costmap import Costmap, INSCRIBED
from amr_description.navigation.footprint import Points
from amr_description.navigation.path_follower import NO_VALID_CONTROL, PursuitSettings
from amr_description.navigation.planner import PlannerSettings
from amr_description.navigation.plugins import (
    find_follower,
    find_planner,
    PlanFunction,
    VelocityFunction,
)
from amr_description.parameters import group, parameter

PATIENCE_EXCEEDED = 104
FAILED_TO_MAKE_PROGRESS = 105
_RECOVERABLE = (planner.NO_VALID_PATH, PATIENCE_EXCEEDED, FAILED_TO_MAKE_PROGRESS)
"""Errors that a recovery may help with; others are final."""


@dataclass(frozen=True)
class GoalCheckerSettings:
    """Of Nav2's StoppedGoalChecker: a robot that still turns has not arrived."""

    xy_goal_tolerance: float = parameter(0.25, 'At the goal', unit='m', minimum=0.01)
    yaw_goal_tolerance: float = parameter(0.25, 'At the goal', unit='rad', minimum=0.01)
    stateful: bool = parameter(True, 'Once it is at the position, only the yaw counts')
    trans_stopped_velocity: float = parameter(
        0.25, 'At the last goal it is no faster', unit='m/s', minimum=0.001
    )
    rot_stopped_velocity: float = parameter(
        0.25, 'At the last goal it turns no faster', unit='rad/s', minimum=0.001
    )


@dataclass(frozen=True)
class ProgressCheckerSettings:
    """Of Nav2's SimpleProgressChecker."""

    required_movement_radius: float = parameter(0.5, 'As far as this …', unit='m', minimum=0.0)
    movement_time_allowance: float = parameter(10.0, '… within this', unit='s', minimum=0.0)


@dataclass(frozen=True)
class NavigationDriveSettings:
    """Parameters of all that drives to a goal."""

    controller_frequency: float = parameter(
        20.0, 'Velocities', unit='Hz', minimum=1.0, maximum=100.0, read_only=True
    )
    failure_tolerance: float = parameter(
        0.3, 'So long it stands still where no velocity is safe', unit='s', minimum=0.0
    )
    replanning_frequency: float = parameter(1.0, 'Paths', unit='Hz', minimum=0.0, maximum=20.0)
    number_of_retries: int = parameter(6, 'Recoveries before it gives up', minimum=0)
    planner: PlannerSettings = group('planner', PlannerSettings)
    pursuit: PursuitSettings = group('FollowPath', PursuitSettings)
    goal_checker: GoalCheckerSettings = group('general_goal_checker', GoalCheckerSettings)
    progress_checker: ProgressCheckerSettings = group('progress_checker', ProgressCheckerSettings)
    recoveries: RecoverySettings = group('behaviors', RecoverySettings)


@dataclass
class NavigationDrive:
    """
    One goal after another, or one path, from the first step to the end.

    Call :meth:`step` at ``controller_frequency``, until ``status`` is no longer RUNNING.
    """

    settings: NavigationDriveSettings
    outline: Points
    """(n, 2): points along the edges of the robot, m."""
    goals: Sequence[Pose]
    """In the frame of the map; at all but the last one only the position counts."""
    given_path: Sequence[Pose] = ()
    """Follow this and do not plan; ``goals`` is its end then."""
    plan: PlanFunction | None = None
    """In place of the planner that the settings name."""
    velocity: VelocityFunction | None = None
    """In place of the follower that the settings name."""
    status: DriveStatus = DriveStatus.RUNNING
    error: NavigationError | None = None
    """Why it has failed."""
    recoveries: int = 0
    path: list[Pose] = field(default_factory=list)
    """That is followed; empty before the first one."""
    plans: int = 0
    """How many paths there have been."""
    started: float | None = None
    """s"""

    def __post_init__(self) -> None:
        tolerance = self.settings.goal_checker.xy_goal_tolerance
        period = 1.0 / self.settings.controller_frequency
        self._planner = find_planner(self.settings.planner, self.plan)
        make = find_follower(self.settings.pursuit, self.velocity)
        self._follower = make(self.settings.pursuit, self.outline, tolerance, period)
        self._index = 0
        self._planned_at = -math.inf
        self._is_there = False
        self._marker: tuple[Pose, float] | None = None
        self._unsafe_since: float | None = None
        self._cleared = False
        self._recovery: Behavior | None = None

    @property
    def goal(self) -> Pose:
        """Where it drives to now."""
        return self.goals[self._index]

    @property
    def goals_left(self) -> int:
        """How many goals have not been reached."""
        return len(self.goals) - self._index

    def configure(self, settings: NavigationDriveSettings) -> None:
        """Take other parameters from now on."""
        self.settings = settings
        self._planner = find_planner(settings.planner, self.plan)
        self._follower.configure(settings.pursuit, settings.goal_checker.xy_goal_tolerance)

    def remaining(self, pose: Pose) -> float:
        """Return the length of the path from here to the last goal, m."""
        if not self.path:
            return pose.distance(self.goal)
        rest = self.goals[self._index :]
        between = sum(a.distance(b) for a, b in zip(rest, rest[1:], strict=False))
        return self._follower.remaining(pose) + between

    def step(
        self, now: float, pose: Pose, speed: tuple[float, float], costmap: Costmap
    ) -> WheelCommand:
        """
        Return what to do until the next step; standing still at the end.

        Args:
            now: s.
            pose: of the robot in the frame of the map.
            speed: of the robot, m/s and rad/s.
            costmap: with the latest scan; it is cleared when nothing else helps.
        """
        if self.started is None:
            self.started = now
        try:
            return self._step(now, pose, speed, costmap)
        except NavigationError as error:
            return self._fail(error, now, pose, costmap)

    def _step(
        self, now: float, pose: Pose, speed: tuple[float, float], costmap: Costmap
    ) -> WheelCommand:
        if self._recovery is not None:
            command = self._recovery.step(now, pose, costmap)
            if command is not None:
                return WheelCommand(*command)
            self._begin_again()
        if self._has_arrived(pose) and not self._next_goal():
            if self._has_stopped(speed):
                self.status = DriveStatus.SUCCEEDED
            return WheelCommand()
        self._plan(now, pose, costmap)
        self._check_progress(now, pose)
        try:
            control = self._follower.control(pose, speed, costmap, at_goal=self._is_there)
        except NavigationError as error:
            if error.error_code != NO_VALID_CONTROL:
                raise
            return self._wait_for_safety(now, error)
        self._unsafe_since = None
        return WheelCommand(control.linear, control.angular, control.lookahead)

    def _has_arrived(self, pose: Pose) -> bool:
        """Return whether the present goal has been reached."""
        checker = self.settings.goal_checker
        is_near = pose.distance(self.goal) <= checker.xy_goal_tolerance
        self._is_there = is_near or (self._is_there and checker.stateful)
        if self._index < len(self.goals) - 1:
            return self._is_there
        turn = abs(wrapped(self.goal.yaw - pose.yaw))
        return self._is_there and turn <= checker.yaw_goal_tolerance

    def _has_stopped(self, speed: tuple[float, float]) -> bool:
        checker = self.settings.goal_checker
        return (
            abs(speed[0]) <= checker.trans_stopped_velocity
            and abs(speed[1]) <= checker.rot_stopped_velocity
        )

    def _next_goal(self) -> bool:
        """Go on to the next goal; return False at the last one."""
        if self._index == len(self.goals) - 1:
            return False
        self._index += 1
        self._begin_again()
        return True

    def _begin_again(self) -> None:
        """Plan at once, and measure progress from here."""
        self._recovery = None
        self._is_there = False
        self._planned_at = -math.inf
        self._marker = None
        self._unsafe_since = None

    def _plan(self, now: float, pose: Pose, costmap: Costmap) -> None:
        """Plan if it is time to. Raises NavigationError: there is no path."""
        if self.given_path:
            if not self.path:
                self._take(list(self.given_path))
            return
        frequency = self.settings.replanning_frequency
        is_due = frequency > 0.0 and now - self._planned_at >= 1.0 / frequency
        is_fresh = self._planned_at > -math.inf and not is_due
        if self._is_there and self.path:
            return
        if is_fresh and not self._is_path_blocked(pose, costmap):
            return
        self._planned_at = now
        self._take(self._planner(costmap, pose, self.goal))

    def _take(self, path: list[Pose]) -> None:
        self.path = path
        self.plans += 1
        self._follower.follow(path)

    def _is_path_blocked(self, pose: Pose, costmap: Costmap) -> bool:
        """Return whether the robot would touch something on the rest of its path."""
        costs = costmap.costs_at(self._follower.rest(pose))
        return bool((costs >= INSCRIBED).any()) and costmap.cost_at(pose.x, pose.y) < INSCRIBED

    def _check_progress(self, now: float, pose: Pose) -> None:
        """Raise NavigationError if the robot has not come far enough in its time."""
        checker = self.settings.progress_checker
        if (
            self._marker is None
            or self._is_there
            or pose.distance(self._marker[0]) > checker.required_movement_radius
        ):
            self._marker = (pose, now)
        elif now - self._marker[1] > checker.movement_time_allowance:
            raise NavigationError(
                FAILED_TO_MAKE_PROGRESS,
                f'the robot has come {pose.distance(self._marker[0]):.2f} m in '
                f'{checker.movement_time_allowance:g} s, less than '
                f'{checker.required_movement_radius:g} m: do its wheels get the commands?',
            )

    def _wait_for_safety(self, now: float, error: NavigationError) -> WheelCommand:
        """Stand still where no velocity is safe. Raises NavigationError: for too long."""
        if self._unsafe_since is None:
            self._unsafe_since = now
        if now - self._unsafe_since >= self.settings.failure_tolerance:
            self._unsafe_since = None
            raise NavigationError(PATIENCE_EXCEEDED, str(error))
        return WheelCommand()

    def _fail(
        self, error: NavigationError, now: float, pose: Pose, costmap: Costmap
    ) -> WheelCommand:
        """Clear the costmap, then recover, then give up; stand still meanwhile."""
        if error.error_code not in _RECOVERABLE or (
            self._cleared and self.recoveries >= self.settings.number_of_retries
        ):
            self.status, self.error = DriveStatus.FAILED, error
            return WheelCommand()
        self._begin_again()
        costmap.clear()
        if self._cleared:
            kind = RECOVERIES[self.recoveries % len(RECOVERIES)]
            self._recovery = kind(self.settings.recoveries, self.outline, pose, now)
            self.recoveries += 1
        self._cleared = not self._cleared
        return WheelCommand()
