# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""Paths over a costmap: around obstacles, smooth, and the errors where there is none."""

import math

import numpy as np
import pytest

from amr_description.errors import NavigationError
from amr_description.maps.grid import OccupancyGrid, OCCUPIED, UNKNOWN
from amr_description.maps.pose import Pose, wrapped
from amr_description.navigation import planner
from amr_description.navigation.costmap import Costmap, CostmapSettings, INSCRIBED
from amr_description.navigation.planner import plan, PlannerSettings

SETTINGS = PlannerSettings()
COSTS = CostmapSettings(inflation_radius=0.6, cost_scaling_factor=3.0)


def room(wall_rows=slice(0, 0)):
    """4 m square, its lower left corner at 0, 0; a wall at x = 2 over some rows."""
    cells = np.zeros((80, 80), dtype=np.int8)
    cells[wall_rows, 40] = OCCUPIED
    return Costmap(OccupancyGrid(cells, 0.05, Pose(0.0, 0.0, 0.0)), 0.17, COSTS)


def length(path):
    return sum(a.distance(b) for a, b in zip(path, path[1:], strict=False))


def test_a_free_way_is_straight_and_ends_at_the_goal():
    goal = Pose(3.0, 3.02, -1.0)
    path = plan(room(), Pose(1.01, 1.0, 0.0), goal, SETTINGS)
    assert path[-1] == goal
    assert path[0][:2] == (1.01, 1.0)
    assert length(path) == pytest.approx(math.hypot(1.99, 2.02), rel=0.01)
    assert all(abs(wrapped(each.yaw - math.pi / 4)) < 0.25 for each in path[:-1])


def test_a_wall_is_passed_with_room_for_the_robot():
    costmap = room(slice(20, 80))
    path = plan(costmap, Pose(1.0, 3.0, 0.0), Pose(3.0, 3.0, 0.0), SETTINGS)
    assert min(each.y for each in path) < 1.0 - 0.17
    assert all(costmap.cost_at(each.x, each.y) < INSCRIBED for each in path)
    turns = [abs(wrapped(b.yaw - a.yaw)) for a, b in zip(path[:-2], path[1:-1], strict=True)]
    assert max(turns) < 0.35


def test_start_and_goal_in_one_cell_are_a_path():
    goal = Pose(1.02, 1.02, 2.0)
    assert plan(room(), Pose(1.01, 1.01, 0.0), goal, SETTINGS) == [goal]


def test_a_robot_that_touches_an_obstacle_may_leave_it():
    path = plan(room(slice(20, 80)), Pose(1.9, 2.0, 0.0), Pose(1.0, 2.0, 0.0), SETTINGS)
    assert length(path) == pytest.approx(0.9, abs=0.05)


@pytest.mark.parametrize(
    ('start', 'goal', 'code', 'complaint'),
    [
        ((-1.0, 1.0), (3.0, 3.0), planner.START_OUTSIDE_MAP, r'start \(-1\.00, 1\.00\) is out'),
        ((1.0, 1.0), (9.0, 3.0), planner.GOAL_OUTSIDE_MAP, r'to \(4\.00, 4\.00\) m'),
        ((2.02, 3.0), (3.0, 3.0), planner.START_OCCUPIED, 'is the robot where'),
        ((1.0, 1.0), (2.02, 3.0), planner.GOAL_OCCUPIED, 'is in an obstacle'),
        ((1.0, 1.0), (1.9, 3.0), planner.GOAL_OCCUPIED, r'than the robot can be, 0\.17 m'),
        ((1.0, 1.0), (3.0, 1.0), planner.NO_VALID_PATH, 'narrower than the robot'),
    ],
)
def test_errors_have_the_codes_of_compute_path_to_pose(start, goal, code, complaint):
    with pytest.raises(NavigationError, match=complaint) as caught:
        plan(room(slice(0, 80)), Pose(*start, 0.0), Pose(*goal, 0.0), SETTINGS)
    assert caught.value.error_code == code


def test_codes_are_those_of_nav2_msgs():
    from nav2_msgs.action import ComputePathToPose

    result = ComputePathToPose.Result
    for name in (
        'START_OUTSIDE_MAP',
        'GOAL_OUTSIDE_MAP',
        'START_OCCUPIED',
        'GOAL_OCCUPIED',
        'NO_VALID_PATH',
    ):
        assert getattr(planner, name) == getattr(result, name)


def test_nothing_leads_through_what_nobody_knows():
    cells = np.zeros((80, 80), dtype=np.int8)
    cells[:, 40] = UNKNOWN
    unknown = Costmap(OccupancyGrid(cells, 0.05, Pose(0.0, 0.0, 0.0)), 0.17, COSTS)
    with pytest.raises(NavigationError, match='nobody knows'):
        plan(unknown, Pose(1.0, 1.0, 0.0), Pose(3.0, 1.0, 0.0), SETTINGS)
