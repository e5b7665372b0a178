# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
Shapes in the plane as cells of a grid: which cells a shape touches, and which are reached.

Lengths are in cells here: cell [row, column] is the square from (column, row) to
(column + 1, row + 1), so that x and y are those of a map less its origin, through its resolution.
"""

from collections.abc import Iterable
from typing import TypeAlias

import numpy as np
from numpy.typing import NDArray

Points: TypeAlias = NDArray[np.float64]
"""(n, 2): x and y of the corners of a convex shape, in cells."""
Mask: TypeAlias = NDArray[np.bool_]
"""(height, width)"""

TOUCH = 1e-5
"""
In cells: what only borders on a cell, or reaches less into it, does not touch it.

So a wall from 1.0 to 1.1 m takes two cells of 0.05 m, whatever its corners are rounded to.
"""


def fill_convex(cells: Mask, corners: Points) -> None:
    """
    Set all cells that a convex shape touches; what of it is outside of the grid is left out.

    Row by row: a convex shape has one interval of x within a row, from the corners in it and from
    where edges cross its two borders, and it touches those cells of the row that the interval
    touches. A segment (two corners) and a point (one) are such shapes too: a segment along a
    border takes the cells above it, or on the right of it.

    Args:
        cells: is changed.
        corners: in their order around the shape.
    """
    height, width = cells.shape
    x, y = corners[:, 0], corners[:, 1]
    first, last = _touched(float(y.min()), float(y.max()))
    if last < 0 or first >= height:
        return
    count = last - first + 1
    row_of_corner = np.clip(np.floor(y), first, last).astype(np.intp) - first
    low, high = np.full(count, np.inf), np.full(count, -np.inf)
    np.minimum.at(low, row_of_corner, x)
    np.maximum.at(high, row_of_corner, x)
    if count > 1:
        borders = np.arange(first + 1, last + 1)[:, None]
        x2, y2 = np.roll(x, -1), np.roll(y, -1)
        below, above = np.minimum(y, y2), np.maximum(y, y2)
        crosses = (below <= borders) & (borders <= above) & (above > below)
        rise = np.where(y2 == y, 1.0, y2 - y)
        at = x + (x2 - x) * np.clip((borders - y) / rise, 0.0, 1.0)
        border_low = np.where(crosses, at, np.inf).min(axis=1)
        border_high = np.where(crosses, at, -np.inf).max(axis=1)
        for side in (slice(0, -1), slice(1, None)):
            low[side] = np.minimum(low[side], border_low)
            high[side] = np.maximum(high[side], border_high)
    for row in range(max(first, 0), min(last, height - 1) + 1):
        left, right = _touched(float(low[row - first]), float(high[row - first]))
        if right >= 0 and left < width:
            cells[row, max(left, 0) : right + 1] = True


def _touched(low: float, high: float) -> tuple[int, int]:
    """Return the first and the last cell that an interval touches."""
    if high - low <= 2.0 * TOUCH:
        middle = int(np.floor((low + high) / 2.0 + TOUCH))
        return middle, middle
    return int(np.floor(low + TOUCH)), int(np.ceil(high - TOUCH)) - 1


def fill_between(cells: Mask, segments: NDArray[np.float64]) -> None:
    """
    Set the cells whose middle is inside of closed curves, by the rule of even and odd.

    Args:
        cells: is changed.
        segments: (n, 2, 2): the ends of the segments of the curves, in any order, in cells.
    """
    height, width = cells.shape
    start, end = segments[:, 0], segments[:, 1]
    rises = start[:, 1] != end[:, 1]
    start, end = start[rises], end[rises]
    low, high = np.minimum(start[:, 1], end[:, 1]), np.maximum(start[:, 1], end[:, 1])
    middles = np.arange(width) + 0.5
    slope = (end[:, 0] - start[:, 0]) / (end[:, 1] - start[:, 1])
    if not len(low):
        return
    lowest, highest = max(0, int(low.min())), min(height - 1, int(high.max()))
    for row in range(lowest, highest + 1):
        y = row + 0.5
        crossed = (low <= y) & (y < high)
        at = np.sort(start[crossed, 0] + slope[crossed] * (y - start[crossed, 1]))
        cells[row] |= np.searchsorted(at, middles) % 2 == 1


def reached(free: Mask, starts: Iterable[tuple[int, int]]) -> Mask:
    """
    Return which cells can be reached from some by steps to a side, over free ones.

    Whole runs of free cells are reached at a time, along rows and columns in turn: there are as
    many rounds as a way has turns.

    Args:
        free: the cells that can be entered.
        starts: row and column of cells of the grid, free ones, to begin from.
    """
    found = np.zeros_like(free)
    for row, column in starts:
        found[row, column] = free[row, column]
    in_rows = _runs(free)
    in_columns = _runs(free.T).T
    count = 0
    while count != (count := int(found.sum())):
        for runs in (in_rows, in_columns):
            is_reached = np.zeros(int(runs.max()) + 1, np.bool_)
            is_reached[runs[found]] = True
            is_reached[0] = False
            found = is_reached[runs]
    return found


def _runs(free: Mask) -> NDArray[np.intp]:
    """Return for each cell the number of the run of free cells that it is in; 0: it is none."""
    begins = free.copy()
    begins[:, 1:] &= ~free[:, :-1]
    numbers = np.cumsum(begins.reshape(-1)).reshape(free.shape)
    return np.where(free, numbers, 0)
