# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""Where the links of a robot are for given joint positions."""

from collections.abc import Mapping
import math
from typing import TYPE_CHECKING

from amr_description.model.frames import multiply, Transform

if TYPE_CHECKING:
    from amr_description.model.robot import Joint, Robot


def joint_transform(joint: 'Joint', position: float = 0.0) -> Transform:
    """
    Return ``transform_child_to_parent`` of a joint at ``position`` (rad; m for a prismatic joint).

    It is origin ∘ motion along or about the axis. Fixed, planar and floating joints have no single
    coordinate and stay at their origin, as KDL has it.
    """
    origin = joint.origin
    if joint.type in ('revolute', 'continuous'):
        x, y, z = joint.axis
        sine = math.sin(position / 2.0)
        turn = (x * sine, y * sine, z * sine, math.cos(position / 2.0))
        return Transform(origin.translation, multiply(origin.rotation, turn))
    if joint.type == 'prismatic':
        x, y, z = joint.axis
        return Transform(origin.apply((x * position, y * position, z * position)), origin.rotation)
    return origin


def joint_position(joint: 'Joint', positions: Mapping[str, float]) -> float:
    """
    Return where a joint stands, given the known positions by joint name; unknown ones stand at 0.

    A mimic joint that is not in ``positions`` itself follows: multiplier · source + offset (one
    level, as URDF).
    """
    if joint.name in positions or joint.mimic is None:
        return positions.get(joint.name, 0.0)
    return joint.mimic.multiplier * positions.get(joint.mimic.joint, 0.0) + joint.mimic.offset


def link_poses(
    robot: 'Robot', positions: Mapping[str, float] | None = None
) -> dict[str, Transform]:
    """Return ``transform_link_to_root`` of every link; joints that are not given stand at 0."""
    poses = {link.name: Transform() for link in robot.roots}
    for _, joint in robot.walk():
        moved = joint_transform(joint, joint_position(joint, positions or {}))
        poses[joint.child] = poses[joint.parent] @ moved
    return poses
