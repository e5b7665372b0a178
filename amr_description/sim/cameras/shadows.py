# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
What a light does not reach of what a camera sees.

Rays from the light, through the part of the world that the camera sees, end at what is lit; what
is behind that, on another shape, is in its shadow. So a shape throws none on itself.
"""

import mujoco
import numpy as np

from amr_description.sim.cameras.ray_caster import Eye, RayCaster
from amr_description.sim.cameras.screen import Screen

_DIRECTIONAL = int(mujoco.mjtLightType.mjLIGHT_DIRECTIONAL)
_SPOT = int(mujoco.mjtLightType.mjLIGHT_SPOT)
_RAYS = 320
"""In a row and in a column."""
_AFAR = 1000.0
"""How many times the size of what is seen a directional light is away from it."""
_CLEARANCE = 2e-3
"""m between a shape and what lies on it without a shadow."""


def shadow_light(model: mujoco.MjModel) -> int:
    """Return the light of which shadows are seen: the first that casts some; -1: there is none."""
    kinds = np.isin(model.light_type, (_DIRECTIONAL, _SPOT))
    lights = np.flatnonzero(kinds & (model.light_active != 0) & (model.light_castshadow != 0))
    return int(lights[0]) if len(lights) else -1


def in_shadow(
    caster: RayCaster,
    model: mujoco.MjModel,
    data: mujoco.MjData,
    light: int,
    geoms: np.ndarray,
    points: np.ndarray,
) -> np.ndarray:
    """
    Return which points a light does not reach, (n,).

    Args:
        caster: Of the scene.
        model: Has the light.
        data: Has its pose.
        light: Its id; directional, or a spot.
        geoms: (n,): on which geom each point is.
        points: (n, 3), in the world, m; at least one.
    """
    forward = data.light_xdir[light] / np.linalg.norm(data.light_xdir[light])
    turn = _turn_to(forward)
    low, high = points.min(axis=0).astype(float), points.max(axis=0).astype(float)
    if model.light_type[light] == _DIRECTIONAL:
        reach = _AFAR * (1.0 + float(np.linalg.norm(high - low)))
        origin = (low + high) / 2.0 - reach * forward
    else:
        origin = data.light_xpos[light].copy()
    seen = (points - origin) @ turn
    depth = seen[:, 0]
    is_ahead = depth > 0.0
    x, y = -seen[:, 1] / depth, -seen[:, 2] / depth
    if model.light_type[light] == _SPOT:
        limit = np.tan(np.radians(min(float(model.light_cutoff[light]), 80.0)))
        is_ahead &= (np.abs(x) <= limit) & (np.abs(y) <= limit)
    if not is_ahead.any():
        return np.zeros(len(points), bool)
    columns, across = _grid(x, is_ahead)
    rows, down = _grid(y, is_ahead)
    step = float(across[0, 1] - across[0, 0])
    ends = caster.cast(Screen(across, down.T, step), Eye(origin, turn, np.inf, -1, 0.0))
    is_behind = ends.depth[rows, columns] < depth - _CLEARANCE
    return np.asarray(is_behind & is_ahead & (ends.geoms()[rows, columns] != geoms))


def _grid(values: np.ndarray, is_used: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Return for each value the number of the ray next to it, and where the rays are, (1, n)."""
    low, high = float(values[is_used].min()), float(values[is_used].max())
    step = max((high - low) / _RAYS, 1e-12)
    number = np.where(is_used, (values - low) / step, 0.0).astype(np.intp)
    centres = low + step * (np.arange(_RAYS) + 0.5)
    return np.minimum(number, _RAYS - 1), centres[np.newaxis]


def _turn_to(forward: np.ndarray) -> np.ndarray:
    """Return axes (3, 3) of which the first, x, is a direction: from them to the world."""
    aside = np.cross((0.0, 0.0, 1.0) if abs(forward[2]) < 0.9 else (1.0, 0.0, 0.0), forward)
    aside /= np.linalg.norm(aside)
    return np.column_stack((forward, aside, np.cross(forward, aside)))
