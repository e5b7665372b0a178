# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
Follow a path: the RegulatedPurePursuitController of Nav2 1.3, its parameters and defaults.

The robot drives an arc to a point on the path that is ``lookahead_dist`` ahead: of curvature
``2 y / (x² + y²)``, with x and y of that point in the frame of the robot (Coulter, Implementation
of the Pure Pursuit Path Tracking Algorithm, 1992). It slows down in sharp arcs, near obstacles and
before the goal (Macenski et al., Regulated Pure Pursuit for Robot Path Tracking, 2023), turns on
the spot where the path begins at an angle, and at the goal; and refuses to drive into something.
Not here: driving backwards along a path with cusps.
"""

from dataclasses import dataclass
import math

import numpy as np

from amr_description.errors import NavigationError
from amr_description.maps.pose import Pose, wrapped
from amr_description.navigation.costmap import Costmap, FREE_SPACE, INSCRIBED
from amr_description.navigation.footprint import placed, Points
from amr_description.parameters import parameter

NO_VALID_CONTROL = 106
_STRAIGHT = 1e-9
"""1/m; below this an arc is a straight line."""


@dataclass(frozen=True)
class PursuitSettings:
    """Parameters, by the names of Nav2."""

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


class RegulatedPurePursuit:
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
        carrot = self._point_ahead(pose, self._lookahead(speed[0]))
        inside = pose.inverse().compose(carrot)
        goal = self._path[-1]
        is_near = at_goal or pose.distance(goal) < self._goal_tolerance
        angle = math.atan2(inside.y, inside.x)
        settings = self.settings
        if settings.use_rotate_to_heading and is_near:
            linear, angular = 0.0, self._turn(wrapped(goal.yaw - pose.yaw), speed[1])
        elif settings.use_rotate_to_heading and abs(angle) > settings.rotate_to_heading_min_angle:
            linear, angular = 0.0, self._turn(angle, speed[1])
        else:
            curvature = _curvature(inside)
            regulated_by = curvature
            if settings.use_fixed_curvature_lookahead:
                ahead = self._point_ahead(pose, settings.curvature_lookahead_dist)
                regulated_by = _curvature(pose.inverse().compose(ahead))
            linear = self._regulated(pose, regulated_by, costmap)
            angular = linear * curvature
        if settings.use_collision_detection:
            self._check(pose, linear, angular, costmap, carrot)
        return Control(linear, angular, carrot)

    def _nearest_to(self, pose: Pose) -> int:
        """Return which point of the path is nearest, none that has been passed."""
        squares = ((self._points[self._nearest :] - (pose.x, pose.y)) ** 2).sum(axis=1)
        self._nearest += int(np.argmin(squares))
        return self._nearest

    def _lookahead(self, speed: float) -> float:
        settings = self.settings
        if not settings.use_velocity_scaled_lookahead_dist:
            return settings.lookahead_dist
        scaled = abs(speed) * settings.lookahead_time
        return min(max(scaled, settings.min_lookahead_dist), settings.max_lookahead_dist)

    def _point_ahead(self, pose: Pose, distance: float) -> Pose:
        """Return where the path leaves a circle around the robot; its end if it does not."""
        first = self._nearest_to(pose)
        away = np.hypot(*(self._points[first:] - (pose.x, pose.y)).T)
        outside = np.flatnonzero(away >= distance)
        if len(outside) == 0:
            return self._path[-1]
        index = first + int(outside[0])
        if index == 0 or outside[0] == 0:
            x, y = self._points[index]
            return Pose(float(x), float(y), 0.0)
        x, y = _on_circle(self._points[index - 1], self._points[index], pose, distance)
        return Pose(x, y, 0.0)

    def _turn(self, angle: float, speed: float) -> float:
        """Return the rate to turn by an angle on the spot, so that it can stop there, rad/s."""
        settings = self.settings
        step = settings.max_angular_accel * self._period
        wanted = math.copysign(settings.rotate_to_heading_angular_vel, angle)
        rate = min(max(wanted, speed - step), speed + step)
        fastest = math.sqrt(2.0 * settings.max_angular_accel * abs(angle))
        return min(max(rate, -fastest), fastest)

    def _regulated(self, pose: Pose, curvature: float, costmap: Costmap) -> float:
        """Return the speed that curvature, obstacles and the goal allow, m/s."""
        settings = self.settings
        desired = settings.desired_linear_vel
        linear = desired
        radius = 1.0 / max(abs(curvature), _STRAIGHT)
        tightest = settings.regulated_linear_scaling_min_radius
        if settings.use_regulated_linear_velocity_scaling and radius < tightest:
            linear = desired * radius / tightest
        if settings.use_cost_regulated_linear_velocity_scaling:
            linear = min(linear, desired * self._cost_factor(pose, costmap))
        linear = max(linear, settings.regulated_linear_scaling_min_speed)
        remaining = self.remaining(pose)
        if remaining < settings.approach_velocity_scaling_dist:
            scaling = pose.distance(self._path[-1]) / settings.approach_velocity_scaling_dist
            linear = min(linear, max(desired * scaling, settings.min_approach_linear_velocity))
        return min(linear, desired)

    def _cost_factor(self, pose: Pose, costmap: Costmap) -> float:
        """Return by which part the obstacle that the cost tells of slows the robot down."""
        cost = costmap.cost_at(pose.x, pose.y)
        settings = self.settings
        if cost == FREE_SPACE or cost > INSCRIBED or settings.cost_scaling_dist == 0.0:
            return 1.0
        distance = costmap.inscribed_radius - math.log(cost / (INSCRIBED - 1)) / (
            settings.inflation_cost_scaling_factor
        )
        if distance >= settings.cost_scaling_dist:
            return 1.0
        return settings.cost_scaling_gain * distance / settings.cost_scaling_dist

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


def _curvature(inside: Pose) -> float:
    """Return the curvature of the arc to a point of the robot's frame, 1/m."""
    square = inside.x**2 + inside.y**2
    return 2.0 * inside.y / square if square > 1e-6 else 0.0


def _on_circle(inner: Points, outer: Points, pose: Pose, radius: float) -> tuple[float, float]:
    """Return where the line between two points leaves the circle around a pose, m."""
    center = np.array((pose.x, pose.y))
    along, offset = outer - inner, inner - center
    a, b = float(along @ along), float(offset @ along)
    c = float(offset @ offset) - radius**2
    if a == 0.0:
        return float(outer[0]), float(outer[1])
    part = (-b + math.sqrt(max(0.0, b * b - a * c))) / a
    x, y = inner + min(max(part, 0.0), 1.0) * along
    return float(x), float(y)
