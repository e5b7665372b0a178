# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
A path from pose to pose over a costmap: A*, then smoothed.

As Nav2's Smac 2-D planner: eight neighbours, a step of length l into a cell of cost c costs
``l (1 + cost_travel_multiplier c / 252)``, and cells in which the robot would touch an obstacle
however it is turned (INSCRIBED and above) are not entered. Where the robot begins within such
cells, it may leave them. The smoother is nav2_smoother's ``SimpleSmoother``.
"""

from dataclasses import dataclass
import heapq
import math

import numpy as np
from numpy.typing import NDArray

from amr_description.errors import NavigationError
from amr_description.maps.pose import Pose
from amr_description.navigation.costmap import Costmap, INSCRIBED, LETHAL, NO_INFORMATION
from amr_description.navigation.footprint import Points
from amr_description.parameters import parameter

START_OUTSIDE_MAP = 203
GOAL_OUTSIDE_MAP = 204
START_OCCUPIED = 205
GOAL_OCCUPIED = 206
NO_VALID_PATH = 208
SMAC_PLANNER_2D = 'nav2_smac_planner::SmacPlanner2D'

_DIAGONAL = math.sqrt(2.0)
_LEAVING = 10.0
"""A step among INSCRIBED cells around the start costs this many times as much."""
_LEAVING_RADIUS = 0.5
"""m around the start within which such steps are allowed."""


@dataclass(frozen=True)
class PlannerSettings:
    """Parameters of planner and smoother, by the names of Nav2."""

    plugin: str = parameter(
        SMAC_PLANNER_2D, 'What plans: this, or package.module/function', read_only=True
    )
    cost_travel_multiplier: float = parameter(
        2.0, 'How much cells near obstacles are avoided', minimum=0.0
    )
    w_data: float = parameter(0.2, 'How much the smoothed path keeps to the path', minimum=0.0)
    w_smooth: float = parameter(0.3, 'How much it is smoothed', minimum=0.0)
    tolerance: float = parameter(
        1e-4, 'Of the smoother: a change at which it ends, m', unit='m', minimum=1e-12
    )
    max_its: int = parameter(1000, 'Of the smoother: iterations at most', minimum=0)


def plan(costmap: Costmap, start: Pose, goal: Pose, settings: PlannerSettings) -> list[Pose]:
    """
    Return the poses of a path, about a cell apart, turned along it; the last one is ``goal``.

    Raises:
        NavigationError: start or goal cannot be, or there is no way.
    """
    first, last = _cell(costmap, start, 'start'), _cell(costmap, goal, 'goal')
    cells = _search(costmap, first, last, settings.cost_travel_multiplier)
    if cells is None:
        raise no_path(start, goal)
    points = np.array([costmap.grid.center_of(*cell) for cell in cells])
    if len(points) == 1:
        return [goal]
    points[0], points[-1] = (start.x, start.y), (goal.x, goal.y)
    return turned(_smoothed(costmap, points, settings), goal)


def check_ends(costmap: Costmap, start: Pose, goal: Pose) -> None:
    """Raise NavigationError: the robot cannot be at start, or at goal."""
    _cell(costmap, start, 'start')
    _cell(costmap, goal, 'goal')


def no_path(start: Pose, goal: Pose) -> NavigationError:
    """Return what says that there is no way."""
    return NavigationError(
        NO_VALID_PATH,
        f'no path from {_text(start)} to {_text(goal)}: all ways are narrower than the robot, '
        f'or lead through what nobody knows; choose a goal that can be reached',
    )


def smoothed(costmap: Costmap, path: list[Pose], settings: PlannerSettings) -> list[Pose]:
    """Return a path smoothed, its ends where they are and its poses turned along it."""
    if len(path) < 3:
        return path
    points = np.array([(each.x, each.y) for each in path])
    return turned(_smoothed(costmap, points, settings), path[-1])


def _text(pose: Pose) -> str:
    return f'({pose.x:.2f}, {pose.y:.2f})'


def _cell(costmap: Costmap, pose: Pose, what: str) -> tuple[int, int]:
    """Return the cell of start or goal. Raises NavigationError: the robot cannot be there."""
    grid = costmap.grid
    cell = grid.cell_of(pose.x, pose.y)
    if not grid.holds(*cell):
        code = START_OUTSIDE_MAP if what == 'start' else GOAL_OUTSIDE_MAP
        x, y = grid.origin.x, grid.origin.y
        raise NavigationError(
            code,
            f'the {what} {_text(pose)} is outside of the map, which reaches from '
            f'({x:.2f}, {y:.2f}) to ({x + grid.width * grid.resolution:.2f}, '
            f'{y + grid.height * grid.resolution:.2f}) m',
        )
    cost = int(costmap.costs[cell])
    if what == 'start' and cost == LETHAL:
        raise NavigationError(
            START_OCCUPIED,
            f'the start {_text(pose)} is in an obstacle: is the robot where localisation says?',
        )
    if what == 'goal' and cost >= INSCRIBED:
        why = (
            'is where nobody has been'
            if cost == NO_INFORMATION
            else 'is in an obstacle'
            if cost == LETHAL
            else 'is nearer to an obstacle than the robot can be, '
            f'{costmap.inscribed_radius:.2f} m'
        )
        raise NavigationError(GOAL_OCCUPIED, f'the goal {_text(pose)} {why}; choose a free one')
    return cell


def _search(
    costmap: Costmap, first: tuple[int, int], last: tuple[int, int], multiplier: float
) -> list[tuple[int, int]] | None:
    """Return the cells of the cheapest way, or None. A*; the estimate is the octile distance."""
    height, width = costmap.costs.shape
    # One cell of rim that cannot be entered, so that no neighbour has to be looked for outside.
    factors = np.full((height + 2, width + 2), math.inf)
    factors[1:-1, 1:-1] = _step_costs(costmap, first, multiplier)
    stride = width + 2
    cost_of: list[float] = factors.ravel().tolist()
    start = (first[0] + 1) * stride + first[1] + 1
    goal_row, goal_column = last[0] + 1, last[1] + 1
    goal = goal_row * stride + goal_column
    steps = [
        (row * stride + column, _DIAGONAL if row and column else 1.0)
        for row in (-1, 0, 1)
        for column in (-1, 0, 1)
        if row or column
    ]
    best = [math.inf] * len(cost_of)
    parent = [-1] * len(cost_of)
    done = bytearray(len(cost_of))
    best[start] = 0.0
    queue = [(0.0, start)]
    while queue:
        here = heapq.heappop(queue)[1]
        if here == goal:
            return _way(parent, goal, stride)
        if done[here]:
            continue
        done[here] = 1
        sofar = best[here]
        for offset, length in steps:
            there = here + offset
            cost = sofar + length * cost_of[there]
            if cost < best[there]:
                best[there] = cost
                parent[there] = here
                row, column = divmod(there, stride)
                rows, columns = abs(row - goal_row), abs(column - goal_column)
                left = max(rows, columns) + (_DIAGONAL - 1.0) * min(rows, columns)
                heapq.heappush(queue, (cost + left, there))
    return None


def _step_costs(
    costmap: Costmap, first: tuple[int, int], multiplier: float
) -> NDArray[np.float64]:
    """Return what a step of one cell's length into each cell costs; ``inf``: not entered."""
    costs = costmap.costs
    factors = np.where(costs < INSCRIBED, 1.0 + multiplier * costs / (INSCRIBED - 1.0), math.inf)
    reach = math.ceil(_LEAVING_RADIUS / costmap.resolution)
    part = np.s_[
        max(0, first[0] - reach) : first[0] + reach + 1,
        max(0, first[1] - reach) : first[1] + reach + 1,
    ]
    if costs[first] >= INSCRIBED:
        factors[part][costs[part] == INSCRIBED] = _LEAVING * (1.0 + multiplier)
        factors[first] = 1.0
    return factors


def _way(parent: list[int], goal: int, stride: int) -> list[tuple[int, int]]:
    cells = []
    here = goal
    while here >= 0:
        row, column = divmod(here, stride)
        cells.append((row - 1, column - 1))
        here = parent[here]
    return cells[::-1]


def _smoothed(costmap: Costmap, points: Points, settings: PlannerSettings) -> Points:
    """
    Return the points moved towards the middle of their neighbours; both ends stay.

    What would come to lie nearer to an obstacle than the robot can be ends the smoothing.
    """
    way = points.copy()
    allowed = max(INSCRIBED - 1, int(costmap.costs_at(points).max()))
    for _ in range(settings.max_its):
        inner = way[1:-1]
        change = settings.w_data * (points[1:-1] - inner) + settings.w_smooth * (
            way[2:] + way[:-2] - 2.0 * inner
        )
        moved = way.copy()
        moved[1:-1] += change
        if int(costmap.costs_at(moved).max()) > allowed:
            break
        way = moved
        if float(np.abs(change).sum(axis=1).max(initial=0.0)) < settings.tolerance:
            break
    return way


def turned(points: Points, goal: Pose) -> list[Pose]:
    """Return poses that look to the next one; the last one is the goal."""
    ahead = np.diff(points, axis=0)
    yaws = np.arctan2(ahead[:, 1], ahead[:, 0])
    poses = [
        Pose(float(x), float(y), float(yaw)) for (x, y), yaw in zip(points[:-1], yaws, strict=True)
    ]
    return [*poses, goal]
