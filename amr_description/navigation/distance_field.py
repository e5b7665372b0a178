# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
How far each cell of a map is from the nearest occupied one: the exact Euclidean transform.

Costmaps inflate obstacles by it, and scans are matched against it.

The square of the distance is separable: the least over the rows of each column, then the least of
``(j - k)² + g(k)²`` over the columns k of each row (Meijster et al., A general algorithm for
computing distance transforms in linear time, 2000). In a row the best k never falls as j grows, so
that of a column between two known ones lies between theirs. Columns are halved level by level, for
all rows at once; a level takes time proportional to the number of cells.
"""

import numpy as np
from numpy.typing import NDArray

_CELLS_AT_ONCE = 1 << 20
"""Cells of a block of rows in the second pass, which bounds its memory."""


def distances(occupied: NDArray[np.bool_], resolution: float) -> NDArray[np.float64]:
    """
    Return how far the middle of each cell is from the middle of the nearest occupied cell, m.

    Args:
        occupied: (height, width).
        resolution: Edge of a cell, m.

    Returns:
        (height, width): 0 in occupied cells; ``inf`` everywhere if no cell is occupied.
    """
    if not occupied.any():
        return np.full(occupied.shape, np.inf)
    height, width = occupied.shape
    columns = _squares_in_columns(occupied)
    squares = np.empty_like(columns)
    rows = max(1, _CELLS_AT_ONCE // width)
    for first in range(0, height, rows):
        squares[first : first + rows] = _least_in_rows(columns[first : first + rows])
    return resolution * np.sqrt(squares)


def _squares_in_columns(occupied: NDArray[np.bool_]) -> NDArray[np.int64]:
    """Return the square of the distance to the nearest occupied cell of the same column, cells."""
    height, width = occupied.shape
    # Farther than any cell of the grid, so that an empty column is never the nearest one.
    far = height + width
    rows = np.arange(height, dtype=np.int64)[:, None]
    before = np.maximum.accumulate(np.where(occupied, rows, -far), axis=0)
    behind = np.minimum.accumulate(np.where(occupied, rows, height + far)[::-1], axis=0)[::-1]
    nearest: NDArray[np.int64] = np.minimum(np.minimum(rows - before, behind - rows), far)
    return nearest * nearest


def _least_in_rows(columns: NDArray[np.int64]) -> NDArray[np.int64]:
    """Return the least of ``(j - k)² + columns[:, k]`` over k, for every row and column j."""
    height, width = columns.shape
    squares = np.empty_like(columns)
    # The best k of column j stands at j + 1, between two bounds that hold for every column.
    best = np.zeros((height, width + 2), dtype=np.int64)
    best[:, -1] = width - 1
    step = 1 << width.bit_length()
    while step > 1:
        step //= 2
        level = np.arange(step, width + 1, 2 * step)
        lowest, highest = best[:, level - step], best[:, np.minimum(level + step, width + 1)]
        squares[:, level - 1], best[:, level] = _least_between(columns, level - 1, lowest, highest)
    return squares


def _least_between(
    columns: NDArray[np.int64],
    level: NDArray[np.int64],
    lowest: NDArray[np.int64],
    highest: NDArray[np.int64],
) -> tuple[NDArray[np.int64], NDArray[np.int64]]:
    """
    Return the least of ``(j - k)² + columns[:, k]`` for some columns j, and its k.

    Args:
        columns: (height, width), the squares g(k)².
        level: (n,), the columns j.
        lowest: (height, n), the first k to look at.
        highest: (height, n), the last one.

    Returns:
        (height, n) each.
    """
    height, width = columns.shape
    counts = (highest - lowest + 1).ravel()
    starts = np.cumsum(counts) - counts
    k = np.arange(starts[-1] + counts[-1]) - np.repeat(starts - lowest.ravel(), counts)
    j = np.repeat(np.tile(level, height), counts)
    row = np.repeat(np.repeat(np.arange(height), len(level)), counts)
    squares = (j - k) ** 2 + columns[row, k]
    # One number holds the square and its column: the first of the least ones is found at once.
    least = np.minimum.reduceat(squares * width + k, starts).reshape(height, -1)
    return least // width, least % width
