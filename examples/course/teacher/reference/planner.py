"""A planner: a way from here to there that touches nothing."""

import heapq
import math
from typing import Any

TOUCHED = 253
"""From this cost on, the robot would touch something, or nobody knows what is there."""
NEIGHBOURS = [(i, j) for i in (-1, 0, 1) for j in (-1, 0, 1) if i or j]


def plan(costmap: Any, start: Any, goal: Any) -> list[tuple[float, float]]:
    """Return points (x, y), m, from start to goal, by A*; an empty list, if there is no way."""
    grid, costs = costmap.grid, costmap.costs
    first, last = grid.cell_of(start.x, start.y), grid.cell_of(goal.x, goal.y)
    if not grid.holds(*last) or costs[last] >= TOUCHED:
        return []
    waiting = [(0.0, first)]
    cost, before = {first: 0.0}, {first: first}
    while waiting:
        _, cell = heapq.heappop(waiting)
        if cell == last:
            cells = [cell]
            while cells[-1] != first:
                cells.append(before[cells[-1]])
            return [grid.center_of(*each) for each in reversed(cells)]
        for row, column in NEIGHBOURS:
            near = cell[0] + row, cell[1] + column
            if not grid.holds(*near) or costs[near] >= TOUCHED:
                continue
            new = cost[cell] + math.hypot(row, column) * (1.0 + costs[near] / 100.0)
            if new < cost.get(near, math.inf):
                cost[near], before[near] = new, cell
                heapq.heappush(waiting, (new + math.dist(near, last), near))
    return []
