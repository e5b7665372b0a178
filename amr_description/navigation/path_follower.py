# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
What follows a path: where on it the robot is, and whether a velocity leads into something.

Which velocity it is comes from a subclass: regulated pure pursuit, or a function of the user's
(:mod:`~amr_description.navigation.plugins`).
"""

from abc import ABC, abstractmethod
from dataclasses import dataclass
import math

import numpy as np

from amr_description.errors import NavigationError
from amr_description.maps.pose import Pose
from amr_description.navigation.costmap import Costmap
from amr_description.navigation.footprint import placed, Points
from amr_description.parameters import parameter

NO_VALID_CONTROL = 106
REGULATED_PURE_PURSUIT = 'nav2_regulated_pure_pursuit_controller::RegulatedPurePursuitController'


@dataclass(frozen=True)
class PursuitSettings:
    """Parameters, by the names of Nav2; a follower of one's own may use them or not."""

    plugin: str = parameter(
        REGULATED_PURE_PURSUIT, 'What follows: this, or package.module/function', read_only=True
    )
    desired_linear_vel: float = parameter(0.5, 'Where nothing slows it', unit='m/s', minimum=0.0)
    lookahead_dist: float = parameter(0.6, 'How far ahead it looks', unit='m', minimum=0.0)
    min_lookahead_dist: float = parameter(0.3, 'Of a scaled lookahead', unit='m', minimum=0.0)
    max_lookahead_dist: float = parameter(0.9, 'Of a scaled lookahead', unit='m', minimum=0.0)
    lookahead_time: float = parameter(1.5, 'Scaled lookahead: speed × this', unit='s', minimum=0.0)
    use_velocity_scaled_lookahead_dist: bool = parameter(
        False, 'Look farther ahead the faster it is'
    )
    min_approach_linear_velocity: float = parameter(0.05, 'At the goal', unit='m/s', minimum=0.01)
    approach_velocity_scaling_dist: float = parameter(
        0.6, 'It slows down this far from the goal', unit='m', minimum=0.0
    )
    use_collision_detection: bool = parameter(True, 'Refuse arcs that lead into an obstacle')
    max_allowed_time_to_collision_up_to_carrot: float = parameter(
        1.0, 'How far ahead arcs are looked at', unit='s', minimum=0.0
    )
    use_regulated_linear_velocity_scaling: bool = parameter(True, 'Slow down in sharp arcs')
    use_cost_regulated_linear_velocity_scaling: bool = parameter(True, 'Slow down near obstacles')
    cost_scaling_dist: float = parameter(0.6, 'How near', unit='m', minimum=0.0)
    cost_scaling_gain: float = parameter(1.0, 'How much, 1 or less', minimum=0.0, maximum=1.0)
    inflation_cost_scaling_factor: float = parameter(
        3.0, 'cost_scaling_factor of the costmap', unit='1/m', minimum=1e-3
    )
    regulated_linear_scaling_min_radius: float = parameter(
        0.9, 'Arcs are sharp below this', unit='m', minimum=1e-3
    )
    regulated_linear_scaling_min_speed: float = parameter(
        0.25, 'Regulation goes no lower', unit='m/s', minimum=0.0
    )
    use_fixed_curvature_lookahead: bool = parameter(
        False, 'Regulate by the arc to a point curvature_lookahead_dist ahead'
    )
    curvature_lookahead_dist: float = parameter(0.6, 'See there', unit='m', minimum=0.0)
    use_rotate_to_heading: bool = parameter(True, 'Turn on the spot')
    rotate_to_heading_min_angle: float = parameter(
        0.785, 'Where the path leads away by more', unit='rad', minimum=0.0
    )
    rotate_to_heading_angular_vel: float = parameter(1.8, 'So fast', unit='rad/s', minimum=0.0)
    max_angular_accel: float = parameter(3.2, 'Of turns on the spot', unit='rad/s²', minimum=1e-3)


@dataclass(frozen=True)
class Control:
    """What to do now."""

    linear: float
    """m/s"""
    angular: float
    """rad/s"""
    lookahead: Pose
    """The point that it drives to, in the frame of the map; its yaw says nothing."""


class PathFollower(ABC):
    """Follows one path after another."""

    def __init__(
        self, settings: PursuitSettings, outline: Points, goal_tolerance: float, period: float
    ) -> None:
        """
        Begin without a path.

        Args:
            settings: the parameters.
            outline: (n, 2) points along the edges of the robot, m.
            goal_tolerance: at which it begins to turn to the yaw of the goal, m.
            period: between two controls, s.
        """
        self.settings = settings
        self._outline = outline
        self._goal_tolerance = goal_tolerance
        self._period = period
        self._path: list[Pose] = []
        self._points = np.zeros((0, 2))
        self._nearest = 0

    def configure(self, settings: PursuitSettings, goal_tolerance: float) -> None:
        """Take other parameters from now on."""
        self.settings = settings
        self._goal_tolerance = goal_tolerance

    @property
    def path(self) -> list[Pose]:
        """The path that is followed."""
        return self._path

    def follow(self, path: list[Pose]) -> None:
        """Take a new path, of one pose at least."""
        self._path = path
        self._points = np.array([(pose.x, pose.y) for pose in path])
        self._nearest = 0

    def remaining(self, pose: Pose) -> float:
        """Return how long the rest of the path is, m."""
        rest = self._points[self._nearest_to(pose) :]
        to_path = math.hypot(*(rest[0] - (pose.x, pose.y)))
        return to_path + float(np.hypot(*np.diff(rest, axis=0).T).sum())

    def rest(self, pose: Pose) -> Points:
        """Return the points (n, 2) of the path that are still ahead, m."""
        return self._points[self._nearest_to(pose) :]

    def control(
        self, pose: Pose, speed: tuple[float, float], costmap: Costmap, *, at_goal: bool = False
    ) -> Control:
        """
        Return the velocity that follows the path.

        Args:
            pose: of the robot in the frame of the map.
            speed: of the robot, m/s and rad/s.
            costmap: for regulation and collisions.
            at_goal: the position of the goal has been reached: only turn.

        Raises:
            NavigationError: the robot would hit something.
        """
        control = self._control(pose, speed, costmap, at_goal=at_goal)
        if self.settings.use_collision_detection:
            self._check(pose, control.linear, control.angular, costmap, control.lookahead)
        return control

    @abstractmethod
    def _control(
        self, pose: Pose, speed: tuple[float, float], costmap: Costmap, *, at_goal: bool
    ) -> Control:
        """See :meth:`control`, without its look at what is ahead."""

    def _nearest_to(self, pose: Pose) -> int:
        """Return which point of the path is nearest, none that has been passed."""
        squares = ((self._points[self._nearest :] - (pose.x, pose.y)) ** 2).sum(axis=1)
        self._nearest += int(np.argmin(squares))
        return self._nearest

    def _check(
        self, pose: Pose, linear: float, angular: float, costmap: Costmap, carrot: Pose
    ) -> None:
        """
        Look at where the robot would be on its way to the carrot, a cell apart.

        Raises:
            NavigationError: it would hit something.
        """
        speed = max(abs(linear), abs(angular) * 0.5)
        if speed == 0.0:
            return
        step = costmap.resolution / speed
        count = int(self.settings.max_allowed_time_to_collision_up_to_carrot / step)
        reach = pose.distance(carrot)
        here = pose
        for _ in range(count):
            here = here.compose(_moved(linear, angular, step))
            if linear > 0.0 and pose.distance(here) > reach:
                return
            if costmap.is_blocked(placed(self._outline, here)):
                raise NavigationError(
                    NO_VALID_CONTROL,
                    f'collision ahead: at ({here.x:.2f}, {here.y:.2f}) the robot would touch '
                    'an obstacle',
                )


def _moved(linear: float, angular: float, seconds: float) -> Pose:
    """Return where an arc leads, in the frame of its beginning."""
    turn = angular * seconds
    half = 0.5 * turn
    chord = linear * seconds * (math.sin(half) / half if half else 1.0)
    return Pose(chord * math.cos(half), chord * math.sin(half), turn)
