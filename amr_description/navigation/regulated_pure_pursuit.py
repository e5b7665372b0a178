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

import math

import numpy as np

from amr_description.maps.pose import Pose, wrapped
from amr_description.navigation.costmap import Costmap, FREE_SPACE, INSCRIBED
from amr_description.navigation.footprint import Points
from amr_description.navigation.path_follower import Control, PathFollower

_STRAIGHT = 1e-9
"""1/m; below this an arc is a straight line."""


class RegulatedPurePursuit(PathFollower):
    """Follows one path after another."""

    def _control(
        self, pose: Pose, speed: tuple[float, float], costmap: Costmap, *, at_goal: bool
    ) -> Control:
        """See :meth:`PathFollower.control`."""
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
        return Control(linear, angular, carrot)

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
