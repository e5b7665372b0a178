# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""
Whether a robot on wheels stands as it should on its ground: it may rear up, or lie on its side.

A robot on a ramp is not tilted against its ground, nor is one with two wheels on a kerb: the
ground is the plane through the points at which the robot is touched, whatever is there.
"""

from dataclasses import dataclass
import math

import mujoco
import numpy as np

LIMIT = 0.2
"""rad between the robot's z and the normal of the ground; suspensions give less."""

_SPREAD = 0.02
"""m, root of the mean square; points that are closer to one line make no plane."""

_UPRIGHT = math.cos(LIMIT)


@dataclass(frozen=True, slots=True)
class Tilt:
    """The attitude of a robot against its ground, rad, as roll and pitch of ROS (nose up: < 0)."""

    roll: float
    pitch: float

    def __str__(self) -> str:
        roll, pitch = round(math.degrees(self.roll)), round(math.degrees(self.pitch))
        return f'pitch {pitch} deg (nose {"up" if pitch < 0 else "down"}), roll {roll} deg'

    @property
    def likely_cause(self) -> str:
        """What a robot that drives has done, and what would do."""
        if abs(self.roll) > abs(self.pitch):
            does, limits = 'turns', 'angular.z.max_velocity and angular.z.max_acceleration'
        elif self.pitch < 0.0:
            does, limits = 'speeds up', 'linear.x.max_acceleration'
        else:
            does = 'brakes, or speeds up backwards,'
            limits = 'linear.x.max_deceleration and linear.x.max_acceleration_reverse'
        return (
            f'it {does} harder than its centre of mass allows: limit {limits} of the '
            'diff_drive_controller, or have that centre lower and further from the axle'
        )


def tilt(model: mujoco.MjModel, data: mujoco.MjData, position: int) -> Tilt | None:
    """
    Return how a robot is tilted against its ground; None: by less than the limit, or in the air.

    Args:
        model: Of the world.
        data: Its present state.
        position: Index into ``qpos`` of the robot's free joint.
    """
    axes = np.empty(9)
    mujoco.mju_quat2Mat(axes, data.qpos[position + 3 : position + 7])
    if axes[8] > _UPRIGHT:  # against the horizon: of most robots, at most times
        return None
    normal = _ground_normal(model, data, int((model.jnt_qposadr <= position).sum()) - 1)
    if normal is None:
        return None
    x, y, z = (normal @ axes.reshape(3, 3)).tolist()
    if z > _UPRIGHT:
        return None
    return Tilt(roll=math.atan2(y, z), pitch=math.atan2(-x, math.hypot(y, z)))


def _ground_normal(model: mujoco.MjModel, data: mujoco.MjData, joint: int) -> np.ndarray | None:
    """Return the unit normal of the ground below the robot of a free joint, upwards, if any."""
    root = model.jnt_bodyid[joint]
    is_own = model.body_rootid[model.geom_bodyid[data.contact.geom]] == root
    touching = is_own[:, 0] != is_own[:, 1]
    points = data.contact.pos[touching]
    if not len(points):
        return None
    _, spread, directions = np.linalg.svd(points - points.mean(axis=0), full_matrices=False)
    if len(spread) > 1 and spread[1] > _SPREAD * math.sqrt(len(points)):
        normal = directions[2]
    else:
        normals = data.contact.frame[touching, :3]
        normal = (normals * np.sign(normals[:, 2:])).sum(axis=0)
    length = float(np.linalg.norm(normal)) * (1.0 if normal[2] > 0.0 else -1.0)
    return normal / length if length else None
