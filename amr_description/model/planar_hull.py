# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""Convex hulls in the plane, and bodies seen from above."""

from typing import TypeAlias

import numpy as np
from numpy.typing import NDArray

_MANY, _DIRECTIONS = 500, 32

PlanarPoints: TypeAlias = NDArray[np.float64]
"""(n, 2)"""
Points: TypeAlias = NDArray[np.float64]
"""(n, 3), z up"""


def planar_hull(points: PlanarPoints) -> PlanarPoints:
    """
    Return the corners of the convex hull, counter-clockwise, the lowest of the leftmost first.

    Andrew's monotone chain (1979). Points on an edge are no corners. Of points on a line the two
    ends are left, of equal points one.
    """
    unique = np.unique(_outer(points), axis=0)  # sorted by x, then by y
    if len(unique) < 3:
        return unique
    rows = unique.tolist()
    lower, upper = _chain(rows), _chain(rows[::-1])
    return np.array(lower[:-1] + upper[:-1])


def _outer(points: PlanarPoints) -> PlanarPoints:
    """Leave out most of very many points: those inside of the farthest ones in some directions."""
    if len(points) <= _MANY:
        return points
    angles = np.arange(_DIRECTIONS) * (2.0 * np.pi / _DIRECTIONS)
    directions = np.column_stack((np.cos(angles), np.sin(angles)))
    extremes = points[[int((points @ direction).argmax()) for direction in directions]]
    corners = planar_hull(extremes)
    along = np.roll(corners, -1, axis=0) - corners
    is_inside = np.full(len(points), len(corners) > 2)
    for (x, y), (dx, dy) in zip(corners.tolist(), along.tolist(), strict=True):
        is_inside &= dx * (points[:, 1] - y) - dy * (points[:, 0] - x) > 0.0
    return points[~is_inside]


def _chain(rows: list[list[float]]) -> list[list[float]]:
    """Return the part of the hull that turns left from the first point to the last."""
    chain: list[list[float]] = []
    for point in rows:
        while len(chain) > 1 and _turn(chain[-2], chain[-1], point) <= 0.0:
            chain.pop()
        chain.append(point)
    return chain


def _turn(a: list[float], b: list[float], c: list[float]) -> float:
    """Return twice the area of a triangle, above 0 where it goes round counter-clockwise."""
    return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])


def cut_between(points: Points, edges: NDArray[np.intp], low: float, high: float) -> PlanarPoints:
    """
    Return corners of what of a convex body is between two heights, seen from above, in any order.

    Args:
        points: corners of a polyhedron (n, 3), or of a flat polygon.
        edges: (m, 2) indices of points.
        low: m.
        high: m, not below ``low``.
    """
    is_between = (low <= points[:, 2]) & (points[:, 2] <= high)
    crossed = [crossings(points, edges, level)[:, :2] for level in {low, high}]
    return np.concatenate([points[is_between, :2], *crossed])


def crossings(points: Points, edges: NDArray[np.intp], level: float) -> Points:
    """Return where edges (m, 2) cross a height, (n, 3)."""
    start, end = points[edges[:, 0]], points[edges[:, 1]]
    crosses = (start[:, 2] < level) != (end[:, 2] < level)
    start, end = start[crosses], end[crosses]
    share = (level - start[:, 2]) / (end[:, 2] - start[:, 2])
    found: Points = start + share[:, None] * (end - start)
    return found
