# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""A robot seen from above: the polygon ``footprint`` of Nav2's costmaps, and where it stands."""

import ast
import math

import numpy as np
from numpy.typing import NDArray

from amr_description.errors import ParameterError
from amr_description.maps.pose import Pose

Points = NDArray[np.float64]


def read_footprint(text: str, name: str = 'footprint') -> Points:
    """
    Return the corners of a footprint as Nav2 writes it: ``[[0.3, 0.17], [0.3, -0.17], …]``, m.

    Args:
        text: of the parameter.
        name: of the parameter, for the error.

    Returns:
        (corners, 2), in the frame of the base.

    Raises:
        ParameterError: it is no polygon around the origin of the base.
    """
    try:
        corners = np.array(ast.literal_eval(text), dtype=float)
    except (ValueError, SyntaxError, TypeError):
        corners = np.zeros(0)
    if corners.ndim != 2 or corners.shape[1] != 2 or not np.isfinite(corners).all():
        raise ParameterError(
            f"parameter '{name}' is {text!r}, which is no list of corners; "
            'write it as "[[0.3, 0.2], [0.3, -0.2], [-0.3, -0.2], [-0.3, 0.2]]", m'
        )
    if len(corners) < 3:
        raise ParameterError(f"parameter '{name}' has {len(corners)} corners; it needs 3 or more")
    if inscribed_radius(corners) <= 0.0:
        raise ParameterError(
            f"parameter '{name}' is {text}: the origin of the robot is not inside of it"
        )
    return corners


def inscribed_radius(corners: Points) -> float:
    """
    Return the distance from the origin to the nearest edge, m; 0 if the origin is outside.

    For a convex polygon this is the radius that Nav2 calls inscribed.
    """
    starts, ends = corners, np.roll(corners, -1, axis=0)
    crosses = starts[:, 0] * ends[:, 1] - starts[:, 1] * ends[:, 0]
    if not (np.all(crosses > 0.0) or np.all(crosses < 0.0)):
        return 0.0
    lengths = np.hypot(*(ends - starts).T)
    return float(np.min(np.abs(crosses) / lengths))


def circumscribed_radius(corners: Points) -> float:
    """Return the distance from the origin to the farthest corner, m."""
    return float(np.max(np.hypot(corners[:, 0], corners[:, 1])))


def outline(corners: Points, spacing: float) -> Points:
    """Return points along the edges, no farther apart than ``spacing`` (m): (n, 2)."""
    pieces = []
    for start, end in zip(corners, np.roll(corners, -1, axis=0), strict=True):
        count = max(1, math.ceil(math.hypot(*(end - start)) / spacing))
        parts = np.arange(count)[:, None] / count
        pieces.append(start + parts * (end - start))
    return np.concatenate(pieces)


def placed(points: Points, pose: Pose) -> Points:
    """Return points of the base in the frame of ``pose``: (n, 2), m."""
    cos, sin = math.cos(pose.yaw), math.sin(pose.yaw)
    turned: Points = points @ np.array([[cos, sin], [-sin, cos]])
    return turned + (pose.x, pose.y)
