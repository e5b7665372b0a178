# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
A planner, or a follower, of the user's: a function, by its name or as it is.

``plan(costmap, start, goal) -> path`` returns poses, or points (x, y), m, from start to goal; an
empty one, or None, where there is no way. ``velocity(pose, twist, path, costmap, dt) -> twist``
returns m/s and rad/s for the next ``dt`` s; ``path`` is what is left of it, and ends in the goal.
What such a function raises, or returns that cannot be, is the end of a goal and of nothing else.
"""

from collections.abc import Callable, Iterable, Sequence
from functools import partial
import math
from typing import Any, TypeAlias

import numpy as np

from amr_description.errors import NavigationError, ParameterError
from amr_description.maps.pose import Pose
from amr_description.navigation import planner
from amr_description.navigation.costmap import Costmap
from amr_description.navigation.footprint import Points
from amr_description.navigation.path_follower import (
    Control,
    PathFollower,
    PursuitSettings,
    REGULATED_PURE_PURSUIT,
)
from amr_description.navigation.planner import PlannerSettings, SMAC_PLANNER_2D
from amr_description.plugin_errors import describe
from amr_description.registry import Registry

Twist: TypeAlias = tuple[float, float]
"""m/s and rad/s."""
PlanFunction: TypeAlias = Callable[[Costmap, Pose, Pose], Iterable[Any] | None]
VelocityFunction: TypeAlias = Callable[[Pose, Twist, Sequence[Pose], Costmap, float], Twist]
Planner: TypeAlias = Callable[[Costmap, Pose, Pose], list[Pose]]
"""Raises NavigationError."""
MakeFollower: TypeAlias = Callable[[PursuitSettings, Points, float, float], PathFollower]

UNKNOWN_OF_PLANNER, UNKNOWN_OF_CONTROLLER = 200, 100
"""Of nav2_msgs: the plugin itself has failed."""
_MODULE = 'amr_description.navigation'
PLANNERS = Registry('planner', {SMAC_PLANNER_2D: f'{_MODULE}.planner:plan'}, ParameterError)
FOLLOWERS = Registry(
    'controller',
    {REGULATED_PURE_PURSUIT: f'{_MODULE}.regulated_pure_pursuit:RegulatedPurePursuit'},
    ParameterError,
)


def find_planner(settings: PlannerSettings, plan: PlanFunction | None = None) -> Planner:
    """
    Return what plans.

    Args:
        settings: name it, and are the built-in one's.
        plan: in its place, if it is given.

    Raises:
        ParameterError: there is none of this name.
    """
    if plan is None and settings.plugin in PLANNERS.names:
        return partial(PLANNERS.find(settings.plugin), settings=settings)
    return partial(_plan, plan or _function(PLANNERS, settings.plugin))


def find_follower(
    settings: PursuitSettings, velocity: VelocityFunction | None = None
) -> MakeFollower:
    """
    Return what makes a follower of paths.

    Args:
        settings: name it.
        velocity: in its place, if it is given.

    Raises:
        ParameterError: there is none of this name.
    """
    if velocity is None and settings.plugin in FOLLOWERS.names:
        made: MakeFollower = FOLLOWERS.find(settings.plugin)
        return made
    return partial(FunctionFollower, velocity or _function(FOLLOWERS, settings.plugin))


def _function(registry: Registry, name: str) -> Any:
    found = registry.find(name)
    if not callable(found):
        raise ParameterError(f"'{name}' is no function but {type(found).__name__}")
    return found


def _plan(function: PlanFunction, costmap: Costmap, start: Pose, goal: Pose) -> list[Pose]:
    """Return the path that a function has found. Raises NavigationError."""
    planner.check_ends(costmap, start, goal)
    try:
        found = function(costmap, start, goal)
        poses = [*(found if found is not None else ())]
        places = np.array([_place(each) for each in poses]).reshape(-1, 3)
    except NavigationError:
        raise
    except (Exception, SystemExit) as error:  # the function may raise anything
        text = f'the planner has failed: {describe(error)}'
        raise NavigationError(UNKNOWN_OF_PLANNER, text) from error
    if not poses:
        raise planner.no_path(start, goal)
    bad = np.flatnonzero(~np.isfinite(places).all(axis=1))
    if len(bad):
        raise NavigationError(
            UNKNOWN_OF_PLANNER,
            f'point {bad[0]} of the {len(poses)} that the planner has returned is '
            f'{poses[bad[0]]}; finite numbers will do',
        )
    points = places[:, :2]
    away = math.hypot(*(points[-1] - (goal.x, goal.y)))
    if away > 2.0 * costmap.resolution:
        raise NavigationError(
            planner.NO_VALID_PATH,
            f'the path that the planner has returned ends {away:.2f} m from the goal, more than '
            f'two cells of {costmap.resolution:g} m',
        )
    if len(poses) == 1:
        return [goal]
    points[-1] = goal.x, goal.y
    turned = planner.turned(points, goal)
    return [
        given if isinstance(given, Pose) else made
        for given, made in zip(poses[:-1], turned, strict=False)
    ] + [goal]


def _place(given: Any) -> tuple[float, float, float]:
    if isinstance(given, Pose):
        return given.x, given.y, given.yaw
    x, y = given
    return float(x), float(y), 0.0


class FunctionFollower(PathFollower):
    """Follows by a function of the user's."""

    def __init__(
        self,
        function: VelocityFunction,
        settings: PursuitSettings,
        outline: Points,
        goal_tolerance: float,
        period: float,
    ) -> None:
        """Take the function; the rest as :class:`PathFollower`."""
        super().__init__(settings, outline, goal_tolerance, period)
        self._function = function

    def _control(self, pose: Pose, speed: Twist, costmap: Costmap, *, at_goal: bool) -> Control:
        """See :meth:`PathFollower.control`; where the goal is reached, it knows by itself."""
        path = self.path[self._nearest_to(pose) :]
        try:
            linear, angular = map(float, self._function(pose, speed, path, costmap, self._period))
        except NavigationError:
            raise
        except (Exception, SystemExit) as error:  # the function may raise anything
            text = f'the controller has failed: {describe(error)}'
            raise NavigationError(UNKNOWN_OF_CONTROLLER, text) from error
        if not (math.isfinite(linear) and math.isfinite(angular)):
            raise NavigationError(
                UNKNOWN_OF_CONTROLLER,
                f'the controller has returned ({linear}, {angular}); m/s and rad/s that are '
                'finite will do',
            )
        return Control(linear, angular, path[-1])
