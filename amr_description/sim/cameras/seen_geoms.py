# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
What cameras see of a model: its visible shapes, not those that only collide.

Of a robot its visuals, as in Gazebo; of a world what MuJoCo's viewer shows: groups 0 to 2. What is
fully transparent is not seen.
"""

import copy

import mujoco
import numpy as np

SEEN, HIDDEN = 0, 5
"""Geom groups of :func:`seen_model`."""
SEEN_GROUPS = np.array([1, 0, 0, 0, 0, 0], np.uint8)
"""For ``mj_multiRay``."""

_VISUAL = 1
"""The group of what MuJoCo makes of a ``<visual>``."""
_SHOWN_GROUPS = (0, 1, 2)


def seen_model(model: mujoco.MjModel, robots: frozenset[str]) -> mujoco.MjModel:
    """
    Return a copy of a model of which the geoms are in the groups :data:`SEEN` and :data:`HIDDEN`.

    Args:
        model: Of the world; it stays as it is.
        robots: The names of robots: their bodies begin with one and a slash.
    """
    own = copy.copy(model)
    names = [model.body(body).name for body in range(model.nbody)]
    is_robot = np.array([name.partition('/')[0] in robots and '/' in name for name in names])
    of_robot = is_robot[model.geom_bodyid]
    groups = model.geom_group
    is_seen = np.where(of_robot, groups == _VISUAL, np.isin(groups, _SHOWN_GROUPS))
    has_material = model.geom_matid >= 0
    alpha = model.geom_rgba[:, 3].copy()
    if model.nmat:
        alpha[has_material] = model.mat_rgba[model.geom_matid[has_material], 3]
    own.geom_group[:] = np.where(is_seen & (alpha > 0.0), SEEN, HIDDEN)
    return own
